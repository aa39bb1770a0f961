// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/lines.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "validation/digitise/sections.hpp"
#include "validation/digitise/stroke.hpp"

namespace bedscope::digitise {
namespace {

/// Ink without a break in one column.
struct Run {
  int column = 0;
  double top = 0, bottom = 0, middle = 0, mass = 0;
  bool cut = false;  ///< an unknown pixel is beside it: its middle is not the line's
  double u = 0;      ///< of a marker that stands for the line
  // The best way that ends here:
  double worth = 0, slope = 0;
  int before = -1;
};

struct Path {
  std::vector<Run> runs;  ///< one a column at most, by column
  double mass = 0;
};

std::vector<Run> runs_of(const InkMap& map, const std::vector<LinePoint>& through, int column) {
  std::vector<Run> runs;
  for (const auto& marker : through)
    if (cvFloor(marker.at.x) == column) {
      Run run;
      run.column = column;
      run.middle = marker.at.y;
      run.top = marker.at.y - 0.5;
      run.bottom = marker.at.y + 0.5;
      run.u = marker.u;
      runs.push_back(run);
    }
  constexpr float seen = 0.22F;
  const int rows = map.coverage.rows;
  for (int y = 0; y < rows; ++y) {
    if (map.coverage.at<float>(y, column) < seen || map.unknown.at<uchar>(y, column) != 0) continue;
    int end = y;
    while (end < rows && map.coverage.at<float>(end, column) >= seen &&
           map.unknown.at<uchar>(end, column) == 0)
      ++end;
    Run run;
    run.column = column;
    const auto hidden = [&](int row, int at) {
      return row < 0 || row >= rows || at < 0 || at >= map.coverage.cols ||
             map.unknown.at<uchar>(row, at) != 0;
    };
    const auto unknown = [&](int row) { return hidden(row, column); };
    const int row_inside = (y + end) / 2;
    run.cut = unknown(y - 1) || unknown(end) || hidden(row_inside, column - 1) ||
              hidden(row_inside, column + 1);
    // The faint rows at both edges belong to it.
    double moment = 0;
    for (int row = std::max(0, y - 1); row < std::min(rows, end + 1); ++row) {
      if (unknown(row)) continue;
      const double share = map.coverage.at<float>(row, column);
      run.mass += share;
      moment += share * (row + 0.5);
    }
    run.top = y;
    run.bottom = end;
    run.middle = moment / run.mass;
    runs.push_back(run);
    y = end;
  }
  return runs;
}

/// Slope of the way that ends in `run`, from some columns back.
double slope_of(const std::vector<Run>& all, int run, int back) {
  int first = run;
  while (all[first].before >= 0 && all[run].column - all[first].column < back)
    first = all[first].before;
  const int columns = all[run].column - all[first].column;
  return columns > 0 ? (all[run].middle - all[first].middle) / columns : 0;
}

/// The way from left to right with the most columns of ink, less what its gaps and jumps cost
/// (Viterbi 1967). `taken` columns are not entered.
Path best_path(const InkMap& map, const std::vector<LinePoint>& through,
               const std::vector<bool>& taken, double stroke) {
  const int width = map.coverage.cols;
  const int longest_gap = std::max(cvRound(12 * stroke), width / 25);
  std::vector<Run> all;
  std::vector<int> first_of(width + 1, 0);
  int best = -1;
  for (int column = 0; column < width; ++column) {
    first_of[column] = static_cast<int>(all.size());
    if (taken[column]) continue;
    for (auto run : runs_of(map, through, column)) {
      const double reward = run.u > 0 ? 3.0 : run.cut ? 0.5 : 1.0;
      run.worth = reward;
      for (int back = 1; back <= longest_gap && column - back >= 0; ++back) {
        if (taken[column - back]) break;
        const int from = first_of[column - back], to = first_of[column - back + 1];
        for (int i = from; i < to; ++i) {
          const auto& other = all[i];
          const double apart = std::max({0.0, run.top - other.bottom, other.top - run.bottom});
          double cost;
          if (back == 1) {
            cost = 0.25 * apart;  // down a steep part a gap costs as much as along
          } else {
            const double off = std::abs(run.middle - other.middle - other.slope * back);
            const int row =
                std::clamp(cvRound((run.middle + other.middle) / 2), 0, map.coverage.rows - 1);
            const bool hidden = map.unknown.at<uchar>(row, column - back / 2) != 0;
            cost = (hidden ? 0.05 : 0.25) * back +
                   0.25 * std::max(0.0, off - 0.15 * back - stroke) + 0.05 * off;
          }
          // A change of the run's length is a branch or a touching neighbour.
          if (run.u == 0 && other.u == 0) cost += 0.02 * std::abs(run.mass - other.mass);
          if (other.worth - cost + reward > run.worth) {
            run.worth = other.worth - cost + reward;
            run.before = i;
          }
        }
      }
      all.push_back(run);
      const int last = static_cast<int>(all.size()) - 1;
      all[last].slope = slope_of(all, last, std::max(6, cvRound(4 * stroke)));
      if (best < 0 || all[last].worth > all[best].worth) best = last;
    }
  }
  first_of[width] = static_cast<int>(all.size());
  Path path;
  for (int i = best; i >= 0; i = all[i].before) {
    path.runs.push_back(all[i]);
    path.mass += all[i].mass;
  }
  std::reverse(path.runs.begin(), path.runs.end());
  return path;
}

/// The best path, then those in the columns it left free (the line was hidden for long), by column.
Path whole_path(const InkMap& map, const std::vector<LinePoint>& through) {
  const int width = map.coverage.cols;
  const double stroke = stroke_width(map.coverage);
  std::vector<bool> taken(width);
  Path whole;
  for (int part = 0; part < 8; ++part) {
    const auto path = best_path(map, through, taken, stroke);
    if (path.runs.size() < 6) break;
    const double least = part == 0 ? 0 : std::max(15.0, 0.02 * width);
    if (static_cast<double>(path.runs.size()) < least) break;
    for (int x = path.runs.front().column; x <= path.runs.back().column; ++x) taken[x] = true;
    whole.mass += path.mass;
    whole.runs.insert(whole.runs.end(), path.runs.begin(), path.runs.end());
  }
  std::sort(whole.runs.begin(), whole.runs.end(),
            [](const Run& a, const Run& b) { return a.column < b.column; });
  return whole;
}

/// The path through the markers, or past them where that explains more ink: a curve that was not
/// drawn from marker to marker.
Path best_of(const InkMap& map, const std::vector<LinePoint>& through, double all) {
  auto joined = whole_path(map, through);
  if (through.empty()) return joined;
  auto alone = whole_path(map, {});
  return alone.mass > joined.mass + 0.03 * all ? alone : joined;
}

/// How far the path is from its beginning at each run.
std::vector<double> lengths_along(const std::vector<Run>& runs) {
  std::vector<double> along{0};
  for (std::size_t i = 1; i < runs.size(); ++i)
    along.push_back(along.back() + std::hypot(runs[i].column - runs[i - 1].column,
                                              runs[i].middle - runs[i - 1].middle));
  return along;
}

/// Where the path passes at each run, its direction that over three strokes to each side.
std::vector<Passage> passages_of(const std::vector<Run>& runs, const std::vector<double>& along,
                                 double stroke) {
  const double reach = 3 * stroke;
  std::vector<Passage> passages;
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    while (from < i && along[i] - along[from + 1] >= reach) ++from;
    while (to + 1 < runs.size() && along[to] - along[i] < reach) ++to;
    const cv::Point2d way(runs[to].column - runs[from].column, runs[to].middle - runs[from].middle);
    passages.push_back({{runs[i].column + 0.5, runs[i].middle}, way / cv::norm(way)});
  }
  return passages;
}

struct Sample {
  PlaceOnLine place;
  bool marker = false;
};

/// Whether the line as seen before or behind a marker goes through it, within twice its
/// uncertainty: a line may pass beside the markers that it was fitted to.
bool on_line(const std::vector<Sample>& samples, std::size_t marker) {
  const PlaceOnLine& place = samples[marker].place;
  const auto meets = [&](std::size_t i) {
    const auto& [at, along] = samples[i].place.passage;
    return std::abs((place.passage.at - at).cross(along)) <= 2 * place.u;
  };
  const auto line = [&](std::size_t i) { return !samples[i].marker; };
  std::size_t before = marker, after = marker;
  while (before > 0 && !line(before)) --before;
  while (after + 1 < samples.size() && !line(after)) ++after;
  return (line(before) && meets(before)) || (line(after) && meets(after));
}

/// At most `points` places, equally spaced along the path, so that steep parts have theirs.
TracedLine sample(const InkMap& map, const Path& path, double stroke, int points) {
  TracedLine line;
  const auto& runs = path.runs;
  if (runs.size() < 2) return line;
  line.first = {runs.front().column + 0.5, runs.front().middle};
  line.last = {runs.back().column + 0.5, runs.back().middle};
  const auto along = lengths_along(runs);
  const auto passages = passages_of(runs, along, stroke);
  const auto thickness = thickness_of(map, passages, stroke);
  const double spacing = std::max(1.0, along.back() / std::max(1, points - 1));
  std::vector<Sample> samples;
  std::size_t next = 0, last = runs.size();
  for (double wanted = 0; wanted < along.back() + 0.5 * spacing; wanted += spacing) {
    while (next + 1 < runs.size() &&
           std::abs(along[next + 1] - wanted) <= std::abs(along[next] - wanted))
      ++next;
    // The nearest run where the line is seen alone, or the marker that stands for it.
    std::vector<std::size_t> near;
    for (std::size_t j = next > 12 ? next - 12 : 0; j < std::min(runs.size(), next + 13); ++j)
      if (std::abs(along[j] - wanted) < spacing) near.push_back(j);
    std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(along[a] - wanted) < std::abs(along[b] - wanted);
    });
    for (const auto j : near) {
      if (j == last) break;
      const bool marker = runs[j].u > 0;
      const auto place = marker ? std::optional(PlaceOnLine{passages[j], runs[j].u})
                                : place_across(map, passages[j], stroke, thickness);
      if (!place) continue;
      samples.push_back({*place, marker});
      last = j;
      break;
    }
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!samples[i].marker || on_line(samples, i))
      line.points.push_back({samples[i].place.passage.at, samples[i].place.u});
  return line;
}

/// Blobs thicker than the line (markers) tell nothing of its place, unless they are most of it.
void hide_blobs(InkMap& map, double stroke) {
  const int disc = 2 * cvRound(0.85 * stroke + 0.5) + 1;
  cv::Mat blobs, mask = map.coverage > 0.3F;
  mask.setTo(0, map.unknown);
  cv::morphologyEx(mask, blobs, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {disc, disc}));
  if (cv::countNonZero(blobs) > 0.6 * cv::countNonZero(mask)) return;
  cv::dilate(blobs, blobs, cv::Mat::ones(3, 3, CV_8U));
  map.unknown.setTo(255, blobs);
}

/// The thickness of the line, not that of ticks: away from the plot's edges, where that leaves
/// some.
double stroke_inside(const cv::Mat& known) {
  const int dx = known.cols / 20, dy = known.rows / 20;
  const cv::Mat inner = known({dy, known.rows - dy}, {dx, known.cols - dx});
  return stroke_width(cv::sum(inner)[0] > 0.25 * cv::sum(known)[0] ? inner : known);
}

}  // namespace

TracedLine trace_line(const InkMap& whole, const std::vector<LinePoint>& through, int points) {
  InkMap map{whole.coverage, whole.unknown.clone()};
  cv::Mat known = map.coverage.clone();
  known.setTo(0, map.unknown);
  hide_blobs(map, stroke_inside(known));
  known.setTo(0, map.unknown);
  const double all = cv::sum(known)[0], stroke = stroke_inside(known);
  const InkMap turned{map.coverage.t(), map.unknown.t()};
  auto turned_through = through;
  for (auto& point : turned_through) std::swap(point.at.x, point.at.y);
  const auto by_column = best_of(map, through, all), by_row = best_of(turned, turned_through, all);
  const bool along_x = by_column.mass >= by_row.mass - 0.03 * all;
  auto line =
      along_x ? sample(map, by_column, stroke, points) : sample(turned, by_row, stroke, points);
  line.along_x = along_x;
  line.stroke = stroke;
  line.explained = all > 0 ? (along_x ? by_column : by_row).mass / all : 0;
  if (!along_x) {
    for (auto& point : line.points) std::swap(point.at.x, point.at.y);
    for (auto* end : {&line.first, &line.last}) std::swap(end->x, end->y);
  }
  return line;
}

}  // namespace bedscope::digitise
