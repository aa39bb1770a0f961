// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <set>

#include "validation/digitise/markers.hpp"
#include "validation/digitise/stroke.hpp"
#include "validation/digitise/typical.hpp"

namespace bedscope::digitise {
namespace {

/// A filter that gives 1 where the ink lies as drawn: the share of the drawn ink that is there,
/// less 0.7 of the share of ink on the paper inside and round it. Lines and bars through an open
/// marker cost little, a filled patch much.
cv::Mat matched_filter(const Template& marker) {
  cv::Mat paper;
  cv::dilate(marker.inside, paper, cv::Mat::ones(3, 3, CV_8U));
  paper.setTo(0, marker.ink > 0.15F);
  paper.convertTo(paper, CV_32F, 1 / 255.0);
  const double ink = marker.ink.dot(marker.ink), around = std::max(1.0, cv::sum(paper)[0]);
  return marker.ink / ink - paper * (0.7 / around);
}

/// The filter's answer at each pixel, summed over the inked ones, which are few: a tenth of the
/// work of a transform or of going over all pixels.
cv::Mat answer(const cv::Mat& coverage, const cv::Mat& filter) {
  cv::Mat turned, sum = cv::Mat::zeros(coverage.rows + filter.rows - 1,
                                       coverage.cols + filter.cols - 1, CV_32F);
  cv::flip(filter, turned, -1);
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x) {
      const float share = coverage.at<float>(y, x);
      if (share == 0) continue;
      for (int row = 0; row < turned.rows; ++row) {
        const float* from = turned.ptr<float>(row);
        float* to = sum.ptr<float>(y + row) + x;
        for (int column = 0; column < turned.cols; ++column) to[column] += share * from[column];
      }
    }
  return sum(cv::Rect((filter.cols - 1) / 2, (filter.rows - 1) / 2, coverage.cols, coverage.rows));
}

/// Places where the filter's answer is above `least`, none within half a box.
std::vector<std::pair<double, cv::Point2d>> peaks(const cv::Mat& coverage, const cv::Mat& filter,
                                                  double least, double apart) {
  std::vector<std::pair<double, cv::Point2d>> found;
  if (filter.cols >= coverage.cols || filter.rows >= coverage.rows) return found;
  const cv::Mat score = answer(coverage, filter);
  const int reach = std::max(1, cvRound(apart / 2));
  const cv::Rect whole({0, 0}, score.size());
  for (int y = 0; y < score.rows; ++y)
    for (int x = 0; x < score.cols; ++x) {
      const float s = score.at<float>(y, x);
      if (!(s > least)) continue;
      double highest;
      cv::minMaxLoc(score(cv::Rect(x - reach, y - reach, 2 * reach + 1, 2 * reach + 1) & whole),
                    nullptr, &highest);
      if (s >= highest)
        found.emplace_back(std::min(1.0F, s),
                           cv::Point2d(x + (filter.cols % 2) / 2.0, y + (filter.rows % 2) / 2.0));
    }
  return found;
}

struct Guess {
  Shape shape;
  cv::Size2d box;
  double stroke = 1, worth = 0;
  std::vector<cv::Point2d> places;
};

/// Shapes and sizes that correlate with the map in several places, the best first. The markers'
/// strokes may be thinner than a line through them.
std::vector<Guess> rough_guesses(const InkMap& map, const std::vector<Shape>& shapes,
                                 double stroke) {
  const double largest = std::min(map.coverage.cols, map.coverage.rows) / 8.0;
  std::vector<Guess> guesses;
  for (double size = std::max(5.0, 2.4 * stroke); size < largest; size *= 1.15) {
    const double scale = std::min(1.0, 11 / size), box = size * scale;
    cv::Mat small;
    cv::resize(map.coverage, small, {}, scale, scale, cv::INTER_AREA);
    for (const auto& shape : shapes)
      for (const double narrow : {1.0, 0.75})
        for (const double thin : {1.0, 0.5}) {
          if (narrow < 1 && shape.outline != Outline::diamond) continue;
          if (thin < 1 && (stroke < 2 || shape.fill == Fill::filled)) continue;
          if (shape.fill != Fill::filled && thin * stroke > thickest_stroke(shape) * narrow * size)
            continue;
          const cv::Size canvas(cvCeil(box) + 2, cvCeil(box) + 2);
          const auto drawn = bare_template(
              draw_shape(shape, {box * narrow, box}, std::max(0.5, thin * stroke * scale), canvas),
              shape);
          auto found = peaks(small, matched_filter(drawn), 0.55, 0.6 * box);
          if (found.size() < 2) continue;
          std::sort(found.begin(), found.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
          if (found.size() > 40) found.resize(40);
          Guess guess{shape, {size * narrow, size}, thin * stroke, 0, {}};
          const double ink = drawn.ink.dot(drawn.ink) / (scale * scale);
          for (const auto& [score, place] : found) {
            guess.worth += ink * (score - 0.5) * (score - 0.5);
            guess.places.emplace_back(place / scale);
          }
          guesses.push_back(guess);
        }
  }
  std::sort(guesses.begin(), guesses.end(),
            [](const auto& a, const auto& b) { return a.worth > b.worth; });
  return guesses;
}

/// The best guesses of each shape, eight at most, of other strokes and sizes each (small ones fit
/// in many places, so that the large would never have their turn).
std::vector<Guess> best_of_each(const std::vector<Guess>& guesses) {
  std::map<std::pair<Outline, Fill>, std::set<std::pair<int, int>>> had;
  std::vector<Guess> best;
  for (const auto& guess : guesses)
    if (auto& sizes = had[{guess.shape.outline, guess.shape.fill}];
        sizes.size() < 8 && sizes
                                .insert({cvRound(4 * guess.stroke),
                                         cvRound(std::log(guess.box.height) / std::log(1.2))})
                                .second)
      best.push_back(guess);
  return best;
}

/// The thickness of the ink round some holes [px]: as far as it covers more than half of the way
/// round them that it covers at most (a blur makes that less than all). Lines and bars that meet
/// there cover less.
double stroke_round(const cv::Mat& coverage, const cv::Mat& holes) {
  cv::Mat away;
  cv::distanceTransform(holes == 0, away, cv::DIST_L2, 5);
  std::map<int, std::pair<double, int>> rings;  // ink and pixels by distance
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x)
      if (const float far = away.at<float>(y, x); far > 0 && far < 40) {
        auto& ring = rings[cvFloor(far)];
        ring.first += coverage.at<float>(y, x);
        ++ring.second;
      }
  double stroke = 0, most = 0;
  for (const auto& [far, ring] : rings) {
    const double share = ring.first / ring.second;
    if (share < most / 2) break;
    most = std::max(most, share);
    stroke += share;
  }
  return std::max(1.0, stroke);
}

/// Open markers by the paper that they enclose: holes in the ink of one size, three or more. A line
/// or a bar that ends at a marker or lies behind it leaves its hole as it is.
std::vector<Guess> guesses_of_holes(const InkMap& map, const std::vector<Shape>& shapes) {
  cv::Mat paper = map.coverage < 0.3F, labels, stats, centres;
  paper.setTo(0, map.unknown);
  const int n = cv::connectedComponentsWithStats(paper, labels, stats, centres, 4);
  const int largest = std::min(paper.cols, paper.rows) / 8;
  struct Hole {
    int label;
    cv::Rect box;
  };
  std::vector<Hole> holes;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const auto [low, high] = std::minmax(box.width, box.height);
    if (low >= 3 && high <= largest && high < 2 * low) holes.push_back({i, box});
  }
  const auto alike = [](int a, int b) { return std::abs(a - b) <= std::max(1.0, 0.1 * a); };
  std::vector<Guess> guesses;
  for (std::vector<bool> had(holes.size()); const auto& first : holes) {
    if (had[static_cast<std::size_t>(&first - holes.data())]) continue;
    Guess guess;
    cv::Mat group = cv::Mat::zeros(paper.size(), CV_8U);
    std::vector<int> widths, heights;
    for (std::size_t i = 0; i < holes.size(); ++i) {
      const auto& box = holes[i].box;
      if (had[i] || !alike(first.box.width, box.width) || !alike(first.box.height, box.height))
        continue;
      had[i] = true;
      group(box).setTo(255, labels(box) == holes[i].label);
      guess.places.emplace_back(box.x + box.width / 2.0, box.y + box.height / 2.0);
      widths.push_back(box.width);
      heights.push_back(box.height);
    }
    if (guess.places.size() < 3) continue;
    std::sort(widths.begin(), widths.end());
    std::sort(heights.begin(), heights.end());
    guess.stroke = stroke_round(map.coverage, group);
    guess.box = cv::Size2d(widths[widths.size() / 2] + 2 * guess.stroke,
                           heights[heights.size() / 2] + 2 * guess.stroke);
    for (const auto& shape : shapes) {
      if (shape.fill != Fill::open || !is_proportioned(shape.outline, guess.box)) continue;
      guess.shape = shape;
      guesses.push_back(guess);
    }
  }
  return guesses;
}

InkMap coarse(const InkMap& map, double scale) {
  InkMap small;
  cv::resize(map.coverage, small.coverage, {}, scale, scale, cv::INTER_AREA);
  cv::resize(map.unknown, small.unknown, small.coverage.size(), 0, 0, cv::INTER_AREA);
  return small;
}

Template drawn_template(const Guess& guess) {
  const cv::Size canvas(cvCeil(guess.box.width) + 2, cvCeil(guess.box.height) + 2);
  return bare_template(draw_shape(guess.shape, guess.box, guess.stroke, canvas), guess.shape);
}

Guess scaled(Guess guess, double by) {
  guess.box = guess.box * by;
  guess.stroke *= by;
  for (auto& place : guess.places) place *= by;
  return guess;
}

/// The map at the sizes at which guesses are tried: a marker of some 16 pixels, its stroke not
/// below 1.3.
class Sizes {
 public:
  explicit Sizes(const InkMap& map) : map_(map) {}

  struct Level {
    double scale = 1;
    InkMap sharp, blurred;
  };

  const Level& level_for(const Guess& guess) {
    const double size = std::max(guess.box.width, guess.box.height);
    const bool thin = guess.shape.fill == Fill::open || is_strokes(guess.shape.outline);
    const double wanted = std::min(1.0, std::max(16 / size, thin ? 1.3 / guess.stroke : 0.0));
    const int step = cvFloor(-2 * std::log2(wanted));
    auto& level = levels_[step];
    if (level.sharp.coverage.empty()) {
      const double scale = std::exp2(-step / 2.0);
      level.sharp = step > 0 ? coarse(map_, scale) : map_;
      level.scale = static_cast<double>(level.sharp.coverage.cols) / map_.coverage.cols;
      level.blurred.unknown = level.sharp.unknown;
      cv::GaussianBlur(level.sharp.coverage, level.blurred.coverage, {}, blur);
    }
    return level;
  }

  static constexpr double blur = 1.0;

 private:
  const InkMap& map_;
  std::map<int, Level> levels_;
};

/// The mean score of the three best of a guess's places (larger filled markers, which correlate
/// well with any outline in them, may hold the first). Blurred, a size off by a tenth still counts
/// for something; an outline of one pixel would else not lie on that in the picture.
double resemblance(const Sizes::Level& level, const Guess& guess, bool blurred) {
  auto marker = drawn_template(guess);
  if (blurred) cv::GaussianBlur(marker.ink, marker.ink, {}, Sizes::blur);
  std::vector<double> scores;
  for (std::size_t i = 0; i < std::min<std::size_t>(12, guess.places.size()); ++i)
    scores.push_back(
        std::max(0.0, fit(marker, blurred ? level.blurred : level.sharp, guess.places[i]).score));
  std::sort(scores.rbegin(), scores.rend());
  scores.resize(std::min<std::size_t>(3, (scores.size() + 1) / 2));
  return std::accumulate(scores.begin(), scores.end(), 0.0) / static_cast<double>(scores.size());
}

/// The width, height and stroke at which a guess lies best.
Guess refined(const Sizes::Level& level, Guess guess) {
  for (const bool blurred : {true, false}) {
    double most = resemblance(level, guess, blurred);
    for (double step = blurred ? 0.08 : 0.03; step > (blurred ? 0.03 : 0.01); step /= 2)
      for (bool better = true; better;) {
        better = false;
        for (const auto& [wide, high, thick] :
             {std::array{1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}})
          for (const double way : {-step, step}) {
            Guess trial = guess;
            trial.box.width *= 1 + wide * way;
            trial.box.height *= 1 + high * way;
            trial.stroke *= 1 + thick * way;
            if (trial.stroke < 0.5 ||
                trial.stroke > thickest_stroke(guess.shape) * trial.box.width ||
                !is_proportioned(trial.shape.outline, trial.box))
              continue;
            if (const double now = resemblance(level, trial, blurred); now > most + 2e-3) {
              most = now;
              guess = trial;
              better = true;
            }
          }
      }
    guess.worth = most;
    if (most < 0.4) break;
  }
  return guess;
}

/// The guesses of each shape that are worth refining: the one that correlated best, and the three
/// that explain most ink a marker, among those that resemble.
std::vector<Guess> best_few_of_each(Sizes& sizes, std::vector<Guess> guesses) {
  std::map<std::pair<Outline, Fill>, int> had;
  const auto which = [](const Guess& guess) {
    return std::pair(guess.shape.outline, guess.shape.fill);
  };
  std::vector<Guess> best;
  std::erase_if(guesses, [&](const Guess& guess) {
    if (had[which(guess)]++ > 0 || guess.worth <= 0) return false;
    best.push_back(guess);
    return true;
  });
  for (auto& guess : guesses) {
    const auto& level = sizes.level_for(guess);
    guess.worth = resemblance(level, scaled(guess, level.scale), true);
  }
  std::erase_if(guesses, [](const Guess& guess) { return guess.worth < 0.4; });
  for (auto& guess : guesses) {
    const auto ink = drawn_template(guess).ink;
    guess.worth = (guess.worth - 0.4) * ink.dot(ink);
  }
  std::stable_sort(guesses.begin(), guesses.end(),
                   [](const auto& a, const auto& b) { return a.worth > b.worth; });
  had.clear();
  for (const auto& guess : guesses)
    if (++had[which(guess)] <= 3) best.push_back(guess);
  return best;
}

/// A guess at its best size, and its markers [px of its level].
struct Refined {
  Guess guess;
  double scale = 1, ink = 0;  ///< ink: of one marker, in pixels of the map
  std::vector<Marker> found;
  std::vector<double> distinct;
};

std::vector<Refined> refine_all(const InkMap& map, const std::vector<Shape>& shapes) {
  Sizes sizes(map);
  // Where filled markers hold most ink, that of the ridges is the line's.
  const double stroke = std::min(stroke_width(map.coverage), line_width(map.coverage));
  auto guesses = best_of_each(rough_guesses(map, shapes, stroke));
  for (auto& guess : guesses_of_holes(map, shapes)) guesses.push_back(guess);
  std::vector<Refined> all;
  for (const auto& guess : best_few_of_each(sizes, guesses)) {
    const auto& level = sizes.level_for(guess);
    const auto finer = refined(level, scaled(guess, level.scale));
    if (finer.worth < 0.55) continue;
    const auto marker = drawn_template(finer);
    Refined one{scaled(finer, 1 / level.scale),
                level.scale,
                marker.ink.dot(marker.ink) / (level.scale * level.scale),
                {},
                {}};
    for (const auto& found : markers_near(level.sharp, marker, finer.places)) {
      if (found.fit.score < 0.6 || found.fit.known < 0.8 || found.fit.least_part < 0.6) continue;
      one.found.push_back(found);
      one.distinct.push_back(distinct(marker, level.sharp, found.fit));
    }
    all.push_back(one);
  }
  return all;
}

/// Whether a rival of another shape lies better where a guess has its i-th marker.
bool is_anothers(const Refined& one, std::size_t i, const std::vector<Refined>& rivals) {
  const cv::Point2d at = one.found[i].fit.origin / one.scale;
  const double near = std::max(one.guess.box.width, one.guess.box.height) / 4;
  return std::any_of(rivals.begin(), rivals.end(), [&](const Refined& rival) {
    const auto &shape = rival.guess.shape, &own = one.guess.shape;
    return (shape.outline != own.outline || shape.fill != own.fill) &&
           std::any_of(rival.found.begin(), rival.found.end(), [&](const Marker& other) {
             return other.fit.score > one.found[i].fit.score &&
                    cv::norm(other.fit.origin / rival.scale - at) < near;
           });
  });
}

}  // namespace

std::optional<Template> search_drawn(const InkMap& map, const std::vector<Shape>& shapes,
                                     const std::vector<Shape>& rivals) {
  const auto all = refine_all(map, shapes);
  const auto others = rivals.empty() ? std::vector<Refined>{} : refine_all(map, rivals);
  double most = 0;
  const Refined* best = nullptr;
  for (const auto& one : all) {
    double worth = 0;
    int good = 0;
    for (std::size_t i = 0; i < one.found.size(); ++i) {
      if (is_anothers(one, i, others)) continue;
      worth += one.ink * (one.found[i].fit.score - least_score) * one.distinct[i];
      ++good;
    }
    if (good < 2 || worth <= most) continue;
    most = worth;
    best = &one;
  }
  if (!best) return std::nullopt;
  const auto& guess = best->guess;
  const auto marker = make_template(drawn_template(guess).ink, guess.shape);
  std::vector<cv::Point2d> places;
  if (rivals.empty()) {
    const auto found = find_markers(map, {marker});  // of which the guess may have had two
    for (const auto& one : found[0]) places.push_back(one.fit.origin);
  }
  for (std::size_t i = 0; i < best->found.size() && !rivals.empty(); ++i)
    if (!is_anothers(*best, i, others)) places.push_back(best->found[i].fit.origin / best->scale);
  const auto seen = typical(map, marker, places);
  return seen ? trimmed(*seen, {guess.shape}) : marker;
}
}  // namespace bedscope::digitise
