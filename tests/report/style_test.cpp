// SPDX-License-Identifier: BSD-3-Clause
#include "report/style.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "report/html.hpp"
#include "report/page.hpp"

namespace bedscope::report {
namespace {

TEST(PlusMinus, RoundsTheIntervalAndTheValueWithIt) {
  EXPECT_EQ(plus_minus({0.025534, 0.000312}), "0.0255 ± 0.0003");
  EXPECT_EQ(plus_minus({0.025534, 0.000146}), "0.02553 ± 0.00015");
  EXPECT_EQ(plus_minus({5.02, 0.21}), "5.02 ± 0.21");
  EXPECT_EQ(plus_minus({1234.5, 67}), "1234 ± 67") << "no decimals below one";
  EXPECT_EQ(plus_minus({-1.5, 0.96}), "-1.5 ± 1.0");
}

TEST(PlusMinus, KeepsTinyAndHugeNumbersReadable) {
  EXPECT_EQ(plus_minus({2.55e-6, 3e-8}), "(2.55 ± 0.03) × 10^-6");
  EXPECT_EQ(plus_minus({0.0243781, 4e-7}), "0.024378 ± < 0.000001");
}

TEST(PlusMinus, SaysWhatIsUnknown) {
  EXPECT_EQ(plus_minus({}), "–");
  EXPECT_EQ(plus_minus({0.02553, std::nan("")}), "0.0255");
}

TEST(RoundedAxis, CoversTheRangeWithWholeTicks) {
  for (const auto& [lo, hi] : {std::pair{0.0, 0.137}, {-3.2, 7.9}, {-1e-7, 2e-6}, {312.0, 319.0}}) {
    for (const int intervals : {2, 4, 8}) {
      const Axis axis = rounded_axis(lo, hi, intervals);
      EXPECT_LE(axis.lo, lo);
      EXPECT_GE(axis.hi, hi);
      const double ticks = (axis.hi - axis.lo) / axis.step;
      EXPECT_NEAR(ticks, std::round(ticks), 1e-9);  // rounding of a quotient of decimals
      EXPECT_LE(ticks, intervals + 1 + 1e-9) << lo << " " << hi;
    }
  }
}

TEST(RoundedAxis, MakesARangeOfAConstantAndOfNothing) {
  EXPECT_LT(rounded_axis(3, 3, 4).lo, 3);
  EXPECT_GT(rounded_axis(3, 3, 4).hi, 3);
  const Axis close = rounded_axis(71.19, 71.19 * (1 + 1e-9), 4);
  EXPECT_GT(close.hi - close.lo, 1e-7 * close.hi) << "what differs in the tenth digit is constant";
  EXPECT_EQ(rounded_axis(0, 0, 4).lo, 0) << "a holdup of zero has no negative side";
  const Range none;
  EXPECT_LT(rounded_axis(none.lo, none.hi, 4).lo, rounded_axis(none.lo, none.hi, 4).hi);
}

TEST(ExactAxis, PutsTicksInsideTheDomain) {
  const Axis axis = exact_axis(0.013, 1.57, 8);
  EXPECT_EQ(axis.lo, 0.013);
  EXPECT_EQ(axis.hi, 1.57);
  EXPECT_NEAR(axis.first, 0.2, 1e-12);  // rounding
  EXPECT_EQ(axis.decimals, 1);
}

TEST(CentralRange, LeavesOutliersAndNanOut) {
  std::vector<double> values(1000, 1.0);
  values[0] = 1e6;
  values[1] = std::nan("");
  values[2] = -5;
  const Range range = central_range(values, 0.005);
  EXPECT_EQ(range.lo, 1.0);
  EXPECT_EQ(range.hi, 1.0);
  EXPECT_TRUE(central_range({std::nan("")}, 0.005).empty());
}

TEST(CurveStyles, DifferInMoreThanColour) {
  std::set<std::string> words, dashes;
  for (std::size_t i = 0; i < 20; ++i) words.insert(curve_style(i).line);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string line = curve_style(i).line;
    dashes.insert(line.substr(line.find("dt")));
  }
  EXPECT_EQ(words.size(), 20U);
  EXPECT_EQ(dashes.size(), 4U) << "the first four are told apart in grey";
}

TEST(Shortened, CutsBetweenCharactersAndNotWithin) {
  EXPECT_EQ(shortened("short", 100), "short");
  const std::string text = shortened("φφφφφφφφφφφφ", text_width("φφφφφ"));
  EXPECT_EQ(text, "φφφ…") << "the ellipsis needs room too";
}

TEST(Escaped, LeavesNothingThatHtmlReads) {
  EXPECT_EQ(escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
}

}  // namespace
}  // namespace bedscope::report
