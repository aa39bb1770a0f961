// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/template.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "validation/digitise/stroke.hpp"
#include "validation/digitise/triangle.hpp"

namespace bedscope::digitise {
namespace {

/// The weights of the pixels at -1, 0, 1 and 2 for a place at 0 <= t < 1 (cubic convolution, Keys
/// 1981, a = -3/4).
std::array<float, 4> cubic(double t) {
  const double s = 1 - t;
  const auto near = [](double d) { return (1.25 * d - 2.25) * d * d + 1; };
  const auto far = [](double d) { return ((-0.75 * d + 3.75) * d - 6) * d + 3; };
  return {static_cast<float>(far(1 + t)), static_cast<float>(near(t)), static_cast<float>(near(s)),
          static_cast<float>(far(1 + s))};
}

/// `ink` shifted by (dx, dy) pixels, paper round it. Of small images, so often that OpenCV's way of
/// any affine map took most of the time; and it rounds the shift to a 32nd of a pixel.
cv::Mat shifted(const cv::Mat& ink, cv::Point2d by) {
  const int x0 = cvFloor(-by.x), y0 = cvFloor(-by.y);  // of the pixel that comes to the first one
  const auto wx = cubic(-by.x - x0), wy = cubic(-by.y - y0);
  const int rows = ink.rows, columns = ink.cols;
  cv::Mat across(rows, columns, CV_32F), moved(rows, columns, CV_32F, cv::Scalar(0));
  for (int y = 0; y < rows; ++y) {
    const float* from = ink.ptr<float>(y);
    float* to = across.ptr<float>(y);
    for (int x = 0; x < columns; ++x) {
      float sum = 0;
      for (int k = 0; k < 4; ++k)
        if (const int at = x + x0 - 1 + k; at >= 0 && at < columns) sum += wx[k] * from[at];
      to[x] = sum;
    }
  }
  for (int y = 0; y < rows; ++y) {
    float* to = moved.ptr<float>(y);
    for (int k = 0; k < 4; ++k) {
      const int at = y + y0 - 1 + k;
      if (at < 0 || at >= rows) continue;
      const float* from = across.ptr<float>(at);
      for (int x = 0; x < columns; ++x) to[x] += wy[k] * from[x];
    }
  }
  return moved;
}

double correlation(const cv::Mat& a, const cv::Mat& b) {
  const double n = static_cast<double>(a.total());
  const double ma = cv::mean(a)[0], mb = cv::mean(b)[0];
  const double ab = a.dot(b) / n - ma * mb, aa = a.dot(a) / n - ma * ma,
               bb = b.dot(b) / n - mb * mb;
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// The box of the pixels that are at least half as much covered as the most covered one (a thin
/// stroke, blurred, covers none of them by half), at sub-pixel edges: by how much the outermost
/// rows and columns are covered.
cv::Rect2d box_of(const cv::Mat& ink) {
  cv::Mat columns, rows;
  cv::reduce(ink, columns, 0, cv::REDUCE_MAX);
  cv::reduce(ink, rows, 1, cv::REDUCE_MAX);
  double most = 0;
  cv::minMaxLoc(columns, nullptr, &most);
  const auto extent = [most](const cv::Mat& profile) {
    const auto n = static_cast<int>(profile.total());
    const auto at = [&](int i) { return profile.at<float>(i) / std::max(most, 1e-6); };
    int first = 0, last = n - 1;
    while (first < n - 1 && at(first) < 0.5) ++first;
    while (last > 0 && at(last) < 0.5) --last;
    const double before = first > 0 ? at(first - 1) : 0, after = last + 1 < n ? at(last + 1) : 0;
    return std::pair(first - before + (1 - std::min(1.0, at(first))) * (before < 0.05),
                     last + 1 + after - (1 - std::min(1.0, at(last))) * (after < 0.05));
  };
  const auto [x0, x1] = extent(columns);
  const auto [y0, y1] = extent(rows);
  return {x0, y0, std::max(1.0, x1 - x0), std::max(1.0, y1 - y0)};
}

/// The marker with its inside: all that the paper round it does not reach.
cv::Mat silhouette(const cv::Mat& ink) {
  cv::Mat mask, outside;
  cv::compare(ink, 0.3, mask, cv::CMP_GT);
  cv::copyMakeBorder(mask, outside, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::floodFill(outside, cv::Point(0, 0), cv::Scalar(128));
  cv::Mat inside = outside(cv::Rect(1, 1, ink.cols, ink.rows)) != 128;
  return inside;
}

/// How far `other` has to move to lie on `ink`: least squares.
cv::Point2d shift_between(const cv::Mat& ink, const cv::Mat& other) {
  cv::Point2d shift(0, 0);
  for (int step = 0; step < 12; ++step) {
    const cv::Mat moved = shifted(other, shift);
    cv::Mat gx, gy;
    cv::Sobel(moved, gx, CV_32F, 1, 0, 1, 0.5);
    cv::Sobel(moved, gy, CV_32F, 0, 1, 1, 0.5);
    const cv::Mat rest = ink - moved;
    const double xx = gx.dot(gx), xy = gx.dot(gy), yy = gy.dot(gy), det = xx * yy - xy * xy;
    if (!(det > 1e-9)) break;
    const double bx = -gx.dot(rest), by = -gy.dot(rest);
    const cv::Point2d change((yy * bx - xy * by) / det, (xx * by - xy * bx) / det);
    shift += change;
    if (cv::norm(change) < 1e-3 || cv::norm(shift) > ink.cols) break;
  }
  return shift;
}

/// The drawn outline that differs least from a silhouette, and by how much of its area.
struct Drawn {
  cv::Rect2d box;
  double differs = 0;
};

/// Absolute differences, so that bars and lines that stick out do not count much.
Drawn drawn_like(const cv::Mat& ink, Outline outline) {
  double most = 0;
  cv::minMaxLoc(ink, nullptr, &most);
  cv::Mat filled = ink / std::max(most, 1e-6), core;  // thin strokes, blurred, cover no pixel
  cv::erode(silhouette(filled), core, cv::Mat::ones(3, 3, CV_8U));
  filled.setTo(1, core);
  const auto start = box_of(filled);
  std::array<double, 4> best{start.x + start.width / 2 - ink.cols / 2.0,
                             start.y + start.height / 2 - ink.rows / 2.0, start.width,
                             start.height};
  // A lost tip may lie outside of the image, not half of the shape: that of a diamond is a
  // triangle.
  const double beyond = 1 + std::max(ink.cols, ink.rows) / 8.0;
  const auto is_inside = [&](const std::array<double, 4>& p) {
    return 2 * std::abs(p[0]) + p[2] < ink.cols + 2 * beyond &&
           2 * std::abs(p[1]) + p[3] < ink.rows + 2 * beyond;
  };
  const auto difference = [&](const std::array<double, 4>& p) {
    const auto drawn =
        draw_shape({outline, Fill::filled}, {p[2], p[3]}, 1, ink.size(), {p[0], p[1]});
    return cv::norm(filled, drawn, cv::NORM_L1);
  };
  double least = difference(best);
  for (double step = 0.15 * start.width; step > 0.04; step /= 2)
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < 4; ++i)
        for (const double way : {-step, step}) {
          auto trial = best;
          trial[i] += way;
          // A side moves alone too: the box grows on one side only.
          for (const double also : {0.0, -0.5, 0.5}) {
            auto shifted_trial = trial;
            if (i >= 2) shifted_trial[i - 2] += also * way;
            if (trial[2] < 2 || trial[3] < 2 || !is_inside(shifted_trial)) continue;
            if (const double now = difference(shifted_trial); now < least - 1e-9) {
              least = now;
              best = shifted_trial;
              better = true;
            }
          }
        }
    }
  return {{best[0] + ink.cols / 2.0 - best[2] / 2, best[1] + ink.rows / 2.0 - best[3] / 2, best[2],
           best[3]},
          least / std::max(1.0, cv::sum(filled)[0])};
}

/// The image turned so that a triangle of this outline stands on its base, and back.
int quarter_turns(Outline outline) {
  switch (outline) {
    case Outline::triangle_right:
      return 3;
    case Outline::triangle_down:
      return 2;
    case Outline::triangle_left:
      return 1;
    default:
      return 0;
  }
}

cv::Mat turned(const cv::Mat& image, int quarters) {
  if (quarters == 0) return image;
  cv::Mat result;
  cv::rotate(image, result,
             quarters == 1   ? cv::ROTATE_90_CLOCKWISE
             : quarters == 2 ? cv::ROTATE_180
                             : cv::ROTATE_90_COUNTERCLOCKWISE);
  return result;
}

/// The vector (x, y) turned by quarters, anticlockwise on the page: undoes turned().
cv::Point2d turned_back(cv::Point2d p, int quarters) {
  for (int i = 0; i < quarters; ++i) p = {p.y, -p.x};
  return p;
}

/// The whole pixel near `guess` where the correlation is best: least squares would go astray from
/// farther off than a thin stroke is wide.
cv::Point2d nearest_peak(const InkMap& map, const Template& marker, cv::Point2d guess) {
  const int reach = 2 + cvCeil(std::max(marker.box.width, marker.box.height) / 14);
  const cv::Size size = marker.ink.size();
  const cv::Rect wanted(cvRound(guess.x - size.width / 2.0) - reach,
                        cvRound(guess.y - size.height / 2.0) - reach, size.width + 2 * reach,
                        size.height + 2 * reach);
  const cv::Rect there = wanted & cv::Rect(0, 0, map.coverage.cols, map.coverage.rows);
  if (there != wanted) return guess;
  cv::Mat score;
  cv::matchTemplate(map.coverage(there), marker.ink, score, cv::TM_CCORR_NORMED);
  cv::Point best;
  cv::minMaxLoc(score, nullptr, nullptr, nullptr, &best);
  return cv::Point2d(there.tl() + best) + cv::Point2d(size.width / 2.0, size.height / 2.0);
}

/// The part of a map that a template of `size` covers near `place`; nothing beyond its edges is
/// known.
struct Part {
  cv::Mat seen, unknown;
  cv::Point middle;  ///< the page's pixel in its middle
};

/// Nothing where less than a third of it is on the map.
std::optional<Part> part_of(const InkMap& map, cv::Point2d place, cv::Size size) {
  Part part{cv::Mat::zeros(size, CV_32F),
            cv::Mat(size, CV_8U, cv::Scalar(255)),
            {cvFloor(place.x), cvFloor(place.y)}};
  const cv::Rect wanted(part.middle - cv::Point(size.width / 2, size.height / 2), size);
  const cv::Rect there = wanted & cv::Rect(0, 0, map.coverage.cols, map.coverage.rows);
  if (there.area() < wanted.area() / 3) return std::nullopt;
  map.coverage(there).copyTo(part.seen(there - wanted.tl()));
  map.unknown(there).copyTo(part.unknown(there - wanted.tl()));
  return part;
}

/// What a template laid at `origin`, the `model`, explains of a part: 1 all, 0 no more than paper.
/// Missing ink counts in full; extra ink may be a line or a bar and counts less: inside of the
/// marker more, but not in the middle quarter of an open one, where its bar is.
double explained(const Template& marker, cv::Point2d origin, const cv::Mat& model,
                 const Part& part) {
  const bool strokes = is_strokes(marker.shape.outline);
  const double inner = strokes ? 0.25 : 0.5, outer = strokes ? 0.1 : 0.15;
  const double bar = marker.shape.fill == Fill::open ? marker.box.width / 8 : 0;
  const double centre = origin.x - (part.middle.x - model.cols / 2);
  double sum = 0, total = 0, around = 0, n_around = 0;
  for (int y = 0; y < model.rows; ++y)
    for (int x = 0; x < model.cols; ++x) {
      if (part.unknown.at<uchar>(y, x) != 0) continue;
      const double m = std::clamp(model.at<float>(y, x), 0.0F, 1.0F);
      const double rest = part.seen.at<float>(y, x) - m;
      const bool within = marker.inside.at<uchar>(y, x) != 0 && std::abs(x + 0.5 - centre) >= bar;
      const double weight = rest < 0 ? 1.0 : within ? inner : outer;
      sum += m * m - weight * rest * rest;
      total += m * m;
      if (m < 0.1) {
        around += part.seen.at<float>(y, x);
        ++n_around;
      }
    }
  // Strokes would fit anywhere within a patch of ink.
  if (strokes && around > 0.6 * n_around) sum = 0;
  return total > 0 ? sum / total : -1;
}

/// The ink of a template without its margin.
cv::Mat bare_ink(const Template& marker) {
  return marker.ink({margin, marker.ink.rows - margin}, {margin, marker.ink.cols - margin});
}

}  // namespace

std::vector<Shape> candidates(const std::optional<Shape>& asked) {
  std::vector<Outline> outlines;
  if (asked && asked->outline == Outline::cross)
    outlines = {Outline::plus, Outline::x};
  else if (asked)
    outlines = {asked->outline};
  else
    outlines = {Outline::circle,         Outline::square,        Outline::diamond,
                Outline::triangle,       Outline::triangle_down, Outline::triangle_left,
                Outline::triangle_right, Outline::pentagon,      Outline::hexagon,
                Outline::star,           Outline::plus,          Outline::x,
                Outline::asterisk};
  std::vector<Shape> shapes;
  for (const auto outline : outlines) {
    const auto fill = asked ? asked->fill : Fill::any;
    if (is_strokes(outline)) {
      shapes.push_back({outline, Fill::any});
      continue;
    }
    if (fill != Fill::open) shapes.push_back({outline, Fill::filled});
    if (fill != Fill::filled) shapes.push_back({outline, Fill::open});
  }
  return shapes;
}

std::pair<Shape, double> recognise(const cv::Mat& ink, const std::vector<Shape>& among) {
  const auto box = box_of(ink);
  const double scale = std::min(1.0, 28.0 / std::max(box.width, box.height));
  // The box in the middle of a small image.
  const cv::Size size(cvCeil(box.width * scale) + 4, cvCeil(box.height * scale) + 4);
  cv::Mat small;
  const double cx = box.x + box.width / 2, cy = box.y + box.height / 2;
  cv::Mat blurred = ink;
  if (scale < 0.7) cv::GaussianBlur(ink, blurred, {}, 0.4 / scale);
  cv::warpAffine(blurred, small,
                 cv::Matx23d(scale, 0, size.width / 2.0 - 0.5 - (cx - 0.5) * scale, 0, scale,
                             size.height / 2.0 - 0.5 - (cy - 0.5) * scale),
                 size, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(0));
  // Both a little blurred; the drawn one also more, as scans and compressed pictures are.
  cv::GaussianBlur(small, small, {}, 0.7);
  Shape best;
  double most = -1;
  const cv::Size2d drawn(box.width * scale, box.height * scale);
  for (const auto& shape : among)
    for (const double share : {0.07, 0.12, 0.18, 0.26, 0.33}) {
      if (share > 0.3 && share > thickest_stroke(shape)) break;
      const double stroke = std::max(0.7, share * std::min(drawn.width, drawn.height));
      const cv::Mat candidate = draw_shape(shape, drawn, stroke, size);
      for (const double blur : {0.7, 1.4}) {
        cv::Mat blurred_candidate;
        cv::GaussianBlur(candidate, blurred_candidate, {}, blur);
        const double now = correlation(small, blurred_candidate);
        if (now > most) {
          most = now;
          best = shape;
        }
      }
      if (shape.fill == Fill::filled) break;
    }
  return {best, most};
}

Template bare_template(const cv::Mat& ink, const Shape& shape) {
  Template marker;
  cv::copyMakeBorder(ink, marker.ink, margin, margin, margin, margin, cv::BORDER_CONSTANT,
                     cv::Scalar(0));
  marker.inside = silhouette(marker.ink);
  cv::dilate(marker.inside, marker.inside, cv::Mat::ones(3, 3, CV_8U));
  marker.shape = shape;
  marker.box = box_of(marker.ink).size();
  return marker;
}

Template reshaped(const Template& marker, const std::vector<Shape>& shapes) {
  if (is_strokes(marker.shape.outline)) return marker;
  const cv::Mat ink = bare_ink(marker);
  Shape best = marker.shape;
  // A hollow outline, too pale to enclose its inside, resembles none.
  double least = std::min(0.4, drawn_like(ink, best.outline).differs);
  for (const auto& one : shapes) {
    if (is_strokes(one.outline) || one.fill != marker.shape.fill) continue;
    const double now = drawn_like(ink, one.outline).differs;
    if (now >= least) continue;
    least = now;
    best = one;
  }
  return best.outline == marker.shape.outline ? marker : make_template(ink, best);
}

Template trimmed(const Template& marker, const std::vector<Shape>& shapes, double most) {
  const cv::Mat ink = bare_ink(marker);
  if (is_strokes(marker.shape.outline)) {
    cv::Mat mirrored;
    cv::flip(ink, mirrored, 1);
    return make_template(cv::min(ink, mirrored), marker.shape);
  }
  // What sticks out is less than that, else it is another shape.
  Drawn best{{}, most};
  Shape shape = marker.shape;
  for (const auto& one : shapes) {
    if (is_strokes(one.outline)) continue;
    const auto drawn = drawn_like(ink, one.outline);
    if (drawn.differs >= best.differs) continue;
    best = drawn;
    shape = one;
  }
  if (best.box.empty()) return marker;
  const auto& box = best.box;
  const cv::Mat outline =
      draw_shape({shape.outline, Fill::filled}, {box.width + 1, box.height + 1}, 1, ink.size(),
                 {box.x + box.width / 2 - ink.cols / 2.0, box.y + box.height / 2 - ink.rows / 2.0});
  const cv::Mat bare = cv::min(ink, outline);
  // Filled and open have one silhouette.
  std::vector<Shape> fills;
  for (const auto& one : shapes)
    if (one.outline == shape.outline) fills.push_back(one);
  return make_template(bare, recognise(bare, fills).first);
}

Template make_template(const cv::Mat& ink, const Shape& shape) {
  Template marker = bare_template(ink, shape);
  const cv::Point2d middle(marker.ink.cols / 2.0, marker.ink.rows / 2.0);
  if (is_triangle(shape.outline)) {
    const int quarters = quarter_turns(shape.outline);
    const cv::Mat standing = turned(marker.ink, quarters);
    const auto drawn = drawn_like(standing, Outline::triangle).box;
    // Ends of a line that are left on the sides move these apart.
    auto box = box_by_sides(standing, drawn).value_or(drawn);
    if (!is_proportioned(Outline::triangle, box.size())) box = drawn;
    const double lacks = box.width - box.height, drawn_lacks = drawn.width - drawn.height;
    const bool flat = lacks > 0.07 * box.width;
    const auto rule =
        reference_of({Outline::triangle, shape.fill}, box.size(), stroke_width(marker.ink),
                     flat ? std::max(0.4, lacks - drawn_lacks) : 0.4);
    const cv::Point2d standing_middle(standing.cols / 2.0, standing.rows / 2.0);
    const cv::Point2d at(box.x + box.width / 2 - standing_middle.x,
                         box.y + box.height * (0.5 + rule.at.y) - standing_middle.y);
    marker.reference = turned_back(at, quarters);
    marker.reference_u[quarters % 2 == 0 ? 1 : 0] = rule.uncertain * box.height;
    marker.box = quarters % 2 == 0 ? box.size() : cv::Size2d(box.height, box.width);
  } else if (shape.outline == Outline::pentagon || shape.outline == Outline::star) {
    const auto moments = cv::moments(marker.ink);
    marker.reference =
        cv::Point2d(moments.m10 / moments.m00 + 0.5, moments.m01 / moments.m00 + 0.5) - middle;
  } else {
    cv::Mat half_turn;
    cv::rotate(marker.ink, half_turn, cv::ROTATE_180);
    marker.reference = 0.5 * shift_between(marker.ink, half_turn);
  }
  return marker;
}

cv::Mat window(const cv::Mat& image, cv::Point2d origin, cv::Size size, double outside) {
  cv::Mat cut;
  cv::warpAffine(image, cut,
                 cv::Matx23d(1, 0, origin.x - size.width / 2.0, 0, 1, origin.y - size.height / 2.0),
                 size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                 cv::Scalar(outside));
  return cut;
}

cv::Mat laid(const Template& marker, cv::Point2d origin, cv::Point middle) {
  return shifted(marker.ink, origin - cv::Point2d(middle.x + (marker.ink.cols % 2) / 2.0,
                                                  middle.y + (marker.ink.rows % 2) / 2.0));
}

Fit seen_at(const Template& marker, const InkMap& map, cv::Point2d origin) {
  Fit found;
  found.origin = origin;
  const cv::Size size = marker.ink.size();
  const auto part = part_of(map, origin, size);
  if (!part) return found;
  const auto& [seen, unknown, middle] = *part;
  const cv::Mat model = laid(marker, origin, middle);
  double all = 0, known = 0;
  std::array<double, 8> there_of{}, ink_of{};
  const cv::Point2d centre =
      origin - cv::Point2d(middle - cv::Point(size.width / 2, size.height / 2));
  const double core = 0.2 * std::min(marker.box.width, marker.box.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double m = std::clamp(model.at<float>(y, x), 0.0F, 1.0F);
      all += m * m;
      if (unknown.at<uchar>(y, x) != 0) continue;
      known += m * m;
      const cv::Point2d arm(x + 0.5 - centre.x, y + 0.5 - centre.y);
      if (cv::norm(arm) < core) continue;
      const auto eighth =
          static_cast<std::size_t>(cvRound(std::atan2(arm.y, arm.x) * 4 / std::numbers::pi) + 8) %
          8;
      there_of[eighth] += m * std::min<double>(m, seen.at<float>(y, x));
      ink_of[eighth] += m * m;
    }
  std::vector<double> parts{1, 1};
  for (std::size_t eighth = 0; eighth < 8; ++eighth)
    if (ink_of[eighth] > 0.03 * all) parts.push_back(there_of[eighth] / ink_of[eighth]);
  std::partial_sort(parts.begin(), parts.begin() + 2, parts.end());
  found.least_part = parts[0];
  found.next_part = parts[1];
  found.score = explained(marker, origin, model, *part);
  found.known = all > 0 ? known / all : 0;
  return found;
}

Fit fit(const Template& marker, const InkMap& map, cv::Point2d near) {
  Fit found;
  const auto guess = nearest_peak(map, marker, near);
  const cv::Size size = marker.ink.size();
  const auto part = part_of(map, guess, size);
  if (!part) return found;
  const auto& [seen, unknown, middle] = *part;
  const double reach = 0.6 * std::max(marker.box.width, marker.box.height);
  cv::Point2d origin = guess;
  cv::Mat model;
  double xx = 0, xy = 0, yy = 0, squares = 0, weights = 0;
  for (int step = 0; step < 15; ++step) {
    model = laid(marker, origin, middle);
    double bx = 0, by = 0;
    xx = xy = yy = squares = weights = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        if (unknown.at<uchar>(y, x) != 0) continue;
        const auto at = [&](int row, int column) {
          return model.at<float>(std::clamp(row, 0, size.height - 1),
                                 std::clamp(column, 0, size.width - 1));
        };
        const double rest = seen.at<float>(y, x) - at(y, x);
        // Geman and McClure's weight: what is off by a third of full coverage hardly counts.
        const double root = 1 + rest * rest / 0.1, w = 1 / (root * root);
        const double gradient_x = 0.5 * (at(y, x - 1) - at(y, x + 1)),
                     gradient_y = 0.5 * (at(y - 1, x) - at(y + 1, x));
        xx += w * gradient_x * gradient_x;
        xy += w * gradient_x * gradient_y;
        yy += w * gradient_y * gradient_y;
        bx += w * gradient_x * rest;
        by += w * gradient_y * rest;
        squares += w * rest * rest;
        weights += w;
      }
    const double det = xx * yy - xy * xy;
    if (!(det > 1e-6 * (xx + yy) * (xx + yy)) || !(xx + yy > 0)) return found;
    cv::Point2d change((yy * bx - xy * by) / det, (xx * by - xy * bx) / det);
    if (const double far = cv::norm(change); far > 1) change *= 1 / far;
    origin += change;
    if (cv::norm(origin - guess) > reach) return found;
    if (cv::norm(change) < 2e-3) break;
  }
  found = seen_at(marker, map, origin);
  const double det = xx * yy - xy * xy, variance = squares / std::max(1.0, weights - 2);
  found.u[0] = std::sqrt(variance * yy / det);
  found.u[1] = std::sqrt(variance * xx / det);
  return found;
}

double distinct(const Template& marker, const InkMap& map, const Fit& where) {
  const auto beside = [&](cv::Point2d by) {
    const auto part = part_of(map, where.origin + by, marker.ink.size());
    return part ? explained(marker, where.origin + by,
                            laid(marker, where.origin + by, part->middle), *part)
                : 0;
  };
  double most = 0;
  for (int sixteenth = 0; sixteenth < 8; ++sixteenth) {
    const double angle = sixteenth * std::numbers::pi / 8;
    const cv::Point2d half(std::cos(angle) * marker.box.width / 2,
                           std::sin(angle) * marker.box.height / 2);
    most = std::max(most, std::min(beside(half), beside(-half)));
  }
  return where.score - most > 0.1 ? where.score - most : 0;
}
}  // namespace bedscope::digitise
