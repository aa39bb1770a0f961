// SPDX-License-Identifier: BSD-3-Clause
// Particle temperature against time, and its distribution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::RunResult;

namespace {

constexpr double left = 19, bottom = 11;

/// Panels of curves against one abscissa: a panel a type with all runs, or, of a single run, one
/// panel with all types.
struct TypedCurve {
  std::string label;
  std::size_t style = 0;
  std::size_t run = 0;
  std::string type;
};
struct TypedPanel {
  std::string title;
  std::vector<TypedCurve> curves;
};

template <class Has>
std::vector<TypedPanel> typed_panels(Runs runs, Has has) {
  std::vector<std::string> types{"all"};
  for (const std::string& name : species_names(runs)) types.push_back(name);
  std::vector<TypedPanel> panels;
  for (std::size_t t = 0; t < types.size(); ++t) {
    const std::string words = species_title(types[t]);
    TypedPanel panel{types.size() == 1 ? "" : words, {}};
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (!has(runs[r], types[t])) continue;
      const bool single = runs.size() == 1;
      panel.curves.push_back({single ? words : runs[r].label, single ? t : r, r, types[t]});
    }
    if (panel.curves.empty()) continue;
    if (runs.size() == 1 && !panels.empty()) {
      panels[0].curves.push_back(panel.curves[0]);
    } else {
      if (runs.size() == 1) panel.title.clear();
      panels.push_back(std::move(panel));
    }
  }
  return panels;
}

std::vector<LegendEntry> typed_legend(std::span<const TypedPanel> panels) {
  std::vector<LegendEntry> entries;
  for (const TypedPanel& panel : panels) {
    if (panel.curves.size() <= entries.size()) continue;
    entries.clear();
    for (const TypedCurve& curve : panel.curves) {
      entries.push_back({curve_style(curve.style).line + " lw 1.3", "", curve.label});
    }
  }
  if (entries.size() < 2) entries.clear();
  return entries;
}

/// The panels one below the other with common axes; `layers` draws the curves of one.
template <class Layers>
Canvas stacked(std::span<const TypedPanel> panels, const Axis& x, const Axis& y,
               const std::string& x_label, const std::string& y_label, double width,
               double row_height, Layers layers) {
  const double title_room = panels.size() > 1 ? 5.5 : 2;
  const std::vector<LegendEntry> entries = typed_legend(panels);
  const double legend = entries.empty() ? 0 : Canvas::legend_height(entries, width - left) + 1;
  const double each = row_height + title_room;
  Canvas canvas(width, bottom + each * static_cast<double>(panels.size()) + legend);
  if (legend > 0) canvas.legend(entries, left, canvas.height() - 0.5, width - left);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    Panel panel;
    panel.left = left;
    panel.bottom = bottom + each * static_cast<double>(panels.size() - 1 - p);
    panel.width = width - left - 4;
    panel.height = row_height;
    panel.x = x;
    panel.y = y;
    panel.x_numbers = p + 1 == panels.size();
    if (panel.x_numbers) panel.x_label = literal(x_label);
    panel.y_label = literal(y_label);
    panel.y_label_gap = 15;
    canvas.open(panel);
    if (panels.size() > 1) {
      canvas.user_label(shortened(panels[p].title, panel.width), left,
                        panel.bottom + row_height + 2.4, "left");
    }
    canvas.draw(layers(canvas, panels[p]));
  }
  return canvas;
}

}  // namespace

Figure temperature_figure(Runs runs) {
  const std::string name = "temperature", title = "Particle temperature";
  Range time, kelvin;
  for (const RunResult& run : runs) {
    for (const analysis::TemperatureSample& sample : run.temperature) {
      time.add(sample.time);
      kelvin.add(sample.mean - sample.std);
      kelvin.add(sample.mean + sample.std);
    }
  }
  if (kelvin.empty()) return left_out(name, title, "no temperature column");
  const auto panels = typed_panels(runs, [](const RunResult& run, const std::string& type) {
    return std::any_of(run.temperature.begin(), run.temperature.end(),
                       [&](const auto& sample) { return sample.type == type; });
  });
  const auto layers = [&](Canvas& canvas, const TypedPanel& panel) {
    shade_windows(canvas, runs);
    std::vector<std::string> bands, lines;
    for (const TypedCurve& curve : panel.curves) {
      Samples mean, spread;
      for (const auto& sample : runs[curve.run].temperature) {
        if (sample.type != curve.type) continue;
        mean.emplace_back(sample.time, sample.mean);
        spread.emplace_back(sample.time, sample.std);
      }
      // Mean and spread are smooth: every n-th sample shows them.
      const std::size_t every = mean.size() / 1500 + 1;
      std::vector<double> times, low, high;
      std::string rows;
      for (std::size_t i = 0; i < mean.size(); i += every) {
        times.push_back(mean[i].first);
        low.push_back(mean[i].second - spread[i].second);
        high.push_back(mean[i].second + spread[i].second);
        rows +=
            fmt::format("{:.10g} {:.7g} {:.7g}\n", mean[i].first, mean[i].second, spread[i].second);
      }
      const CurveStyle style = curve_style(curve.style);
      if (const std::string band = band_outline(times, low, high); !band.empty()) {
        bands.push_back(Canvas::layer(
            canvas.block("band of " + curve.label + ": temperature, time", band),
            fmt::format("using 2:1 with filledcurves closed fs transparent solid 0.2 noborder fc "
                        "rgb '{}'",
                        style.colour)));
      }
      lines.push_back(Canvas::layer(canvas.block(curve.label + ": time, mean, std", rows),
                                    fmt::format("using 1:2 with lines {} lw 1.3", style.line)));
    }
    bands.insert(bands.end(), lines.begin(), lines.end());
    return bands;
  };
  const Canvas canvas =
      stacked(panels, exact_axis(time.lo, time.hi, 8),
              rounded_axis(kelvin.padded().lo, kelvin.padded().hi, 5), time_label(runs),
              "temperature [K]", page_width, panels.size() == 1 ? 60 : 42, layers);
  return drawn(
      canvas, name, title,
      fmt::format("Mean particle temperature (line) and its spread over the particles (band: "
                  "± one standard deviation) in every snapshot; shaded: averaging window. {}.",
                  window_words(runs)));
}

Figure temperature_pdf_figure(Runs runs) {
  const std::string name = "temperature_pdf", title = "Distribution of particle temperature";
  const auto pdf_of = [](const RunResult& run, const std::string& type) {
    const analysis::SpeciesResult* one = find_species(run, type);
    return one == nullptr ? std::vector<double>{} : one->temperature_pdf;
  };
  const auto panels = typed_panels(runs, [&](const RunResult& run, const std::string& type) {
    return !pdf_of(run, type).empty();
  });
  if (panels.empty())
    return left_out(name, title, "no temperature column, or no temperature range chosen");
  Range density;
  density.add(0);
  for (const TypedPanel& panel : panels) {
    for (const TypedCurve& curve : panel.curves) {
      for (const double value : pdf_of(runs[curve.run], curve.type)) density.add(value);
    }
  }
  const auto layers = [&](Canvas& canvas, const TypedPanel& panel) {
    std::vector<std::string> lines;
    for (const TypedCurve& curve : panel.curves) {
      const std::vector<double> pdf = pdf_of(runs[curve.run], curve.type);
      const double width = 1.0 / static_cast<double>(pdf.size());
      // Drawn as steps from bin edge to bin edge.
      std::string rows = data_row({0, 0});
      for (std::size_t i = 0; i < pdf.size(); ++i) {
        rows += data_row({width * static_cast<double>(i), pdf[i]});
        rows += data_row({width * static_cast<double>(i + 1), pdf[i]});
      }
      rows += data_row({1, 0});
      lines.push_back(Canvas::layer(
          canvas.block(curve.label + ": temperature made dimensionless, probability density", rows),
          fmt::format("using 1:2 with lines {} lw 1.1", curve_style(curve.style).line)));
    }
    return lines;
  };
  const RunResult& first = runs[panels.front().curves.front().run];
  const Canvas canvas =
      stacked(panels, exact_axis(0, 1, 5), rounded_axis(0, density.hi, 5), "(T − T₀)/(T₁ − T₀) [-]",
              "probability density [-]", 110, panels.size() == 1 ? 60 : 42, layers);
  return drawn(
      canvas, name, title,
      fmt::format("Distribution of the particles' temperature over the window, T₀ = {} K and "
                  "T₁ = {} K. {}.",
                  number(first.temperature_from), number(first.temperature_to),
                  window_words(runs)));
}

}  // namespace bedscope::report
