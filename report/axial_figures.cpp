// SPDX-License-Identifier: BSD-3-Clause
// Axial profiles, all runs overlaid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Estimate;
using analysis::Profile;

namespace {

/// A curve in a panel.
struct Curve {
  std::string label;
  std::size_t style = 0;
  const Profile* profile = nullptr;
};

std::vector<LegendEntry> legend_of(std::span<const Curve> curves) {
  std::vector<LegendEntry> entries;
  for (const Curve& curve : curves) {
    entries.push_back({curve_style(curve.style).line + " lw 1.3", "", curve.label});
  }
  return entries;
}

/// Holdup against height with its band.
void axial_layers(Canvas& canvas, const Curve& curve, double z_factor,
                  std::vector<std::string>& bands, std::vector<std::string>& lines) {
  const Profile& profile = *curve.profile;
  const CurveStyle style = curve_style(curve.style);
  std::string rows;
  for (std::size_t i = 0; i < profile.coordinate.size(); ++i) {
    const Estimate& holdup = profile.holdup[i];
    rows += data_row({holdup.value, z_factor * profile.coordinate[i], holdup.ci95});
  }
  const std::string band = estimate_band(profile.coordinate, profile.holdup, z_factor);
  if (!band.empty()) {
    const std::size_t block = canvas.block("band of " + curve.label + ": holdup, height", band);
    bands.push_back(Canvas::layer(block, fmt::format("using 1:2 {}", band_words(style.colour))));
  }
  const std::size_t block = canvas.block(curve.label + ": holdup, height, ci95", rows);
  lines.push_back(Canvas::layer(block, fmt::format("using 1:2 with lines {} lw 1.3", style.line)));
}

Range holdup_range(std::span<const std::vector<Curve>> panels) {
  Range range;
  range.add(0);
  for (const auto& curves : panels) {
    for (const Curve& curve : curves) add_estimates(range, curve.profile->holdup);
  }
  range.lo = 0;  // holdup is not negative: a band that reaches below is cut at the axis
  return range;
}

/// Panels of axial profiles side by side with common ranges and one legend.
Canvas axial_canvas(Runs runs, std::span<const std::vector<Curve>> panels,
                    std::span<const std::string> titles, double width, double height) {
  constexpr double left = 15, bottom = 11, gap = 8, right = 5;
  std::vector<LegendEntry> entries;
  for (const auto& curves : panels) {
    if (curves.size() > entries.size()) entries = legend_of(curves);
  }
  const double legend = entries.size() > 1 ? Canvas::legend_height(entries, width - left) + 1 : 0;
  const double title_room = titles.empty() ? 2 : 5.5;
  Canvas canvas(width, height + legend);
  if (legend > 0) canvas.legend(entries, left, canvas.height() - 0.5, width - left);

  const Range z = domain_range(runs, analysis::up);
  const Unit unit = length_unit(z.hi - z.lo);
  const Range holdup = holdup_range(panels);
  const double each = (width - left - right + gap) / static_cast<double>(panels.size()) - gap;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    Panel panel;
    panel.left = left + static_cast<double>(p) * (each + gap);
    panel.bottom = bottom;
    panel.width = each;
    panel.height = height - bottom - title_room;
    panel.x = rounded_axis(holdup.lo, holdup.hi, std::max(2, static_cast<int>(each / 13)));
    panel.y = exact_axis(z.lo * unit.factor, z.hi * unit.factor, 8);
    panel.x_label =
        literal(holdup_label(runs, text_width(holdup_label(runs)) > each + gap ? "φ" : "holdup φ"));
    panel.y_numbers = p == 0;
    if (p == 0) panel.y_label = literal(fmt::format("height z [{}]", unit.name));
    canvas.open(panel);
    if (!titles.empty()) {
      canvas.user_label(shortened(titles[p], each + gap), panel.left + each / 2,
                        panel.bottom + panel.height + 2.6);
    }
    std::vector<std::string> bands, lines;
    for (const Curve& curve : panels[p]) axial_layers(canvas, curve, unit.factor, bands, lines);
    bands.insert(bands.end(), lines.begin(), lines.end());
    canvas.draw(bands);
  }
  return canvas;
}

std::string axial_caption(Runs runs, std::string_view what) {
  return fmt::format("{} over the whole cross-section against height; band: {}. {}. {}.", what,
                     interval_words, window_words(runs), mapping_words(runs));
}

}  // namespace

Figure axial_figure(Runs runs) {
  const std::string name = "axial_holdup", title = "Axial holdup";
  std::vector<std::vector<Curve>> panels(1);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const analysis::SpeciesResult* all = find_species(runs[r], "all");
    if (all != nullptr && seen(all->axial)) panels[0].push_back({runs[r].label, r, &all->axial});
  }
  if (panels[0].empty()) return left_out(name, title, "no axial profile in the results");
  const Canvas canvas = axial_canvas(runs, panels, {}, 85, 110);
  return drawn(canvas, name, title, axial_caption(runs, "Holdup of all solids"));
}

Figure axial_species_figure(Runs runs) {
  const std::string name = "axial_holdup_species", title = "Axial holdup of each type";
  const std::vector<std::string> types = species_names(runs);
  if (types.empty()) return left_out(name, title, "there is one type of particles only");
  // Several runs: a panel a type; one run: all types in one.
  std::vector<std::vector<Curve>> panels;
  std::vector<std::string> titles;
  for (std::size_t t = 0; t < types.size(); ++t) {
    std::vector<Curve> curves;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const analysis::SpeciesResult* one = find_species(runs[r], types[t]);
      if (one == nullptr || !seen(one->axial)) continue;
      const bool single = runs.size() == 1;
      curves.push_back(
          {single ? species_title(types[t]) : runs[r].label, single ? t : r, &one->axial});
    }
    if (curves.empty()) continue;
    if (runs.size() == 1 && !panels.empty()) {
      panels[0].push_back(curves[0]);
    } else {
      panels.push_back(std::move(curves));
      if (runs.size() > 1) titles.push_back(species_title(types[t]));
    }
  }
  if (panels.empty()) return left_out(name, title, "no axial profile of a type in the results");
  const double width =
      std::clamp(20.0 + 50.0 * static_cast<double>(panels.size()), 85.0, page_width);
  const Canvas canvas = axial_canvas(runs, panels, titles, width, 110);
  return drawn(canvas, name, title, axial_caption(runs, "Holdup of each type"));
}

}  // namespace bedscope::report
