// SPDX-License-Identifier: BSD-3-Clause
// The digitiser's file (TOML), on a small picture of a plot.
#include <opencv2/imgproc.hpp>

#include "app/figure_file.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "validation/digitise/table.hpp"

namespace bedscope::fuzz {
namespace {

/// A frame from (20, 10) to (110, 70), five red triangles and a blue line.
cv::Mat plot() {
  cv::Mat picture(90, 120, CV_8UC3, cv::Scalar::all(255));
  cv::rectangle(picture, {20, 10}, {110, 70}, {0, 0, 0});
  for (int k = 0; k < 5; ++k) {
    const cv::Point at(32 + 16 * k, 55 - 8 * k);
    const std::vector<cv::Point> corners{at + cv::Point(-4, 3), at + cv::Point(4, 3),
                                         at + cv::Point(0, -4)};
    cv::fillConvexPoly(picture, corners, {0, 0, 255});
  }
  cv::line(picture, {22, 20}, {108, 60}, {255, 0, 0}, 2);
  return picture;
}

}  // namespace

void use(std::string_view input) {
  static MemoryFile file;
  static const auto picture = [] {
    cv::setNumThreads(0);
    return plot();
  }();
  const auto& path = file.write(input);
  const auto figure = app::read_figure(path).figure;
  require(figure.x.points.size() > 1 && figure.y.points.size() > 1, "axes have points");
  add_input(picture.total() * picture.elemSize());
  const auto found = digitise::digitise(picture, false, figure, path);
  for (const auto& note : found.notes) require_line(note);
  for (const auto& doubt : found.doubts) require_line(doubt);
  require(!digitise::table_of(found, figure).empty(), "a table has its titles");
}

}  // namespace bedscope::fuzz
