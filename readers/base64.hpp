// SPDX-License-Identifier: BSD-3-Clause
// Base64 (RFC 4648, section 4) read forward in pieces. Internal to this room.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace bedscope::readers {

/// The bytes that a base64 text stands for. "=" ends a stream; what follows begins another one, as
/// VTK writes them (block header and blocks). Blanks between the characters are passed over.
class Base64Reader {
 public:
  explicit Base64Reader(std::string_view text) : text_(text) {}

  /// Decodes `count` bytes; fewer where the text ends before, or at a byte that is not base64.
  std::size_t read(char* into, std::size_t count);

  /// An upper bound of the bytes that are left.
  std::size_t left() const { return (text_.size() - next_) / 4 * 3 + kept_; }

  /// Whether read() met a byte that is not base64, and its offset in the text.
  bool damaged() const { return damaged_; }
  std::size_t position() const { return next_; }

 private:
  bool read_group();

  std::string_view text_;
  std::size_t next_ = 0;
  std::array<char, 3> group_{};  ///< the last group; its first bytes may have been given out
  std::size_t kept_ = 0;         ///< bytes of it still to be given out
  std::size_t group_size_ = 0;
  bool damaged_ = false;
};

namespace base64 {

inline constexpr std::uint32_t bad = 0x80000000;

// One table for each place in a group of four, so that a group is four look-ups and three ORs. The
// bytes stand in memory order of a little-endian number.
using Tables = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr Tables make_tables() {
  Tables tables{};
  for (auto& table : tables) table.fill(bad);
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::uint32_t value = 0; value < 64; ++value) {
    const auto c = static_cast<unsigned char>(alphabet[value]);
    for (std::uint32_t place = 0; place < 4; ++place) {
      const std::uint32_t bits = value << (18 - 6 * place);  // byte 0 in bits 16..23
      tables[place][c] = bits >> 16 | (bits & 0xFF00) | (bits & 0xFF) << 16;
    }
  }
  return tables;
}

inline constexpr Tables tables = make_tables();

inline std::uint32_t group(const unsigned char* four) {
  return tables[0][four[0]] | tables[1][four[1]] | tables[2][four[2]] | tables[3][four[3]];
}

/// Decodes whole blocks of 32 characters, until one holds something else than the alphabet or fewer
/// than 32 bytes of room are left (of which it writes 24). Returns how many characters it used; 0
/// on processors without AVX2.
std::size_t decode_blocks(const unsigned char* from, std::size_t chars, char* into,
                          std::size_t room);

inline void store(char* into, std::uint32_t value) {
  into[0] = static_cast<char>(value);
  into[1] = static_cast<char>(value >> 8);
  into[2] = static_cast<char>(value >> 16);
}

}  // namespace base64

inline std::size_t Base64Reader::read(char* into, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    if (kept_ > 0) {
      into[done++] = group_[group_size_ - kept_--];
      continue;
    }
    const auto* const text = reinterpret_cast<const unsigned char*>(text_.data());
    if (count - done >= 32) {
      const auto used =
          base64::decode_blocks(text + next_, text_.size() - next_, into + done, count - done);
      next_ += used;
      done += used / 4 * 3;
    }
    while (count - done >= 3 && text_.size() - next_ >= 4) {
      const std::uint32_t value = base64::group(text + next_);
      if (value & base64::bad) break;  // blanks, "=" or damage
      base64::store(into + done, value);
      done += 3;
      next_ += 4;
    }
    if (done < count && !read_group()) break;
  }
  return done;
}

/// The careful way: one group of four characters, blanks and "=" allowed.
inline bool Base64Reader::read_group() {
  std::array<unsigned char, 4> four{};
  std::size_t found = 0, padding = 0;
  for (; found < 4; ++next_) {
    if (next_ == text_.size()) return false;
    const char c = text_[next_];
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const bool is_padding = c == '=';
    if (is_padding ? found < 2 : padding > 0) break;
    padding += is_padding ? 1U : 0U;
    four[found] = is_padding ? 'A' : static_cast<unsigned char>(c);
    if (base64::tables[0][four[found]] & base64::bad) break;
    ++found;
  }
  if (found < 4) {
    damaged_ = true;
    return false;
  }
  base64::store(group_.data(), base64::group(four.data()));
  kept_ = group_size_ = 3 - padding;
  return true;
}

}  // namespace bedscope::readers
