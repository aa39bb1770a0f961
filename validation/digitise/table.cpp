// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bedscope::digitise {
namespace {

/// A field of RFC 4180: quoted where it holds a comma, a quote or a line break.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// No more digits than the uncertainty bears.
std::string number(double value) {
  return std::isnan(value) ? "nan" : fmt::format("{:.7g}", value);
}

}  // namespace

std::string table_of(const Digitised& found, const Figure& figure) {
  const auto title = [](const AxisSpec& axis, const char* what) {
    return field(fmt::format("{}{} [{}]", axis.name, what, axis.unit));
  };
  const bool bars =
      std::any_of(found.series.begin(), found.series.end(), [](const FoundSeries& series) {
        return std::any_of(series.points.begin(), series.points.end(),
                           [](const Point& p) { return !std::isnan(p.lo) || !std::isnan(p.hi); });
      });
  std::string text = fmt::format("series,{},{},{},{}", title(figure.x, ""), title(figure.x, "_u"),
                                 title(figure.y, ""), title(figure.y, "_u"));
  if (bars) text += fmt::format(",{},{}", title(figure.y, "_lo"), title(figure.y, "_hi"));
  text += '\n';
  for (const auto& series : found.series)
    for (const auto& p : series.points) {
      text += fmt::format("{},{},{:.3g},{},{:.3g}", field(series.name), number(p.x), p.x_u,
                          number(p.y), p.y_u);
      if (bars) text += fmt::format(",{},{}", number(p.lo), number(p.hi));
      text += '\n';
    }
  return text;
}

}  // namespace bedscope::digitise
