// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/clear.hpp"

#include <algorithm>
#include <cmath>

namespace bedscope::digitise {
namespace {

/// A row is part of a rule where ink is spread over all of it: in all but a sixteenth of 48 pieces
/// (of 8 pixels at least), which are longer than the gaps of dashes and shorter than those between
/// many markers at one height.
bool spread(const cv::Mat& row, double least) {
  const int pieces = std::clamp(row.cols / 8, 1, 48);
  int with = 0;
  double share = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const int from = row.cols * piece / pieces, to = row.cols * (piece + 1) / pieces;
    int inked = 0;
    for (int x = from; x < to; ++x) inked += row.at<float>(x) > 0.06F;
    with += inked > 0.08 * (to - from);
    share += static_cast<double>(inked) / (to - from) / pieces;
  }
  return with >= pieces - pieces / 16 && share > least;
}

void clear_row(cv::Mat coverage, cv::Mat unknown) {
  std::vector<float> inked;
  for (int x = 0; x < coverage.cols; ++x)
    if (coverage.at<float>(x) > 0.06F) inked.push_back(coverage.at<float>(x));
  std::sort(inked.begin(), inked.end());
  const float pale = inked[inked.size() / 2], upper = inked[inked.size() * 3 / 4];
  if (upper > 0.6F) {  // as dark as data
    unknown.setTo(255);
    coverage.setTo(0);
    return;
  }
  for (int x = 0; x < coverage.cols; ++x) {
    float& share = coverage.at<float>(x);
    share = share < 1.15F * upper + 0.05F ? 0 : (share - pale) / (1 - pale);
  }
}

/// Rows of ink from edge to edge, by their runs. None where they are so thick that this is a
/// picture, not a grid: a rule is thin.
std::vector<cv::Range> ruled_rows(const cv::Mat& coverage) {
  std::vector<cv::Range> ruled;
  for (int y = 0; y < coverage.rows; ++y) {
    if (!spread(coverage.row(y), 0.25)) continue;
    if (ruled.empty() || ruled.back().end < y)
      ruled.emplace_back(y, y + 1);
    else
      ++ruled.back().end;
  }
  const int thickest = std::max(12, coverage.rows / 25);
  if (std::any_of(ruled.begin(), ruled.end(),
                  [&](const cv::Range& rule) { return rule.size() > thickest; }))
    return {};
  return ruled;
}

/// Whether a rule lies in the plot and not on its edge, where the frame is.
bool is_inside(const cv::Range& rule, int rows) {
  const int edge = std::max(4, rows / 50);
  return rule.start >= edge && rule.end <= rows - edge;
}

/// Where data lies over a rule: ink on both sides, what is there is wider than the rule; or a
/// stretch of ink much longer than the dots or dashes of a broken one.
std::vector<bool> data_over(const cv::Mat& coverage, const cv::Range& rule) {
  const auto inked = [&](int y, int x) {
    return y >= 0 && y < coverage.rows && coverage.at<float>(y, x) > 0.3F;
  };
  std::vector<bool> data(coverage.cols);
  std::vector<cv::Range> dashes;
  for (int x = 0; x < coverage.cols; ++x) {
    data[x] = inked(rule.start - 1, x) && inked(rule.end, x);
    bool any = false;
    for (int y = rule.start; y < rule.end; ++y) any = any || inked(y, x);
    if (!any) continue;
    if (dashes.empty() || dashes.back().end < x)
      dashes.emplace_back(x, x + 1);
    else
      ++dashes.back().end;
  }
  if (dashes.size() < 8) return data;
  std::vector<int> lengths;
  for (const auto& dash : dashes) lengths.push_back(dash.size());
  std::sort(lengths.begin(), lengths.end());
  const int longest = 2 * lengths[lengths.size() * 3 / 4] + 4;
  for (const auto& dash : dashes)
    if (dash.size() > longest) std::fill(data.begin() + dash.start, data.begin() + dash.end, true);
  return data;
}

/// Each rule with its paler edge rows, but for the data over it.
void clear_rows(cv::Mat coverage, cv::Mat unknown, const std::vector<cv::Range>& ruled) {
  for (const auto& rule : ruled) {
    const cv::Mat as_it_was = coverage.rowRange(rule).clone(),
                  known_before = unknown.rowRange(rule).clone();
    const auto data = data_over(coverage, rule);
    for (int y = rule.start; y < rule.end; ++y) clear_row(coverage.row(y), unknown.row(y));
    for (int x = 0; x < coverage.cols; ++x) {
      if (!data[x]) continue;
      as_it_was.col(x).copyTo(coverage.rowRange(rule).col(x));
      known_before.col(x).copyTo(unknown.rowRange(rule).col(x));
    }
  }
}

/// Whether there is paper round a stroke that sticks in from the left edge of the map: it is a
/// tick, and not part of a marker or a curve that goes on there.
bool ends_in_paper(const cv::Mat& coverage, cv::Range rows, int end) {
  const auto inked = [&](int y, int x) {
    return y >= 0 && y < coverage.rows && x < coverage.cols && coverage.at<float>(y, x) > 0.3F;
  };
  for (int y = rows.start - 2; y < rows.end + 2; ++y)
    if (inked(y, end + 1) || inked(y, end + 2)) return false;
  return true;
}

/// Strokes that stick in from the left edge of the map, up to a twentieth of its width.
void clear_ticks(cv::Mat coverage, cv::Mat unknown) {
  const int longest = std::max(8, coverage.cols / 20);
  for (int y = 0; y < coverage.rows; ++y) {
    int x = 0;
    while (x < coverage.cols && unknown.at<uchar>(y, x) != 0) ++x;
    if (x > longest) continue;
    const int first = x;
    while (x < coverage.cols && coverage.at<float>(y, x) > 0.12F) ++x;
    if (x == first || x - first > longest) continue;
    // Thin: no more than a few rows start here together.
    int top = y, bottom = y + 1;
    const auto starts = [&](int row) {
      return row >= 0 && row < coverage.rows && coverage.at<float>(row, first) > 0.12F;
    };
    while (starts(top - 1) && y - top < longest) --top;
    while (starts(bottom) && bottom - y < longest) ++bottom;
    if (bottom - top > std::max(5, coverage.rows / 60)) continue;
    if (!ends_in_paper(coverage, {top, bottom}, x)) continue;
    const auto tick = cv::Range(0, std::min(coverage.cols, x + 1));
    unknown(cv::Range(y, y + 1), tick).setTo(255);
    coverage(cv::Range(y, y + 1), tick).setTo(0);
  }
}

cv::Mat mirrored(const cv::Mat& m) {
  cv::Mat copy;
  cv::flip(m, copy, 1);
  return copy;
}

}  // namespace

void clear_rules(InkMap& map, bool is_grey) {
  cv::Mat coverage = map.coverage.t(), unknown = map.unknown.t();
  auto rows = ruled_rows(map.coverage), columns = ruled_rows(coverage);
  const auto take_inside = [](std::vector<cv::Range>& ruled, int n) {
    std::vector<cv::Range> inside;
    std::copy_if(ruled.begin(), ruled.end(), std::back_inserter(inside),
                 [&](const cv::Range& rule) { return is_inside(rule, n); });
    std::erase_if(ruled, [&](const cv::Range& rule) { return is_inside(rule, n); });
    return inside;
  };
  const auto inner_rows = take_inside(rows, map.coverage.rows),
             inner_columns = take_inside(columns, map.coverage.cols);
  const auto clear = [&](const std::vector<cv::Range>& ruled,
                         const std::vector<cv::Range>& across) {
    clear_rows(map.coverage, map.unknown, ruled);
    coverage = map.coverage.t(), unknown = map.unknown.t();
    clear_rows(coverage, unknown, across);
    map.coverage = coverage.t(), map.unknown = unknown.t();
  };
  clear(rows, columns);
  // A grid has more lines than one: one alone is the data's, a constant, if it has a colour of its
  // own or holds most of the ink.
  bool constant = inner_rows.size() + inner_columns.size() == 1;
  if (constant && is_grey) {
    // With as many rows on both sides, as it may wave a little.
    const auto& rule = inner_rows.empty() ? inner_columns[0] : inner_rows[0];
    const cv::Mat& along = inner_rows.empty() ? coverage : map.coverage;
    const int more = std::min({rule.size(), rule.start, along.rows - rule.end});
    constant = cv::sum(along.rowRange(rule.start - more, rule.end + more))[0] >
               0.5 * cv::sum(map.coverage)[0];
  }
  if (!constant) clear(inner_rows, inner_columns);
  coverage = map.coverage.t(), unknown = map.unknown.t();
  for (int turn = 0; turn < 2; ++turn) {  // top, bottom; then left, right
    clear_ticks(coverage, unknown);
    cv::Mat far_coverage = mirrored(coverage), far_unknown = mirrored(unknown);
    clear_ticks(far_coverage, far_unknown);
    coverage = mirrored(far_coverage).t();
    unknown = mirrored(far_unknown).t();
  }
  map.coverage = coverage.t();
  map.unknown = unknown.t();
}

}  // namespace bedscope::digitise
