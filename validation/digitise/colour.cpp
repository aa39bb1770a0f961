// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "validation/digitise/page.hpp"

namespace bedscope::digitise {
namespace {

constexpr float faint = 0.12F;  // of full contrast: below it is paper

/// Luma of a BGR difference (ITU-R BT.601): what JPEG keeps sharp.
float luma(cv::Vec3f d) { return 0.114F * d[0] + 0.587F * d[1] + 0.299F * d[2]; }

float length(cv::Vec3f d) { return static_cast<float>(cv::norm(d)); }

/// The share of `ink` (paper subtracted) that leaves the least of `d`, and what it leaves.
struct Share {
  float share, rest;
};
Share share_of(cv::Vec3f d, cv::Vec3f ink) {
  const float share = std::clamp(d.dot(ink) / ink.dot(ink), 0.0F, 1.15F);
  return {share, length(d - share * ink)};
}

/// The same for a compressed picture, which keeps the luma sharp and smears the colour: the luma
/// tells the share, and the colour may have lost up to 0.6 of its strength.
Share smeared_share_of(cv::Vec3f d, cv::Vec3f ink) {
  const float y = luma(d), full = luma(ink);
  if (std::abs(full) < 55) return share_of(d, ink);
  const float share = std::clamp(y / full, 0.0F, 1.15F);
  const cv::Vec2f seen(0.564F * (d[0] - y), 0.713F * (d[2] - y));
  const cv::Vec2f own = share * cv::Vec2f(0.564F * (ink[0] - full), 0.713F * (ink[2] - full));
  const float strength =
      own.dot(own) > 0 ? std::clamp(seen.dot(own) / own.dot(own), 0.4F, 1.3F) : 0;
  return {share, static_cast<float>(cv::norm(seen - strength * own)) + std::abs(y - share * full)};
}

/// Pixels whose difference from the paper is no weaker than their neighbours': the cores of areas
/// and the ridges of lines, which show an ink least mixed.
std::vector<cv::Vec3f> core_colours(const cv::Mat& difference) {
  std::vector<cv::Vec3f> cores;
  for (int y = 1; y + 1 < difference.rows; ++y)
    for (int x = 1; x + 1 < difference.cols; ++x) {
      const auto d = difference.at<cv::Vec3f>(y, x);
      const float here = length(d);
      if (here < 40) continue;
      const auto weaker = [&](int dy, int dx) {
        return length(difference.at<cv::Vec3f>(y + dy, x + dx)) <= here + 6 &&
               length(difference.at<cv::Vec3f>(y - dy, x - dx)) <= here + 6;
      };
      if ((weaker(0, 1) || weaker(1, 0)) && (weaker(1, 1) || weaker(1, -1))) cores.push_back(d);
    }
  return cores;
}

/// The colour of the picture that is meant by `asked`: the mean of the core colours near it;
/// `asked` itself where the picture only shows it thinned: fine lines, compressed or blurred.
/// Nothing where fewer than `least` are near.
std::optional<cv::Vec3f> find_again(const std::vector<cv::Vec3f>& cores, cv::Vec3f asked,
                                    bool smeared, std::size_t least) {
  for (const float tolerance : {18.0F, 35.0F, same_ink, 1.5F * same_ink}) {
    cv::Vec3d sum;
    std::size_t n = 0;
    for (const auto& core : cores)
      if (length(core - asked) < tolerance) {
        sum += cv::Vec3d(core);
        ++n;
      }
    if (n >= least) return cv::Vec3f(sum / static_cast<double>(n));
  }
  const auto thinned = std::count_if(cores.begin(), cores.end(), [&](cv::Vec3f core) {
    const auto [share, rest] = smeared ? smeared_share_of(core, asked) : share_of(core, asked);
    return share > 0.25F && rest < 20;
  });
  if (static_cast<std::size_t>(thinned) >= least) return asked;
  return std::nullopt;
}

/// Whether two colours that were found are those of one ink: near each other, or of one hue and
/// the paler by up to a fifth, as the edges of its strokes are.
bool are_one_ink(cv::Vec3f a, cv::Vec3f b) {
  if (length(a - b) < 20) return true;
  const auto [pale, full] = length(a) < length(b) ? std::pair(a, b) : std::pair(b, a);
  const auto [share, rest] = share_of(pale, full);
  return share > 0.8F && rest < 12;
}

/// A colour that is a mixture of paper and one of `inks`, or nearly one of them.
bool is_mixture(cv::Vec3f colour, const std::vector<cv::Vec3f>& inks, bool lossy) {
  return std::any_of(inks.begin(), inks.end(), [&](cv::Vec3f ink) {
    return lossy ? smeared_share_of(colour, ink).rest < 40 : share_of(colour, ink).rest < 30;
  });
}

/// Inks that nobody asked for: the commonest core colours that are no mixture of known ones.
void add_others(const std::vector<cv::Vec3f>& cores, bool lossy, std::vector<cv::Vec3f>& inks) {
  std::map<int, std::pair<cv::Vec3d, int>> boxes;
  for (const auto& core : cores) {
    const auto step = [](float v) { return static_cast<int>(std::floor(v / 24)) + 32; };
    auto& [sum, n] = boxes[(step(core[0]) * 64 + step(core[1])) * 64 + step(core[2])];
    sum += cv::Vec3d(core);
    ++n;
  }
  std::vector<std::pair<int, cv::Vec3f>> sorted;
  for (const auto& [key, box] : boxes)
    sorted.emplace_back(box.second, cv::Vec3f(box.first / box.second));
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto least = std::max<std::size_t>(30, cores.size() / 200);
  for (const auto& [n, colour] : sorted)
    if (static_cast<std::size_t>(n) >= least && inks.size() < 24 && length(colour) > 60 &&
        !is_mixture(colour, inks, lossy))
      inks.push_back(colour);
}

/// The share that tells where an edge lies: of the luma where the picture was compressed and the
/// ink is dark enough, as the other channels are smeared there; else of the whole colour.
float sharp_share(cv::Vec3f d, cv::Vec3f ink, bool lossy) {
  const float full = luma(ink);
  if (lossy && std::abs(full) > 55) return std::clamp(luma(d) / full, 0.0F, 1.0F);
  return std::clamp(d.dot(ink) / ink.dot(ink), 0.0F, 1.0F);
}

/// The edge of a stroke is a mixture of its ink and the paper, and may look like a paler ink (grey
/// at the edge of black, a pale violet at that of violet): a pixel beside a stronger one that is a
/// mixture of that one's ink belongs to it.
void give_edges_to_stronger(const std::vector<cv::Vec3f>& inks, const cv::Mat& difference,
                            bool smeared, Colours& colours) {
  const cv::Mat before = colours.owner.clone();
  cv::Mat strength(difference.size(), CV_32F);
  for (int y = 0; y < difference.rows; ++y)
    for (int x = 0; x < difference.cols; ++x)
      strength.at<float>(y, x) = length(difference.at<cv::Vec3f>(y, x));
  for (int y = 1; y + 1 < difference.rows; ++y)
    for (int x = 1; x + 1 < difference.cols; ++x) {
      const int own = before.at<int>(y, x);
      if (own < 0) continue;
      int best = own;
      float strongest = 1.15F * strength.at<float>(y, x) + 6;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int other = before.at<int>(y + dy, x + dx);
          if (other < 0 || strength.at<float>(y + dy, x + dx) <= strongest) continue;
          const auto [share, rest] = share_of(difference.at<cv::Vec3f>(y, x), inks[other]);
          if (other != own && (rest > 30 || share > 0.95F)) continue;
          strongest = strength.at<float>(y + dy, x + dx);
          best = other;
        }
      if (best == own) continue;
      colours.owner.at<int>(y, x) = best;
      colours.coverage.at<float>(y, x) =
          sharp_share(difference.at<cv::Vec3f>(y, x), inks[best], smeared);
    }
}

/// Blue and red less luma of a BGR difference (ITU-R BT.601): what JPEG smears.
cv::Vec2f chroma(cv::Vec3f d) {
  const float y = luma(d);
  return {0.564F * (d[0] - y), 0.713F * (d[2] - y)};
}

constexpr int grey_hue = -1;  // the hue of greys

/// A twelfth of the circle of hues; greys have less chroma than compression gives to them.
int hue_of(cv::Vec3f d) {
  const auto c = chroma(d);
  return cv::norm(c) < 20 ? grey_hue : static_cast<int>(cv::fastAtan2(c[1], c[0]) / 30) % 12;
}

/// The mean of the strongest tenth of `colours` of one hue: thin strokes, compressed or blurred,
/// show their ink nowhere else.
cv::Vec3f fullest(std::vector<cv::Vec3f> colours, bool grey) {
  const auto strength = [&](cv::Vec3f d) {
    return grey ? length(d) : static_cast<float>(cv::norm(chroma(d)));
  };
  const auto n = std::min(colours.size(), std::max<std::size_t>(12, colours.size() / 10));
  const auto end = colours.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(colours.begin(), end - 1, colours.end(),
                   [&](cv::Vec3f a, cv::Vec3f b) { return strength(a) > strength(b); });
  cv::Vec3d sum;
  for (auto one = colours.begin(); one != end; ++one) sum += cv::Vec3d(*one);
  return cv::Vec3f(sum / static_cast<double>(n));
}

struct Noise {
  bool any = false;     ///< the paper is uneven: compression, scanning, blur
  bool smears = false;  ///< compression: it spreads the colour of thin strokes
};

/// Drawing programs leave the paper exact; a blurred stroke does not reach far, the noise of a
/// scanner is everywhere, and that of compression near strokes.
Noise noise_of(const cv::Mat& difference) {
  cv::Mat paper(difference.size(), CV_8U), distance;
  for (int y = 0; y < difference.rows; ++y)
    for (int x = 0; x < difference.cols; ++x)
      paper.at<uchar>(y, x) = length(difference.at<cv::Vec3f>(y, x)) < 25 ? 255 : 0;
  cv::distanceTransform(paper, distance, cv::DIST_L2, 3);
  double uneven = 0, flat = 0, near_uneven = 0, near = 1, far_uneven = 0, far = 1;
  for (int y = 0; y < difference.rows; ++y)
    for (int x = 0; x < difference.cols; ++x) {
      const float d = length(difference.at<cv::Vec3f>(y, x)), from = distance.at<float>(y, x);
      const bool here = d >= 1.5F && d < 15;
      flat += d < 1.5F;
      uneven += here;
      if (from > 3.5F && from < 8) {
        ++near;
        near_uneven += here;
      } else if (from > 20) {
        ++far;
        far_uneven += here;
      }
    }
  return {uneven > flat / 15,
          near_uneven / near > 0.1 && near_uneven / near > 3 * far_uneven / far};
}

/// The direction of greys: frame, text and grid lines, which would else be taken for a faint ink.
/// Nothing where an asked ink is nearly neutral itself.
std::optional<cv::Vec3f> neutral_beside(const std::vector<cv::Vec3f>& inks, cv::Vec3f paper) {
  const cv::Vec3f neutral = luma(paper) > 128 ? -paper : cv::Vec3f(255, 255, 255) - paper;
  for (const auto& ink : inks)
    if (share_of(ink, neutral).rest < 0.2F * length(ink)) return std::nullopt;
  return neutral;
}

}  // namespace

Colours separate(const cv::Mat& page, const cv::Rect& area, bool lossy,
                 const std::vector<cv::Vec3f>& asked) {
  Colours colours;
  colours.paper = paper_of(page, area);
  cv::Mat difference;
  page.convertTo(difference, CV_32F);
  difference -= cv::Scalar(colours.paper[0], colours.paper[1], colours.paper[2]);
  const auto noise = noise_of(difference(area));
  colours.lossy = lossy || noise.any;
  const bool smeared = lossy || noise.smears;
  const auto cores = core_colours(difference(area));
  std::vector<cv::Vec3f> inks;
  for (const auto& colour : asked) {
    const auto found = find_again(cores, colour - colours.paper, smeared, 12);
    if (!found || length(*found) < 25) {
      colours.ink_of_asked.push_back(-1);
      continue;
    }
    // Colours given by eye may mean the same ink.
    const auto same = std::find_if(inks.begin(), inks.end(),
                                   [&](cv::Vec3f ink) { return are_one_ink(ink, *found); });
    colours.ink_of_asked.push_back(static_cast<int>(same - inks.begin()));
    if (same == inks.end())
      inks.push_back(*found);
    else if (length(*found) > length(*same) + 20)
      *same = *found;
  }
  if (const auto neutral = neutral_beside(inks, colours.paper)) inks.push_back(*neutral);
  add_others(cores, smeared, inks);

  cv::Mat blurred = difference;
  if (smeared) cv::GaussianBlur(difference, blurred, {}, 1.1);
  colours.owner = cv::Mat(page.size(), CV_32S, cv::Scalar(-1));
  colours.coverage = cv::Mat::zeros(page.size(), CV_32F);
  for (int y = 0; y < page.rows; ++y)
    for (int x = 0; x < page.cols; ++x) {
      const auto d = difference.at<cv::Vec3f>(y, x);
      if (length(d) < 14) continue;
      const auto who = blurred.at<cv::Vec3f>(y, x);
      int best = -1;
      float least = 1e9F;
      for (int k = 0; k < static_cast<int>(inks.size()); ++k) {
        const auto [share, rest] =
            smeared ? smeared_share_of(who, inks[k]) : share_of(who, inks[k]);
        const float cost = rest + 12 * std::max(0.0F, 1 - share);  // of two in line, the nearer one
        if (share > 0.02F && cost < least) {
          least = cost;
          best = k;
        }
      }
      if (best < 0) continue;
      const float share = sharp_share(d, inks[best], smeared);
      if (share < faint / 3) continue;
      colours.owner.at<int>(y, x) = best;
      colours.coverage.at<float>(y, x) = share;
    }
  // Compression blurs an edge over some pixels: from each to the next.
  for (int pass = 0; pass < (smeared ? 3 : 1); ++pass)
    give_edges_to_stronger(inks, difference, smeared, colours);
  for (const auto& ink : inks) colours.inks.push_back(ink + colours.paper);
  return colours;
}

cv::Mat coverage_of(const Colours& colours, int index) {
  cv::Mat mine, coverage = cv::Mat::zeros(colours.coverage.size(), CV_32F);
  cv::compare(colours.owner, index, mine, cv::CMP_EQ);
  colours.coverage.copyTo(coverage, mine);
  return coverage;
}

cv::Mat hidden_from(const Colours& colours, int index) {
  cv::Mat others, strong, mine;
  cv::compare(colours.owner, index, mine, cv::CMP_EQ);
  cv::compare(colours.coverage, 0.3, strong, cv::CMP_GT);
  cv::bitwise_not(mine, others);
  return others & strong;
}

std::vector<cv::Vec3f> inks_in(const cv::Mat& page, const cv::Rect& area, bool lossy) {
  const auto paper = paper_of(page, area);
  cv::Mat difference;
  page(area).convertTo(difference, CV_32F);
  difference -= cv::Scalar(paper[0], paper[1], paper[2]);
  const bool noisy = lossy || noise_of(difference).any;
  auto rest = core_colours(difference);
  const auto least = std::max<std::size_t>(30, rest.size() / 200);
  std::vector<cv::Vec3f> inks;
  while (inks.size() < 24) {
    std::map<int, std::vector<cv::Vec3f>> of_hue;
    for (const auto& core : rest) of_hue[hue_of(core)].push_back(core);
    const auto commonest = std::max_element(
        of_hue.begin(), of_hue.end(),
        [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    if (commonest == of_hue.end() || commonest->second.size() < least) break;
    const auto ink = fullest(commonest->second, commonest->first == grey_hue);
    // In noise, and where it is too faint to be one, the rest of a hue is no other ink.
    const bool whole = noisy || length(ink) < 60;
    const int hue = commonest->first;
    const auto known = std::erase_if(rest, [&](cv::Vec3f core) {
      return is_mixture(core, {ink}, noisy) || (whole && hue_of(core) == hue);
    });
    if (known == 0) break;
    if (length(ink) >= 60) inks.push_back(ink + paper);
  }
  return inks;
}

std::string hex_of(cv::Vec3f colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", cvRound(colour[2]), cvRound(colour[1]),
                     cvRound(colour[0]));
}

}  // namespace bedscope::digitise
