// SPDX-License-Identifier: BSD-3-Clause
#include "report/strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bedscope::report {

using analysis::Frame;
using analysis::RunResult;

namespace {

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

}  // namespace

std::string outline_rows(const analysis::Cluster& cluster, double x_factor, double z_factor) {
  std::string rows;
  for (const auto& contour : cluster.contours) {
    for (const analysis::Point& point : contour) {
      rows += data_row({x_factor * point.x, z_factor * point.z});
    }
    if (!contour.empty()) {  // closed, whether or not the first point is repeated
      rows += data_row({x_factor * contour.front().x, z_factor * contour.front().z}) + gap_row;
    }
  }
  return rows;
}

Figure strip_figure(const RunResult& run, const Strip& strip, const std::string& name,
                    const std::string& title) {
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
  const Axis bar = rounded_axis(0, std::max(range.empty() ? 0.6 : range.hi, strip.least_range), 6);
  canvas.legend(strip.legend, left + 62, canvas.height() - 3, page_width - left - 62);
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
    strip.draw_over(canvas, frame,
                    {x_unit.factor, z_unit.factor, x_unit.factor * lx / grid.width,
                     z_unit.factor * lz / grid.height},
                    of, layers);
    canvas.draw(layers);
    canvas.command("unset colorbox");
  }
  return drawn(
      canvas, name, title,
      fmt::format("{}: holdup in {} snapshots of the averaging window, {}. {}.{}", run.label, count,
                  strip.caption, mapping_words({&run, 1}), stretch_words(grid.stretch)));
}

std::vector<Figure> figure_a_run(
    Runs runs, const std::string& name, const std::string& title,
    const std::function<bool(const RunResult&)>& has,
    const std::function<Figure(const RunResult&, const std::string&, const std::string&)>& draw) {
  std::vector<Figure> figures;
  const bool several = runs.size() > 1;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!has(runs[r])) continue;
    figures.push_back(draw(runs[r], several ? fmt::format("{}_{}", name, r + 1) : name,
                           several ? title + ": " + runs[r].label : title));
  }
  return figures;
}

}  // namespace bedscope::report
