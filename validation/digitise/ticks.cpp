// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/ticks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "validation/digitise/page.hpp"

namespace bedscope::digitise {
namespace {

constexpr float faint = 0.25F;  // of the edge's ink: below it there is no tick

/// The colour of the line along the row `edge` from `from` to `to`, less that of the paper: of each
/// column the pixel within two of the row that differs most, of these the median.
cv::Vec3f line_colour(const cv::Mat& difference, double edge, int from, int to) {
  std::array<std::vector<float>, 3> channels;
  for (int x = from; x < to; ++x) {
    cv::Vec3f most;
    for (int y = std::max(0, cvFloor(edge) - 2); y < std::min(difference.rows, cvFloor(edge) + 3);
         ++y)
      if (const auto d = difference.at<cv::Vec3f>(y, x); d.dot(d) > most.dot(most)) most = d;
    for (int c = 0; c < 3; ++c) channels[static_cast<std::size_t>(c)].push_back(most[c]);
  }
  cv::Vec3f colour;
  for (int c = 0; c < 3; ++c) {
    auto& values = channels[static_cast<std::size_t>(c)];
    if (values.empty()) continue;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    colour[c] = *middle;
  }
  return colour;
}

/// The share of `ink` in a pixel that differs by `d` from the paper; 0 where it is of another hue:
/// farther from any mixture of the two than noise (25 of 255) and a seventh of its own strength,
/// the angle between black and the browns.
float share_of_line(cv::Vec3f d, cv::Vec3f ink) {
  const float share = d.dot(ink) / ink.dot(ink);
  const double rest = cv::norm(d - share * ink);
  return rest < std::max(25.0, cv::norm(d) / 7) ? std::clamp(share, 0.0F, 1.0F) : 0;
}

/// The middle of the ink in the `columns` of a row, and how much of it there is [px].
std::pair<double, double> middle_of(const cv::Mat& row, cv::Range columns) {
  double mass = 0, moment = 0;
  for (int x = columns.start; x < columns.end; ++x) {
    mass += row.at<float>(x);
    moment += row.at<float>(x) * (x + 0.5);
  }
  return {moment / mass, mass};
}

/// Whether what crosses all rows in `columns` does so straight: a curve that starts at the edge
/// leans. To half a pixel, as the ink of the nearest and of the farthest row tells it in a JPEG.
bool is_upright(const cv::Mat& rows, cv::Range columns) {
  const double near = middle_of(rows.row(0), columns).first,
               far = middle_of(rows.row(rows.rows - 1), columns).first;
  return std::abs(far - near) < 0.5;
}

/// The first row beyond the line along the row `edge`, to one `side`: where less than half of the
/// columns hold its ink.
int beyond_line(const cv::Mat& difference, cv::Vec3f ink, double edge, int from, int to, int side) {
  int y = cvFloor(edge);
  for (; y >= 0 && y < difference.rows; y += side) {
    int held = 0;
    for (int x = from; x < to; ++x)
      held += share_of_line(difference.at<cv::Vec3f>(y, x), ink) >= faint;
    if (2 * held < to - from) break;
  }
  return y;
}

/// The ticks along the row `edge` of `page`, from column `from` to `to`.
std::vector<double> ticks_along(const cv::Mat& page, cv::Vec3f paper, double edge, int from, int to,
                                double shorter_side) {
  const int reach = std::max(3, cvRound(0.006 * shorter_side));  // the least length of a tick
  const int margin = 4 * reach;
  const int top = std::clamp(cvFloor(edge) - margin, 0, page.rows);
  const int bottom = std::clamp(cvCeil(edge) + margin, top, page.rows);
  from = std::clamp(from - reach, 0, page.cols);  // the ends are middles of thick lines
  to = std::clamp(to + reach, from, page.cols);
  cv::Mat difference;
  page(cv::Range(top, bottom), cv::Range::all()).convertTo(difference, CV_32F);
  difference -= cv::Scalar(paper[0], paper[1], paper[2]);
  const auto ink = line_colour(difference, edge - top, from, to);
  if (ink.dot(ink) < 60 * 60) return {};  // there is no line
  std::vector<double> best;
  for (const int side : {+1, -1}) {
    // The rows beside the line that a tick crosses, the nearest first; blur is left out.
    const int first_row = beyond_line(difference, ink, edge - top, from, to, side) + side;
    cv::Mat shares = cv::Mat::zeros(reach, page.cols, CV_32F), least;
    for (int i = 0; i < reach; ++i) {
      const int y = first_row + side * i;
      if (y < 0 || y >= difference.rows) continue;
      for (int x = from; x < to; ++x)
        shares.at<float>(i, x) = share_of_line(difference.at<cv::Vec3f>(y, x), ink);
    }
    cv::reduce(shares, least, 0, cv::REDUCE_MIN);
    std::vector<double> ticks;
    for (int x = 1; x + 1 < page.cols; ++x) {
      if (least.at<float>(x) < faint) continue;
      const int first = x;
      while (x + 1 < page.cols && least.at<float>(x) >= faint) ++x;
      const cv::Range columns(first - 1, x + 1);
      const auto [middle, thickness] = middle_of(least, columns);
      if (thickness < 2 * reach && is_upright(shares, columns)) ticks.push_back(middle);
    }
    if (ticks.size() > best.size()) best = ticks;
  }
  return best;
}

}  // namespace

Ticks find_ticks(const cv::Mat& page, const cv::Rect2d& area) {
  const auto paper = paper_of(page, {{0, 0}, page.size()});
  const double shorter = std::min(area.width, area.height);
  return {ticks_along(page, paper, area.br().y, cvFloor(area.x), cvCeil(area.br().x), shorter),
          ticks_along(page.t(), paper, area.x, cvFloor(area.y), cvCeil(area.br().y), shorter)};
}

}  // namespace bedscope::digitise
