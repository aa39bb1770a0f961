// SPDX-License-Identifier: BSD-3-Clause
// Numbers in text, as simulation codes print them. The whole token must be a number: "3.0D-03" and
// "0x1p-8" are refused, which strtod would read as something else.
#pragma once

#include <fast_float/fast_float.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace bedscope::readers {

namespace detail {
inline constexpr std::array<double, 23> power_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

inline bool parse_any(const char* begin, const char* end, double& value) {
  const bool plus = begin != end && *begin == '+';
  begin += plus;
  if (begin == end || *begin == '+' || (plus && *begin == '-')) return false;
  const auto [rest, error] = fast_float::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) return rest == end;  // 0 or infinity, rounded
  const std::string_view tail(rest,
                              error == std::errc() ? static_cast<std::size_t>(end - rest) : 0);
  if (!tail.starts_with("#")) return error == std::errc() && rest == end;
  value = tail.starts_with("#INF") ? std::copysign(std::numeric_limits<double>::infinity(), value)
                                   : std::numeric_limits<double>::quiet_NaN();
  return tail.starts_with("#INF") || tail.starts_with("#IND") || tail.starts_with("#QNAN");
}
}  // namespace detail

/// The double nearest to the decimal number in [begin, end); false where that is not a number.
/// "1.#INF", "-1.#IND" and "1.#QNAN" are what older programs for Windows print for inf and nan.
/// Short decimals (%g prints six digits) take a path that is exact by Clinger (1990): both the
/// digits and the power of ten are doubles, so one rounding is left. Everything else goes to
/// fast_float.
inline bool parse_number(const char* begin, const char* end, double& value) {
  const char* at = begin;
  const bool negative = at != end && *at == '-';
  at += negative;
  std::uint64_t digits = 0;
  const char* const first = at;
  unsigned digit = 0;
  while (at != end && (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10) {
    digits = digits * 10 + digit;
    ++at;
  }
  std::int64_t exponent = 0;
  auto count = at - first;
  if (at != end && *at == '.') {
    const char* const point = ++at;
    while (at != end && (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10) {
      digits = digits * 10 + digit;
      ++at;
    }
    exponent = point - at;
    count += at - point;
  }
  if (count == 0 || count > 19) return detail::parse_any(begin, end, value);
  if (at != end) {
    if ((*at | 0x20) != 'e' || end - at < 2 || end - at > 5)
      return detail::parse_any(begin, end, value);
    ++at;
    const bool minus = *at == '-';
    if (minus || *at == '+') ++at;
    if (at == end) return false;
    int power = 0;
    for (; at != end; ++at) {
      digit = static_cast<unsigned char>(*at) - unsigned{'0'};
      if (digit > 9) return false;
      power = power * 10 + static_cast<int>(digit);
    }
    exponent += minus ? -power : power;
  }
  if (digits > (1ULL << 53) || exponent < -22 || exponent > 22)
    return detail::parse_any(begin, end, value);
  const auto whole = static_cast<double>(digits);
  const double magnitude = exponent < 0
                               ? whole / detail::power_of_ten[static_cast<std::size_t>(-exponent)]
                               : whole * detail::power_of_ten[static_cast<std::size_t>(exponent)];
  value = negative ? -magnitude : magnitude;
  return true;
}

/// An integer; false where the token is not one or does not fit in 64 bits (`overflow` tells
/// which).
inline bool parse_integer(std::string_view token, std::int64_t& value, bool& overflow) {
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  overflow = false;
  if (token.empty()) return false;
  std::uint64_t magnitude = 0;
  for (const char c : token) {
    const auto digit = static_cast<unsigned char>(c) - unsigned{'0'};
    if (digit > 9) return false;
    if (magnitude >
        (static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) - digit) / 10)
      overflow = true;
    magnitude = magnitude * 10 + digit;
  }
  if (overflow) return false;
  value = negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
  return true;
}

}  // namespace bedscope::readers
