// SPDX-License-Identifier: BSD-3-Clause
// Bubbles: their outlines in snapshots, and what they are like at each height.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"
#include "report/strip.hpp"

namespace bedscope::report {

using analysis::BubbleBand;
using analysis::Cluster;
using analysis::Estimate;
using analysis::Frame;
using analysis::RunResult;

namespace {

constexpr const char* free_line = "lc rgb '#0072B2' dt solid lw 1.3";
constexpr const char* wall_line = "lc rgb '#D55E00' dt (3,1.5) lw 1.3";

std::string bubble_words(const RunResult& run) {
  const auto& limits = run.bubbles->thresholds;
  return fmt::format("Bubbles: voidage > {} everywhere, > {} somewhere, area ≥ {} mm²",
                     number(limits.threshold), number(limits.core), number(1e6 * limits.min_area));
}

Figure bubble_strip(const RunResult& run, const std::string& name, const std::string& title) {
  Strip strip;
  strip.legend = {{free_line, "", "bubble"}, {wall_line, "", "at a wall or the floor"}};
  strip.draw_over = [&run](Canvas& canvas, const Frame& frame, const StripScale& scale,
                           const std::string& of, std::vector<std::string>& layers) {
    std::string outlines[2];
    for (const Cluster& bubble : run.bubbles->bubbles)
      if (bubble.snapshot == frame.snapshot)
        outlines[bubble.at_wall ? 1 : 0] += outline_rows(bubble, scale.x_factor, scale.z_factor);
    for (const std::size_t wall : {0, 1})
      if (!outlines[wall].empty())
        layers.push_back(Canvas::layer(
            canvas.block(fmt::format("outlines of bubbles{}, {}", wall ? " at walls" : "", of),
                         outlines[wall]),
            fmt::format("using 1:2 with lines {}", wall ? wall_line : free_line)));
  };
  strip.caption =
      fmt::format("with the outlines of bubbles (white is empty). {}", bubble_words(run));
  return strip_figure(run, strip, name, title);
}

/// A quantity against height.
struct Quantity {
  std::string label;
  Estimate BubbleBand::*value;
  double factor = 1;
  Range range;
};

std::vector<Estimate> values_of(const RunResult& run, const Quantity& quantity) {
  std::vector<Estimate> values;
  for (const BubbleBand& band : run.bubbles->bands) {
    const Estimate& one = band.*quantity.value;
    const bool seen = band.number.value > 0 || (band.*quantity.value).value > 0;
    values.push_back(seen ? Estimate{quantity.factor * one.value, quantity.factor * one.ci95}
                          : Estimate{});
  }
  return values;
}

}  // namespace

std::vector<Figure> bubble_strips(Runs runs) {
  const auto has = [](const RunResult& run) { return run.bubbles && !run.frames.empty(); };
  return figure_a_run(runs, "bubbles", "Snapshots with bubbles", has, bubble_strip);
}

Figure bubble_profile_figure(Runs runs) {
  const std::string name = "bubble_profile", title = "Bubbles against height";
  Range size, z;
  for (const RunResult& run : runs) {
    if (!run.bubbles) continue;
    for (const BubbleBand& band : run.bubbles->bands) {
      if (band.number.value > 0) size.add(band.diameter.value);
      z.add(band.height - band.width / 2);
      z.add(band.height + band.width / 2);
    }
  }
  if (size.empty()) return left_out(name, title, "no bubbles found");
  const Unit unit = length_unit(size.hi), z_unit = length_unit(z.hi - z.lo);
  std::vector<Quantity> quantities{
      {fmt::format("diameter [{}]", unit.name), &BubbleBand::diameter, unit.factor, {}},
      {"rise velocity [m/s]", &BubbleBand::velocity, 1, {}},
      {"frequency [1/s]", &BubbleBand::frequency, 1, {}},
      {"area fraction [-]", &BubbleBand::area_fraction, 1, {}}};
  for (Quantity& quantity : quantities) {
    quantity.range.add(0);
    for (const RunResult& run : runs)
      if (run.bubbles) add_estimates(quantity.range, values_of(run, quantity));
  }
  std::erase_if(quantities, [](const Quantity& one) { return one.range.hi <= one.range.lo; });

  constexpr double left = 15, bottom = 11, gap = 4, right = 4.5, height = 80;
  const std::vector<LegendEntry> entries = run_legend(runs, true);
  const double legend = runs.size() > 1 ? Canvas::legend_height(entries, page_width - left) + 1 : 0;
  Canvas canvas(page_width, bottom + height + 2 + legend);
  if (legend > 0) canvas.legend(entries, left, canvas.height() - 0.5, page_width - left);
  const auto n = static_cast<double>(quantities.size());
  const double width = (page_width - left - right + gap) / n - gap;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const Quantity& quantity = quantities[q];
    Panel panel;
    panel.left = left + static_cast<double>(q) * (width + gap);
    panel.bottom = bottom;
    panel.width = width;
    panel.height = height;
    panel.x = rounded_axis(quantity.range.lo, quantity.range.hi, 4);
    panel.y = exact_axis(z_unit.factor * z.lo, z_unit.factor * z.hi, 8);
    panel.neighbour = q + 1 < quantities.size();
    panel.y_numbers = q == 0;
    panel.x_label = literal(quantity.label);
    if (q == 0) panel.y_label = literal(fmt::format("height z [{}]", z_unit.name));
    canvas.open(panel);
    std::vector<std::string> back, front;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (!runs[r].bubbles) continue;
      const CurveStyle style = curve_style(r);
      const auto values = values_of(runs[r], quantity);
      std::vector<double> heights;
      std::string rows;
      for (std::size_t b = 0; b < values.size(); ++b) {
        heights.push_back(runs[r].bubbles->bands[b].height);
        rows += data_row({values[b].value, z_unit.factor * heights[b], values[b].ci95});
      }
      const std::string of = runs[r].label + ": " + quantity.label + ", height";
      if (const auto band = estimate_band(heights, values, z_unit.factor); !band.empty())
        back.push_back(Canvas::layer(canvas.block("band of " + of, band),
                                     fmt::format("using 1:2 {}", band_words(style.colour))));
      front.push_back(Canvas::layer(
          canvas.block(of + ", ci95", rows),
          fmt::format("using 1:2 with linespoints {} lw 1.0 {}", style.line, style.marker)));
    }
    back.insert(back.end(), front.begin(), front.end());
    canvas.draw(back);
  }
  const auto first =
      std::find_if(runs.begin(), runs.end(), [](const RunResult& run) { return run.bubbles; });
  return drawn(
      canvas, name, title,
      fmt::format(
          "Mean equivalent diameter and rise velocity of the bubbles whose centroid lies in "
          "a band of {} mm around each height, how many pass that height a second over the "
          "whole width, and the share of the band that bubbles cover; band: {}. {}. {}.",
          number(1e3 * first->bubbles->bands.front().width), interval_words, bubble_words(*first),
          window_words(runs)));
}

}  // namespace bedscope::report
