// SPDX-License-Identifier: BSD-3-Clause
// What the markers of an ink look like.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <set>

#include "validation/digitise/markers.hpp"

namespace bedscope::digitise {
namespace {

struct Piece {
  cv::Rect box;
  int area = 0;
  double ink = 0;
};

/// Connected pieces of `mask` of a marker's size, whole and not beside unknown pixels.
std::vector<Piece> pieces_of(const cv::Mat& mask, const InkMap& map) {
  cv::Mat labels, stats, centres, near_unknown;
  const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  cv::dilate(map.unknown, near_unknown, cv::Mat::ones(3, 3, CV_8U));
  const int largest = std::max(24, std::min(mask.cols, mask.rows) / 6);
  std::vector<int> touched(n);
  std::vector<double> ink(n);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (const int label = labels.at<int>(y, x); label > 0) {
        ink[label] += map.coverage.at<float>(y, x);
        touched[label] += near_unknown.at<uchar>(y, x) != 0;
      }
  std::vector<Piece> pieces;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (touched[i] > 0.08 * stats.at<int>(i, cv::CC_STAT_AREA) ||
        std::min(box.width, box.height) < 4 || std::max(box.width, box.height) > largest ||
        std::max(box.width, box.height) > 2.0 * std::min(box.width, box.height))
      continue;
    pieces.push_back({box, stats.at<int>(i, cv::CC_STAT_AREA), ink[i]});
  }
  return pieces;
}

bool alike(const Piece& a, const Piece& b) {
  const auto near = [](double p, double q, double slack) { return std::abs(p - q) <= slack; };
  return near(a.box.width, b.box.width, std::max(1.5, 0.1 * a.box.width)) &&
         near(a.box.height, b.box.height, std::max(1.5, 0.1 * a.box.height)) &&
         near(a.ink, b.ink, 0.2 * a.ink + 2);
}

/// The patch of a piece, its box in the middle.
cv::Mat patch_of(const cv::Mat& coverage, const Piece& piece) {
  constexpr int margin = 2;
  const cv::Rect box(piece.box.x - margin, piece.box.y - margin, piece.box.width + 2 * margin,
                     piece.box.height + 2 * margin);
  cv::Mat patch = cv::Mat::zeros(box.size(), CV_32F);
  const cv::Rect there = box & cv::Rect(0, 0, coverage.cols, coverage.rows);
  coverage(there).copyTo(patch(there - box.tl()));
  return patch;
}

/// Pixel by pixel the median of windows of the map at the places where `marker` fits well: what is
/// not in most of them (lines, bars, neighbours) is gone, and so is noise.
cv::Mat typical(const InkMap& map, const Template& marker,
                const std::vector<cv::Point2d>& guesses) {
  std::vector<cv::Mat> windows;
  for (const auto guess : guesses) {
    if (windows.size() == 40) break;
    const auto found = fit(marker, map, guess);
    if (found.score < 0.5 || found.known < 0.95 || found.least_part < 0.5) continue;
    windows.push_back(window(map.coverage, found.origin, marker.ink.size(), 0));
  }
  if (windows.size() < 3) return {};
  cv::Mat median(marker.ink.size(), CV_32F);
  std::vector<float> values(windows.size());
  for (int y = 0; y < median.rows; ++y)
    for (int x = 0; x < median.cols; ++x) {
      for (std::size_t i = 0; i < windows.size(); ++i) values[i] = windows[i].at<float>(y, x);
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      median.at<float>(y, x) = std::clamp(*middle, 0.0F, 1.0F);
    }
  return median;
}

/// Nothing outside of the marker itself: what a median leaves of lines that always meet it.
void trim(cv::Mat& ink, const cv::Mat& inside) {
  cv::Mat outside;
  cv::bitwise_not(inside, outside);
  ink.setTo(0, outside);
}

cv::Mat without_margin(const cv::Mat& ink, int margin) {
  return ink(cv::Rect(margin, margin, ink.cols - 2 * margin, ink.rows - 2 * margin)).clone();
}

struct Group {
  std::vector<Piece> pieces;
  Shape shape;
  double resemblance = 0, ink = 0;
};

/// The group of pieces of one size and shape that most likely are the markers: those that resemble
/// one of the shapes, and of these the group with most ink.
std::optional<Group> best_group(const std::vector<Piece>& pieces, const cv::Mat& coverage,
                                const std::vector<Shape>& shapes, double least) {
  std::optional<Group> best;
  std::vector<bool> seen(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (seen[i]) continue;
    Group group;
    std::vector<std::pair<Shape, double>> verdicts;
    for (std::size_t j = i; j < pieces.size(); ++j)
      if (alike(pieces[i], pieces[j])) {
        const auto verdict = recognise(patch_of(coverage, pieces[j]), candidates(std::nullopt));
        const auto wanted = std::find_if(shapes.begin(), shapes.end(), [&](const Shape& shape) {
          return shape.outline == verdict.first.outline &&
                 (shape.fill == verdict.first.fill || shape.fill == Fill::any);
        });
        if (wanted == shapes.end()) continue;
        seen[j] = true;
        group.pieces.push_back(pieces[j]);
        group.ink += pieces[j].ink;
        verdicts.push_back(verdict);
      }
    if (verdicts.empty()) continue;
    std::nth_element(
        verdicts.begin(), verdicts.begin() + static_cast<std::ptrdiff_t>(verdicts.size() / 2),
        verdicts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::tie(group.shape, group.resemblance) = verdicts[verdicts.size() / 2];
    if (group.resemblance < least) continue;
    if (!best || group.ink > best->ink) best = group;
  }
  return best;
}

/// The template of a group: one of them, then the median of all.
Template template_of(const Group& group, const InkMap& map) {
  const auto& piece = group.pieces[group.pieces.size() / 2];
  Template marker = make_template(without_margin(patch_of(map.coverage, piece), 1), group.shape);
  std::vector<cv::Point2d> guesses;
  for (const auto& each : group.pieces)
    guesses.emplace_back(each.box.x + each.box.width / 2.0, each.box.y + each.box.height / 2.0);
  if (cv::Mat median = typical(map, marker, guesses); !median.empty()) {
    trim(median, marker.inside);
    marker = make_template(without_margin(median, 2), group.shape);
  }
  return marker;
}

/// Twice the distance to the paper along the ridges, by how often it occurs: of a thick line with
/// markers that of the line, and less than it by about a pixel.
double ridge_width(const cv::Mat& coverage) {
  cv::Mat mask, distance, highest;
  cv::compare(coverage, 0.4, mask, cv::CMP_GT);
  cv::distanceTransform(mask, distance, cv::DIST_L2, 5);
  cv::dilate(distance, highest, cv::Mat::ones(3, 3, CV_8U));
  std::vector<int> counts(64);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const float d = distance.at<float>(y, x);
      if (d > 0 && d >= highest.at<float>(y, x))
        ++counts[static_cast<std::size_t>(std::clamp(cvRound(2 * d - 1), 0, 63))];
    }
  return std::max(
      1.0, static_cast<double>(std::max_element(counts.begin(), counts.end()) - counts.begin()));
}

/// Filled markers on thinner lines and bars: what an opening by a little more than the stroke
/// leaves.
std::optional<Template> on_lines(const InkMap& map, const cv::Mat& mask,
                                 const std::vector<Shape>& shapes) {
  const double stroke = ridge_width(map.coverage);
  for (const double factor : {1.5, 2.2}) {
    const int disc = 2 * cvRound(factor * stroke / 2 + 0.6) + 1;
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_ELLIPSE, {disc, disc});
    cv::Mat opened, grown;
    cv::morphologyEx(mask, opened, cv::MORPH_OPEN, element);
    cv::dilate(opened, grown, cv::Mat::ones(3, 3, CV_8U));
    InkMap cores{map.coverage.clone(), map.unknown};
    cv::Mat rest;
    cv::bitwise_not(grown, rest);
    cores.coverage.setTo(0, rest);
    std::vector<Shape> filled;
    for (const auto& shape : shapes)
      if (shape.fill == Fill::filled) filled.push_back(shape);
    auto pieces = pieces_of(opened, cores);
    // Where strokes cross or turn they are thicker too, but not by much.
    std::erase_if(pieces, [&](const Piece& piece) {
      return std::min(piece.box.width, piece.box.height) < std::max(5.0, 2.6 * stroke);
    });
    const auto group = best_group(pieces, cores.coverage, filled, 0.8);
    if (!group || group->pieces.size() < 2) continue;
    auto marker = template_of(*group, cores);
    // Once more with the whole ink: the opening has rounded the corners.
    std::vector<cv::Point2d> guesses;
    for (const auto& each : group->pieces)
      guesses.emplace_back(each.box.x + each.box.width / 2.0, each.box.y + each.box.height / 2.0);
    if (cv::Mat median = typical(map, marker, guesses); !median.empty()) {
      trim(median, marker.inside);
      marker = make_template(without_margin(median, 2), group->shape);
    }
    return marker;
  }
  return std::nullopt;
}

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

/// Places where the filter's answer is above `least`, none within half a box.
std::vector<std::pair<double, cv::Point2d>> peaks(const cv::Mat& coverage, const cv::Mat& filter,
                                                  double least, double apart) {
  std::vector<std::pair<double, cv::Point2d>> found;
  if (filter.cols >= coverage.cols || filter.rows >= coverage.rows) return found;
  cv::Mat score, highest;
  cv::filter2D(coverage, score, CV_32F, filter, {filter.cols / 2, filter.rows / 2}, 0,
               cv::BORDER_CONSTANT);
  const int reach = 2 * std::max(1, cvRound(apart / 2)) + 1;
  cv::dilate(score, highest, cv::Mat::ones(reach, reach, CV_8U));
  for (int y = 0; y < score.rows; ++y)
    for (int x = 0; x < score.cols; ++x) {
      const float s = score.at<float>(y, x);
      if (s > least && s >= highest.at<float>(y, x))
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
          for (const auto& [score, place] : found) {
            guess.worth += (score - 0.5) * (score - 0.5);
            guess.places.emplace_back(place / scale);
          }
          guesses.push_back(guess);
        }
  }
  std::sort(guesses.begin(), guesses.end(),
            [](const auto& a, const auto& b) { return a.worth > b.worth; });
  return guesses;
}

/// The best guess of each shape, stroke and range of sizes (small ones fit in many places, so that
/// the large would never have their turn), 80 at most.
std::vector<Guess> best_of_each(const std::vector<Guess>& guesses) {
  std::set<std::array<int, 4>> had;
  std::vector<Guess> best;
  for (const auto& guess : guesses)
    if (best.size() < 80 &&
        had.insert({static_cast<int>(guess.shape.outline), static_cast<int>(guess.shape.fill),
                    cvRound(4 * guess.stroke), cvRound(std::log(guess.box.height) / std::log(1.2))})
            .second)
      best.push_back(guess);
  return best;
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

/// The mean score of the better half of a guess's best places. Blurred, a size off by a tenth
/// still counts for something; an outline of one pixel would else not lie on that in the picture.
double resemblance(const Sizes::Level& level, const Guess& guess, bool blurred) {
  auto marker = drawn_template(guess);
  if (blurred) cv::GaussianBlur(marker.ink, marker.ink, {}, Sizes::blur);
  std::vector<double> scores;
  for (std::size_t i = 0; i < std::min<std::size_t>(6, guess.places.size()); ++i)
    scores.push_back(
        std::max(0.0, fit(marker, blurred ? level.blurred : level.sharp, guess.places[i]).score));
  std::sort(scores.rbegin(), scores.rend());
  scores.resize((scores.size() + 1) / 2);
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
            const double thickest = is_strokes(guess.shape.outline) ? 0.3 : 0.45;
            if (trial.stroke < 0.5 || trial.stroke > thickest * trial.box.width) continue;
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

/// The three guesses of each shape that resemble most.
std::vector<Guess> best_three_of_each(Sizes& sizes, std::vector<Guess> guesses) {
  for (auto& guess : guesses) {
    const auto& level = sizes.level_for(guess);
    guess.worth = resemblance(level, scaled(guess, level.scale), true);
  }
  std::stable_sort(guesses.begin(), guesses.end(),
                   [](const auto& a, const auto& b) { return a.worth > b.worth; });
  std::map<std::pair<Outline, Fill>, int> had;
  std::erase_if(guesses, [&](const Guess& guess) {
    return guess.worth < 0.4 || ++had[{guess.shape.outline, guess.shape.fill}] > 3;
  });
  return guesses;
}

/// Drawn shapes of all sizes, for thin and open markers on lines and bars: the one that explains
/// most ink where it lies well. A smaller one of the same kind would lie as well, but explains
/// less.
std::optional<Template> by_search(const InkMap& map, const std::vector<Shape>& shapes) {
  Sizes sizes(map);
  const auto guesses =
      best_of_each(rough_guesses(map, shapes, std::max(1.0, stroke_width(map.coverage))));
  double most = 0;
  std::optional<Guess> best;
  for (const auto& guess : best_three_of_each(sizes, guesses)) {
    const auto& level = sizes.level_for(guess);
    const auto finer = refined(level, scaled(guess, level.scale));
    if (finer.worth < 0.55) continue;
    const auto marker = drawn_template(finer);
    const double ink = marker.ink.dot(marker.ink) / (level.scale * level.scale);
    double worth = 0;
    int good = 0;
    for (const auto& place : finer.places) {
      const auto found = fit(marker, level.sharp, place);
      if (found.score < 0.6 || found.known < 0.8 || found.least_part < 0.6) continue;
      worth += ink * (found.score - 0.5);
      ++good;
    }
    if (good < 2 || worth <= most) continue;
    most = worth;
    best = scaled(finer, 1 / level.scale);
  }
  if (!best) return std::nullopt;
  auto marker = make_template(drawn_template(*best).ink, best->shape);
  if (cv::Mat median = typical(map, marker, best->places); !median.empty()) {
    trim(median, marker.inside);
    marker = make_template(without_margin(median, 2), best->shape);
  }
  return marker;
}

/// What a search tries where the user names no shape.
std::vector<Shape> common_shapes() {
  std::vector<Shape> shapes{{Outline::plus, Fill::any}, {Outline::x, Fill::any}};
  for (const auto outline : {Outline::circle, Outline::square, Outline::diamond, Outline::triangle,
                             Outline::triangle_down}) {
    shapes.push_back({outline, Fill::filled});
    shapes.push_back({outline, Fill::open});
  }
  return shapes;
}

/// How much ink a template explains, and how well.
double worth(const InkMap& map, const Template& marker) {
  double sum = 0;
  const auto found = find_markers(map, {marker});
  for (const auto& one : found[0]) sum += marker.ink.dot(marker.ink) * (one.fit.score - 0.5);
  return sum;
}

}  // namespace

namespace {

/// For each pixel the ink of the unbroken stretch of its row that it lies in.
cv::Mat mass_of_rows(const cv::Mat& coverage) {
  cv::Mat mass = cv::Mat::zeros(coverage.size(), CV_32F);
  for (int y = 0; y < coverage.rows; ++y) {
    const auto* ink = coverage.ptr<float>(y);
    for (int x = 0; x < coverage.cols; ++x) {
      int end = x;
      float sum = 0;
      while (end < coverage.cols && ink[end] > 0.1F) sum += ink[end++];
      if (end > x) mass.row(y).colRange(x, end).setTo(sum);
      x = end;
    }
  }
  return mass;
}

}  // namespace

double stroke_width(const cv::Mat& coverage) {
  // Where a stroke is cut by a row and by a column, its thickness is the height of the triangle of
  // the two cuts. The commonest by length, in steps of an eighth of an octave.
  const cv::Mat across = mass_of_rows(coverage), down = mass_of_rows(coverage.t()).t();
  std::map<int, double> lengths;
  for (int y = 0; y < coverage.rows; ++y)
    for (int x = 0; x < coverage.cols; ++x) {
      if (coverage.at<float>(y, x) < 0.4F) continue;
      const double h = across.at<float>(y, x), v = down.at<float>(y, x);
      const double thickness = h * v / std::hypot(h, v);
      lengths[cvRound(8 * std::log2(thickness))] += coverage.at<float>(y, x) / thickness;
    }
  double most = 0, width = 1;
  for (const auto& [step, length] : lengths) {
    const auto at = [&](int k) { return lengths.contains(k) ? lengths.at(k) : 0.0; };
    if (const double around = at(step - 1) + at(step) + at(step + 1); around > most) {
      most = around;
      width = std::exp2(step / 8.0);
    }
  }
  return std::max(1.0, width);
}

std::optional<Template> learn(const InkMap& map, const MarkerQuery& query) {
  const auto shapes = candidates(query.shape);
  if (!query.sample.empty()) {
    auto shape = query.shape.value_or(recognise(query.sample, shapes).first);
    auto marker = make_template(query.sample, shape);
    if (query.reference)
      marker.reference =
          *query.reference - cv::Point2d(query.sample.cols / 2.0, query.sample.rows / 2.0);
    return marker;
  }
  cv::Mat mask;
  cv::compare(map.coverage, 0.28, mask, cv::CMP_GT);
  const double all = cv::sum(map.coverage)[0];
  const auto pieces = pieces_of(mask, map);
  const auto alone = best_group(pieces, map.coverage, shapes, 0.8);
  if (alone && (alone->ink > 0.35 * all ||
                (alone->pieces.size() >= 3 && (query.shape || alone->resemblance > 0.88))))
    return template_of(*alone, map);
  const auto filled = on_lines(map, mask, shapes);
  if (filled && recognise(filled->ink, {filled->shape}).second > 0.94) return filled;
  const auto drawn = by_search(map, query.shape ? shapes : common_shapes());
  if (filled && drawn) return worth(map, *filled) > worth(map, *drawn) ? filled : drawn;
  if (filled) return filled;
  if (drawn) return drawn;
  if (alone) return template_of(*alone, map);
  // A shape without a name, or one that does not look like its name.
  if (auto group = best_group(pieces, map.coverage, candidates(std::nullopt), 0.0)) {
    if (query.shape) group->shape = shapes.front();
    return template_of(*group, map);
  }
  return std::nullopt;
}

std::optional<Template> markers_on_line(const InkMap& map) {
  const double stroke = stroke_width(map.coverage);
  const auto marker = learn(map, {});
  if (!marker || std::min(marker->box.width, marker->box.height) < 2.0 * stroke) return {};
  const auto found = find_markers(map, {*marker});
  std::vector<double> scores;
  for (const auto& one : found[0]) scores.push_back(one.fit.score);
  if (scores.size() < 4) return {};
  std::sort(scores.begin(), scores.end());
  const double ink = cv::sum(marker->ink)[0] * static_cast<double>(scores.size());
  if (scores[scores.size() / 2] < 0.75 || ink < 0.05 * cv::sum(map.coverage)[0]) return {};
  return marker;
}

}  // namespace bedscope::digitise
