// SPDX-License-Identifier: BSD-3-Clause
// Maps of the time-averaged fields, a panel for each quantity and run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Grid;
using analysis::RunResult;

namespace {

struct Quantity {
  std::string title;                      ///< of its colour bar
  std::vector<std::vector<double>> maps;  ///< one a run, cells[lateral] x cells[up]
  bool holdup = false;
  Axis range;
};

/// sum over depth of weight * value over the sum of weights; cells without weight are NaN.
std::vector<double> over_depth(const Grid& grid, const std::vector<double>& value,
                               const std::vector<double>* weight) {
  using enum analysis::Axis;
  std::vector<double> map;
  for (int k = 0; k < grid.cells[up]; ++k) {
    for (int i = 0; i < grid.cells[lateral]; ++i) {
      double sum = 0, weights = 0;
      for (int j = 0; j < grid.cells[depth]; ++j) {
        const std::size_t cell = grid.index(i, j, k);
        const double part = weight == nullptr ? 1 : (*weight)[cell];
        if (part == 0) continue;
        sum += part * value[cell];
        weights += part;
      }
      map.push_back(weights == 0 ? std::nan("") : sum / weights);
    }
  }
  return map;
}

/// Holdup, velocity and flux of all solids; a run without density has no flux.
std::vector<Quantity> quantities(Runs runs) {
  Quantity holdup{holdup_label(runs), {}, true, {}};
  Quantity velocity{"solids velocity v_z [m/s]", {}, false, {}};
  Quantity flux{"mass flux G_z [kg/(m² s)]", {}, false, {}};
  for (const RunResult& run : runs) {
    const analysis::MeanFields& fields = run.species.front().fields;
    holdup.maps.push_back(over_depth(run.grid, fields.holdup, nullptr));
    velocity.maps.push_back(over_depth(run.grid, fields.velocity_z, &fields.holdup));
    flux.maps.push_back(over_depth(run.grid, fields.mass_flux_z, nullptr));
  }
  std::vector<Quantity> found;
  for (Quantity* quantity : {&holdup, &velocity, &flux}) {
    std::vector<double> values;
    for (const auto& map : quantity->maps) values.insert(values.end(), map.begin(), map.end());
    const Range range = central_range(std::move(values), 0.005);
    if (range.empty()) continue;
    quantity->range = rounded_axis(std::min(range.lo, 0.0), std::max(range.hi, 0.0), 4);
    if (quantity->holdup) quantity->range.lo = quantity->range.first = 0;
    found.push_back(std::move(*quantity));
  }
  return found;
}

constexpr double left = 15, bottom = 11, bar_room = 13, gap = 3, group_gap = 8, shortest_bar = 36;

/// Where the panels are. Tall domains: quantities side by side, each with all runs; others: a row
/// of runs for each quantity.
struct Layout {
  PanelGrid panel;
  bool rows = false;
  double group_width = 0, group_height = 0;
  double slot = 0;               ///< for a group and its colour bar [mm]
  double names = 0;              ///< room for the runs' names above the panels [mm]
  double width = 0, height = 0;  ///< of all

  double x(std::size_t quantity, std::size_t run) const {
    const double group = rows ? 0 : static_cast<double>(quantity) * (slot + group_gap);
    return left + group + (slot - group_width) / 2 + static_cast<double>(run) * (panel.width + gap);
  }
  double y(std::size_t quantity, std::size_t quantities) const {
    return bottom + (rows ? static_cast<double>(quantities - 1 - quantity) * group_height : 0);
  }
};

Layout layout(std::size_t quantities, std::size_t runs, double lx, double lz) {
  const auto q = static_cast<double>(quantities), r = static_cast<double>(runs);
  const double names = runs > 1 ? 5.5 : 2;
  const double above = bar_room + names;
  // Very many runs make the figure wider than the page rather than their panels thinner than 10 mm.
  const double room = std::max(page_width - left - 2, r * (10 + gap));
  const PanelGrid beside = panel_grid(quantities * runs, 1, lx, lz, room - (q - 1) * group_gap,
                                      page_height - bottom - above - 10, gap, 0);
  const PanelGrid row = panel_grid(runs, 1, lx, lz, room,
                                   std::min(90.0, (page_height - 6) / q) - bottom - above, gap, 0);
  Layout found;
  found.names = names;
  found.rows = beside.width < 11 || beside.width * beside.height < row.width * row.height;
  found.panel = found.rows ? row : beside;
  found.group_width = r * (found.panel.width + gap) - gap;
  found.group_height = bottom + found.panel.height + above;
  found.slot = std::max(found.group_width, shortest_bar);
  found.width = left + found.slot + 6;
  if (!found.rows) found.width += (q - 1) * (found.slot + group_gap);
  found.height = found.rows ? q * found.group_height : found.group_height;
  return found;
}

std::string letter(std::size_t run) {
  return fmt::format("({})", static_cast<char>('a' + run % 26));
}

/// The panels of one quantity with their colour bar.
void draw_quantity(Canvas& canvas, Runs runs, std::span<const Quantity> all, std::size_t q,
                   const Layout& places, bool letters) {
  const Quantity& quantity = all[q];
  const Range x = domain_range(runs, analysis::lateral), z = domain_range(runs, analysis::up);
  const Unit x_unit = length_unit(x.hi - x.lo), z_unit = length_unit(z.hi - z.lo);
  const double y0 = places.y(q, all.size()), top = y0 + places.panel.height;
  const double bar = std::clamp(places.group_width, shortest_bar, 60.0);
  const double middle = places.x(q, 0) + places.group_width / 2;
  const auto [lo, hi] = std::pair(quantity.range.lo, quantity.range.hi);
  canvas.command(quantity.holdup ? viridis() : diverging(lo, hi));
  canvas.command(fmt::format("set cbrange [{:.10g}:{:.10g}]", lo, hi));
  canvas.colour_bar(middle - bar / 2, top + places.names, bar, quantity.range,
                    literal(quantity.title));
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RunResult& run = runs[r];
    const bool first = r == 0 && (q == 0 || places.rows);
    Panel panel;
    panel.left = places.x(q, r);
    panel.bottom = y0;
    panel.width = places.panel.width;
    panel.height = places.panel.height;
    panel.x = exact_axis(x.lo * x_unit.factor, x.hi * x_unit.factor, panel.width < 16 ? 2 : 4);
    panel.y = exact_axis(z.lo * z_unit.factor, z.hi * z_unit.factor, 8);
    panel.y_numbers = first;
    panel.map = true;
    panel.neighbour = r + 1 < runs.size();
    panel.x_label = literal(fmt::format("x [{}]", x_unit.name));
    if (first) panel.y_label = literal(fmt::format("height z [{}]", z_unit.name));
    canvas.open(panel);
    if (letters || runs.size() > 1) {
      canvas.user_label(letters ? letter(r) : run.label, panel.left + panel.width / 2, top + 2.6);
    }
    const std::size_t block = canvas.block(
        fmt::format("{} of {}, rows upwards", quantity.title, run.label),
        image_rows(quantity.maps[r], static_cast<std::size_t>(run.grid.cells[analysis::lateral])));
    const std::string layers[] = {
        Canvas::layer(block, image_words(run.grid, x_unit.factor, z_unit.factor))};
    canvas.draw(layers);
    canvas.command("unset colorbox");
  }
}

bool has_fields(const RunResult& run) {
  return !run.species.empty() && run.species.front().fields.holdup.size() == run.grid.size();
}

}  // namespace

Figure fields_figure(Runs runs) {
  const std::string name = "fields", title = "Time-averaged fields";
  if (runs.empty() || !std::all_of(runs.begin(), runs.end(), has_fields)) {
    return left_out(name, title, "no time-averaged fields in the results");
  }
  const std::vector<Quantity> all = quantities(runs);
  if (all.empty()) return left_out(name, title, "no solids were seen in the window");
  const Range x = domain_range(runs, analysis::lateral), z = domain_range(runs, analysis::up);
  const Layout places = layout(all.size(), runs.size(), x.hi - x.lo, z.hi - z.lo);

  // Names above the panels where they fit, else letters that lines at the top explain.
  const bool letters =
      runs.size() > 1 && std::any_of(runs.begin(), runs.end(), [&](const RunResult& run) {
        return text_width(run.label) > places.panel.width + gap - 1;
      });
  std::vector<LegendEntry> names;
  for (std::size_t r = 0; r < runs.size() && letters; ++r) {
    names.push_back({"", "", letter(r) + "  " + runs[r].label});
  }
  const double width = std::max(places.width, 85.0);
  const double room = letters ? Canvas::legend_height(names, width - left) + 1 : 0;
  Canvas canvas(width, places.height + room);
  if (letters) canvas.legend(names, left, canvas.height() - 0.5, width - left);
  for (std::size_t q = 0; q < all.size(); ++q) draw_quantity(canvas, runs, all, q, places, letters);

  const bool all_fluxes =
      std::all_of(runs.begin(), runs.end(), [](const RunResult& run) { return run.density_known; });
  return drawn(
      canvas, name, title,
      fmt::format("Holdup, vertical solids velocity ⟨φ v⟩/⟨φ⟩{}, positive (red) upwards. {}. {}. "
                  "Colours saturate beyond the central 99 % of the cells; grey: no solids "
                  "seen.{}{}",
                  all_fluxes ? " and mass flux ρ⟨φ v⟩" : "", window_words(runs),
                  mapping_words(runs), stretch_words(places.panel.stretch),
                  all_fluxes ? "" : " No mass flux where no density is known."));
}

}  // namespace bedscope::report
