// SPDX-License-Identifier: BSD-3-Clause
// The height of the bed in time; and which figures of a bed a page has.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::BedHeightSample;
using analysis::RunResult;

namespace {

/// The three definitions side by side in a panel; the expansion is the first of them again.
struct Curve {
  const char* label;
  double BedHeightSample::*value;
  const char* line;
};
constexpr Curve curves[] = {{"twice the height of the centre of mass", &BedHeightSample::by_centre,
                             "lc rgb '#0072B2' dt solid lw 1.1"},
                            {"surface: half the bed’s holdup", &BedHeightSample::surface,
                             "lc rgb '#D55E00' dt (8,3) lw 1.1"},
                            {"below it 95 % of the solids", &BedHeightSample::by_solids,
                             "lc rgb '#009E73' dt (2,2) lw 1.1"}};

bool asked(const RunResult& run) { return run.bed.asked && !run.bed.samples.empty(); }

}  // namespace

Figure bed_height_figure(Runs runs) {
  const std::string name = "bed_height", title = "Bed height";
  std::vector<const RunResult*> shown;
  Range time, height;
  for (const RunResult& run : runs) {
    if (!asked(run)) continue;
    shown.push_back(&run);
    for (const BedHeightSample& sample : run.bed.samples) {
      time.add(sample.time);
      for (const Curve& curve : curves) height.add(sample.*curve.value);
    }
  }
  if (height.empty()) return left_out(name, title, "no bed in the snapshots");
  const Unit unit = length_unit(height.hi);
  constexpr double left = 19, bottom = 11, right = 5, title_room = 5.5;
  std::vector<LegendEntry> entries;
  for (const Curve& curve : curves) entries.push_back({curve.line, "", curve.label});
  const double legend = Canvas::legend_height(entries, page_width - left) + 2;
  const auto n = static_cast<double>(shown.size());
  const double room = (page_height - bottom - legend) / n - title_room;
  const double row_height = std::min(shown.size() == 1 ? 55. : 38., room);
  const double each = row_height + title_room;
  Canvas canvas(page_width, bottom + each * n + legend);
  canvas.legend(entries, left, canvas.height() - 0.5, page_width - left);
  for (std::size_t r = 0; r < shown.size(); ++r) {
    const RunResult& run = *shown[r];
    Panel panel;
    panel.left = left;
    panel.bottom = bottom + each * (n - 1 - static_cast<double>(r));
    panel.width = page_width - left - right;
    panel.height = row_height;
    panel.x = exact_axis(time.lo, time.hi, 8);
    const Range padded = height.padded();
    panel.y = rounded_axis(unit.factor * std::max(0., padded.lo), unit.factor * padded.hi,
                           row_height < 25 ? 3 : 6);
    panel.x_numbers = r + 1 == shown.size();
    if (panel.x_numbers) panel.x_label = literal(time_label(runs));
    panel.y_label = literal(fmt::format("bed height [{}]", unit.name));
    panel.y_label_gap = 14;
    canvas.open(panel);
    shade_windows(canvas, {&run, 1});
    const std::string expansion = fmt::format("{}: mean height {} {}, expansion {}", run.label,
                                              plus_minus(run.bed.by_centre, unit.factor), unit.name,
                                              plus_minus(run.bed.expansion));
    canvas.user_label(shortened(expansion, panel.width), left, panel.bottom + row_height + 2.4,
                      "left");
    std::vector<std::string> layers;
    for (const Curve& curve : curves) {
      Samples samples;
      for (const BedHeightSample& sample : run.bed.samples)
        samples.emplace_back(sample.time, unit.factor * sample.*curve.value);
      const std::size_t block = canvas.block(fmt::format("{}: time, {}", run.label, curve.label),
                                             sample_rows(thinned(samples)));
      layers.push_back(Canvas::layer(block, fmt::format("using 1:2 with lines {}", curve.line)));
    }
    canvas.draw(layers);
  }
  return drawn(canvas, name, title,
               fmt::format("Height of the bed above the floor of the domain in every snapshot, by "
                           "three definitions; shaded: averaging window. Mean: twice the height of "
                           "the centre of mass over the window, with its 95 % confidence interval; "
                           "expansion: this over the height at rest. {}.",
                           window_words(runs)));
}

std::vector<Figure> bed_figures(Runs runs) {
  std::vector<Figure> figures;
  if (std::any_of(runs.begin(), runs.end(), asked)) figures.push_back(bed_height_figure(runs));
  if (std::any_of(runs.begin(), runs.end(),
                  [](const RunResult& run) { return run.bubbles.has_value(); })) {
    auto strips = bubble_strips(runs);
    std::move(strips.begin(), strips.end(), std::back_inserter(figures));
    figures.push_back(bubble_profile_figure(runs));
  }
  if (std::any_of(runs.begin(), runs.end(),
                  [](const RunResult& run) { return !run.fluctuations.empty(); }))
    figures.push_back(spectra_figure(runs));
  return figures;
}

}  // namespace bedscope::report
