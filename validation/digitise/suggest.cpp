// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "readers/error.hpp"
#include "validation/digitise/colour.hpp"
#include "validation/digitise/page.hpp"
#include "validation/digitise/rules.hpp"
#include "validation/digitise/ticks.hpp"

namespace bedscope::digitise {
namespace {

/// The widest area that a horizontal and a vertical line enclose or span.
cv::Rect2d largest_area(const Rules& rules, cv::Size size) {
  cv::Rect2d best;
  for (const auto& row : rules.rows)
    for (const auto& column : rules.columns) {
      const bool meet = row.at > column.from - 6 && row.at < column.to + 6 &&
                        column.at > row.from - 6 && column.at < row.to + 6;
      if (!meet || row.length() * column.length() <= best.area()) continue;
      if (row.length() > 0.98 * size.width || column.length() > 0.98 * size.height) continue;
      best = plot_area(rules,
                       {row.from + 2, column.from + 2, row.length() - 4, column.length() - 4}, size)
                 .box;
    }
  return best;
}

}  // namespace

std::string suggest(const cv::Mat& picture, bool lossy, const std::string& image_name) {
  double angle = angle_of_ink(picture);
  const double least = 0.25 * std::min(picture.cols, picture.rows);
  const auto ink_at = [&](const Page& page) {
    return ink_of(page.image(),
                  paper_of(page.image(), {0, 0, page.image().cols, page.image().rows}));
  };
  if (const auto rest = angle_of(find_rules(ink_at(Page(picture, angle)), least, least / 12));
      rest && std::abs(*rest) < 0.5)
    angle += *rest;
  const Page page(picture, angle);
  const auto rules = find_rules(ink_at(page), least, least / 12);
  const auto area = largest_area(rules, page.image().size());
  if (area.width < 20 || area.height < 20)
    throw InputError(
        "{}: expected axes as straight lines across at least a quarter of the picture, found none",
        image_name);
  const auto ticks = find_ticks(page.image(), area);

  std::string text =
      "# Pixels of axes and ticks as found; the values are yours. Two points an axis are enough.\n";
  text += fmt::format("image = \"{}\"\n", image_name);
  const auto back = [&](cv::Point2d p) { return page.to_picture(p); };
  const auto corner = back(area.tl()), far_corner = back(area.br());
  const cv::Point2d middle = 0.5 * (corner + far_corner);
  text += fmt::format("plot_area = [{:.0f}, {:.0f}, {:.0f}, {:.0f}]\n", middle.x - area.width / 2,
                      middle.y - area.height / 2, area.width, area.height);
  if (page.angle() != 0)
    text += fmt::format("rotation = {:.3f}  # degrees anticlockwise\n", page.angle());
  const auto axis = [&](const char* name, std::vector<double> found, bool is_x) {
    if (found.size() < 2)
      found = is_x ? std::vector{area.x, area.br().x} : std::vector{area.br().y, area.y};
    text += fmt::format(
        "[axes.{}]\nname = \"{}\"\nunit = \"-\"\nscale = \"linear\"  # or \"log\"\npoints = [\n",
        name, name);
    for (const double tick : found) {
      const auto p = back(is_x ? cv::Point2d(tick, area.br().y) : cv::Point2d(area.x, tick));
      text += fmt::format("  {{ pixel = [{:.2f}, {:.2f}], value = nan }},\n", p.x, p.y);
    }
    text += "]\n";
  };
  axis("x", ticks.x, true);
  std::vector<double> upwards(ticks.y.rbegin(), ticks.y.rend());
  axis("y", upwards, false);
  for (const auto& colour : inks_in(page.image(), cv::Rect(area), lossy))
    text += fmt::format(
        "[[series]]\nname = \"{0}\"\nkind = \"markers\"  # or \"line\"\ncolour = \"{0}\"\n",
        hex_of(colour));
  return text;
}

}  // namespace bedscope::digitise
