// SPDX-License-Identifier: BSD-3-Clause
// A window that moves forward over a file: large reads into one re-used buffer, pieces of text that
// never straddle its edge.
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "readers/source.hpp"

namespace bedscope::readers {

class ByteWindow {
 public:
  /// Bytes behind end() that may be read (not used): lets the tokeniser load whole blocks.
  static constexpr std::size_t padding = 64;
  /// A piece that stays in the second-level cache between the kernel's copy and the parsing.
  static constexpr std::size_t piece = window_bytes(1U << 18);

  ByteWindow(Source& source, std::vector<char>& buffer, std::size_t size = piece)
      : source_(&source), buffer_(&buffer) {
    if (buffer.size() < size + padding) buffer.resize(size + padding);
    begin_ = end_ = buffer.data();
  }

  const char* begin() const { return begin_; }
  const char* end() const { return end_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  void drop_until(const char* at) { begin_ = at; }
  /// Offset in the (decompressed) file of a place in the window.
  std::uint64_t offset(const char* at) const {
    return source_->position() - static_cast<std::uint64_t>(end_ - at);
  }
  std::uint64_t offset() const { return offset(begin_); }

  /// Reads more behind end(), at most `most` bytes, moving the rest to the front; false at the end
  /// of the file. Pointers into the window are invalid afterwards.
  bool more(std::size_t most = piece) {
    const std::size_t rest = size();
    if (2 * rest + padding > buffer_->size()) {  // a long line: grow
      std::vector<char> larger(buffer_->size() * 2);
      std::memcpy(larger.data(), begin_, rest);
      buffer_->swap(larger);
    } else {
      std::memmove(buffer_->data(), begin_, rest);
    }
    begin_ = buffer_->data();
    const auto room = buffer_->size() - padding - rest;
    const auto got = source_->read({buffer_->data() + rest, std::min(room, most)});
    end_ = begin_ + rest + got;
    return got > 0;
  }

  /// Forgets what the window holds, after source.seek().
  void restart() { begin_ = end_ = buffer_->data(); }

  /// Makes sure that `count` bytes are in the window, unless the file ends before.
  bool ensure(std::size_t count) {
    while (size() < count)
      if (!more()) return false;
    return true;
  }

  /// The next line without its end (\n or \r\n), dropped from the window; nothing at the end of the
  /// file. Valid until the next call. `closed()` tells whether the line had an end.
  std::optional<std::string_view> line() {
    std::size_t seen = 0;
    const void* found = nullptr;
    while ((found = std::memchr(begin_ + seen, '\n', size() - seen)) == nullptr) {
      seen = size();
      if (!more()) break;
    }
    closed_ = found != nullptr;
    if (!closed_ && begin_ == end_) return std::nullopt;
    const char* stop = closed_ ? static_cast<const char*>(found) : end_;
    std::string_view text(begin_, static_cast<std::size_t>(stop - begin_));
    if (text.ends_with('\r')) text.remove_suffix(1);
    begin_ = closed_ ? stop + 1 : stop;
    return text;
  }
  bool closed() const { return closed_; }

 private:
  Source* source_;
  std::vector<char>* buffer_;
  const char* begin_;
  const char* end_;
  bool closed_ = true;
};

}  // namespace bedscope::readers
