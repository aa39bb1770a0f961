// SPDX-License-Identifier: BSD-3-Clause
// Texts for people, whatever was quoted in them.
#include "readers/error.hpp"

#include <gtest/gtest.h>

namespace bedscope {
namespace {

TEST(OneLine, KeepsWhatCanBeReadAndEscapesTheRest) {
  EXPECT_EQ(one_line("a \"b\" ≤ 流化床 😀"), "a \"b\" ≤ 流化床 😀");
  EXPECT_EQ(one_line("a\nb\x1b\x7f"), "a\\nb\\x1b\\x7f");
}

TEST(OneLine, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(one_line("M\xfcller"), "M\\xfcller");
  EXPECT_EQ(one_line("\xff\xfez"), "\\xff\\xfez");
  EXPECT_EQ(one_line("cut \xe2\x89"), "cut \\xe2\\x89");
  // Longer than needed, a half of a pair, above U+10FFFF.
  EXPECT_EQ(one_line("\xc0\xaf"), "\\xc0\\xaf");
  EXPECT_EQ(one_line("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(one_line("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(one_line("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(one_line("\xf8\x90\x80\x80"), "\\xf8\\x90\\x80\\x80");
}

TEST(OneLine, LeavesTheMiddleOfLongOnesOut) {
  EXPECT_EQ(one_line(std::string(5000, 'a')),
            std::string(900, 'a') + " ... " + std::string(900, 'a'));
  std::string wide;  // whose 900th byte is within a character
  for (int i = 0; i < 2000; ++i) wide += "≤";
  EXPECT_LT(one_line(wide + "x").size(), 1900u);
}

}  // namespace
}  // namespace bedscope
