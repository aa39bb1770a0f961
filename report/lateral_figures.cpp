// SPDX-License-Identifier: BSD-3-Clause
// Lateral profiles at the chosen heights, all runs overlaid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Estimate;
using analysis::Profile;
using analysis::RunResult;

namespace {

constexpr double row_height = 38;  // [mm]

struct Row {
  std::string label;
  std::vector<Estimate> Profile::*values;
  Range range;
};

/// The profile of `run` at a height of the figure, which other runs may not have.
const Profile* at_height(const RunResult& run, double height) {
  if (run.species.empty()) return nullptr;
  const auto& lateral = run.species.front().lateral;
  for (std::size_t h = 0; h < std::min(run.heights.size(), lateral.size()); ++h) {
    if (std::abs(run.heights[h] - height) < 1e-9) return &lateral[h];
  }
  return nullptr;
}

std::vector<double> all_heights(Runs runs) {
  std::vector<double> heights;
  for (const RunResult& run : runs) {
    for (const double height : run.heights) {
      const Profile* profile = at_height(run, height);
      if (profile == nullptr || !seen(*profile)) continue;
      const auto same = [&](double other) { return std::abs(other - height) < 1e-9; };
      if (std::none_of(heights.begin(), heights.end(), same)) heights.push_back(height);
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

std::vector<Row> lateral_rows(Runs runs, std::span<const double> heights) {
  // Short enough for the height of a row.
  const std::string words = holdup_label(runs);
  const std::string label = text_width(words) > row_height ? holdup_label(runs, "φ") : words;
  std::vector<Row> rows{{label, &Profile::holdup, {}},
                        {"v_z [m/s]", &Profile::velocity_z, {}},
                        {"G_z [kg/(m² s)]", &Profile::mass_flux_z, {}}};
  for (Row& row : rows) {
    for (const RunResult& run : runs) {
      for (const double height : heights) {
        if (const Profile* profile = at_height(run, height)) {
          add_estimates(row.range, profile->*row.values);
        }
      }
    }
    if (!row.range.empty()) row.range.add(0);
  }
  rows.front().range.lo = 0;
  std::erase_if(rows, [](const Row& row) { return row.range.empty(); });
  return rows;
}

/// Error bars where there is room for them, a band where the cells are too narrow.
void lateral_layers(Canvas& canvas, const std::string& label, std::size_t run,
                    const Profile& profile, const Row& row, double x_factor, const Panel& panel,
                    std::vector<std::string>& back, std::vector<std::string>& front) {
  const std::vector<Estimate>& values = profile.*row.values;
  const CurveStyle style = curve_style(run);
  const double cap = bar_cap * (panel.x.hi - panel.x.lo) / panel.width;
  const bool with_bars = static_cast<double>(values.size()) < panel.width / 0.7;
  std::string rows;
  std::vector<double> places;
  for (std::size_t i = 0; i < values.size(); ++i) {
    places.push_back(x_factor * profile.coordinate[i]);
    rows += data_row({places.back(), values[i].value, values[i].ci95});
  }
  const std::size_t block = canvas.block(label + ": x, " + row.label + ", ci95", rows);
  if (with_bars) {
    const std::string bars = bar_rows(places, values, cap);
    if (!bars.empty()) {
      back.push_back(
          Canvas::layer(canvas.block("bars of " + label + ": x, " + row.label, bars),
                        fmt::format("using 1:2 with lines lw 0.6 lc rgb '{}'", style.colour)));
    }
    front.push_back(Canvas::layer(
        block, fmt::format("using 1:2 with points {} lc rgb '{}'", style.marker, style.colour)));
  } else if (const std::string band = estimate_band(profile.coordinate, values, x_factor);
             !band.empty()) {
    back.push_back(Canvas::layer(canvas.block("band of " + label + ": value, x", band),
                                 fmt::format("using 2:1 {}", band_words(style.colour))));
  }
  front.push_back(Canvas::layer(block, fmt::format("using 1:2 with lines {} lw 1.0", style.line)));
}

Figure lateral_figure(Runs runs, std::span<const double> heights, std::span<const Row> rows,
                      const std::string& name, const std::string& title) {
  constexpr double left = 19, bottom = 11, gap = 4, top = 5.5;
  const std::vector<LegendEntry> entries = run_legend(runs, true);
  const double legend = runs.size() > 1 ? Canvas::legend_height(entries, page_width - left) + 1 : 0;
  const auto n = static_cast<double>(rows.size());
  Canvas canvas(page_width, bottom + n * (row_height + gap) - gap + top + legend);
  if (legend > 0) canvas.legend(entries, left, canvas.height() - 0.5, page_width - left);
  const Range x = domain_range(runs, analysis::lateral);
  const Unit unit = length_unit(x.hi - x.lo);
  const auto columns = static_cast<double>(heights.size());
  const double width = std::min((page_width - left - 2 + gap) / columns - gap, 80.0);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    for (std::size_t h = 0; h < heights.size(); ++h) {
      Panel panel;
      panel.left = left + static_cast<double>(h) * (width + gap);
      panel.bottom = bottom + (n - 1 - static_cast<double>(q)) * (row_height + gap);
      panel.width = width;
      panel.height = row_height;
      panel.x = exact_axis(x.lo * unit.factor, x.hi * unit.factor,
                           width < 20   ? 2
                           : width < 30 ? 4
                                        : 5);
      panel.y = rounded_axis(rows[q].range.lo, rows[q].range.hi, 6);
      panel.x_numbers = q + 1 == rows.size();
      panel.y_numbers = h == 0;
      if (panel.x_numbers) panel.x_label = literal(fmt::format("x [{}]", unit.name));
      if (h == 0) panel.y_label = literal(rows[q].label);
      panel.y_label_gap = 15;
      panel.zero_line = true;
      panel.neighbour = h + 1 < heights.size();
      canvas.open(panel);
      if (q == 0) {
        canvas.label(literal(fmt::format("z = {} m", number(heights[h]))), panel.left + width / 2,
                     panel.bottom + row_height + 2.6);
      }
      std::vector<std::string> back, front;
      for (std::size_t r = 0; r < runs.size(); ++r) {
        const Profile* profile = at_height(runs[r], heights[h]);
        if (profile == nullptr) continue;
        lateral_layers(canvas, runs[r].label, r, *profile, rows[q], unit.factor, panel, back,
                       front);
      }
      back.insert(back.end(), front.begin(), front.end());
      canvas.draw(back);
    }
  }
  const bool flux = std::any_of(rows.begin(), rows.end(),
                                [](const Row& row) { return row.values == &Profile::mass_flux_z; });
  return drawn(
      canvas, name, title,
      fmt::format("Holdup φ, vertical solids velocity ⟨φ v⟩/⟨φ⟩{} against lateral position, "
                  "in bands of {} mm height around z; bars (bands where cells are narrow): "
                  "{}. {}. {}.{}",
                  flux ? " and mass flux ρ⟨φ v⟩" : "", number(1e3 * runs.front().band),
                  interval_words, window_words(runs), mapping_words(runs),
                  flux ? "" : " No mass flux: no density is known."));
}

}  // namespace

std::vector<Figure> lateral_figures(Runs runs) {
  constexpr std::size_t most = 6;  // panels side by side
  const std::string name = "lateral", title = "Lateral profiles";
  const std::vector<double> heights = all_heights(runs);
  if (heights.empty())
    return {left_out(name, title, "no lateral profile with solids in the results")};
  // Ranges of all heights, so that a second figure can be laid beside the first.
  const std::vector<Row> rows = lateral_rows(runs, heights);
  std::vector<Figure> figures;
  for (std::size_t first = 0; first < heights.size(); first += most) {
    const auto some = std::span(heights).subspan(first, std::min(most, heights.size() - first));
    const std::string number_part = first == 0 ? "" : fmt::format("_{}", first / most + 1);
    figures.push_back(lateral_figure(runs, some, rows, name + number_part, title));
  }
  return figures;
}

}  // namespace bedscope::report
