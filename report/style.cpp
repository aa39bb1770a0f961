// SPDX-License-Identifier: BSD-3-Clause
#include "report/style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace bedscope::report {
namespace {

/// Width of a character of DejaVu Sans at 8.25 pt [mm].
double char_width(char c) {
  if (std::string_view("ijlI.,:;'|! ").find(c) != std::string_view::npos) return 0.95;
  if (std::string_view("frt()[]/-\"").find(c) != std::string_view::npos) return 1.25;
  if (std::string_view("mwMW@%").find(c) != std::string_view::npos) return 2.9;
  return c >= 'A' && c <= 'Z' ? 2.1 : 1.85;
}

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

/// The smallest of 1, 2, 5 x 10^n that is not below `rough`.
double round_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

int decimals_of(double step) {
  return std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
}

/// A range of some width: gnuplot refuses an empty one, and canvas.cpp writes ten digits of it.
void widen(double& lo, double& hi) {
  if (!(std::isfinite(lo) && std::isfinite(hi))) {
    lo = 0;
    hi = 1;
  }
  if (hi - lo > 1e-7 * std::max(std::abs(lo), std::abs(hi))) return;
  if (lo == 0) {
    hi = 1;
    return;
  }
  const double half = 0.1 * std::abs(lo);
  lo -= half;
  hi += half;
}

int decimals_for(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return 0;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 12);
}

}  // namespace

CurveStyle curve_style(std::size_t i) {
  static constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#000000",
                                      "#CC79A7", "#E69F00", "#56B4E9"};
  static constexpr std::array dashes{"dt solid", "dt (8,3)", "dt (2,2)", "dt (8,2,2,2)",
                                     "dt (12,3)"};
  static constexpr std::array markers{"pt 7 ps 0.30",  "pt 4 ps 0.32", "pt 9 ps 0.38",
                                      "pt 12 ps 0.40", "pt 5 ps 0.28", "pt 6 ps 0.32"};
  const std::string colour = colours[i % colours.size()];
  return {colour, fmt::format("lc rgb '{}' {}", colour, dashes[i % dashes.size()]),
          markers[i % markers.size()]};
}

Axis rounded_axis(double lo, double hi, int intervals) {
  widen(lo, hi);
  Axis axis;
  axis.step = round_step((hi - lo) / intervals);
  // Rounding outwards may need one interval more than there is room for.
  for (int attempt = 0; attempt < 2; ++attempt) {
    axis.lo = axis.step * std::floor(lo / axis.step + 1e-9);
    axis.hi = axis.step * std::ceil(hi / axis.step - 1e-9);
    if (std::lround((axis.hi - axis.lo) / axis.step) <= intervals) break;
    if (attempt == 0) axis.step = round_step(axis.step * 1.01);
  }
  axis.first = axis.lo;
  axis.last = axis.hi;
  axis.decimals = decimals_of(axis.step);
  return axis;
}

Axis exact_axis(double lo, double hi, int intervals) {
  widen(lo, hi);
  Axis axis;
  axis.lo = lo;
  axis.hi = axis.last = hi;
  axis.step = round_step((hi - lo) / intervals);
  axis.first = axis.step * std::ceil(lo / axis.step - 1e-9);
  axis.decimals = decimals_of(axis.step);
  return axis;
}

Axis log_axis(double lo, double hi) {
  constexpr double most_ticks = 8;
  double first = std::floor(std::log10(lo) + 1e-9), last = std::ceil(std::log10(hi) - 1e-9);
  if (last <= first) last = first + 1;
  Axis axis;
  axis.logarithmic = true;
  axis.lo = axis.first = std::pow(10, first);
  axis.hi = axis.last = std::pow(10, last);
  axis.step = last - first > most_ticks ? 100 : 10;
  return axis;
}

void Range::add(double value) {
  if (!std::isfinite(value)) return;
  lo = std::min(lo, value);
  hi = std::max(hi, value);
}

Range central_range(std::vector<double> values, double share) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  Range range;
  if (values.empty()) return range;
  const auto cut = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto low = values.begin() + cut, high = values.end() - 1 - cut;
  std::nth_element(values.begin(), low, values.end());
  range.add(*low);
  std::nth_element(values.begin(), high, values.end());
  range.add(*high);
  return range;
}

Unit length_unit(double magnitude) { return magnitude < 0.5 ? Unit{"mm", 1e3} : Unit{"m", 1}; }

Unit mass_unit(double magnitude) {
  if (magnitude >= 1) return {"kg", 1};
  return magnitude >= 1e-3 ? Unit{"g", 1e3} : Unit{"mg", 1e6};
}

std::string number(double value, int digits) {
  if (std::isnan(value)) return "–";
  return fmt::format("{:.{}g}", value, digits);
}

std::string plus_minus(const analysis::Estimate& estimate, double factor) {
  const double value = factor * estimate.value, ci95 = factor * estimate.ci95;
  if (!std::isfinite(value)) return "–";
  if (!(std::isfinite(ci95) && ci95 > 0)) return number(value, 3);
  const double size = std::max(std::abs(value), ci95);
  if (size < 1e-3 || size >= 1e6) {
    const int exponent = static_cast<int>(std::floor(std::log10(size)));
    const double down = std::pow(10.0, -exponent);
    return fmt::format("({}) × 10^{}", plus_minus({value * down, ci95 * down}), exponent);
  }
  const int enough = decimals_for(value, 5);
  if (ci95 < 0.5 * std::pow(10.0, -enough)) {  // digits that nobody needs
    return fmt::format("{:.{}f} ± < {:.{}f}", value, enough, std::pow(10.0, -enough), enough);
  }
  const double power = std::pow(10.0, std::floor(std::log10(ci95)));
  const int decimals = decimals_for(ci95, ci95 / power < 2.95 ? 2 : 1);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, ci95, decimals);
}

double text_width(std::string_view text) {
  double width = 0;
  for (const char c : text) width += begins_character(c) ? char_width(c) : 0;
  return width;
}

std::string shortened(const std::string& text, double width) {
  if (text_width(text) <= width) return text;
  double used = char_width('m');  // the ellipsis
  std::size_t end = 0;
  while (end < text.size()) {
    used += begins_character(text[end]) ? char_width(text[end]) : 0;
    if (begins_character(text[end]) && used > width) break;
    ++end;
  }
  return text.substr(0, end) + "…";
}

}  // namespace bedscope::report
