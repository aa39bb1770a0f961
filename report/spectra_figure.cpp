// SPDX-License-Identifier: BSD-3-Clause
// Power spectral densities, a panel a signal, all runs overlaid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Fluctuation;
using analysis::RunResult;

namespace {

constexpr std::size_t most_panels = 8;  // of a page: probes may be many

bool has_spectrum(const Fluctuation& one) { return one.spectrum.frequency.size() > 2; }

/// The signals of all runs with their units, in order of appearance.
std::vector<std::pair<std::string, std::string>> signals_of(Runs runs) {
  std::vector<std::pair<std::string, std::string>> signals;
  for (const RunResult& run : runs)
    for (const Fluctuation& one : run.fluctuations) {
      const std::pair signal(one.signal, one.unit);
      if (has_spectrum(one) && std::find(signals.begin(), signals.end(), signal) == signals.end())
        signals.push_back(signal);
    }
  return signals;
}

const Fluctuation* find_signal(const RunResult& run, const std::string& name) {
  for (const Fluctuation& one : run.fluctuations)
    if (one.signal == name && has_spectrum(one)) return &one;
  return nullptr;
}

std::string density_unit(const std::string& unit) {
  return unit == "-" ? "1/Hz" : fmt::format("{}²/Hz", unit);
}

void add_curve(Canvas& canvas, const std::string& label, std::size_t run, const Fluctuation& one,
               std::vector<std::string>& back, std::vector<std::string>& front) {
  const auto& spectrum = one.spectrum;
  const CurveStyle style = curve_style(run);
  std::string rows;
  for (std::size_t k = 1; k < spectrum.frequency.size(); ++k)
    rows +=
        data_row({spectrum.frequency[k], spectrum.density[k], spectrum.low[k], spectrum.high[k]});
  const std::size_t block = canvas.block(
      fmt::format("{}, {}: frequency, density, lower and upper bound", label, one.signal), rows);
  back.push_back(Canvas::layer(
      block, fmt::format("using 1:3:4 with filledcurves fs transparent solid 0.25 noborder fc rgb "
                         "'{}'",
                         style.colour)));
  front.push_back(Canvas::layer(block, fmt::format("using 1:2 with lines {} lw 1.0", style.line)));
}

}  // namespace

Figure spectra_figure(Runs runs) {
  const std::string name = "spectra", title = "Spectra of fluctuations";
  auto signals = signals_of(runs);
  if (signals.empty()) return left_out(name, title, "no signal fluctuates over enough samples");
  const std::size_t all = signals.size();
  if (all > most_panels) signals.resize(most_panels);

  constexpr double left = 19, bottom = 12, gap_x = 23, gap_z = 20, right = 4, top = 6, height = 50;
  const std::size_t columns = signals.size() == 1 ? 1 : 2;
  const std::size_t rows = (signals.size() + columns - 1) / columns;
  const std::vector<LegendEntry> entries = run_legend(runs, false);
  const double legend = runs.size() > 1 ? Canvas::legend_height(entries, page_width - left) + 1 : 0;
  Canvas canvas(page_width,
                bottom + static_cast<double>(rows) * (height + gap_z) - gap_z + top + legend);
  if (legend > 0) canvas.legend(entries, left, canvas.height() - 0.5, page_width - left);
  const double width = (page_width - left - right + gap_x) / static_cast<double>(columns) - gap_x;
  for (std::size_t s = 0; s < signals.size(); ++s) {
    Range frequency, density;
    std::vector<std::string> back, front;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Fluctuation* one = find_signal(runs[r], signals[s].first);
      if (one == nullptr) continue;
      frequency.add(one->spectrum.frequency[1]);
      frequency.add(one->spectrum.frequency.back());
      for (std::size_t k = 1; k < one->spectrum.density.size(); ++k) {
        // What is lower than this is rounding: the window's side lobes.
        const double most =
            one->dominant.value > 0
                ? *std::max_element(one->spectrum.density.begin() + 1, one->spectrum.density.end())
                : 0;
        if (one->spectrum.density[k] > 1e-10 * most) density.add(one->spectrum.density[k]);
      }
      add_curve(canvas, runs[r].label, r, *one, back, front);
    }
    Panel panel;
    panel.left = left + static_cast<double>(s % columns) * (width + gap_x);
    panel.bottom = bottom + static_cast<double>(rows - 1 - s / columns) * (height + gap_z);
    panel.width = width;
    panel.height = height;
    panel.x = log_axis(frequency.lo, frequency.hi);
    panel.x.lo = frequency.lo;
    panel.x.hi = frequency.hi;
    panel.y = log_axis(density.lo, 2 * density.hi);
    panel.x_label = literal("frequency [Hz]");
    panel.y_label = literal(fmt::format("density [{}]", density_unit(signals[s].second)));
    panel.y_label_gap = 14;
    canvas.open(panel);
    canvas.user_label(shortened(signals[s].first, width), panel.left + width / 2,
                      panel.bottom + height + 2.6);
    back.insert(back.end(), front.begin(), front.end());
    canvas.draw(back);
  }
  return drawn(
      canvas, name, title,
      fmt::format("One-sided power spectral density by Welch’s method (Hann window, segments that "
                  "overlap by half, a straight line taken off each); band: its 95 % confidence "
                  "interval. {}.{}",
                  window_words(runs),
                  all > most_panels ? fmt::format(" {} of {} signals.", most_panels, all) : ""));
}

}  // namespace bedscope::report
