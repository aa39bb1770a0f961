// SPDX-License-Identifier: BSD-3-Clause
// What lists of values and lists of labels share: how they open, and their binary form.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "readers/openfoam_list.hpp"

namespace bedscope::readers::detail {

inline constexpr std::size_t piece_bytes =
    window_bytes(1U << 18);  // read, converted and checked in the cache

/// The opening of a list: how many values, and what follows.
struct Opening {
  enum class Form { empty, parenthesis, uniform, uncounted } form = Form::empty;
  std::uint64_t count = 0;
};

/// A token as length of a list. Throws for a negative one.
std::uint64_t claimed_count(FoamStream& stream, const FoamToken& token);

Opening read_opening(FoamStream& stream, const FoamLayout& layout);

/// Throws CutError where the file cannot hold `count` values of `bytes` (the least) each.
void check_claim(FoamStream& stream, std::uint64_t count, std::uint64_t bytes,
                 std::string_view type, bool binary);

void check_expected(FoamStream& stream, std::uint64_t count, std::optional<FoamCount> expected);

/// The parenthesis behind the bytes of a binary list; proves their number.
void close_binary(FoamStream& stream, const FoamLayout& layout, std::uint64_t bytes);

// Room for `more` further numbers of `total`: at once where the file can surely hold them, else
// as they come (a gzip file claims what it likes).
template <class T>
void make_room(std::vector<T>& out, const FoamStream& stream, std::uint64_t total) {
  if (!stream.compressed()) out.reserve(static_cast<std::size_t>(total));
}

template <class T>
T swapped(T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

// `count` numbers of the type File on disk, in pieces of whole values: room(n) gives where the next
// n go, take(n) is told when they are there.
template <class File, class T, class Room, class Take>
void read_binary(FoamStream& stream, const FoamLayout& layout, std::uint64_t count,
                 std::size_t components, Room&& room, Take&& take) {
  std::vector<File> piece;
  const std::size_t step = piece_bytes / sizeof(File) / components * components;
  const bool swap = layout.big_endian != (std::endian::native == std::endian::big);
  while (count > 0) {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, step));
    T* const into = room(now);
    std::size_t got = 0;
    if constexpr (std::is_same_v<File, T>) {
      got = stream.read({reinterpret_cast<char*>(into), now * sizeof(T)});
      if (swap) std::transform(into, into + now, into, swapped<T>);
    } else {
      piece.resize(now);
      got = stream.read({reinterpret_cast<char*>(piece.data()), now * sizeof(File)});
      for (std::size_t i = 0; i < now; ++i) {
        const File value = swap ? swapped(piece[i]) : piece[i];
        into[i] = static_cast<T>(value);
        if constexpr (std::is_integral_v<T>)
          if (into[i] != value) stream.fail_binary("label {} does not fit in 32 bits", value);
      }
    }
    if (got < now * sizeof(File))
      stream.fail_cut("the file ends inside a binary list, {} numbers before its end",
                      count - got / sizeof(File));
    take(now);
    count -= now;
  }
}

}  // namespace bedscope::readers::detail
