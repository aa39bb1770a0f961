// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/legend.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace bedscope::digitise {
namespace {

struct Word {
  std::vector<cv::Rect> glyphs;
  cv::Rect box;
};

/// Letters with ascender and descender are some 2.4 times as high as those with neither; a dash
/// beside a marker with its bars is lower than that.
bool same_row(const cv::Rect& a, const cv::Rect& b) {
  const int overlap = std::min(a.br().y, b.br().y) - std::max(a.y, b.y);
  const auto [low, high] = std::minmax(a.height, b.height);
  return 2 * overlap >= low && 2.5 * low >= high;
}

/// Whether a disc of more than 0.6 of a piece's height finds room in it: a filled marker is no
/// letter. (Small letters are filled by a blur.)
bool is_filled(const cv::Mat& piece) {
  if (piece.rows < 10) return false;
  cv::Mat framed, depth;
  cv::copyMakeBorder(piece, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(framed, depth, cv::DIST_L2, 5);
  double radius = 0;
  cv::minMaxLoc(depth, nullptr, &radius);
  return 2 * radius > 0.6 * piece.rows;
}

/// Pieces of ink of a letter's size.
std::vector<cv::Rect> glyphs_of(const cv::Mat& mask, cv::Point offset) {
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  const int tallest = std::max(16, std::min(mask.cols, mask.rows) / 12);
  std::vector<cv::Rect> glyphs;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (box.height < 5 || box.height > tallest || box.width > 3 * box.height) continue;
    if (!is_filled(labels(box) == i)) glyphs.push_back(box + offset);
  }
  std::sort(glyphs.begin(), glyphs.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return glyphs;
}

bool alike(const cv::Rect& a, const cv::Rect& b) {
  return std::abs(a.width - b.width) <= std::max(1.0, 0.12 * a.width) &&
         std::abs(a.height - b.height) <= std::max(1.0, 0.08 * a.height);
}

/// In how many other columns there is a glyph's like. Letters that the rows of a legend have in
/// common stand below one another; a series' markers do not.
std::ptrdiff_t recurrences(const cv::Rect& glyph, const std::vector<cv::Rect>& glyphs) {
  return std::count_if(glyphs.begin(), glyphs.end(), [&](const cv::Rect& other) {
    return std::abs(other.x - glyph.x) > glyph.width / 2 && alike(glyph, other);
  });
}

/// Letters next to one another, unlike in size: markers in a row are alike, or each is like others;
/// with dashes at some of them these are wider than letters.
std::vector<Word> words_of(const std::vector<cv::Rect>& glyphs) {
  std::vector<Word> words;
  for (const auto& glyph : glyphs) {
    Word* home = nullptr;
    for (auto& word : words) {
      const int gap = glyph.x - word.box.br().x;
      const int height = std::max(glyph.height, word.glyphs.back().height);
      if (same_row(glyph, word.box) && gap <= 0.4 * height && gap >= -height &&
          (home == nullptr || word.box.br().x > home->box.br().x))
        home = &word;
    }
    if (home == nullptr) {
      words.push_back({{glyph}, glyph});
    } else {
      home->glyphs.push_back(glyph);
      home->box |= glyph;
    }
  }
  std::erase_if(words, [&](const Word& word) {
    const auto every = [&](const auto& holds) {
      return std::all_of(word.glyphs.begin(), word.glyphs.end(), holds);
    };
    const auto any = [&](const auto& holds) {
      return std::any_of(word.glyphs.begin(), word.glyphs.end(), holds);
    };
    const auto is_wide = [&](const cv::Rect& glyph) {
      return glyph.height > 0.6 * word.box.height && glyph.width > 1.6 * glyph.height;
    };
    return word.glyphs.size() < 2 ||
           every([&](const cv::Rect& glyph) { return alike(word.glyphs.front(), glyph); }) ||
           every([&](const cv::Rect& glyph) { return recurrences(glyph, glyphs) >= 4; }) ||
           (any(is_wide) && any([&](const cv::Rect& glyph) {
              return !is_wide(glyph) && recurrences(glyph, glyphs) >= 2;
            }));
  });
  return words;
}

/// The sample beside a row of text: what lies whole in a strip at that side, at its height.
std::optional<cv::Rect> sample_beside(const cv::Mat& mask, const cv::Rect& text, int height,
                                      bool left, const cv::Rect& area) {
  const int near = cvRound(0.25 * height), far = cvRound(9 * height);
  // Room for a sample of one and a half times the letters' height, off their middle by 0.4 of it.
  const int reach = cvRound(1.25 * height);
  const cv::Rect strip = cv::Rect(left ? text.x - far : text.br().x + near,
                                  text.y + text.height / 2 - reach, far - near, 2 * reach) &
                         area;
  if (strip.width < height || strip.height < height) return std::nullopt;
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(mask(strip), labels, stats, centres, 8);
  std::vector<cv::Rect> parts;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (std::max(box.width, box.height) < 3) continue;
    const bool inside =
        box.y > 0 && box.br().y < strip.height && (left ? box.x > 0 : box.br().x < strip.width);
    const double off = box.y + box.height / 2.0 + strip.y - text.y - text.height / 2.0;
    if (inside && std::abs(off) < 0.4 * height) parts.push_back(box);
  }
  // The nearest part, and what is close to it: more samples, dashes.
  std::sort(parts.begin(), parts.end(), [left](const cv::Rect& a, const cv::Rect& b) {
    return left ? a.br().x > b.br().x : a.x < b.x;
  });
  cv::Rect sample;
  for (const auto& part : parts)
    if (sample.empty() || std::max(part.x - sample.br().x, sample.x - part.br().x) < 0.8 * height)
      sample |= part;
  if (sample.empty()) return std::nullopt;
  const int gap = left ? strip.width - sample.br().x : sample.x;
  if (gap > 4.2 * height) return std::nullopt;
  return sample + strip.tl();
}

/// The largest share of inked pixels between two rows that a column within `slack` of `x` has.
double inked(const cv::Mat& ink, double x, double top, double bottom, double slack) {
  const cv::Rect there = cv::Rect(cv::Point(cvFloor(x - slack), cvFloor(top)),
                                  cv::Point(cvCeil(x + slack), cvCeil(bottom))) &
                         cv::Rect({0, 0}, ink.size());
  if (there.empty()) return 0;
  const cv::Mat mask = (ink(there) > 0.12F) / 255;  // as rules are seen
  cv::Mat sums;
  cv::reduce(mask, sums, 0, cv::REDUCE_SUM, CV_32S);
  double most = 0;
  cv::minMaxLoc(sums, nullptr, &most);
  return most / there.height;
}

/// Pieces of ink that lie whole in a box.
int pieces_within(const cv::Mat& ink, const cv::Rect& box) {
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(ink(box) > 0.3F, labels, stats, centres, 8);
  int pieces = 0;
  for (int i = 1; i < n; ++i) {
    const int x = stats.at<int>(i, cv::CC_STAT_LEFT), y = stats.at<int>(i, cv::CC_STAT_TOP);
    const int w = stats.at<int>(i, cv::CC_STAT_WIDTH), h = stats.at<int>(i, cv::CC_STAT_HEIGHT);
    pieces += x > 0 && y > 0 && x + w < box.width && y + h < box.height && std::max(w, h) >= 3 &&
              w < box.width / 2 + 1;
  }
  return pieces;
}

/// Whether the sides of a box cut through dark ink: markers and bars that lie beside one another.
bool cuts(const cv::Mat& text, const cv::Rect& box) {
  const int blur = 2;
  const cv::Rect round =
      cv::Rect(box.x - 2 * blur, box.y - 2 * blur, box.width + 4 * blur, box.height + 4 * blur) &
      cv::Rect({0, 0}, text.size());
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(text(round) > 0.4F, labels, stats, centres, 8);
  const cv::Rect inner =
      cv::Rect(box.x - blur, box.y - blur, box.width + 2 * blur, box.height + 2 * blur) -
      round.tl();
  for (int i = 1; i < n; ++i) {
    const cv::Rect piece(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                         stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if ((piece & inner) != piece && !(piece & inner).empty()) return true;
  }
  return false;
}

}  // namespace

std::vector<cv::Rect> find_boxes(const Rules& rules, const cv::Mat& ink, const cv::Rect& area) {
  std::vector<cv::Rect> boxes;
  const double slack = std::max(4.0, 0.02 * std::min(area.width, area.height));
  const auto near = [&](double a, double b) { return std::abs(a - b) < slack; };
  // Two lines side by side that end alike, a third that ends where they are, and ink that closes
  // the box: a grid line close to its last side is taken for a part of that.
  const auto find = [&](const std::vector<Rule>& along, const std::vector<Rule>& across,
                        const cv::Mat& seen, double wide, double high, bool is_upright) {
    for (const auto& first : along)
      for (const auto& second : along) {
        const double apart = second.at - first.at;
        if (apart < 0.03 * high || apart > 0.75 * high) continue;
        if (!near(first.from, second.from) || !near(first.to, second.to)) continue;
        if (first.length() < 0.06 * wide || first.length() > 0.75 * wide) continue;
        const auto joins = [&](double at) {
          return std::any_of(across.begin(), across.end(), [&](const Rule& rule) {
            return near(rule.at, at) && rule.from < first.at + slack &&
                   rule.to > second.at - slack && rule.from > first.at - 2 * slack &&
                   rule.to < second.at + 2 * slack;
          });
        };
        const auto closed = [&](double at) {
          return inked(seen, at, first.at, second.at, slack) > 0.9;
        };
        const double from = (first.from + second.from) / 2, to = (first.to + second.to) / 2;
        if (!(joins(from) && closed(to)) && !(joins(to) && closed(from))) continue;
        cv::Rect box(cvFloor(first.from - 3), cvFloor(first.at - 3), cvCeil(first.length() + 6),
                     cvCeil(apart + 6));
        if (is_upright) box = cv::Rect(box.y, box.x, box.height, box.width);
        // A marker is a box too, an empty one.
        if ((box & area).area() > 0.9 * box.area() && pieces_within(ink, box & area) >= 3)
          boxes.push_back(box & area);
      }
  };
  find(rules.rows, rules.columns, ink, area.width, area.height, false);
  find(rules.columns, rules.rows, ink.t(), area.height, area.width, true);
  // Boxes of one size, apart from one another, are markers.
  const auto all = boxes;
  std::erase_if(boxes, [&](const cv::Rect& box) {
    return std::any_of(all.begin(), all.end(), [&](const cv::Rect& other) {
      return (box & other).empty() && std::abs(box.width - other.width) < 3 &&
             std::abs(box.height - other.height) < 3;
    });
  });
  return boxes;
}

std::vector<cv::Rect> find_legend_rows(const cv::Mat& text, const cv::Mat& ink,
                                       const cv::Rect& area) {
  std::vector<cv::Rect> rows;
  // The strokes of small letters are thin, and pale where a scan or a compression blurs them; where
  // they are sharp, the lower limit joins letters to one. So it is with thin samples, and those
  // close to the legend's frame.
  for (const double least : {0.4, 0.3})
    for (const auto& word : words_of(glyphs_of(text(area) > least, area.tl()))) {
      int height = 0;
      for (const auto& glyph : word.glyphs) height = std::max(height, glyph.height);
      if (word.box.width < 0.8 * height) continue;
      const int margin = std::max(2, height / 4);
      bool found = false;
      for (const bool left : {true, false}) {
        for (const double any : {0.25, 0.5})
          if (const auto sample = sample_beside(ink > any, word.box, height, left, area)) {
            const cv::Rect both = word.box | *sample;
            if (cuts(text, both)) continue;
            rows.push_back(cv::Rect(both.x - margin, both.y - margin, both.width + 2 * margin,
                                    both.height + 2 * margin) &
                           area);
            found = true;
          }
        if (found) break;
      }
    }
  return rows;
}

}  // namespace bedscope::digitise
