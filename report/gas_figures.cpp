// SPDX-License-Identifier: BSD-3-Clause
// Axial and lateral profiles of the gas, its velocity beside that of the solids.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Estimate;
using analysis::GasProfile;
using analysis::Profile;
using analysis::RunResult;

namespace {

struct Quantity {
  std::string label;
  std::vector<Estimate> GasProfile::*values;
  Range range;
};

/// A profile of the gas and the solids' beside it, at one place of one run.
struct Pair {
  std::size_t run = 0;
  const GasProfile* gas = nullptr;
  const Profile* solids = nullptr;
};

bool is_velocity(const Quantity& quantity) { return quantity.values == &GasProfile::velocity_z; }

/// What is drawn: pressures less the last one, which is at the top.
std::vector<Estimate> drawn_values(const GasProfile& profile, const Quantity& quantity) {
  auto values = profile.*quantity.values;
  if (quantity.values != &GasProfile::pressure) return values;
  const auto last = std::find_if(values.rbegin(), values.rend(),
                                 [](const Estimate& one) { return std::isfinite(one.value); });
  const double top = last == values.rend() ? 0 : last->value;
  for (auto& one : values) one.value -= top;
  return values;
}

/// The quantities that any of the profiles has, with their ranges.
std::vector<Quantity> quantities_of(std::span<const Pair> pairs, std::vector<Quantity> quantities) {
  for (Quantity& quantity : quantities) {
    for (const Pair& pair : pairs) add_estimates(quantity.range, drawn_values(*pair.gas, quantity));
    if (quantity.range.empty() || !is_velocity(quantity)) continue;
    quantity.range.add(0);
    for (const Pair& pair : pairs)
      if (pair.solids != nullptr) add_estimates(quantity.range, pair.solids->velocity_z);
  }
  std::erase_if(quantities, [](const Quantity& quantity) { return quantity.range.empty(); });
  if (!quantities.empty() && quantities[0].values == &GasProfile::voidage)
    quantities[0].range.hi = std::min(quantities[0].range.hi, 1.0);  // no voidage is more
  return quantities;
}

/// With a margin; no voidage is above 1.
Range shown_range(const Quantity& quantity) {
  Range range = quantity.range.padded();
  if (quantity.values == &GasProfile::voidage) range.hi = 1;
  return range;
}

/// One run: gas and solids in two styles. Several: each its own, the solids thinner.
CurveStyle style_of(Runs runs, std::size_t run, bool solids) {
  return curve_style(runs.size() == 1 && solids ? 1 : run);
}
double thickness(bool solids) { return solids ? 0.7 : 1.4; }

std::vector<LegendEntry> gas_legend(Runs runs) {
  if (runs.size() > 1) return run_legend(runs, false);
  return {{style_of(runs, 0, false).line + " lw 1.4", "", "gas"},
          {style_of(runs, 0, true).line + " lw 0.7", "", "solids"}};
}

std::string solids_words(Runs runs) {
  return runs.size() > 1 ? "thin: of the solids" : "beside that of the solids";
}

/// A curve with its band. `upright`: the coordinate is the vertical axis.
void curve_layers(Canvas& canvas, const std::string& label, const CurveStyle& style, double width,
                  std::span<const double> places, std::span<const Estimate> values, double factor,
                  bool upright, std::vector<std::string>& back, std::vector<std::string>& front) {
  std::string rows;
  for (std::size_t i = 0; i < places.size(); ++i)
    rows += data_row({values[i].value, factor * places[i], values[i].ci95});
  const std::string band = estimate_band(places, values, factor);
  const std::string_view columns = upright ? "1:2" : "2:1";
  if (!band.empty())
    back.push_back(Canvas::layer(canvas.block("band of " + label, band),
                                 fmt::format("using {} {}", columns, band_words(style.colour))));
  front.push_back(
      Canvas::layer(canvas.block(label + ": value, coordinate, ci95", rows),
                    fmt::format("using {} with lines {} lw {}", columns, style.line, width)));
}

void draw_panel(Canvas& canvas, Runs runs, std::span<const Pair> pairs, const Quantity& quantity,
                double factor, bool upright) {
  std::vector<std::string> back, front;
  for (const Pair& pair : pairs) {
    const auto& label = runs[pair.run].label;
    curve_layers(canvas, label + ": gas, " + quantity.label, style_of(runs, pair.run, false),
                 thickness(false), pair.gas->coordinate, drawn_values(*pair.gas, quantity), factor,
                 upright, back, front);
    if (!is_velocity(quantity) || pair.solids == nullptr) continue;
    curve_layers(canvas, label + ": solids, v_z", style_of(runs, pair.run, true), thickness(true),
                 pair.solids->coordinate, pair.solids->velocity_z, factor, upright, back, front);
  }
  back.insert(back.end(), front.begin(), front.end());
  canvas.draw(back);
}

const Profile* solids_at(const RunResult& run, const std::vector<Profile>* lateral, std::size_t h) {
  if (run.species.empty()) return nullptr;
  if (lateral == nullptr) return &run.species.front().axial;
  return h < lateral->size() ? &(*lateral)[h] : nullptr;
}

Figure axial_gas_figure(Runs runs) {
  constexpr double left = 15, bottom = 11, gap = 7, right = 5, height = 110;
  const std::string name = "gas_axial", title = "Axial profiles of the gas";
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (runs[r].gas.present)
      pairs.push_back({r, &runs[r].gas.axial, solids_at(runs[r], nullptr, 0)});
  const auto quantities = quantities_of(pairs, {{"voidage ε [-]", &GasProfile::voidage, {}},
                                                {"u_z and v_z [m/s]", &GasProfile::velocity_z, {}},
                                                {"p − p_top [Pa]", &GasProfile::pressure, {}},
                                                {"T [K]", &GasProfile::temperature, {}}});
  if (quantities.empty()) return left_out(name, title, "no gas in the averaging window");
  const auto n = static_cast<double>(quantities.size());
  const double width = std::min(page_width, left + right + 55 * n - gap);
  const auto entries = gas_legend(runs);
  const double legend = Canvas::legend_height(entries, width - left) + 1;
  Canvas canvas(width, height + legend);
  canvas.legend(entries, left, canvas.height() - 0.5, width - left);
  const Range z = domain_range(runs, analysis::up);
  const Unit unit = length_unit(z.hi - z.lo);
  const double each = (width - left - right + gap) / n - gap;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const Quantity& quantity = quantities[q];
    Panel panel;
    panel.left = left + static_cast<double>(q) * (each + gap);
    panel.bottom = bottom;
    panel.width = each;
    panel.height = height - bottom - 2;
    const Range shown = shown_range(quantity);
    panel.x = exact_axis(shown.lo, shown.hi, std::max(2, static_cast<int>(each / 8)));
    panel.y = exact_axis(z.lo * unit.factor, z.hi * unit.factor, 8);
    panel.x_label = literal(quantity.label);
    panel.y_numbers = q == 0;
    if (q == 0) panel.y_label = literal(fmt::format("height z [{}]", unit.name));
    canvas.open(panel);
    draw_panel(canvas, runs, pairs, quantity, unit.factor, true);
  }
  return drawn(canvas, name, title,
               fmt::format("Voidage ε and vertical gas velocity u_z = ⟨ε u⟩/⟨ε⟩ (interstitial; "
                           "{}) over the whole cross-section against height{}; band: {}. {}.",
                           solids_words(runs),
                           std::any_of(quantities.begin(), quantities.end(),
                                       [](const Quantity& one) {
                                         return one.values == &GasProfile::pressure;
                                       })
                               ? ", pressure p less that of the highest layer"
                               : "",
                           interval_words, window_words(runs)));
}

std::vector<double> gas_heights(Runs runs) {
  std::vector<double> heights;
  for (const RunResult& run : runs)
    for (std::size_t h = 0; h < run.gas.lateral.size(); ++h)
      if (std::none_of(heights.begin(), heights.end(),
                       [&](double other) { return std::abs(other - run.heights[h]) < 1e-9; }))
        heights.push_back(run.heights[h]);
  std::sort(heights.begin(), heights.end());
  return heights;
}

std::vector<Pair> pairs_at(Runs runs, double height) {
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t h = 0; h < runs[r].gas.lateral.size(); ++h)
      if (std::abs(runs[r].heights[h] - height) < 1e-9)
        pairs.push_back(
            {r, &runs[r].gas.lateral[h], solids_at(runs[r], &runs[r].species.front().lateral, h)});
  return pairs;
}

Figure lateral_gas_figure(Runs runs, std::span<const double> heights,
                          std::span<const Quantity> quantities, const std::string& name) {
  constexpr double left = 19, bottom = 11, gap = 4, top = 5.5, row = 38;
  const auto entries = gas_legend(runs);
  const double legend = Canvas::legend_height(entries, page_width - left) + 1;
  const auto n = static_cast<double>(quantities.size());
  Canvas canvas(page_width, bottom + n * (row + gap) - gap + top + legend);
  canvas.legend(entries, left, canvas.height() - 0.5, page_width - left);
  const Range x = domain_range(runs, analysis::lateral);
  const Unit unit = length_unit(x.hi - x.lo);
  const double width =
      std::min((page_width - left - 2 + gap) / static_cast<double>(heights.size()) - gap, 80.0);
  for (std::size_t q = 0; q < quantities.size(); ++q)
    for (std::size_t h = 0; h < heights.size(); ++h) {
      Panel panel;
      panel.left = left + static_cast<double>(h) * (width + gap);
      panel.bottom = bottom + (n - 1 - static_cast<double>(q)) * (row + gap);
      panel.width = width;
      panel.height = row;
      panel.x = exact_axis(x.lo * unit.factor, x.hi * unit.factor, width < 20 ? 2 : 4);
      panel.y = rounded_axis(quantities[q].range.lo, quantities[q].range.hi, 6);
      panel.x_numbers = q + 1 == quantities.size();
      panel.y_numbers = h == 0;
      if (panel.x_numbers) panel.x_label = literal(fmt::format("x [{}]", unit.name));
      if (h == 0) panel.y_label = literal(quantities[q].label);
      panel.y_label_gap = 15;
      panel.zero_line = true;
      panel.neighbour = h + 1 < heights.size();
      canvas.open(panel);
      if (q == 0)
        canvas.label(literal(fmt::format("z = {} m", number(heights[h]))), panel.left + width / 2,
                     panel.bottom + row + 2.6);
      draw_panel(canvas, runs, pairs_at(runs, heights[h]), quantities[q], unit.factor, false);
    }
  return drawn(canvas, name, "Lateral profiles of the gas",
               fmt::format("Voidage ε and vertical gas velocity u_z = ⟨ε u⟩/⟨ε⟩ (interstitial; "
                           "{}) against lateral position, in bands of {} mm height around z; "
                           "bands: {}. {}.",
                           solids_words(runs), number(1e3 * runs.front().band), interval_words,
                           window_words(runs)));
}

}  // namespace

std::vector<Figure> gas_figures(Runs runs) {
  if (std::none_of(runs.begin(), runs.end(), [](const RunResult& run) { return run.gas.present; }))
    return {};
  constexpr std::size_t most = 6;  // panels side by side
  std::vector<Figure> figures{axial_gas_figure(runs)};
  const auto heights = gas_heights(runs);
  std::vector<Pair> pairs;
  for (const double height : heights)
    for (const Pair& pair : pairs_at(runs, height)) pairs.push_back(pair);
  const auto quantities = quantities_of(pairs, {{"voidage ε [-]", &GasProfile::voidage, {}},
                                                {"u_z and v_z [m/s]", &GasProfile::velocity_z, {}},
                                                {"T [K]", &GasProfile::temperature, {}}});
  if (quantities.empty()) return figures;
  for (std::size_t first = 0; first < heights.size(); first += most) {
    const auto some = std::span(heights).subspan(first, std::min(most, heights.size() - first));
    const auto part = first == 0 ? "" : fmt::format("_{}", first / most + 1);
    figures.push_back(lateral_gas_figure(runs, some, quantities, "gas_lateral" + part));
  }
  return figures;
}

}  // namespace bedscope::report
