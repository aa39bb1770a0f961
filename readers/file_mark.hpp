// SPDX-License-Identifier: BSD-3-Clause
// Whether a file is what it was: told by what the file system says of it and a few of its bytes.
#pragma once

#include <cstdint>
#include <string>

namespace bedscope::readers {

/// A file as it was when it was looked at.
struct FileMark {
  std::string path;  ///< absolute
  std::uint64_t size = 0;
  /// Last change of the content and of anything else [ns]: a program that sets the first one back
  /// shows in the second.
  std::int64_t modified = 0, changed = 0;
  std::uint64_t end = 0;               ///< up to here its bytes are known; 0: it may not grow
  std::uint32_t head = 0, before = 0;  ///< checksums of 4096 bytes at the start and before `end`

  bool operator==(const FileMark&) const = default;
};

template <class Archive>
void archive(Archive& ar, FileMark& mark) {
  auto& [path, size, modified, changed, end, head, before] = mark;
  ar(path, size, modified, changed, end, head, before);
}

/// The mark of a file, without a look into it. Throws FileError.
FileMark mark_of(const std::string& path);

/// Makes a mark one of a file that may grow: its bytes up to `end` were read. Not for gzip files,
/// whose mark stays as it is. Throws FileError.
void let_grow(FileMark& mark, std::uint64_t end);

enum class Change {
  none,
  grown,  ///< longer, with the same bytes at the start and before `end`
  other
};

/// What became of the file since `then`; `now` is its mark_of(). A change between the start and
/// `end` of a file that has grown as well goes unnoticed.
Change change_since(const FileMark& then, const FileMark& now);

}  // namespace bedscope::readers
