// SPDX-License-Identifier: BSD-3-Clause
#include "report/check_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "report/columns.hpp"
#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Estimate;
using validation::Verdict;

namespace {

constexpr double coverage_factor = 1.96;
constexpr double width = 110, right = 4, bottom = 11;  // [mm]
constexpr double end_margin = 0.02;                    // of the range of the data
constexpr double main_height = 46, error_height = 20, gap = 4;
constexpr const char* data_style = "pt 7 ps 0.35 lc rgb '#000000'";
constexpr const char* range_style = "lw 0.8 lc rgb '#000000'";  // columns touch: 0.8 px of 0.26 mm
constexpr const char* bars_style = "lw 0.8 lc rgb '#B0B0B0'";
constexpr const char* outside_style = "pt 6 ps 0.5 lc rgb '#000000'";
constexpr const char* result_colour = "#0072B2";

std::vector<Estimate> estimates_of(const validation::Sampled& sampled) {
  std::vector<Estimate> estimates;
  for (std::size_t i = 0; i < sampled.value.size(); ++i)
    estimates.push_back({sampled.value[i], coverage_factor * sampled.u[i]});
  return estimates;
}

/// A single value as a level, so that it has a panel like a profile.
Verdict widened(Verdict verdict) {
  if (!verdict.result.is_scalar) return verdict;
  verdict.result.x = {};
  verdict.result.at = {-1, 1};
  verdict.result.value.resize(2, verdict.result.value.front());
  verdict.result.u.resize(2, verdict.result.u.front());
  for (auto& point : verdict.reference.points) point.x = 0;
  for (auto& point : verdict.comparison.points) point.x = 0;
  return verdict;
}

/// A power of ten in which numbers of this size are easy to read: 0 where they are as they stand.
int exponent_of(double magnitude) {
  if (!(magnitude > 0) || (magnitude >= 1e-4 && magnitude < 1e6)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(magnitude) / 3));
}

/// "10⁻⁹ kg"; the unit alone for an exponent of 0.
std::string unit_in(int exponent, const std::string& unit) {
  if (exponent == 0) return unit;
  static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                      "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
  return unit == "-" ? text : text + " " + unit;
}

double largest(const Verdict& verdict) {
  double size = 0;
  for (const double value : verdict.result.value)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  for (const auto& point : verdict.reference.points) size = std::max(size, std::abs(point.y));
  return size;
}

/// In a power of ten of its unit.
Verdict scaled(Verdict verdict) {
  const int exponent = exponent_of(largest(verdict));
  if (exponent == 0) return verdict;
  const double factor = std::pow(10, -exponent);
  verdict.result.y.unit = unit_in(exponent, verdict.result.y.unit);
  for (double& value : verdict.result.value) value *= factor;
  for (double& u : verdict.result.u) u *= factor;
  for (auto* points :
       {&verdict.reference.points, &verdict.comparison.outside, &verdict.comparison.without_error})
    for (auto& point : *points) {
      point.y *= factor;
      point.u_y *= factor;
      point.u_y_down *= factor;
    }
  for (auto& point : verdict.comparison.points)
    for (double* value : {&point.result, &point.reference, &point.u_result, &point.u_interpolation,
                          &point.u_reference, &point.u_reference_away})
      *value *= factor;
  return verdict;
}

/// The reference as it was compared: turned round where that was so.
std::vector<validation::CurvePoint> shown_reference(const Verdict& verdict) {
  if (!verdict.comparison.mirrored) return verdict.reference.points;
  std::vector<validation::CurvePoint> points;
  for (const auto& point : verdict.comparison.points)
    points.push_back({point.x, point.reference, 0, point.u_reference});
  for (const auto* more : {&verdict.comparison.outside, &verdict.comparison.without_error})
    points.insert(points.end(), more->begin(), more->end());
  return points;
}

/// Abscissae of points that were not compared, ascending.
std::vector<double> left_out_at(const Verdict& verdict) {
  std::vector<double> x;
  for (const auto* points : {&verdict.comparison.outside, &verdict.comparison.without_error})
    for (const auto& point : *points) x.push_back(point.x);
  std::sort(x.begin(), x.end());
  return x;
}

/// Ranges of both panels and what stands under their axes.
struct Layout {
  Panel main, errors;
  double x_factor = 1;
};

/// From the frame to the middle of the y label, past the numbers of the axis [mm].
double label_gap(const Axis& axis) {
  constexpr double least = 14, around = 4;  // half a line of text, and a space on both sides
  double widest = 0;
  for (const double number : {axis.lo, axis.hi})
    widest = std::max(widest, text_width(fmt::format("{:.{}f}", number, axis.decimals)));
  return std::max(least, widest + around);
}

/// The room left of a panel: for half a line of text and a margin [mm].
double left_of(double label_gap) { return label_gap + 5; }

Layout layout_of(const Verdict& verdict, std::span<const Estimate> result, bool with_errors) {
  Range x, y, e;
  for (const double at : verdict.result.at) x.add(at);
  for (const auto& point : shown_reference(verdict)) {
    x.add(point.x);
    y.add(point.y - coverage_factor * point.down());
    y.add(point.y + coverage_factor * point.up());
  }
  add_estimates(y, result);
  if (y.lo > 0 && y.lo < 0.4 * y.hi) y.lo = 0;
  // Markers and bars at the ends stand free of the frame.
  const double margin_x = end_margin * (x.hi - x.lo), margin_y = end_margin * (y.hi - y.lo);
  if (y.lo != 0) y.lo -= margin_y;
  y.hi += margin_y;
  // Errors of rounding are a line at 0.
  const double negligible = 1e-3 * std::max(std::abs(y.lo), std::abs(y.hi));
  e.add(-negligible);
  e.add(negligible);
  for (const auto& point : verdict.comparison.points) {
    e.add(point.error());
    e.add(coverage_factor * point.u_validation());
    e.add(-coverage_factor * point.u_validation());
  }
  const bool is_length = verdict.result.x.unit == "m";
  const Unit unit = is_length ? length_unit(x.hi - x.lo) : Unit{verdict.result.x.unit, 1};
  Layout layout;
  layout.x_factor = unit.factor;
  const double lower = with_errors ? error_height + gap : 0;
  layout.main = {.bottom = bottom + lower, .height = main_height};
  layout.main.x = exact_axis((x.lo - margin_x) * unit.factor, (x.hi + margin_x) * unit.factor, 7);
  layout.main.y = rounded_axis(y.lo, y.hi, 6);
  const auto errors = rounded_axis(e.lo, e.hi, 4);
  layout.main.y_label_gap = std::max(label_gap(layout.main.y), label_gap(errors));
  layout.main.left = left_of(layout.main.y_label_gap);
  layout.main.width = width - layout.main.left - right;
  const bool has_axis = !verdict.result.is_scalar;
  layout.main.x_numbers = !with_errors && has_axis;
  layout.main.y_label = literal(shortened(verdict.result.y.text(), main_height));
  layout.errors = layout.main;
  layout.errors.bottom = bottom;
  layout.errors.height = error_height;
  layout.errors.x_numbers = has_axis;
  layout.errors.y = errors;
  layout.errors.zero_line = true;
  layout.errors.y_label =
      literal(shortened(fmt::format("error [{}]", verdict.result.y.unit), error_height + gap));
  if (has_axis)
    (with_errors ? layout.errors : layout.main).x_label =
        literal(fmt::format("{} [{}]", verdict.result.x.name, unit.name));
  return layout;
}

/// Where columns merge several points: strokes from one end to the other.
void add_strokes(Canvas& canvas, const std::string& name, std::span<const Column> columns,
                 double Column::*low, double Column::*high, const char* style,
                 std::vector<std::string>& layers) {
  std::string rows;
  for (const auto& column : columns)
    if (column.points > 1)
      rows += data_row({column.x, column.*low}) + data_row({column.x, column.*high}) + "\n";
  if (!rows.empty())
    layers.push_back(Canvas::layer(canvas.block(name + ": x, value", rows),
                                   fmt::format("using 1:2 with lines {}", style)));
}

void add_ranges(Canvas& canvas, const std::string& name, std::span<const Column> columns,
                std::vector<std::string>& layers) {
  add_strokes(canvas, "range of the bars of the " + name, columns, &Column::bar_low,
              &Column::bar_high, bars_style, layers);
  add_strokes(canvas, "range of the " + name, columns, &Column::low, &Column::high, range_style,
              layers);
}

/// Single points: their bars and markers.
void add_single(Canvas& canvas, const char* name, std::span<const Column> columns, double cap,
                const char* style, std::vector<std::string>& layers) {
  std::vector<double> x;
  std::vector<Estimate> bars;
  std::string points;
  for (const auto& column : columns) {
    if (column.points > 1) continue;
    x.push_back(column.x);
    bars.push_back(
        {(column.bar_low + column.bar_high) / 2, (column.bar_high - column.bar_low) / 2});
    points += data_row({column.x, column.low, bars.back().ci95});
  }
  if (points.empty()) return;
  if (cap > 0)
    layers.push_back(Canvas::layer(
        canvas.block(fmt::format("bars of the {}: x, value", name), bar_rows(x, bars, cap)),
        "using 1:2 with lines lw 0.6 lc rgb '#000000'"));
  layers.push_back(Canvas::layer(canvas.block(fmt::format("{}: x, value, ci95", name), points),
                                 fmt::format("using 1:2 with points {}", style)));
}

/// The result's line and band.
void add_result(Canvas& canvas, const Verdict& verdict, const Layout& layout,
                std::span<const Estimate> result, std::vector<std::string>& layers) {
  std::vector<BarPoint> points;
  for (std::size_t i = 0; i < result.size(); ++i)
    points.push_back({layout.x_factor * verdict.result.at[i], result[i].value,
                      result[i].value - result[i].ci95, result[i].value + result[i].ci95});
  std::vector<double> at;
  std::vector<Estimate> shown;
  std::string rows;
  for (const std::size_t i : corners_of(points, layout.main)) {
    at.push_back(points[i].x);
    shown.push_back(result[i]);
    rows += data_row({points[i].x, result[i].value, result[i].ci95});
  }
  if (const auto band = estimate_band(at, shown, 1); !band.empty())
    layers.push_back(Canvas::layer(canvas.block("band of the result: value, x", band),
                                   fmt::format("using 2:1 {}", band_words(result_colour))));
  layers.push_back(
      Canvas::layer(canvas.block("result: x, value, ci95", rows),
                    fmt::format("using 1:2 with lines lc rgb '{}' lw 1.3", result_colour)));
}

/// The reference, by what was compared of it and what was not.
struct Shown {
  std::vector<Column> compared, left_out;
};

Shown reference_in(const Verdict& verdict, const Layout& layout) {
  const auto outside = left_out_at(verdict);
  std::vector<BarPoint> compared, left_out;
  for (const auto& point : shown_reference(verdict)) {
    const bool is_out = std::binary_search(outside.begin(), outside.end(), point.x);
    (is_out ? left_out : compared)
        .push_back({layout.x_factor * point.x, point.y, point.y - coverage_factor * point.down(),
                    point.y + coverage_factor * point.up()});
  }
  return {columns_of(compared, layout.main), columns_of(left_out, layout.main)};
}

void draw_main(Canvas& canvas, const Verdict& verdict, const Layout& layout,
               std::span<const Estimate> result) {
  canvas.open(layout.main);
  const auto reference = reference_in(verdict, layout);
  const double cap = bar_cap * (layout.main.x.hi - layout.main.x.lo) / layout.main.width;
  std::vector<std::string> layers;
  add_ranges(canvas, "reference", reference.compared, layers);
  add_ranges(canvas, "reference not compared", reference.left_out, layers);
  add_result(canvas, verdict, layout, result, layers);
  add_single(canvas, "reference", reference.compared, cap, data_style, layers);
  add_single(canvas, "reference not compared", reference.left_out, cap, outside_style, layers);
  canvas.draw(layers);
}

void draw_errors(Canvas& canvas, const Verdict& verdict, const Layout& layout) {
  canvas.open(layout.errors);
  std::vector<BarPoint> points;
  for (const auto& point : verdict.comparison.points) {
    const double half = coverage_factor * point.u_validation();
    points.push_back({layout.x_factor * point.x, point.error(), -half, half});
  }
  const auto columns = columns_of(points, layout.errors);
  std::vector<double> x, low, high;
  for (const auto& column : columns) {
    x.push_back(column.x);
    low.push_back(column.bar_low);
    high.push_back(column.bar_high);
  }
  std::vector<std::string> layers;
  if (x.size() > 1)
    layers.push_back(
        Canvas::layer(canvas.block("1.96 u_val: value, x", band_outline(x, low, high)),
                      "using 2:1 with filledcurves closed fs solid 1 noborder fc rgb '#E4E4E4'"));
  add_strokes(canvas, "range of result - reference", columns, &Column::low, &Column::high,
              range_style, layers);
  add_single(canvas, "result - reference", columns, 0, data_style, layers);
  canvas.draw(layers);
}

/// ", height 0.8 m, 2", or nothing.
std::string place_of(const Verdict& verdict) {
  std::string text;
  for (const auto& [key, value] : verdict.check.place.at)
    text += fmt::format(", {} {}{}", key, value, unit_of_place(key));
  if (verdict.check.place.species != "all")
    text += ", " + species_title(verdict.check.place.species);
  return text;
}

std::string place_words(const Verdict& verdict) {
  return verdict.run + ": " + verdict.check.place.quantity + place_of(verdict);
}

/// What the legend of a scatter plot calls its comparisons: by run, place and reference; by run
/// alone where that would be a long list; nothing but their number where that is one, too.
std::vector<std::string> names_in(const validation::Family& family) {
  constexpr std::size_t long_list = 8, too_long = 16;
  std::vector<std::string> names;
  for (const auto* verdict : family.verdicts) {
    auto name = verdict->run;
    if (family.verdicts.size() <= long_list) {
      name += place_of(*verdict);
      name += " against " + reference_name(*verdict);
    }
    names.push_back(name);
  }
  const std::set<std::string> different(names.begin(), names.end());
  if (different.size() > too_long)
    names.assign(names.size(), fmt::format("{} runs", different.size()));
  return names;
}

}  // namespace

std::string_view unit_of_place(std::string_view key) {
  if (key == "height" || key == "x") return " m";
  return key == "time" ? " s" : "";
}

Figure check_figure(const Verdict& judged, const std::string& name) {
  const auto title = place_words(judged);
  if (judged.outcome == validation::Outcome::skipped || !judged.result.unseen.empty())
    return left_out(name, title, judged.reason);
  const auto verdict = scaled(widened(judged));
  const bool with_errors = !verdict.comparison.points.empty();
  const auto result = estimates_of(verdict.result);
  auto layout = layout_of(verdict, result, with_errors);
  std::vector<LegendEntry> entries;
  const bool merges = verdict.reference.points.size() > most_single;
  if (!verdict.reference.points.empty())
    entries.push_back(
        {merges ? range_style : "", merges ? "" : data_style, verdict.reference.name});
  if (!verdict.comparison.outside.empty() || !verdict.comparison.without_error.empty())
    entries.push_back({"", outside_style, "not compared (outside, or no interval)"});
  entries.push_back({fmt::format("lc rgb '{}' lw 1.3", result_colour), "", verdict.run});
  const double left = layout.main.left;
  const double legend = Canvas::legend_height(entries, width - left) + 1;
  Canvas canvas(width, layout.main.bottom + main_height + 2 + legend);
  canvas.legend(entries, left, canvas.height() - 0.5, width - left);
  draw_main(canvas, verdict, layout, result);
  if (with_errors) draw_errors(canvas, verdict, layout);
  std::string caption = "Line: result";
  if (verdict.result.error_known) caption += ", band: its 95 % confidence interval";
  if (!verdict.reference.points.empty())
    caption += "; points: " + verdict.reference.name + ", bars: 95 % interval";
  if (with_errors)
    caption += ". Beneath: result less reference, grey: 1.96 times the validation uncertainty";
  if (merges || verdict.result.at.size() > most_single)
    caption += fmt::format(
        ". More points than can be seen ({} of the result, {} of the reference): each {} mm shows "
        "how far its points reach{}",
        verdict.result.at.size(), verdict.reference.points.size(), column_width,
        merges ? ", grey: how far their bars do" : "");
  return drawn(canvas, name, title, caption + ".");
}

Figure family_figure(const validation::Family& family, const std::string& name) {
  const auto title = "All of " + family.quantity;
  if (family.points < 3) return left_out(name, title, "fewer than three points above 0");
  constexpr double side = 70;
  double size = 0;
  for (const auto* verdict : family.verdicts) size = std::max(size, largest(*verdict));
  const int exponent = exponent_of(size);
  const double factor = std::pow(10, -exponent);
  const auto unit = unit_in(exponent, family.unit);
  Range range;
  for (const auto* verdict : family.verdicts)
    for (const auto& point : verdict->comparison.points) {
      range.add(factor * point.result);
      range.add(factor * point.reference);
    }
  const double margin = end_margin * (range.hi - range.lo);
  range.hi += margin;
  if (range.lo > 0 && range.lo < 0.4 * range.hi)
    range.lo = 0;
  else
    range.lo -= margin;
  const auto names = names_in(family);
  std::vector<std::string> legend_of;  // each name once
  for (const auto& each : names)
    if (std::find(legend_of.begin(), legend_of.end(), each) == legend_of.end())
      legend_of.push_back(each);
  const auto style_of = [&](const std::string& each) {
    return curve_style(static_cast<std::size_t>(
        std::find(legend_of.begin(), legend_of.end(), each) - legend_of.begin()));
  };
  std::vector<LegendEntry> entries;
  for (const auto& each : legend_of) {
    const auto style = style_of(each);
    entries.push_back({"", fmt::format("{} lc rgb '{}'", style.marker, style.colour), each});
  }
  Panel panel{.bottom = bottom, .width = side, .height = side};
  panel.x = panel.y = rounded_axis(range.lo, range.hi, 5);
  panel.y_label_gap = label_gap(panel.y);
  panel.left = left_of(panel.y_label_gap);
  const double legend = Canvas::legend_height(entries, width - panel.left) + 1;
  Canvas canvas(width, bottom + side + 2 + legend);
  canvas.legend(entries, panel.left, canvas.height() - 0.5, width - panel.left);
  panel.x_label = literal(shortened(fmt::format("reference {} [{}]", family.quantity, unit), side));
  panel.y_label = literal(shortened(fmt::format("result {} [{}]", family.quantity, unit), side));
  canvas.open(panel);
  std::vector<std::string> layers;
  const auto ray = [&](double slope, const char* words) {
    const double from = std::max(0., std::max(panel.x.lo, panel.y.lo / slope));
    const double to = std::min(panel.x.hi, panel.y.hi / slope);
    if (from >= to) return;  // it passes by
    layers.push_back(
        Canvas::layer(canvas.block(fmt::format("result = {:.3g} reference", slope),
                                   data_row({from, slope * from}) + data_row({to, slope * to})),
                      fmt::format("using 1:2 with lines {}", words)));
  };
  ray(1, "lc rgb '#000000' lw 1");
  ray(family.bias, "lc rgb '#D55E00' lw 1.3 dt (12,3)");
  for (const double sign : {-2., 2.})
    ray(family.bias * std::max(0.01, 1 + sign * family.scatter),
        "lc rgb '#D55E00' lw 0.8 dt (3,3)");
  bool merges = false;
  for (std::size_t k = 0; k < family.verdicts.size(); ++k) {
    std::vector<std::pair<double, double>> points;
    for (const auto& point : family.verdicts[k]->comparison.points)
      points.emplace_back(factor * point.reference, factor * point.result);
    merges = merges || points.size() > most_single;
    std::string rows;
    for (const auto& [reference, result] : told_apart(points, panel))
      rows += data_row({reference, result});
    const auto style = style_of(names[k]);
    layers.push_back(Canvas::layer(
        canvas.block("reference, result", rows),
        fmt::format("using 1:2 with points {} lc rgb '{}'", style.marker, style.colour)));
  }
  canvas.draw(layers);
  auto caption = fmt::format(
      "Solid line: equal; long dashes: mean bias {:.3g} (model over reference), short ones: twice "
      "the scatter {:.2g} about it, "
      "the reference's own ({:.2g}) taken out; {} points",
      family.bias, family.scatter, family.sigma_experiment, family.points);
  if (family.left_out > 0)
    caption +=
        fmt::format(", {} not above 0 by more than their uncertainty left out", family.left_out);
  if (merges) caption += fmt::format(", one marker for all within {} mm", cell_width);
  return drawn(canvas, name, title, caption + ".");
}

}  // namespace bedscope::report
