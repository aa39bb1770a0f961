// SPDX-License-Identifier: BSD-3-Clause
// What changes in time: inventory and cluster occurrence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::RunResult;

namespace {

constexpr double left = 19, bottom = 11, gap = 4.5;

/// Brackets above a panel that mark the windows; those that differ in their runs' colours.
double bracket_room(Runs runs) {
  return same_windows(runs) ? 5.5 : 2 + 1.8 * static_cast<double>(runs.size());
}
void mark_windows(Canvas& canvas, Runs runs, const Panel& panel) {
  const bool same = same_windows(runs);
  const double top = panel.bottom + panel.height;
  for (std::size_t r = 0; r < (same ? 1 : runs.size()); ++r) {
    const analysis::Window& window = runs[r].window;
    if (window.snapshots == 0) continue;
    const double y = (top + 1.4 + (same ? 0 : 1.8 * static_cast<double>(r))) / canvas.height();
    canvas.command(
        fmt::format("set arrow from first {:.10g}, screen {:.5f} to first {:.10g}, "
                    "screen {:.5f} heads size screen {:.5f},90 lw 1.2 lc rgb '{}'",
                    window.from, y, window.to, y, 0.7 / canvas.width(),
                    same ? "#000000" : curve_style(r).colour));
    if (!same) continue;
    const double middle = 0.5 * (window.from + window.to);
    const double x = panel.left + panel.width * (middle - panel.x.lo) / (panel.x.hi - panel.x.lo);
    const double half = text_width("averaging window") / 2;
    canvas.label("'averaging window'",
                 std::clamp(x, panel.left + half, panel.left + panel.width - half), top + 4);
  }
}

/// One row of the inventory figure: a quantity of all runs against time.
struct Row {
  std::string label;
  std::vector<Samples> runs;
  Range range;
};

Row inventory_row(Runs runs, std::string label, double factor,
                  double analysis::InventorySample::*value) {
  Row row{std::move(label), {}, {}};
  for (const RunResult& run : runs) {
    Samples samples;
    for (const analysis::InventorySample& sample : run.inventory) {
      if (sample.type != "all") continue;
      samples.emplace_back(sample.time, factor * sample.*value);
      row.range.add(factor * sample.*value);
    }
    row.runs.push_back(thinned(samples));
  }
  return row;
}

}  // namespace

Figure inventory_figure(Runs runs) {
  const std::string name = "inventory", title = "Inventory";
  Range time;
  double most_mass = 0;
  bool density = true;
  for (const RunResult& run : runs) {
    density = density && run.density_known;
    for (const auto& sample : run.inventory) {
      time.add(sample.time);
      if (std::isfinite(sample.solids_mass)) most_mass = std::max(most_mass, sample.solids_mass);
    }
  }
  if (time.empty()) return left_out(name, title, "no inventory in the results");
  const Unit mass = mass_unit(most_mass);
  const Range z = domain_range(runs, analysis::up);
  const Unit length = length_unit(z.hi - z.lo);
  using Sample = analysis::InventorySample;
  std::vector<Row> rows;
  rows.push_back(density ? inventory_row(runs, fmt::format("solids mass [{}]", mass.name),
                                         mass.factor, &Sample::solids_mass)
                         : inventory_row(runs, holdup_label(runs), 1, &Sample::holdup));
  rows.push_back(inventory_row(runs, fmt::format("mean height [{}]", length.name), length.factor,
                               &Sample::mean_height));
  std::erase_if(rows, [](const Row& row) { return row.range.empty(); });
  if (rows.empty()) return left_out(name, title, "no particles in the snapshots");

  constexpr double row_height = 42;
  const auto n = static_cast<double>(rows.size());
  const std::vector<LegendEntry> entries = run_legend(runs, false);
  const double legend = runs.size() > 1 ? Canvas::legend_height(entries, page_width - left) + 1 : 0;
  Canvas canvas(page_width,
                bottom + n * (row_height + gap) - gap + bracket_room(runs) + 1 + legend);
  if (legend > 0) canvas.legend(entries, left, canvas.height() - 0.5, page_width - left);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    Panel panel;
    panel.left = left;
    panel.bottom = bottom + (n - 1 - static_cast<double>(q)) * (row_height + gap);
    panel.width = page_width - left - 4;
    panel.height = row_height;
    panel.x = exact_axis(time.lo, time.hi, 8);
    const Range padded = rows[q].range.padded();
    panel.y = rounded_axis(padded.lo, padded.hi, 5);
    panel.x_numbers = q + 1 == rows.size();
    if (panel.x_numbers) panel.x_label = literal(time_label(runs));
    panel.y_label = literal(rows[q].label);
    panel.y_label_gap = 15;
    canvas.open(panel);
    shade_windows(canvas, runs);
    if (q == 0) mark_windows(canvas, runs, panel);
    std::vector<std::string> layers;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const std::size_t block =
          canvas.block(runs[r].label + ": time, " + rows[q].label, sample_rows(rows[q].runs[r]));
      layers.push_back(
          Canvas::layer(block, fmt::format("using 1:2 with lines {} lw 1.0", curve_style(r).line)));
    }
    canvas.draw(layers);
  }
  return drawn(canvas, name, title,
               fmt::format("{} and mean height of all particles of the dump, in every snapshot; "
                           "shaded: averaging window{}. {}.",
                           density ? "Solids mass" : "Holdup of the domain (no density is known)",
                           same_windows(runs) ? "" : "s, brackets in the runs’ colours",
                           window_words(runs)));
}

Figure occurrence_figure(Runs runs) {
  const std::string name = "occurrence", title = "Cluster occurrence";
  Range time, clusters;
  for (const RunResult& run : runs) {
    for (const analysis::OccurrenceSample& sample : run.occurrence) {
      time.add(sample.time);
      clusters.add(sample.clusters);
    }
  }
  if (time.empty()) return left_out(name, title, "clusters were not looked for");
  if (clusters.hi == 0) return left_out(name, title, "no clusters found");

  constexpr double right = 27, title_room = 5.5;
  const double row_height = runs.size() == 1 ? 45 : runs.size() <= 4 ? 30 : 22;
  const double each = row_height + title_room;
  Canvas canvas(page_width, bottom + each * static_cast<double>(runs.size()) + 1);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RunResult& run = runs[r];
    Panel panel;
    panel.left = left;
    panel.bottom = bottom + each * static_cast<double>(runs.size() - 1 - r);
    panel.width = page_width - left - right;
    panel.height = row_height;
    panel.x = exact_axis(time.lo, time.hi, 8);
    panel.y = rounded_axis(0, 1.08 * clusters.hi, row_height < 25 ? 3 : 5);
    if (panel.y.step < 1) panel.y = {0, clusters.hi + 0.5, 0, 1, clusters.hi, 0};
    panel.x_numbers = r + 1 == runs.size();
    if (panel.x_numbers) panel.x_label = literal(time_label(runs));
    panel.y_label = literal("clusters [-]");
    panel.y_label_gap = 12;
    canvas.open(panel);
    shade_windows(canvas, runs.subspan(r, 1));
    canvas.user_label(shortened(run.label, panel.width), left, panel.bottom + row_height + 2.4,
                      "left");
    Samples samples;
    for (const auto& sample : run.occurrence) samples.emplace_back(sample.time, sample.clusters);
    const std::size_t block =
        canvas.block(run.label + ": time, clusters", sample_rows(thinned(samples)));
    const std::string colour = curve_style(r).colour;
    std::vector<std::string> layers{
        Canvas::layer(block, fmt::format("using 1:2 with steps lw 0.6 lc rgb '{}'", colour))};
    const analysis::Estimate& mean = run.mean_occurrence;
    if (std::isfinite(mean.value) && run.window.snapshots > 0) {
      const double half = std::isfinite(mean.ci95) ? mean.ci95 : 0;
      const std::size_t line = canvas.block(
          run.label + ": window, mean, lower and upper end of its interval",
          data_row({run.window.from, mean.value, mean.value - half, mean.value + half}) +
              data_row({run.window.to, mean.value, mean.value - half, mean.value + half}));
      for (const char* bound : {"1:3", "1:4"}) {
        layers.push_back(Canvas::layer(
            line, fmt::format("using {} with lines dt (4,3) lw 0.9 lc rgb '#000000'", bound)));
      }
      layers.push_back(Canvas::layer(line, "using 1:2 with lines lw 1.6 lc rgb '#000000'"));
      const double y =
          panel.bottom + row_height * (mean.value - panel.y.lo) / (panel.y.hi - panel.y.lo);
      canvas.label(literal(plus_minus(mean)), panel.left + panel.width + 2, y, "left");
    }
    canvas.draw(layers);
  }
  return drawn(canvas, name, title,
               fmt::format("Clusters in each snapshot; black: mean over the averaging window "
                           "(shaded, and at the right) and, dashed, the bounds of its 95 % "
                           "confidence interval. {}. {}. {}.",
                           threshold_words(runs), window_words(runs), mapping_words(runs)));
}

}  // namespace bedscope::report
