// SPDX-License-Identifier: BSD-3-Clause
#include "report/figure_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bedscope::report {

using analysis::Estimate;
using analysis::Grid;
using analysis::RunResult;
using analysis::SpeciesResult;

namespace {

/// What `words` says of each run, said once where it is the same for all.
template <class Words>
std::string for_runs(Runs runs, Words words) {
  std::vector<std::string> said;
  for (const RunResult& run : runs) said.push_back(words(run));
  if (std::all_of(said.begin(), said.end(), [&](const auto& one) { return one == said.front(); })) {
    return said.empty() ? "" : said.front();
  }
  std::string text;
  for (std::size_t i = 0; i < said.size(); ++i) {
    text += fmt::format("{}“{}”: {}", i == 0 ? "" : "; ", runs[i].label, said[i]);
  }
  return text;
}

}  // namespace

Figure drawn(const Canvas& canvas, std::string name, std::string title, std::string caption) {
  Figure figure;
  figure.script = canvas.script(name, name);
  figure.data = canvas.data();
  figure.width = canvas.width();
  figure.height = canvas.height();
  figure.name = std::move(name);
  figure.title = std::move(title);
  figure.caption = std::move(caption);
  return figure;
}

Figure left_out(std::string name, std::string title, std::string why) {
  Figure figure;
  figure.name = std::move(name);
  figure.title = std::move(title);
  figure.missing = std::move(why);
  return figure;
}

std::string holdup_label(Runs runs, std::string_view what) {
  const bool assumed = std::any_of(runs.begin(), runs.end(),
                                   [](const RunResult& run) { return run.domain_assumed; });
  return fmt::format("{} [-]{}", what, assumed ? ", domain assumed" : "");
}

std::string time_label(Runs runs) {
  const auto unknown =
      std::count_if(runs.begin(), runs.end(), [](const RunResult& run) { return !run.time_known; });
  if (unknown == 0) return "time t [s]";
  return unknown == std::ssize(runs) ? "step [-]" : "time t [s], or step [-] where it is unknown";
}

std::string window_words(Runs runs) {
  return "Averaging window: " + for_runs(runs, [](const RunResult& run) {
           return fmt::format("{}{} to {}{} ({} snapshots{})", run.time_known ? "" : "steps ",
                              number(run.window.from, 10), number(run.window.to, 10),
                              run.time_known ? " s" : "", run.window.snapshots,
                              run.window.automatic ? ", chosen automatically" : "");
         });
}

std::string mapping_words(Runs runs) {
  return "Mapping kernel and grid: " + for_runs(runs, [](const RunResult& run) {
           const Grid& grid = run.grid;
           const int nx = grid.cells[analysis::lateral], nz = grid.cells[analysis::up];
           const std::string depth =
               grid.depth_averaged() ? "" : fmt::format(" × {}", grid.cells[analysis::depth]);
           return fmt::format("{}, {}{} × {} cells of {:.4g} × {:.4g} mm", run.mapping, nx, depth,
                              nz, 1e3 * grid.width(analysis::lateral),
                              1e3 * grid.width(analysis::up));
         });
}

std::string threshold_words(Runs runs) {
  return "Clusters: " + for_runs(runs, [](const RunResult& run) {
           return fmt::format("φ > {} everywhere, φ > {} somewhere, area ≥ {} mm²",
                              number(run.thresholds.threshold), number(run.thresholds.core),
                              number(1e6 * run.thresholds.min_area));
         });
}

std::vector<std::string> species_names(Runs runs) {
  std::vector<std::string> names;
  for (const RunResult& run : runs) {
    for (const std::string& type : run.types) {
      if (type != "all" && std::find(names.begin(), names.end(), type) == names.end()) {
        names.push_back(type);
      }
    }
  }
  if (names.size() == 1) names.clear();
  return names;
}

std::string species_title(const std::string& type) {
  if (type == "all") return "all types";
  const bool number = type.find_first_not_of("0123456789") == std::string::npos;
  return number ? "type " + type : type;
}

const SpeciesResult* find_species(const RunResult& run, const std::string& type) {
  const auto found = std::find_if(run.species.begin(), run.species.end(),
                                  [&](const SpeciesResult& one) { return one.type == type; });
  return found == run.species.end() ? nullptr : &*found;
}

Range domain_range(Runs runs, int axis) {
  Range range;
  for (const RunResult& run : runs) {
    range.add(run.grid.min[axis]);
    range.add(run.grid.max[axis]);
  }
  return range;
}

PanelGrid panel_grid(std::size_t columns, std::size_t rows, double lx, double lz, double width,
                     double height, double gap_x, double gap_z) {
  constexpr double legible = 20;  // a panel is not thinner where there is room [mm]
  const double most_x = std::max(1.0, width / static_cast<double>(columns) - gap_x);
  const double most_z = std::max(1.0, height / static_cast<double>(rows) - gap_z);
  const double scale = std::min(most_x / lx, most_z / lz);
  PanelGrid grid{columns, rows, lx * scale, lz * scale, 1};
  grid.width = std::max(grid.width, std::min(most_x, legible));
  grid.height = std::max(grid.height, std::min(most_z, legible));
  grid.stretch = (grid.width / lx) / (grid.height / lz);
  return grid;
}

PanelGrid arrange_panels(std::size_t count, double lx, double lz, double width, double height,
                         double gap_x, double gap_z) {
  PanelGrid best;
  for (std::size_t columns = 1; columns <= count; ++columns) {
    const PanelGrid grid =
        panel_grid(columns, (count + columns - 1) / columns, lx, lz, width, height, gap_x, gap_z);
    if (grid.width * grid.height >= 0.999 * best.width * best.height) best = grid;
  }
  return best;
}

std::string stretch_words(double stretch) {
  if (stretch > 1.02) return fmt::format(" The lateral axis is stretched {:.2g} times.", stretch);
  if (stretch < 0.98)
    return fmt::format(" The vertical axis is stretched {:.2g} times.", 1 / stretch);
  return "";
}

std::vector<LegendEntry> run_legend(Runs runs, bool markers) {
  std::vector<LegendEntry> entries;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const CurveStyle style = curve_style(r);
    entries.push_back({style.line + " lw 1.3",
                       markers ? fmt::format("{} lc rgb '{}'", style.marker, style.colour) : "",
                       runs[r].label});
  }
  return entries;
}

bool same_windows(Runs runs) {
  return std::all_of(runs.begin(), runs.end(), [&](const RunResult& run) {
    return run.window.from == runs.front().window.from && run.window.to == runs.front().window.to;
  });
}

void shade_windows(Canvas& canvas, Runs runs) {
  const bool same = same_windows(runs);
  for (const RunResult& run : runs) {
    if (run.window.snapshots == 0) continue;
    canvas.command(
        fmt::format("set object rectangle from first {:.10g}, graph 0 to first {:.10g}, "
                    "graph 1 behind fc rgb '#000000' fs transparent solid 0.08 noborder",
                    run.window.from, run.window.to));
    if (same) break;
  }
}

void add_estimates(Range& range, std::span<const Estimate> estimates) {
  for (const Estimate& one : estimates) {
    const double half = std::isfinite(one.ci95) ? one.ci95 : 0;
    range.add(one.value - half);
    range.add(one.value + half);
  }
}

Samples thinned(const Samples& samples) {
  constexpr std::size_t most = 2000;
  if (samples.size() <= most) return samples;
  const std::size_t stretch = 2 * samples.size() / most + 1;
  Samples kept;
  const auto by_value = [](const auto& a, const auto& b) { return a.second < b.second; };
  for (std::size_t i = 0; i < samples.size(); i += stretch) {
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        samples.begin() + static_cast<std::ptrdiff_t>(std::min(i + stretch, samples.size()));
    auto [low, high] = std::minmax_element(begin, end, by_value);
    if (high < low) std::swap(low, high);
    kept.push_back(*low);
    if (high != low) kept.push_back(*high);
  }
  return kept;
}

std::string sample_rows(const Samples& samples) {
  std::string rows;
  for (const auto& [time, value] : samples) {
    rows += fmt::format("{:.10g} {:.7g}\n", time, value);
  }
  return rows;
}

bool seen(const analysis::Profile& profile) {
  return std::any_of(profile.holdup.begin(), profile.holdup.end(),
                     [](const Estimate& one) { return std::isfinite(one.value); });
}

std::string data_row(std::initializer_list<double> values) {
  std::string row;
  for (const double value : values) {
    if (!row.empty()) row += ' ';
    fmt::format_to(std::back_inserter(row), "{:.7g}", value);
  }
  return row + "\n";
}

std::string band_outline(std::span<const double> along, std::span<const double> low,
                         std::span<const double> high) {
  std::string rows;
  const auto defined = [&](std::size_t i) {
    return std::isfinite(low[i]) && std::isfinite(high[i]);
  };
  for (std::size_t i = 0; i < along.size();) {
    std::size_t end = i;
    while (end < along.size() && defined(end)) ++end;
    for (std::size_t j = i; j < end; ++j) rows += data_row({low[j], along[j]});
    for (std::size_t j = end; j-- > i;) rows += data_row({high[j], along[j]});
    if (end > i) rows += data_row({low[i], along[i]}) + "\n";
    i = end + (end == i ? 1 : 0);
  }
  return rows;
}

std::string estimate_band(std::span<const double> along, std::span<const Estimate> estimates,
                          double factor) {
  std::vector<double> places, low, high;
  for (std::size_t i = 0; i < along.size(); ++i) {
    places.push_back(factor * along[i]);
    low.push_back(estimates[i].value - estimates[i].ci95);
    high.push_back(estimates[i].value + estimates[i].ci95);
  }
  return band_outline(places, low, high);
}

std::string bar_rows(std::span<const double> x, std::span<const Estimate> estimates, double cap) {
  std::string rows;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double low = estimates[i].value - estimates[i].ci95;
    const double high = estimates[i].value + estimates[i].ci95;
    if (!std::isfinite(low) || !std::isfinite(high)) continue;
    rows += data_row({x[i] - cap, low}) + data_row({x[i] + cap, low}) + data_row({x[i], low}) +
            data_row({x[i], high}) + data_row({x[i] - cap, high}) + data_row({x[i] + cap, high}) +
            "\n";
  }
  return rows;
}

std::string band_words(const std::string& colour) {
  return fmt::format("with filledcurves closed fs transparent solid 0.25 noborder fc rgb '{}'",
                     colour);
}

std::string image_rows(std::span<const double> values, std::size_t columns, double factor) {
  std::string rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::format_to(std::back_inserter(rows), "{:.4g}{}", factor * values[i],
                   (i + 1) % columns == 0 ? '\n' : ' ');
  }
  return rows;
}

std::string image_words(const Grid& grid, double x_factor, double z_factor) {
  using analysis::lateral, analysis::up;
  return fmt::format("matrix using ({:.10g}+{:.10g}*$1):({:.10g}+{:.10g}*$2):3 with image",
                     x_factor * grid.centre(lateral, 0), x_factor * grid.width(lateral),
                     z_factor * grid.centre(up, 0), z_factor * grid.width(up));
}

}  // namespace bedscope::report
