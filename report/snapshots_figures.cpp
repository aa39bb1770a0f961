// SPDX-License-Identifier: BSD-3-Clause
// Snapshots side by side, with outlines and ellipses of their clusters.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Cluster;
using analysis::Frame;
using analysis::Point;
using analysis::RunResult;

namespace {

constexpr double arrow_length = 3.4, arrow_gap = 1;  // [mm]
constexpr std::size_t most_arrows = 40;              // in a frame: more would hide it
/// Lifts the pen. Not a blank line: in a file with blank lines inside blocks gnuplot miscounts the
/// matrices that follow.
const std::string gap_row = "nan nan\n";

/// What is drawn over one frame: outlines, ellipses and arrows of both directions.
struct Overlay {
  std::size_t clusters = 0;
  std::string contours;
  std::string ellipses[2], arrows[2];  ///< upward, downward
};

std::string ellipse_rows(const Cluster& cluster, double x_factor, double z_factor) {
  constexpr int corners = 40;
  std::string rows;
  for (int i = 0; i <= corners; ++i) {
    const double phase = 2 * std::numbers::pi * i / corners;
    const double along = 0.5 * cluster.major * std::cos(phase);
    const double across = 0.5 * cluster.minor * std::sin(phase);
    const double c = std::cos(cluster.angle), s = std::sin(cluster.angle);
    rows += data_row({x_factor * (cluster.centre.x + along * c - across * s),
                      z_factor * (cluster.centre.z + along * s + across * c)});
  }
  return rows + gap_row;
}

/// `arrow` is the length of the arrows and `beside` their distance, in units of the axes.
Overlay overlay(const RunResult& run, const Frame& frame, double x_factor, double z_factor,
                double arrow, double beside) {
  Overlay found;
  for (const Cluster& cluster : run.clusters) {
    if (cluster.snapshot != frame.snapshot) continue;
    ++found.clusters;
    for (const auto& contour : cluster.contours) {
      for (const Point& point : contour) {
        found.contours += data_row({x_factor * point.x, z_factor * point.z});
      }
      if (!contour.empty()) {  // closed, whether or not the first point is repeated
        found.contours +=
            data_row({x_factor * contour.front().x, z_factor * contour.front().z}) + gap_row;
      }
    }
    const std::size_t way = cluster.velocity_z < 0 ? 1 : 0;
    if (std::isfinite(cluster.major) && std::isfinite(cluster.angle)) {
      found.ellipses[way] += ellipse_rows(cluster, x_factor, z_factor);
    }
    // Beside the ellipse, to the right where there is room.
    const double reach = std::hypot(0.5 * cluster.major * std::cos(cluster.angle),
                                    0.5 * cluster.minor * std::sin(cluster.angle));
    const double aside = (std::isfinite(reach) ? reach : 0) + beside / x_factor;
    const bool right =
        cluster.centre.x + aside + beside / x_factor < run.grid.max[analysis::lateral];
    const double x = cluster.centre.x + (right ? aside : -aside);
    const double length = way == 0 ? arrow : -arrow;
    found.arrows[way] +=
        data_row({x_factor * x, z_factor * cluster.centre.z - length / 2, 0, length});
  }
  return found;
}

constexpr std::string_view up_line = "lc rgb '#009E73' dt solid lw 1.3";
constexpr std::string_view down_line = "lc rgb '#D55E00' dt (2,1.2) lw 1.3";

void overlay_layers(Canvas& canvas, const Overlay& overlay, const std::string& of,
                    std::vector<std::string>& layers) {
  const auto add = [&](const std::string& what, const std::string& rows, std::string_view words) {
    if (!rows.empty()) layers.push_back(Canvas::layer(canvas.block(what + of, rows), words));
  };
  add("outlines of clusters, ", overlay.contours, "using 1:2 with lines lc rgb '#000000' lw 0.5");
  for (const std::size_t way : {0, 1}) {
    const std::string name = way == 0 ? "upward" : "downward";
    const std::string_view line = way == 0 ? up_line : down_line;
    const std::string colour = way == 0 ? "#009E73" : "#D55E00";
    add("ellipses of " + name + " clusters, ", overlay.ellipses[way],
        fmt::format("using 1:2 with lines {}", line));
    if (overlay.arrows[way].empty() || overlay.clusters > most_arrows) continue;
    const std::size_t block =
        canvas.block(fmt::format("arrows of {} clusters, {}", name, of), overlay.arrows[way]);
    const double head = 1.3 / canvas.width();
    layers.push_back(Canvas::layer(
        block,
        fmt::format("using 1:2:3:4 with vectors head filled size screen {:.5f},24 lw 2.6 lc rgb "
                    "'#FFFFFF'",
                    head)));
    layers.push_back(Canvas::layer(
        block,
        fmt::format("using 1:2:3:4 with vectors head filled size screen {:.5f},24 lw 1.3 lc rgb "
                    "'{}'",
                    head, colour)));
  }
}

/// Decimals that give the frames' times as they are, four at most.
int time_decimals(const RunResult& run) {
  int decimals = 0;
  for (double unit = 1; decimals < 4; ++decimals, unit /= 10) {
    const auto whole = [&](const Frame& frame) {
      return std::abs(frame.time / unit - std::round(frame.time / unit)) * unit < 1e-6;
    };
    if (std::all_of(run.frames.begin(), run.frames.end(), whole)) break;
  }
  return decimals;
}

Figure snapshots_figure(const RunResult& run, const std::string& name, const std::string& title) {
  using enum analysis::Axis;
  constexpr double left = 15, bottom = 11, gap_x = 2.5, gap_z = 5, top = 19;
  const std::size_t count = std::min<std::size_t>(run.frames.size(), 8);
  const double lx = run.grid.length(lateral), lz = run.grid.length(up);
  const PanelGrid grid = arrange_panels(count, lx, lz, page_width - left - 2 + gap_x,
                                        page_height - bottom - top, gap_x, gap_z);
  const auto rows = static_cast<double>(grid.rows);
  Canvas canvas(page_width, bottom + rows * (grid.height + gap_z) + top);

  const Unit x_unit = length_unit(lx), z_unit = length_unit(lz);
  std::vector<double> values;
  for (const Frame& frame : run.frames)
    values.insert(values.end(), frame.holdup.begin(), frame.holdup.end());
  const Range range = central_range(std::move(values), 0.0005);
  const Axis bar =
      rounded_axis(0, std::max(range.empty() ? 0.6 : range.hi, run.thresholds.core), 6);
  const std::vector<LegendEntry> entries{
      {std::string(up_line), "", "upward cluster ↑"},
      {std::string(down_line), "", "downward cluster ↓"},
      {"lc rgb '#000000' lw 0.5", "", fmt::format("φ = {}", number(run.thresholds.threshold))}};
  canvas.legend(entries, left + 62, canvas.height() - 3, page_width - left - 62);
  canvas.command(light_greys());
  canvas.command(fmt::format("set cbrange [0:{:.10g}]", bar.hi));
  canvas.colour_bar(left, canvas.height() - 13, 50, bar, literal(holdup_label({&run, 1})));

  const int decimals = time_decimals(run);
  for (std::size_t f = 0; f < count; ++f) {
    const Frame& frame = run.frames[f];
    const std::size_t column = f % grid.columns, row = f / grid.columns;
    const bool last = f + grid.columns >= count;
    Panel panel;
    panel.left = left + static_cast<double>(column) * (grid.width + gap_x);
    panel.bottom = bottom + (rows - 1 - static_cast<double>(row)) * (grid.height + gap_z);
    panel.width = grid.width;
    panel.height = grid.height;
    panel.x = exact_axis(x_unit.factor * run.grid.min[lateral],
                         x_unit.factor * run.grid.max[lateral], grid.width < 16 ? 2 : 4);
    panel.y = exact_axis(z_unit.factor * run.grid.min[up], z_unit.factor * run.grid.max[up], 8);
    panel.x_numbers = last;
    panel.y_numbers = column == 0;
    panel.map = true;
    panel.neighbour = column + 1 < grid.columns && f + 1 < count;
    if (last) panel.x_label = literal(fmt::format("x [{}]", x_unit.name));
    if (column == 0) panel.y_label = literal(fmt::format("height z [{}]", z_unit.name));
    canvas.open(panel);
    canvas.label(literal(run.time_known ? fmt::format("{:.{}f} s", frame.time, decimals)
                                        : fmt::format("{:.0f}", frame.time)),
                 panel.left + grid.width / 2, panel.bottom + grid.height + 2.4);
    const std::string of = fmt::format("frame at {:.8g}", frame.time);
    const std::size_t block =
        canvas.block("holdup, " + of,
                     image_rows(frame.holdup, static_cast<std::size_t>(run.grid.cells[lateral])));
    std::vector<std::string> layers{
        Canvas::layer(block, image_words(run.grid, x_unit.factor, z_unit.factor))};
    const double arrow = arrow_length * z_unit.factor * lz / grid.height;
    const double beside = arrow_gap * x_unit.factor * lx / grid.width;
    overlay_layers(canvas, overlay(run, frame, x_unit.factor, z_unit.factor, arrow, beside), of,
                   layers);
    canvas.draw(layers);
    canvas.command("unset colorbox");
  }
  return drawn(
      canvas, name, title,
      fmt::format(
          "{}: holdup in {} snapshots of the averaging window, with the outlines of "
          "clusters and their ellipses of equal second moments; green, solid, arrow up: "
          "moving upwards; red, dashed, arrow down: moving downwards (no arrows where there are "
          "more than {} clusters). {}. {}.{}",
          run.label, count, most_arrows, threshold_words({&run, 1}), mapping_words({&run, 1}),
          stretch_words(grid.stretch)));
}

}  // namespace

std::vector<Figure> snapshots_figures(Runs runs) {
  const std::string name = "snapshots", title = "Snapshots with clusters";
  std::vector<Figure> figures;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (runs[r].frames.empty()) continue;
    const bool several = runs.size() > 1;
    figures.push_back(snapshots_figure(runs[r], several ? fmt::format("{}_{}", name, r + 1) : name,
                                       several ? title + ": " + runs[r].label : title));
  }
  if (figures.empty()) figures.push_back(left_out(name, title, "no snapshots were kept"));
  return figures;
}

}  // namespace bedscope::report
