// SPDX-License-Identifier: BSD-3-Clause
// Snapshots side by side, with outlines and ellipses of their clusters.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/figure_parts.hpp"
#include "report/strip.hpp"

namespace bedscope::report {

using analysis::Cluster;
using analysis::Frame;
using analysis::RunResult;

namespace {

constexpr double arrow_length = 3.4, arrow_gap = 1;  // [mm]
constexpr std::size_t most_arrows = 40;              // in a frame: more would hide it

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
    found.contours += outline_rows(cluster, x_factor, z_factor);
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

Figure snapshots_figure(const RunResult& run, const std::string& name, const std::string& title) {
  Strip strip;
  strip.least_range = run.thresholds.core;
  strip.legend = {
      {std::string(up_line), "", "upward cluster ↑"},
      {std::string(down_line), "", "downward cluster ↓"},
      {"lc rgb '#000000' lw 0.5", "", fmt::format("φ = {}", number(run.thresholds.threshold))}};
  strip.draw_over = [&run](Canvas& canvas, const Frame& frame, const StripScale& scale,
                           const std::string& of, std::vector<std::string>& layers) {
    const double arrow = arrow_length * scale.z_per_mm, beside = arrow_gap * scale.x_per_mm;
    overlay_layers(canvas, overlay(run, frame, scale.x_factor, scale.z_factor, arrow, beside), of,
                   layers);
  };
  strip.caption = fmt::format(
      "with the outlines of clusters and their ellipses of equal second moments; green, solid, "
      "arrow up: moving upwards; red, dashed, arrow down: moving downwards (no arrows where there "
      "are more than {} clusters). {}",
      most_arrows, threshold_words({&run, 1}));
  return strip_figure(run, strip, name, title);
}

}  // namespace

std::vector<Figure> snapshots_figures(Runs runs) {
  const auto has_frames = [](const RunResult& run) { return !run.frames.empty(); };
  const std::string name = "snapshots", title = "Snapshots with clusters";
  auto figures = figure_a_run(runs, name, title, has_frames, snapshots_figure);
  if (figures.empty()) figures.push_back(left_out(name, title, "no snapshots were kept"));
  return figures;
}

}  // namespace bedscope::report
