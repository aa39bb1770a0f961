// SPDX-License-Identifier: BSD-3-Clause
// Names, numbers and their bytes in legacy VTK files.
#pragma once

#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "readers/processor.hpp"

namespace bedscope::readers::vtk_legacy_file {

/// Kinds of number in a legacy VTK file.
enum class Kind { integer, real };
struct Type {
  std::string_view name;
  int size;  // bytes in binary files
  Kind kind;
  bool is_signed;
};
// vtkIdType is written as 32-bit int, whatever its size in memory.
inline constexpr std::array types{
    Type{"char", 1, Kind::integer, true},
    Type{"signed_char", 1, Kind::integer, true},
    Type{"unsigned_char", 1, Kind::integer, false},
    Type{"short", 2, Kind::integer, true},
    Type{"unsigned_short", 2, Kind::integer, false},
    Type{"int", 4, Kind::integer, true},
    Type{"unsigned_int", 4, Kind::integer, false},
    Type{"long", 8, Kind::integer, true},
    Type{"unsigned_long", 8, Kind::integer, false},
    Type{"vtktypeint64", 8, Kind::integer, true},
    Type{"vtktypeuint64", 8, Kind::integer, false},
    Type{"vtkidtype", 4, Kind::integer, true},
    Type{"float", 4, Kind::real, true},
    Type{"double", 8, Kind::real, true},
};

inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (auto& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

inline std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (auto& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return upper;
}

/// "name%20with%20space": VTK encodes what would break the line of a name.
inline std::string decode_name(std::string_view encoded) {
  std::string name;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'                     ? c - '0'
           : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                    : -1;
  };
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    if (encoded[i] == '%' && i + 2 < encoded.size() && digit(encoded[i + 1]) >= 0 &&
        digit(encoded[i + 2]) >= 0) {
      name += static_cast<char>(16 * digit(encoded[i + 1]) + digit(encoded[i + 2]));
      i += 2;
    } else {
      name += encoded[i];
    }
  }
  return name;
}

template <class T>
T load_big_endian(const char* at) {
  using Bits = std::conditional_t<
      sizeof(T) == 8, std::uint64_t,
      std::conditional_t<sizeof(T) == 4, std::uint32_t,
                         std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
  Bits bits = 0;
  std::memcpy(&bits, at, sizeof(T));
  if constexpr (std::endian::native == std::endian::little) {
    if constexpr (sizeof(T) == 8) bits = __builtin_bswap64(bits);
    if constexpr (sizeof(T) == 4) bits = __builtin_bswap32(bits);
    if constexpr (sizeof(T) == 2) bits = __builtin_bswap16(bits);
  }
  return std::bit_cast<T>(bits);
}

template <class T>
void decode(const char* from, std::size_t tuples, std::size_t components, std::size_t component,
            double* to) {
  from += component * sizeof(T);
  for (std::size_t i = 0; i < tuples; ++i)
    to[i] = static_cast<double>(load_big_endian<T>(from + i * components * sizeof(T)));
}

/// Component `component` of big-endian tuples as doubles.
[[gnu::flatten]] BEDSCOPE_FOR_EACH_PROCESSOR inline void decode(const Type& type, const char* from,
                                                                std::size_t tuples,
                                                                std::size_t components,
                                                                std::size_t component, double* to) {
  const auto with = [&](auto zero) {
    decode<decltype(zero)>(from, tuples, components, component, to);
  };
  if (type.kind == Kind::real) return type.size == 4 ? with(float{}) : with(double{});
  switch (type.size) {
    case 1:
      return type.is_signed ? with(std::int8_t{}) : with(std::uint8_t{});
    case 2:
      return type.is_signed ? with(std::int16_t{}) : with(std::uint16_t{});
    case 4:
      return type.is_signed ? with(std::int32_t{}) : with(std::uint32_t{});
    default:
      return type.is_signed ? with(std::int64_t{}) : with(std::uint64_t{});
  }
}

}  // namespace bedscope::readers::vtk_legacy_file
