// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "validation/digitise/page.hpp"

namespace bedscope::digitise {
namespace {

struct Run {
  int row, from, to;
};

/// The runs of a row of `mask` of at least `least` pixels, gaps of two bridged.
void runs_of_row(const cv::Mat& mask, int row, int least, std::vector<Run>& runs) {
  const auto* pixel = mask.ptr<uchar>(row);
  int from = -1, last = -10;
  const auto close = [&] {
    if (from >= 0 && last - from + 1 >= least) runs.push_back({row, from, last + 1});
    from = -1;
  };
  for (int x = 0; x < mask.cols; ++x) {
    if (pixel[x] == 0) continue;
    if (x - last > 3) {
      close();
      from = x;
    }
    last = x;
  }
  close();
}

/// Middle, thickness and slope of a rule from the ink across it, a straight line through the
/// centres of 32 pieces.
void measure(const cv::Mat& ink, int top, int bottom, Rule& rule) {
  const int margin = 2, pieces = 32;
  top = std::max(0, top - margin);
  bottom = std::min(ink.rows - 1, bottom + margin);
  std::vector<cv::Point2d> centres;
  std::vector<double> masses;
  for (int piece = 0; piece < pieces; ++piece) {
    const int from = static_cast<int>(rule.from + rule.length() * piece / pieces);
    const int to = static_cast<int>(rule.from + rule.length() * (piece + 1) / pieces);
    if (to <= from) continue;
    const cv::Mat strip = ink(cv::Range(top, bottom + 1), cv::Range(from, to));
    double mass = 0, moment = 0, strongest = 0;
    for (int y = 0; y < strip.rows; ++y) {
      const double row = cv::mean(strip.row(y))[0];
      mass += row;
      moment += row * (top + y + 0.5);
      strongest = std::max(strongest, row);
    }
    if (mass <= 0) continue;
    centres.emplace_back((from + to) / 2.0, moment / mass);
    masses.push_back(mass / std::max(strongest, 1e-6));
  }
  if (centres.size() < 4) return;
  // Where data or ticks touch the line the centre is off: the median of slopes and of centres.
  std::vector<double> slopes, offsets;
  for (std::size_t i = 0; i + centres.size() / 2 < centres.size(); ++i) {
    const auto d = centres[i + centres.size() / 2] - centres[i];
    slopes.push_back(d.y / d.x);
  }
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  rule.slope = median(slopes);
  const double middle = (rule.from + rule.to) / 2;
  for (const auto& c : centres) offsets.push_back(c.y - rule.slope * (c.x - middle));
  rule.at = median(offsets);
  rule.thickness = std::max(1.0, median(masses));
}

std::vector<Rule> horizontal(const cv::Mat& ink, double least, double thickest) {
  // A line that leans by a pixel or two over its length stays in one run.
  cv::Mat mask, thick;
  cv::compare(ink, 0.12, mask, cv::CMP_GT);
  cv::dilate(mask, thick, cv::Mat::ones(3, 1, CV_8U));
  std::vector<Run> runs;
  for (int row = 0; row < thick.rows; ++row) runs_of_row(thick, row, static_cast<int>(least), runs);
  std::vector<Rule> rules;
  std::vector<bool> used(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (used[i]) continue;
    int bottom = runs[i].row, from = runs[i].from, to = runs[i].to;
    for (std::size_t j = i + 1; j < runs.size() && runs[j].row <= bottom + 1; ++j) {
      if (used[j] || runs[j].to < from || runs[j].from > to) continue;
      used[j] = true;
      bottom = runs[j].row;
      from = std::min(from, runs[j].from);
      to = std::max(to, runs[j].to);
    }
    Rule rule;
    rule.from = from;
    rule.to = to;
    rule.thickness = bottom - runs[i].row + 1 - 2;
    if (rule.thickness > thickest) continue;
    measure(ink, runs[i].row + 1, bottom - 1, rule);
    rules.push_back(rule);
  }
  return rules;
}

}  // namespace

Rules find_rules(const cv::Mat& ink, double least, double thickest) {
  return {horizontal(ink, least, thickest), horizontal(ink.t(), least, thickest)};
}

std::optional<double> angle_of(const Rules& rules) {
  std::vector<std::pair<double, double>> slopes;  // and lengths
  for (const auto& rule : rules.rows) slopes.emplace_back(-rule.slope, rule.length());
  for (const auto& rule : rules.columns) slopes.emplace_back(rule.slope, rule.length());
  if (slopes.empty()) return std::nullopt;
  std::sort(slopes.begin(), slopes.end());
  double total = 0, sum = 0;
  for (const auto& [slope, length] : slopes) total += length;
  for (const auto& [slope, length] : slopes)
    if ((sum += length) >= total / 2) return std::atan(slope) * 180 / std::numbers::pi;
  return std::nullopt;
}

std::optional<cv::Rect2d> shaded_area(const cv::Mat& page, const cv::Rect2d& inside) {
  const cv::Rect whole({0, 0}, page.size());
  const cv::Rect box = cv::Rect(inside) & whole;
  if (box.width < 8 || box.height < 8) return std::nullopt;
  const auto outer = paper_of(page, whole), inner = paper_of(page, box);
  const cv::Rect frame_of_page[] = {{0, 0, page.cols, 4}, {0, page.rows - 4, page.cols, 4}};
  const auto margin = paper_of(page, frame_of_page[0]), foot = paper_of(page, frame_of_page[1]);
  const auto differs = [&](cv::Vec3f paper) { return cv::norm(paper - inner) > 8; };
  cv::Vec3f page_paper = outer;
  if (!differs(outer)) page_paper = margin;  // the plot fills most of the page
  if (!differs(page_paper) || cv::norm(margin - foot) > 8) return std::nullopt;
  // A row or column of the plot has more pixels near the plot's paper than near the page's.
  const auto of_plot = [&](const cv::Mat& strip) {
    int plot = 0, rest = 0;
    for (int y = 0; y < strip.rows; ++y)
      for (int x = 0; x < strip.cols; ++x) {
        const cv::Vec3f pixel = strip.at<cv::Vec3b>(y, x);
        const double a = cv::norm(pixel - inner), b = cv::norm(pixel - page_paper);
        if (std::min(a, b) < 60) (a < b ? plot : rest) += 1;
      }
    return plot >= rest;
  };
  int left = box.x, right = box.br().x, top = box.y, bottom = box.br().y;
  const auto rows = cv::Range(box.y, box.br().y), columns = cv::Range(box.x, box.br().x);
  while (left > 0 && of_plot(page(rows, {left - 1, left}))) --left;
  while (right < page.cols && of_plot(page(rows, {right, right + 1}))) ++right;
  while (top > 0 && of_plot(page({top - 1, top}, columns))) --top;
  while (bottom < page.rows && of_plot(page({bottom, bottom + 1}, columns))) ++bottom;
  return cv::Rect2d(left, top, right - left, bottom - top);
}

namespace {

/// The box grown to the nearest line on each side of it, where one that spans the box is within a
/// fifth of the box's size.
cv::Rect2d grown_to_lines(const Rules& rules, const cv::Rect2d& box) {
  const auto nearest = [](const std::vector<Rule>& lines, double low, double high,
                          double across_low, double across_high) {
    const double reach = (high - low) / 5;
    double from = low - reach, to = high + reach;
    bool below = false, above = false;
    for (const auto& line : lines) {
      if (line.from > across_low || line.to < across_high) continue;
      if (line.at <= low && line.at >= from) {
        from = line.at;
        below = true;
      }
      if (line.at >= high && line.at <= to) {
        to = line.at;
        above = true;
      }
    }
    return std::pair(below ? from : low, above ? to : high);
  };
  const auto [left, right] = nearest(rules.columns, box.x, box.br().x, box.y, box.br().y);
  const auto [top, bottom] = nearest(rules.rows, box.y, box.br().y, box.x, box.br().x);
  return {left, top, right - left, bottom - top};
}

/// Of the lines that meet the box; see the header.
PlotArea area_of_lines_at(const Rules& rules, const cv::Rect2d& inside, cv::Size page) {
  // A frame in the paper's colour cuts the ends of grid lines.
  const double slack = std::max(4.0, 0.01 * std::min(inside.width, inside.height));
  bool guess = false;
  // The ends of the lines that run this way and meet the box; where a tick goes on beyond a corner,
  // the line across there is the edge.
  const auto edges = [&](const std::vector<Rule>& along, const std::vector<Rule>& across,
                         double low, double high, double across_low, double across_high,
                         double limit) {
    double from = std::max(0.0, low - (high - low) / 8),
           to = std::min(limit, high + (high - low) / 8);
    bool found = false;
    for (const auto& rule : along) {
      const bool meets = rule.at > across_low - slack && rule.at < across_high + slack;
      if (!meets || rule.from > low + slack || rule.to < high - slack) continue;
      from = std::min(found ? std::min(from, rule.from) : rule.from, low);
      to = std::max(found ? std::max(to, rule.to) : rule.to, high);
      found = true;
    }
    guess = guess || !found;
    const double tick = 0.04 * (to - from);
    double first = to, last = from;
    for (const auto& rule : across)
      if (rule.from < across_low + slack && rule.to > across_high - slack) {
        if (rule.at > from - 2 && rule.at < from + tick) first = std::min(first, rule.at);
        if (rule.at < to + 2 && rule.at > to - tick) last = std::max(last, rule.at);
      }
    return std::pair(first < to ? first : from, last > from ? last : to);
  };
  const auto [left, right] = edges(rules.rows, rules.columns, inside.x, inside.br().x, inside.y,
                                   inside.br().y, page.width);
  const auto [top, bottom] = edges(rules.columns, rules.rows, inside.y, inside.br().y, inside.x,
                                   inside.br().x, page.height);
  return {{left, top, right - left, bottom - top}, guess};
}

}  // namespace

PlotArea plot_area(const Rules& rules, const cv::Rect2d& inside, cv::Size page) {
  const auto area = area_of_lines_at(rules, inside, page);
  if (!area.guess) return area;
  const auto framed = area_of_lines_at(rules, grown_to_lines(rules, inside), page);
  return framed.guess ? area : framed;
}

}  // namespace bedscope::digitise
