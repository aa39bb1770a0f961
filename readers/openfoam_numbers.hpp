// SPDX-License-Identifier: BSD-3-Clause
// Numbers inside long ascii lists: read where they stand, their end found on the way. Every reader
// of this header has NUL behind the last character and 64 readable bytes behind that.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "readers/numbers.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers {

inline constexpr std::size_t longest_row = 4096;  ///< bytes of one value; beyond: the slow way

inline const char* skip_space(const char* p, const char* end) {
  while (is_blank(*p) && p < end) ++p;
  return p;
}

/// May a number end before this character?
inline bool ends_number(char c) {
  return is_blank(c) || c == ')' || c == '(' || c == '}' || c == ';' || c == '/';
}

/// How many of the 8 characters at p are digits before the first other one, and their number.
/// All at once, since the branch at the end of a loop over digits is mispredicted for each number:
/// measured, 1.3 times the speed for lists of six digits.
struct DigitRun {
  unsigned length;
  std::uint64_t number;
};
inline DigitRun digit_run(const char* p) {
  if constexpr (std::endian::native == std::endian::little) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, p, 8);
    bytes ^= 0x3030303030303030;  // digits become 0 to 9
    const std::uint64_t others =
        ((bytes + 0x7676767676767676) | bytes) & 0x8080808080808080;  // exact up to the first
    const auto length = static_cast<unsigned>(std::countr_zero(others)) / 8;
    if (length == 0) return {0, 0};
    bytes <<= 64 - 8 * length;  // zeros before the digits
    bytes = (bytes * 10 + (bytes >> 8)) & 0x00ff00ff00ff00ff;
    bytes = (bytes * 100 + (bytes >> 16)) & 0x0000ffff0000ffff;
    return {length, (bytes * 10000 + (bytes >> 32)) & 0xffffffff};
  } else {
    DigitRun run{0, 0};
    for (unsigned digit = 0; run.length < 8; ++run.length) {
      digit = static_cast<unsigned char>(p[run.length]) - unsigned{'0'};
      if (digit > 9) break;
      run.number = run.number * 10 + digit;
    }
    return run;
  }
}

inline constexpr std::array<std::uint64_t, 9> tens{1,      10,      100,      1000,     10000,
                                                   100000, 1000000, 10000000, 100000000};

/// The number at p, which moves behind it; false where there is none. Short decimals as in
/// parse_number (exact by Clinger 1990), the rest by fast_float.
inline bool number_here(const char*& p, const char* end, double& value) {
  const char* at = p;
  const bool negative = *at == '-';
  at += negative;
  const char* const first = at;
  std::uint64_t digits = 0;
  unsigned digit = 0;
  while ((digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10) {
    digits = digits * 10 + digit;
    ++at;
  }
  auto count = at - first;
  std::int64_t exponent = 0;
  if (*at == '.') {
    const char* const point = ++at;
    const auto run = digit_run(at);
    digits = digits * tens[run.length] + run.number;
    at += run.length;
    while (run.length == 8 && (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10) {
      digits = digits * 10 + digit;
      ++at;
    }
    exponent = point - at;
    count += at - point;
  }
  bool simple = count > 0 && count <= 19;
  if (simple && (*at | 0x20) == 'e') {
    ++at;
    const bool minus = *at == '-';
    at += minus || *at == '+';
    int power = 0;
    const char* const power_digits = at;
    for (; (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10 && at - power_digits < 4;
         ++at)
      power = power * 10 + static_cast<int>(digit);
    simple = at != power_digits;
    exponent += minus ? -power : power;
  }
  if (simple && digits <= (1ULL << 53) && exponent >= -22 && exponent <= 22) {
    const auto whole = static_cast<double>(digits);
    const double magnitude = exponent < 0
                                 ? whole / detail::power_of_ten[static_cast<std::size_t>(-exponent)]
                                 : whole * detail::power_of_ten[static_cast<std::size_t>(exponent)];
    value = negative ? -magnitude : magnitude;
    p = at;
    return ends_number(*at);
  }
  const char* stop = p;
  while (stop < end && !ends_number(*stop)) ++stop;
  if (!parse_number(p, stop, value)) return false;
  p = stop;
  return true;
}

/// The label at p, which moves behind it; false where there is none that fits in 32 bits.
inline bool label_here(const char*& p, std::int32_t& value) {
  const bool negative = *p == '-';
  p += negative;
  std::int64_t magnitude = 0;
  unsigned digit = 0;
  const char* const first = p;
  while ((digit = static_cast<unsigned char>(*p) - unsigned{'0'}) < 10 && p - first < 11) {
    magnitude = magnitude * 10 + digit;
    ++p;
  }
  if (p == first || magnitude > std::numeric_limits<std::int32_t>::max()) return false;
  value = static_cast<std::int32_t>(negative ? -magnitude : magnitude);
  return true;
}

/// Bytes of a file in a form fit for an error: at most 24, others than ascii as ?.
inline std::string printable(std::string_view text) {
  std::string out(text.substr(0, 24));
  for (auto& c : out)
    if (c < ' ' || c > '~') c = '?';
  return out;
}

}  // namespace bedscope::readers
