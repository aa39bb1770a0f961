// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/figure.hpp"

#include <fmt/format.h>

#include "readers/error.hpp"

namespace bedscope::digitise {

void check_inside(const Figure& figure, cv::Size picture, const std::string& where) {
  const cv::Rect2d whole(0, 0, picture.width, picture.height);
  const auto fail = [&](const std::string& key, const std::string& expected,
                        const std::string& found) {
    throw InputError("{}: {}: expected {} the picture of {} x {} pixels, found {}", where, key,
                     expected, picture.width, picture.height, found);
  };
  const auto check_point = [&](const std::string& key, cv::Point2d at) {
    if (!(at.x >= 0 && at.x <= picture.width && at.y >= 0 && at.y <= picture.height))
      fail(key, "a pixel inside", fmt::format("[{:g}, {:g}]", at.x, at.y));
  };
  const auto text_of = [](const cv::Rect2d& box) {
    return fmt::format("[{:g}, {:g}, {:g}, {:g}]", box.x, box.y, box.width, box.height);
  };
  const auto check_box = [&](const std::string& key, const cv::Rect2d& box) {
    if (box.x < -1 || box.y < -1 || box.br().x > picture.width + 1 ||
        box.br().y > picture.height + 1)
      fail(key, "a box inside", text_of(box));
  };
  for (const auto& [name, axis] :
       {std::pair("axes.x.points", &figure.x), {"axes.y.points", &figure.y}})
    for (const auto& point : axis->points) check_point(name, point.pixel);
  if (figure.plot_area) check_box("plot_area", *figure.plot_area);
  for (const auto& box : figure.exclude)  // to the picture's edge and beyond is everything there
    if ((box & whole).empty()) fail("exclude", "a box that meets", text_of(box));
  for (const auto& series : figure.series) {
    const auto key = fmt::format("series \"{}\": ", series.name);
    if (series.sample) check_box(key + "template", *series.sample);
    if (series.reference) check_point(key + "reference", *series.reference);
  }
}

}  // namespace bedscope::digitise
