// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bedscope::digitise {
namespace {

struct Looker {
  const InkMap& map;
  double coverage(int y, int x) const {
    return y < 0 || x < 0 || y >= map.coverage.rows || x >= map.coverage.cols
               ? 0
               : map.coverage.at<float>(y, x);
  }
  bool unknown(int y, int x) const {
    return y >= 0 && x >= 0 && y < map.coverage.rows && x < map.coverage.cols &&
           map.unknown.at<uchar>(y, x) != 0;
  }
  /// The most ink of a row within a pixel of the bar's column.
  double on_bar(int y, int x) const {
    return std::max({coverage(y, x - 1), coverage(y, x), coverage(y, x + 1)});
  }
  /// Middle of the ink of a row near x.
  double centre(int y, int x) const {
    double mass = 0, moment = 0;
    for (int i = x - 3; i <= x + 3; ++i) {
      mass += coverage(y, i);
      moment += coverage(y, i) * i;
    }
    return mass > 0 ? moment / mass : x;
  }
  /// Length of the unbroken ink of a row around x.
  int breadth(int y, int x) const {
    int left = x, right = x;
    while (coverage(y, left - 1) > 0.3) --left;
    while (coverage(y, right + 1) > 0.3) ++right;
    return on_bar(y, x) > 0.3 ? right - left + 1 : 0;
  }
};

struct End {
  double row = std::numeric_limits<double>::quiet_NaN();
  double half_cap = 0;
  int cap = 0;        ///< its rows
  int thickness = 0;  ///< of the bar; 0: none is seen
};

/// How far a stroke leans from end to end: from the median of its first third of rows to that of
/// its last, as what it touches at its ends would shift these.
double lean_of(const std::vector<double>& centres) {
  const auto third = static_cast<std::ptrdiff_t>((centres.size() + 2) / 3);
  std::vector<double> first(centres.begin(), centres.begin() + third),
      last(centres.end() - third, centres.end());
  for (auto* part : {&first, &last})
    std::nth_element(part->begin(), part->begin() + third / 2, part->end());
  const auto n = static_cast<double>(centres.size());
  const double apart = std::abs(last[third / 2] - first[third / 2]);
  return n > 1 ? apart * (n - 1) / (n - static_cast<double>(third)) : 0;
}

/// The end of a stroke that leaves the marker's edge row `start` in direction `step` (+1 down).
/// `thickness`: of the bar where others show it, else 0.
End end_of(const Looker& look, int x, int start, int step, double marker_width, bool with_line,
           int thickness) {
  const End none;
  std::vector<int> breadths;
  std::vector<double> centres;
  const double halo = std::max(2.0, marker_width / 4);  // paper that gnuplot leaves round a marker
  int y = start, last = start - step, broken = 0;
  bool after_paper = false;
  for (; y >= 0 && y < look.map.coverage.rows; y += step) {
    if (look.unknown(y, x)) {
      if (++broken > 12) break;
      continue;
    }
    if (look.on_bar(y, x) < 0.3) {
      if (breadths.empty() && std::abs(y - start) < halo) {
        after_paper = true;
        continue;
      }
      if (broken == 0 || look.on_bar(y + step, x) < 0.3) break;
    }
    broken = 0;
    last = y;
    breadths.push_back(look.breadth(y, x));
    centres.push_back(look.centre(y, x));
  }
  const int length = std::abs(last - start) + 1;
  if (breadths.empty()) return none;
  auto sorted = breadths;
  std::sort(sorted.begin(), sorted.end());
  // Of a short bar most rows are the cap's.
  int thin = sorted[sorted.size() / 8];
  if (thickness > 0) thin = std::min(thin, thickness);
  // A bar is thinner than the marker, and straight: it stays so over most of its length.
  if (thin > std::max(2.0, 0.55 * marker_width)) return none;
  const auto wide = [&](int b) { return b >= 1.5 * thin + 2.5; };
  // Behind paper a bar begins thin; the edge of another marker does not stay so.
  if (after_paper)
    for (std::size_t i = 0; i < 3; ++i)
      if (i == breadths.size() || breadths[i] > 1.5 * thin + 1) return none;
  // The cap: the wide rows at the end, but for a faint one at its edge. Its middle is the value.
  const int n = static_cast<int>(breadths.size());
  const int faint = n > 1 && !wide(breadths[n - 1]) && wide(breadths[n - 2]) ? 1 : 0;
  int cap = 0, widest = 0;
  while (cap + faint < n && wide(breadths[n - 1 - faint - cap]))
    widest = std::max(widest, breadths[n - 1 - faint - cap++]);
  if (cap > 0 && cap <= 3 * thin + 2 && (cap < length || widest < marker_width)) {
    double mass = 0, moment = 0;
    for (int i = -1; i <= cap + faint; ++i) {
      const int row = last - step * (cap + faint - 1) + step * i;
      double across = 0;
      for (int dx = thin + 1; dx <= thin + 2; ++dx)
        across += look.coverage(row, x - dx) + look.coverage(row, x + dx);
      mass += across;
      moment += across * (row + 0.5);
    }
    // Where a line runs along the cap, that is not all the cap's.
    if (mass > 0) return {moment / mass, std::min(widest / 2.0, 1.5 * marker_width), cap, thin};
  }
  // A marker's own shoulder is no bar, nor is a steep line; a line does not end in paper.
  if (lean_of(centres) > (with_line ? 0.6 : 1.2)) return none;
  if (with_line && look.breadth(last + 2 * step, x) > 0) return none;
  // Where other markers show bars, what little is seen of a short one is no shoulder.
  const double shortest =
      with_line ? std::max(6.0, 0.12 * marker_width + 2) : 0.12 * marker_width + 2;
  if (length < (thickness > 0 ? 2 : shortest)) return none;
  const double at_last = std::min(1.0, look.on_bar(last, x)),
               beyond = std::min(1.0, look.on_bar(last + step, x));
  const double edge = at_last < 0.9 ? at_last - 1 : beyond;  // how far the ink reaches past the row
  return {(step > 0 ? last + 1 : last) + step * edge, thin / 2.0, 0, thin};
}

/// Nothing is known under the ink of a bar from its marker to this end: the stroke and the cap, and
/// `round` pixels round them.
void hide(InkMap& map, const ErrorBar& bar, cv::Point2d from, double end, double round) {
  const auto hide_box = [&](double half_width, double top, double bottom) {
    const cv::Rect box(cv::Point(cvFloor(from.x - half_width), cvFloor(top)),
                       cv::Point(cvCeil(from.x + half_width), cvCeil(bottom)));
    const cv::Rect there = box & cv::Rect({0, 0}, map.unknown.size());
    if (!there.empty()) map.unknown(there).setTo(255);
  };
  hide_box(bar.thickness / 2.0 + round, std::min(from.y, end), std::max(from.y, end));
  hide_box(bar.half_cap + round, end - bar.cap / 2.0 - round, end + bar.cap / 2.0 + round);
}

}  // namespace

ErrorBar find_error_bar(const InkMap& map, const Template& marker, cv::Point2d at, bool with_line,
                        int thickness) {
  const Looker look{map};
  const cv::Point2d middle = at - marker.reference;
  const int x = cvFloor(at.x);
  const int above = cvFloor(middle.y - marker.box.height / 2 - 1.5);
  const int below = cvFloor(middle.y + marker.box.height / 2 + 1.5);
  const auto lower = end_of(look, x, below, +1, marker.box.width, with_line, thickness);
  const auto upper = end_of(look, x, above, -1, marker.box.width, with_line, thickness);
  return {lower.row, upper.row, std::max(lower.half_cap, upper.half_cap),
          std::max(lower.cap, upper.cap), std::max(lower.thickness, upper.thickness)};
}

std::vector<ErrorBar> find_error_bars(const InkMap& map, const Template& marker,
                                      const std::vector<cv::Point2d>& at, bool with_line) {
  std::vector<ErrorBar> bars;
  std::vector<int> thicknesses;
  for (const auto& place : at) {
    bars.push_back(find_error_bar(map, marker, place, with_line));
    if (bars.back().thickness > 0) thicknesses.push_back(bars.back().thickness);
  }
  if (3 * thicknesses.size() < at.size()) return bars;
  std::sort(thicknesses.begin(), thicknesses.end());
  for (std::size_t i = 0; i < at.size(); ++i)
    if (std::isnan(bars[i].lower) || std::isnan(bars[i].upper))
      bars[i] = find_error_bar(map, marker, at[i], with_line, thicknesses[thicknesses.size() / 2]);
  return bars;
}

void drop_on_bars(const InkMap& map, const std::vector<Template>& templates,
                  const std::vector<bool>& with_bars, std::vector<std::vector<Marker>>& found,
                  bool with_line) {
  struct Barred {
    const Template* marker;
    Fit fit;
    cv::Point2d at;
    ErrorBar bar;
  };
  std::vector<Barred> barred;
  for (std::size_t t = 0; t < templates.size(); ++t) {
    if (!with_bars[t]) continue;
    std::vector<Barred> own;
    for (const auto& one : found[t]) {
      const auto at = one.fit.origin + templates[t].reference;
      const auto bar = find_error_bar(map, templates[t], at, with_line);
      if (bar.thickness > 0) own.push_back({&templates[t], one.fit, at, bar});
    }
    // Where most markers have none, what looks like one is a steep line or a neighbour.
    if (2 * own.size() >= found[t].size()) barred.insert(barred.end(), own.begin(), own.end());
  }
  for (std::size_t t = 0; t < templates.size(); ++t) {
    const auto& marker = templates[t];
    const double little = little_alike(found[t]);
    const auto is_of_bar = [&](const Marker& one, const Barred& other) {
      if (!(one.fit.score < other.fit.score)) return false;
      const auto at = one.fit.origin + marker.reference;
      const double end = at.y < other.at.y ? other.bar.upper : other.bar.lower;
      if (std::abs(at.x - other.at.x) > marker.box.width / 4 || std::isnan(end)) return false;
      if (std::abs(at.y - other.at.y) > std::abs(end - other.at.y) + marker.box.height / 2)
        return false;
      if (one.fit.score < little) return true;
      // Not all that fits is the bar's: two markers of one abscissa.
      InkMap rest{map.coverage.clone(), map.unknown.clone()};
      take_away(rest, *other.marker, other.fit.origin);
      hide(rest, other.bar, other.at, end, 1);
      return !is_marker(fit(marker, rest, one.fit.origin));
    };
    std::erase_if(found[t], [&](const Marker& one) {
      return std::any_of(barred.begin(), barred.end(),
                         [&](const Barred& other) { return is_of_bar(one, other); });
    });
  }
}

void cover(InkMap& map, const ErrorBar& bar, cv::Point2d at) {
  for (const double end : {bar.lower, bar.upper})
    if (!std::isnan(end)) hide(map, bar, at, end, 2);
}

}  // namespace bedscope::digitise
