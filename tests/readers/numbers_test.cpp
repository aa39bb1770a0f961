// SPDX-License-Identifier: BSD-3-Clause
// Numbers and words of text files, against strtod and against a loop over characters.
#include "readers/numbers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

bool parses(const std::string& text, double& value) {
  return parse_number(text.data(), text.data() + text.size(), value);
}

bool is_number(const std::string& text) {
  double value = 0;
  return parses(text, value);
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_bits_of_strtod(const std::string& text) {
  double ours = 0;
  ASSERT_TRUE(parses(text, ours)) << text;
  const double theirs = std::strtod(text.c_str(), nullptr);
  ASSERT_TRUE(same_bits(ours, theirs)) << text << ": " << ours << " against " << theirs;
}

TEST(Numbers, PrintedDoublesOfAnyBitPatternGiveTheBitsOfStrtod) {
  std::mt19937_64 random(1);
  char text[64];
  for (int i = 0; i < 200'000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    for (const char* format : {"%g", "%.17g", "%.15e", "%.20e", "%E"}) {
      std::snprintf(text, sizeof text, format, value);
      ASSERT_NO_FATAL_FAILURE(expect_bits_of_strtod(text));
    }
  }
}

TEST(Numbers, NumbersOfAnOrdinaryDumpGiveTheBitsOfStrtod) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1), power(-12, 12);
  char text[64];
  for (int i = 0; i < 200'000; ++i) {
    const double value = unit(random) * std::pow(10, power(random));
    for (const char* format : {"%g", "%.11g", "%.17g", "%f", "%-1.16e"}) {
      std::snprintf(text, sizeof text, format, value);
      ASSERT_NO_FATAL_FAILURE(expect_bits_of_strtod(text));
    }
  }
}

TEST(Numbers, StringsOfDigitsOfAnyLengthGiveTheBitsOfStrtod) {
  std::mt19937_64 random(3);
  const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  for (int i = 0; i < 300'000; ++i) {
    std::string text = below(3) == 0 ? "-" : "";
    const unsigned digits = 1 + below(30), point = below(digits + 2);
    for (unsigned k = 0; k < digits; ++k) {
      if (k == point) text += '.';
      text += static_cast<char>('0' + (below(4) == 0 ? 0 : below(10)));
    }
    if (below(2) == 0) {
      text += below(2) == 0 ? 'e' : 'E';
      text += std::array{"", "+", "-"}[below(3)];
      text += std::to_string(below(4) == 0 ? below(500) : below(40));
    }
    ASSERT_NO_FATAL_FAILURE(expect_bits_of_strtod(text));
  }
}

TEST(Numbers, TheEdgesOfTheExactPathGiveTheBitsOfStrtod) {
  for (const char* text : {"9007199254740992",
                           "9007199254740993",
                           "9007199254740991e22",
                           "9007199254740992e22",
                           "9007199254740993e-22",
                           "1e22",
                           "1e23",
                           "1e-22",
                           "1e-23",
                           "18446744073709551615",
                           "18446744073709551616",
                           "9999999999999999999",
                           "0.0000000000000000001",
                           "0000000000000000000000012.5",
                           "4.9e-324",
                           "2.4703282292062328e-324",
                           "2.2250738585072011e-308",
                           "2.2250738585072014e-308",
                           "1.7976931348623157e308",
                           "-0",
                           "-0.0",
                           "0e-99",
                           "-0e+5",
                           "0.000e99",
                           "1.",
                           ".5",
                           "-.5e1",
                           "1e0",
                           "1e000005",
                           "1e-000005",
                           "0.1e-400",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "123456789012345678901234567890e-300"})
    ASSERT_NO_FATAL_FAILURE(expect_bits_of_strtod(text));
}

TEST(Numbers, AnythingButAWholeDecimalNumberIsRefused) {
  for (const char* text :
       {"",      "-",     "+",     ".",   "-.",     "e5",       ".e5",
        "1e",    "1e+",   "1e-",   "1E+", "0x1p-8", "0x10",     "3.0D-03",
        "3.0d3", "0,003", "1_000", "--1", "+-1",    "-+1",      "++1",
        "1.2.3", "1e5.0", "1e5 ",  " 1",  "1e+-5",  "1e5e5",    "nanx",
        "infx",  "12a",   "0.0x1", "1/2", "1e99x",  "1e12345x", "12345678901234567890123x",
        "i",     "n",     "na",    "1f"})
    EXPECT_FALSE(is_number(text)) << text;
  EXPECT_FALSE(
      is_number(std::string("1\0"
                            "2",
                            3)));
}

TEST(Numbers, NanAndInfinityAreReadAsThePrintedOnesOfARunThatBlewUp) {
  double value = 0;
  for (const char* text : {"nan", "-nan", "NaN", "NAN"}) {
    EXPECT_TRUE(parses(text, value)) << text;
    EXPECT_TRUE(std::isnan(value)) << text;
  }
  for (const char* text : {"inf", "-inf", "Infinity", "INF"}) {
    EXPECT_TRUE(parses(text, value)) << text;
    EXPECT_TRUE(std::isinf(value)) << text;
    EXPECT_EQ(std::signbit(value), text[0] == '-') << text;
  }
}

TEST(Numbers, WhatWindowsPrintsForNanAndInfinityIsRead) {
  double value = 0;
  for (const char* text : {"1.#QNAN", "-1.#IND", "-1.#IND00", "-nan(ind)"})
    EXPECT_TRUE(parses(text, value) && std::isnan(value)) << text;
  EXPECT_TRUE(parses("-1.#INF", value) && value < 0 && std::isinf(value));
  for (const char* text : {"1.#", "1.5#", "1#2", "#IND", "1.#OK"}) EXPECT_FALSE(is_number(text));
}

TEST(Numbers, APlusInFrontIsAccepted) {
  double value = 0;
  EXPECT_TRUE(parses("+2.5e-3", value));
  EXPECT_EQ(value, 2.5e-3);
}

TEST(Integers, EveryNumberOf64BitsIsReadAndLargerOnesAreSaidToOverflow) {
  std::int64_t value = 0;
  bool overflow = false;
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t expected :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{7}, most, -most}) {
    EXPECT_TRUE(parse_integer(std::to_string(expected), value, overflow));
    EXPECT_EQ(value, expected);
    EXPECT_FALSE(overflow);
  }
  EXPECT_TRUE(parse_integer("+12", value, overflow));
  EXPECT_EQ(value, 12);
  // 2^63 with a minus is where the negation itself would overflow.
  for (const char* text : {"9223372036854775808", "-9223372036854775808", "18446744073709551616",
                           "99999999999999999999999999", "-99999999999999999999999999"}) {
    EXPECT_FALSE(parse_integer(text, value, overflow)) << text;
    EXPECT_TRUE(overflow) << text;
  }
  for (const char* text : {"", "-", "+", "1.0", "2e1", "1 ", " 1", "0x1", "12a", "--1", "+-1"}) {
    EXPECT_FALSE(parse_integer(text, value, overflow)) << text;
    EXPECT_FALSE(overflow) << text;
  }
}

// Words of a text by the plainest loop.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + " ") {
    if (static_cast<unsigned char>(c) > ' ') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(word);
      word.clear();
    }
  }
  return words;
}

std::string random_words(std::mt19937_64& random, std::size_t size) {
  std::string text;
  while (text.size() < size) {
    // Long and short words and gaps, so that every edge of a block of 64 is met.
    text.append(random() % (random() % 4 == 0 ? 150 : 8), static_cast<char>('a' + random() % 20));
    text.append(1 + random() % (random() % 4 == 0 ? 150 : 3), " \t\r\n"[random() % 4]);
  }
  text.resize(size);
  return text;
}

TEST(Words, AreThoseOfAPlainLoopWhereverBlocksOf64BytesEnd) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20'000; ++i) {
    const auto text = random_words(random, random() % 400);
    const auto expected = words_of(text);
    // What lies behind the end must not matter.
    const std::string buffer = text + std::string(64, i % 2 == 0 ? 'x' : ' ');
    std::vector<std::string> found;
    const auto passed = for_each_word(buffer.data(), buffer.data() + text.size(),
                                      [&](std::int64_t index, const char* from, const char* to) {
                                        EXPECT_EQ(index, static_cast<std::int64_t>(found.size()));
                                        found.emplace_back(from, to);
                                        return true;
                                      });
    ASSERT_EQ(found, expected) << text;
    ASSERT_EQ(passed, static_cast<std::int64_t>(expected.size()));
    std::string_view rest = text;
    for (const auto& word : expected) ASSERT_EQ(next_word(rest), word);
    ASSERT_TRUE(next_word(rest).empty());
  }
}

TEST(Words, CanBePassedOverInAnyPortions) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20'000; ++i) {
    const auto text = random_words(random, random() % 400);  // with or without a blank at its end
    const auto all = static_cast<std::int64_t>(words_of(text).size());
    const std::string buffer = text + std::string(64, 'x');
    const char* at = buffer.data();
    const char* const end = at + text.size();
    std::int64_t passed = 0;
    while (passed < all) {
      const auto ask = static_cast<std::int64_t>(1 + random() % 9);
      const auto got = skip_words(at, end, ask);
      ASSERT_EQ(got, std::min(ask, all - passed)) << text;
      ASSERT_LE(at, end) << text;
      passed += got;
      ASSERT_EQ(static_cast<std::int64_t>(words_of(std::string(at, end)).size()), all - passed);
    }
    ASSERT_EQ(skip_words(at, end, 1), 0);
  }
}

}  // namespace
}  // namespace bedscope::readers
