// SPDX-License-Identifier: BSD-3-Clause
#include "validation/curves.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "analysis/csv.hpp"
#include "readers/toml_table.hpp"
#include "validation/sidecar.hpp"

namespace bedscope::validation {
namespace {

namespace fs = std::filesystem;
constexpr double coverage_factor = 1.96;  // of a 95 % interval of a normal distribution

/// Places of a set's columns in its rows.
struct Columns {
  std::size_t x = 0, y = 0;
  std::optional<std::size_t> u_x, u_y, y_lo, y_hi;
  std::vector<std::size_t> parameters;

  bool has_bars() const { return y_lo && y_hi; }
};

std::optional<std::size_t> column_of(const analysis::CsvReader& rows, const std::string& name) {
  const auto& header = rows.header();
  for (std::size_t k = 0; k < header.size(); ++k)
    if (header[k] == name || parse_title(header[k]).name == name) return k;
  return std::nullopt;
}

std::size_t needed(const std::string& path, const analysis::CsvReader& rows,
                   const std::string& name) {
  if (const auto column = column_of(rows, name)) return *column;
  throw FormatError("{}: line 1: expected a column \"{}\", found {}", path, name,
                    fmt::join(rows.header(), ", "));
}

void need_unit(const std::string& path, const std::string& title) {
  if (parse_title(title).unit.empty())
    throw FormatError("{}: line 1: column \"{}\": expected its unit in brackets, such as \"z [m]\"",
                      path, title);
}

/// The column of an axis' uncertainty: the one that the sidecar names, or <name>_u, <name>_ci95.
std::optional<std::size_t> uncertainty_column(const std::string& path,
                                              const analysis::CsvReader& rows,
                                              const std::string& name, UncertaintyRule& rule) {
  if (rule.column.empty() && !rule.absolute && !rule.relative)
    for (const char* suffix : {"_u", "_ci95"})
      if (column_of(rows, name + suffix)) rule.column = name + suffix;
  if (rule.column.empty()) return std::nullopt;
  const auto column = needed(path, rows, rule.column);
  rule.is_interval = parse_title(rows.header()[column]).name.ends_with("_ci95");
  return column;
}

/// A column of uncertainties is in the unit of what it belongs to, where it names one.
void need_unit_of(const std::string& path, const analysis::CsvReader& rows, std::size_t axis,
                  std::optional<std::size_t> column) {
  if (!column) return;
  const auto &title = rows.header()[axis], &found = rows.header()[*column];
  if (const auto unit = parse_title(found).unit; !unit.empty() && unit != parse_title(title).unit)
    throw FormatError("{}: line 1: column \"{}\": expected the unit of \"{}\"", path, found, title);
}

Columns find_columns(const std::string& path, const analysis::CsvReader& rows, Sidecar& sidecar) {
  Columns columns;
  const auto& header = rows.header();
  if (sidecar.table) {
    for (std::size_t k = 0; k < header.size(); ++k) columns.parameters.push_back(k);
    return columns;
  }
  const auto is_extra = [](const std::string& name) {
    for (const char* suffix : {"_u", "_ci95", "_lo", "_hi"})
      if (name.ends_with(suffix)) return true;
    return false;
  };
  std::vector<std::size_t> plain;
  for (std::size_t k = 0; k < header.size(); ++k)
    if (!is_extra(parse_title(header[k]).name)) plain.push_back(k);
  if (plain.size() < 2)
    throw FormatError(
        "{}: line 1: expected an abscissa and an ordinate with their units, a comma between them, "
        "found {}",
        path, fmt::join(header, ", "));
  columns.x =
      sidecar.abscissa.empty() ? plain[plain.size() - 2] : needed(path, rows, sidecar.abscissa);
  columns.y = sidecar.ordinate.empty() ? plain.back() : needed(path, rows, sidecar.ordinate);
  for (const auto k : {columns.x, columns.y}) {
    rows.column(header[k]);  // of that name there is one
    need_unit(path, header[k]);
  }
  const auto x = parse_title(header[columns.x]).name, y = parse_title(header[columns.y]).name;
  columns.u_x = uncertainty_column(path, rows, x, sidecar.u_x);
  columns.u_y = uncertainty_column(path, rows, y, sidecar.u_y);
  columns.y_lo = column_of(rows, y + "_lo");
  columns.y_hi = column_of(rows, y + "_hi");
  if (columns.y_lo.has_value() != columns.y_hi.has_value())
    throw FormatError("{}: line 1: expected both ends of error bars, found \"{}\" alone", path,
                      header[columns.y_lo ? *columns.y_lo : *columns.y_hi]);
  need_unit_of(path, rows, columns.x, columns.u_x);
  for (const auto column : {columns.u_y, columns.y_lo, columns.y_hi})
    need_unit_of(path, rows, columns.y, column);
  for (const auto k : plain)
    if (k != columns.x && k != columns.y && columns.u_x != k && columns.u_y != k)
      columns.parameters.push_back(k);
  return columns;
}

double finite(const analysis::CsvReader& rows, std::size_t column) {
  const double value = rows.number(column);
  if (!std::isfinite(value))
    rows.fail(fmt::format("a number in \"{}\"", rows.header()[column]),
              std::string(rows.text(column)));
  return value;
}

double uncertainty_in(const analysis::CsvReader& rows, std::size_t column) {
  const double value = finite(rows, column);
  if (value < 0)
    rows.fail(fmt::format("an uncertainty of at least 0 in \"{}\"", rows.header()[column]),
              std::string(rows.text(column)));
  return value;
}

/// The arms of an error bar, which is taken as a 95 % interval; an uncertainty beside it (of
/// reading the plot) comes on top.
void read_bar(const analysis::CsvReader& rows, const Columns& columns, CurvePoint& point) {
  const double low = finite(rows, *columns.y_lo), high = finite(rows, *columns.y_hi);
  if (!(low <= point.y && point.y <= high))
    rows.fail(fmt::format("{} <= {} <= {}", rows.header()[*columns.y_lo], rows.header()[columns.y],
                          rows.header()[*columns.y_hi]),
              fmt::format("{}, {}, {}", low, point.y, high));
  point.u_y_down = std::hypot(point.u_y, (point.y - low) / coverage_factor);
  point.u_y = std::hypot(point.u_y, (high - point.y) / coverage_factor);
}

/// The standard uncertainty of a value as a column or the sidecar states it; 0 where neither does.
double stated_uncertainty(const analysis::CsvReader& rows, std::optional<std::size_t> column,
                          const UncertaintyRule& rule, double value) {
  if (column) return uncertainty_in(rows, *column) / (rule.is_interval ? coverage_factor : 1);
  return rule.absolute.value_or(rule.relative.value_or(0) * std::abs(value));
}

CurvePoint read_point(const analysis::CsvReader& rows, const Columns& columns,
                      const Sidecar& sidecar) {
  CurvePoint point{finite(rows, columns.x), finite(rows, columns.y)};
  point.u_x = stated_uncertainty(rows, columns.u_x, sidecar.u_x, point.x);
  point.u_y = stated_uncertainty(rows, columns.u_y, sidecar.u_y, point.y);
  if (columns.has_bars()) read_bar(rows, columns, point);
  return point;
}

/// Values of a text or number column in the order of numbers where all are numbers.
std::vector<std::string> ordered(const std::set<std::string>& values) {
  std::vector<std::string> sorted(values.begin(), values.end());
  const auto is_finite = [](const std::string& text) {
    const auto value = to_number(text);
    return value && std::isfinite(*value);  // nan has no order
  };
  if (std::all_of(sorted.begin(), sorted.end(), is_finite))
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return *to_number(a) < *to_number(b); });
  return sorted;
}

CurveSet read_set(const std::string& name, const std::string& path) {
  CurveSet set{.name = name, .path = path};
  auto sidecar = sidecar_of(path);
  set.about = sidecar.about;
  if (!fs::exists(path)) {
    if (set.about.redistribute)
      throw FileError("{}: missing beside its sidecar, which does not say redistribute = \"no\"",
                      path);
    set.available = false;
    return set;
  }
  analysis::CsvReader rows(path);
  const auto columns = find_columns(path, rows, sidecar);
  if (!sidecar.table) {
    set.x = parse_title(rows.header()[columns.x]);
    set.y = parse_title(rows.header()[columns.y]);
  }
  std::vector<std::set<std::string>> values(columns.parameters.size());
  while (rows.next()) {
    ++set.points;
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k].emplace(rows.text(columns.parameters[k]));
    if (sidecar.table) continue;
    read_point(rows, columns, sidecar);
  }
  if (set.points == 0) throw FormatError("{}: no rows: expected at least one point", path);
  for (std::size_t k = 0; k < values.size(); ++k)
    set.parameters.push_back(
        {parse_title(rows.header()[columns.parameters[k]]), ordered(values[k])});
  return set;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == text.npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

/// "name?U=5.55&height=0.8"
std::pair<std::string, std::map<std::string, std::string>> parse_selection(
    const std::string& selection) {
  const auto question = selection.find('?');
  std::map<std::string, std::string> chosen;
  if (question == selection.npos) return {selection, chosen};
  for (std::size_t at = question + 1; at <= selection.size();) {
    const auto end = std::min(selection.find('&', at), selection.size());
    const auto part = selection.substr(at, end - at);
    const auto equals = part.find('=');
    if (equals == part.npos || equals == 0)
      throw InputError("{}: expected a selection such as \"?U=5.55&height=0.8\", found \"{}\"",
                       selection, part);
    chosen[trimmed(part.substr(0, equals))] = trimmed(part.substr(equals + 1));
    at = end + 1;
  }
  return {selection.substr(0, question), chosen};
}

bool matches(std::string_view text, const std::string& wanted) {
  if (text == wanted) return true;
  const auto a = to_number(text), b = to_number(wanted);
  return a && b && std::abs(*a - *b) <= 1e-6 * std::max(std::abs(*a), std::abs(*b));
}

/// Where nobody states an uncertainty: that of a digitised plot, or none of an original; said.
void assume_uncertainties(const Sidecar& sidecar, bool has_bars, Curve& curve) {
  if (curve.points.empty()) return;
  const bool digitised = sidecar.about.method != "original";
  const auto assume = [&](const UncertaintyRule& rule, const Title& title,
                          double CurvePoint::*value, double CurvePoint::*u, double share) {
    if (rule.stated()) return;
    const auto [low, high] = std::minmax_element(
        curve.points.begin(), curve.points.end(),
        [&](const CurvePoint& a, const CurvePoint& b) { return a.*value < b.*value; });
    // A single value has no range; what it was read from reached as far at least.
    const bool has_range = *high.*value > *low.*value;
    const double range = has_range ? *high.*value - *low.*value : std::abs(*high.*value);
    const double assumed = digitised ? share * range : 0;
    for (auto& point : curve.points) point.*u = assumed;
    curve.assumptions.push_back(one_line(
        digitised
            ? fmt::format("{}: uncertainty of {} not stated; {:.1g}{} ({} % of its {}) "
                          "assumed as for a digitised plot",
                          curve.name, title.name, assumed,
                          title.unit == "-" ? "" : " " + title.unit, share * 100,
                          has_range ? "range" : "value")
            : fmt::format("{}: uncertainty of {} not stated; taken as 0", curve.name, title.name)));
  };
  assume(sidecar.u_x, curve.x, &CurvePoint::x, &CurvePoint::u_x, assumed_u_x);
  if (!has_bars) assume(sidecar.u_y, curve.y, &CurvePoint::y, &CurvePoint::u_y, assumed_u_y);
}

/// All of a few values, the ends of many.
std::string listed(const std::vector<std::string>& values) {
  constexpr std::size_t most = 12;
  if (values.size() <= most) return fmt::format("{}", fmt::join(values, ", "));
  return fmt::format("{}, {} ... {} ({} values)", values[0], values[1], values.back(),
                     values.size());
}

std::string choices(const CurveSet& set) {
  std::string text;
  for (const auto& parameter : set.parameters)
    text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", parameter.title.name,
                        listed(parameter.values));
  return text;
}

/// For each parameter what its rows must hold: chosen, or given by the check's place.
std::vector<std::string> wanted_values(const CurveSet& set, const std::string& selection,
                                       std::map<std::string, std::string> chosen,
                                       const Place& place) {
  std::vector<std::string> wanted;
  for (const auto& [title, values] : set.parameters) {
    std::string value;
    if (const auto named = chosen.find(title.name); named != chosen.end()) {
      value = named->second;
      chosen.erase(named);
    } else if (const auto at = place.at.find(title.name); at != place.at.end()) {
      value = fmt::format("{}", at->second);
    } else {
      wanted.emplace_back();  // any, if the rows that are left agree
      continue;
    }
    if (std::none_of(values.begin(), values.end(),
                     [&](const auto& v) { return matches(v, value); }))
      throw InputError("{}: no point has {} = {}; there are {}", selection, title.name, value,
                       choices(set));
    wanted.push_back(value);
  }
  std::set<std::string> parameters;
  for (const auto& parameter : set.parameters) parameters.insert(parameter.title.name);
  require_place_keys(place, parameters);
  if (!chosen.empty())
    throw InputError("{}: expected a choice among {}, found {}{}", selection,
                     set.parameters.empty() ? "nothing" : choices(set), chosen.begin()->first,
                     chosen.begin()->first == set.x.name ? ", which is the curve's abscissa" : "");
  return wanted;
}

Curve read_curve(const CurveSet& set, const std::string& selection,
                 const std::vector<std::string>& wanted) {
  auto sidecar = sidecar_of(set.path);
  analysis::CsvReader rows(set.path);
  const auto columns = find_columns(set.path, rows, sidecar);
  Curve curve{.name = selection, .path = set.path, .x = set.x, .y = set.y, .about = set.about};
  std::vector<std::set<std::string>> left(wanted.size());
  std::string disorder;
  while (rows.next()) {
    bool mine = true;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      mine = mine && (wanted[k].empty() || matches(rows.text(columns.parameters[k]), wanted[k]));
    if (!mine) continue;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      left[k].emplace(rows.text(columns.parameters[k]));
    const auto point = read_point(rows, columns, sidecar);
    if (!curve.points.empty() && !(point.x > curve.points.back().x) && disorder.empty())
      disorder = fmt::format("{}: line {}: expected times that ascend, found {} after {}", set.path,
                             rows.line(), point.x, curve.points.back().x);
    curve.points.push_back(point);
  }
  // A column without a unit is a label of the source; the numbers beside it choose.
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (left[k].size() > 1 && !set.parameters[k].title.unit.empty())
      throw InputError("{}: several curves of {} against {}: expected a choice of {} among {}",
                       selection, set.y.text(), set.x.text(), set.parameters[k].title.name,
                       listed(ordered(left[k])));
  if (curve.points.empty())
    throw InputError("{}: no point is left; there are {}", selection, choices(set));
  if (curve.x.is_time() && !disorder.empty()) throw FormatError("{}", disorder);
  std::stable_sort(curve.points.begin(), curve.points.end(),
                   [](const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; });
  if (columns.has_bars())
    curve.assumptions.push_back(one_line(
        fmt::format("{}: error bars of {} taken as 95 % intervals", selection, curve.y.name)));
  assume_uncertainties(sidecar, columns.has_bars(), curve);
  return curve;
}

}  // namespace

Curves Curves::open(std::span<const std::string> folders, const fs::path& base) {
  Curves curves;
  curves.base_ = base;
  std::set<std::string> seen;
  for (const auto& folder : folders) {
    if (!fs::is_directory(folder)) throw FileError("{}: expected a folder of curves", folder);
    std::set<std::string> names;
    for (const auto& item : fs::recursive_directory_iterator(folder)) {
      const auto extension = item.path().extension();
      if (!item.is_regular_file() || (extension != ".csv" && extension != ".toml")) continue;
      names.insert(fs::path(item.path()).replace_extension().lexically_relative(folder).string());
    }
    for (const auto& name : names)
      if (seen.insert(name).second)
        curves.sets_.push_back(read_set(name, (fs::path(folder) / name).string() + ".csv"));
  }
  std::sort(curves.sets_.begin(), curves.sets_.end(),
            [](const CurveSet& a, const CurveSet& b) { return a.name < b.name; });
  return curves;
}

Curve Curves::curve(const std::string& selection, const Place& place) const {
  const auto [name, chosen] = parse_selection(selection);
  const auto found =
      std::find_if(sets_.begin(), sets_.end(),
                   [&, &name = name](const CurveSet& set) { return set.name == name; });
  CurveSet set;
  if (found != sets_.end()) {
    set = *found;
  } else if (name.ends_with(".csv")) {
    const auto path = base_ / name;  // an absolute name stays as it is
    if (!fs::exists(path)) throw InputError("{}: no such file, expected a curve", path.string());
    set = read_set(name, path.string());
  } else {
    std::set<std::string> names;
    for (const auto& each : sets_) names.insert(each.name);
    throw InputError("{}: no such curve; the nearest known one is {} (bedscope curves lists them)",
                     name, readers::nearest_name(name, names));
  }
  if (!set.available)
    throw MissingCurve("{}: its numbers may not be passed on; supply {} ({})", name, set.path,
                       set.about.citation);
  if (set.x.name.empty())
    throw InputError("{}: a table of values, not a curve: expected an abscissa and an ordinate",
                     name);
  return read_curve(set, selection, wanted_values(set, selection, chosen, place));
}

}  // namespace bedscope::validation
