// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/overlay.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

namespace bedscope::digitise {
namespace {

constexpr int shift = 4;  // fractional bits of OpenCV's drawing

cv::Point fine(cv::Point2d p) {
  return {cvRound((p.x - 0.5) * (1 << shift)), cvRound((p.y - 0.5) * (1 << shift))};
}

/// Colours that stand out from the paled picture, one a series.
const std::array<cv::Scalar, 6> colours{
    {{255, 0, 255}, {0, 160, 0}, {255, 80, 0}, {0, 120, 255}, {160, 0, 160}, {120, 120, 0}}};

}  // namespace

cv::Mat draw_overlay(const Page& page, const Digitised& found, const Figure& figure) {
  cv::Mat canvas = 0.55 * page.image() + cv::Scalar::all(255 * 0.45);
  const int size = std::max(4, std::min(canvas.cols, canvas.rows) / 120);
  const int thick = std::max(1, size / 6);
  const auto line = [&](cv::Point2d a, cv::Point2d b, const cv::Scalar& colour) {
    cv::line(canvas, fine(a), fine(b), colour, thick, cv::LINE_AA, shift);
  };
  const auto box = [&](const cv::Rect2d& r, const cv::Scalar& colour) {
    line(r.tl(), {r.br().x, r.y}, colour);
    line({r.br().x, r.y}, r.br(), colour);
    line(r.br(), {r.x, r.br().y}, colour);
    line({r.x, r.br().y}, r.tl(), colour);
  };
  box(found.plot_area, {200, 160, 0});
  for (const auto& left_out : found.left_out) {
    box(left_out, {0, 0, 200});
    line(left_out.tl(), left_out.br(), {0, 0, 200});
  }
  for (const auto* axis : {&figure.x, &figure.y})
    for (const auto& point : axis->points) {
      const auto at = page.to_page(point.pixel);
      cv::circle(canvas, fine(at), size << shift, {0, 0, 255}, thick, cv::LINE_AA, shift);
    }
  for (std::size_t i = 0; i < found.series.size(); ++i) {
    const auto& colour = colours[i % colours.size()];
    for (const auto& point : found.series[i].points) {
      const auto p = point.pixel;
      const double arm = found.series[i].kind == Kind::line ? size / 2.0 : size;
      line(p - cv::Point2d(arm, 0), p + cv::Point2d(arm, 0), colour);
      line(p - cv::Point2d(0, arm), p + cv::Point2d(0, arm), colour);
      for (const double end : point.bar_pixel)
        if (end == end) {
          line(p, {p.x, end}, colour);
          line({p.x - arm, end}, {p.x + arm, end}, colour);
        }
    }
  }
  return canvas;
}

}  // namespace bedscope::digitise
