// SPDX-License-Identifier: BSD-3-Clause
#include "app/figure_file.hpp"

#include <array>
#include <filesystem>
#include <set>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::app {
namespace {

using Table = readers::TomlTable;
using readers::found_text;
using readers::parse_toml;

using digitise::AxisSpec;
using digitise::Kind;
using digitise::SeriesSpec;

std::optional<std::vector<double>> numbers_of(Table& table, std::string_view key, std::size_t count,
                                              std::string_view expected) {
  const auto values = table.numbers(key);
  if (values && values->size() != count)
    table.fail(*table.find(key), "{}: expected {}, found {} numbers", table.key(key), expected,
               values->size());
  return values;
}

cv::Rect2d box_of(const Table& table, const toml::node& node, const std::string& key,
                  const std::vector<double>& v) {
  if (!(v[2] > 0 && v[3] > 0))
    table.fail(node, "{}: expected a width and a height above 0, found {} and {}", key, v[2], v[3]);
  return {v[0], v[1], v[2], v[3]};
}

std::optional<cv::Rect2d> box(Table& table, std::string_view key) {
  const auto values = numbers_of(table, key, 4, "[left, top, width, height]");
  if (!values) return std::nullopt;
  return box_of(table, *table.find(key), table.key(key), *values);
}

/// [[left, top, width, height], ...]
std::vector<cv::Rect2d> boxes(Table& table, std::string_view key) {
  std::vector<cv::Rect2d> found;
  const auto* node = table.find(key);
  if (node == nullptr) return found;
  if (!node->is_array())
    table.fail(*node, "{}: expected [[left, top, width, height], ...], found {}", table.key(key),
               found_text(*node));
  for (const auto& item : *node->as_array()) {
    if (!item.is_array() || item.as_array()->size() != 4)
      table.fail(item, "{}: expected [[left, top, width, height], ...], found {}", table.key(key),
                 found_text(item));
    std::vector<double> values;
    for (const auto& number : *item.as_array())
      values.push_back(table.number(number, table.key(key)));
    found.push_back(box_of(table, item, table.key(key), values));
  }
  return found;
}

AxisSpec read_axis(Table& axes, std::string_view name) {
  auto table = axes.table(name);
  if (!table)
    axes.fail(axes.raw(), "{} is missing: expected points = [{{ pixel = [x, y], value = v }}, ...]",
              axes.key(name));
  AxisSpec axis;
  axis.name = table->text("name").value_or(std::string(name));
  axis.unit = table->text("unit").value_or("-");
  const auto scale = table->text("scale").value_or("linear");
  if (scale != "linear" && scale != "log")
    table->fail(*table->find("scale"), "{}: expected \"linear\" or \"log\", found \"{}\"",
                table->key("scale"), scale);
  axis.log = scale == "log";
  auto points = table->tables("points");
  if (points.size() < 2)
    table->fail(table->raw(), "{}: expected two points or more, found {}", table->key("points"),
                points.size());
  for (auto& point : points) {
    const auto pixel = numbers_of(point, "pixel", 2, "[x, y]");
    const auto value = point.number("value");
    if (!pixel || !value)
      point.fail(point.raw(), "{}: expected {{ pixel = [x, y], value = v }}", table->key("points"));
    if (axis.log && !(*value > 0))
      point.fail(*point.find("value"), "{}: expected values above 0 on a log axis, found {}",
                 table->key("points"), *value);
    point.finish();
    axis.points.push_back({{(*pixel)[0], (*pixel)[1]}, *value});
  }
  table->finish();
  return axis;
}

constexpr std::array<std::pair<std::string_view, unsigned>, 19> colour_names{
    {{"black", 0x000000},
     {"white", 0xffffff},
     {"red", 0xff0000},
     {"green", 0x008000},
     {"blue", 0x0000ff},
     {"orange", 0xffa500},
     {"purple", 0x800080},
     {"brown", 0xa52a2a},
     {"pink", 0xffc0cb},
     {"grey", 0x808080},
     {"gray", 0x808080},
     {"olive", 0x808000},
     {"cyan", 0x00ffff},
     {"magenta", 0xff00ff},
     {"yellow", 0xffff00},
     {"lime", 0x00ff00},
     {"navy", 0x000080},
     {"teal", 0x008080},
     {"maroon", 0x800000}}};

cv::Vec3f read_colour(Table& table) {
  const auto text = table.text("colour");
  if (!text) table.fail(table.raw(), "series.colour is missing: expected \"#rrggbb\"");
  for (const auto& [name, value] : colour_names)
    if (*text == name)
      return {static_cast<float>(value & 255), static_cast<float>(value >> 8 & 255),
              static_cast<float>(value >> 16)};
  std::string digits = text->substr(text->starts_with('#') ? 1 : 0);
  if (digits.size() == 3)
    digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
  if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != digits.npos)
    table.fail(*table.find("colour"),
               "series.colour: expected \"#rrggbb\" or a name such as \"red\", found \"{}\"",
               *text);
  const auto value = std::stoul(digits, nullptr, 16);
  return {static_cast<float>(value & 255), static_cast<float>(value >> 8 & 255),
          static_cast<float>(value >> 16)};
}

SeriesSpec read_series(Table& table, std::size_t number) {
  SeriesSpec series;
  series.name = table.text("name").value_or(fmt::format("series {}", number));
  const auto kind = table.text("kind").value_or("markers");
  if (kind != "markers" && kind != "line")
    table.fail(*table.find("kind"), "series.kind: expected \"markers\" or \"line\", found \"{}\"",
               kind);
  series.kind = kind == "line" ? Kind::line : Kind::markers;
  series.colour = read_colour(table);
  if (const auto shape = table.text("shape")) {
    series.shape = digitise::shape_of(*shape);
    if (!series.shape)
      table.fail(*table.find("shape"),
                 "series.shape: expected open or filled and one of {}, found \"{}\"",
                 fmt::join(digitise::outline_names(), ", "), *shape);
  }
  if (const auto sample = box(table, "template"))
    series.sample = cv::Rect(cv::Point(cvFloor(sample->x), cvFloor(sample->y)),
                             cv::Point(cvCeil(sample->br().x), cvCeil(sample->br().y)));
  if (const auto reference = numbers_of(table, "reference", 2, "[x, y]"))
    series.reference = cv::Point2d((*reference)[0], (*reference)[1]);
  if (series.reference && !series.sample)
    table.fail(*table.find("reference"),
               "series.reference: expected a template beside it, found none");
  series.error_bars = table.boolean("error_bars");
  const auto points = table.integer("points").value_or(series.points);
  if (points < 2 || points > 100000)
    table.fail(*table.find("points"), "series.points: expected 2 to 100000, found {}", points);
  series.points = static_cast<int>(points);
  table.finish();
  return series;
}

std::vector<std::string> read_images(Table& table, const std::filesystem::path& folder) {
  const auto* node = table.find("image");
  if (node == nullptr) return {};  // given on the command line
  const auto names = node->is_string() ? std::vector{*table.text("image")} : *table.texts("image");
  std::vector<std::string> images;
  for (const auto& name : names) {
    const std::filesystem::path path(name);
    images.push_back((path.is_absolute() ? path : folder / path).lexically_normal().string());
  }
  return images;
}

}  // namespace

FigureFile read_figure(const std::string& path) {
  const auto parsed = parse_toml(path);
  Table table(parsed, "", path);
  FigureFile file;
  file.images = read_images(table, std::filesystem::path(path).parent_path());
  auto& figure = file.figure;
  figure.plot_area = box(table, "plot_area");
  figure.exclude = boxes(table, "exclude");
  figure.rotation = table.number("rotation");
  if (figure.rotation && !(std::abs(*figure.rotation) <= 45))
    table.fail(*table.find("rotation"), "rotation: expected -45 to 45 degrees, found {}",
               *figure.rotation);
  auto axes = table.table("axes");
  auto series = table.tables("series");
  table.finish();
  if (!axes) throw InputError("{}: axes is missing: expected [axes.x] and [axes.y]", path);
  figure.x = read_axis(*axes, "x");
  figure.y = read_axis(*axes, "y");
  axes->finish();
  if (series.empty()) throw InputError("{}: no [[series]]: expected at least one", path);
  std::set<std::string> names;
  for (auto& one : series) {
    figure.series.push_back(read_series(one, figure.series.size() + 1));
    if (!names.insert(figure.series.back().name).second)
      one.fail(one.raw(), "series.name: \"{}\" occurs twice", figure.series.back().name);
  }
  return file;
}

}  // namespace bedscope::app
