// SPDX-License-Identifier: BSD-3-Clause
// Files that hold no particles but name the files that do: .pvtp, .pvtu, .pvd, .vtm, .series. To
// add a form of index: a constant IndexForm in a file of its own, its name in file_index.cpp, the
// file in readers/CMakeLists.txt.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/snapshot.hpp"

namespace bedscope::readers {

/// A file as an index names it.
struct IndexEntry {
  std::string name;          ///< as it stands there, relative to the folder of the index
  double time = unknown;     ///< [s]
  std::string part;          ///< tells files of one time apart
  std::uint64_t offset = 0;  ///< where it stands in the text
};

struct IndexForm {
  std::string_view name;  ///< what it calls a file, for messages: "piece", "block", "file"
  /// True: all entries together are one snapshot, written with the index and below its folder.
  /// False: a list of snapshots; entries of one time are one.
  bool one_snapshot = false;
  /// Times 0, 1, 2, ... may be a running number that a writer without times put there.
  bool may_count = false;
  bool (*matches)(std::string_view head);
  /// `text` is the whole file. Where a list ends early its whole entries are given, and `cut`
  /// tells. Throws FormatError, CutError.
  std::vector<IndexEntry> (*read)(const std::string& path, std::string_view text, std::string& cut);
};

/// The form of index that begins like this; null for anything else.
const IndexForm* index_form(std::string_view head);

/// A file that holds particles (or is a block of something else), and where an index names it.
struct IndexedFile {
  std::string path;
  std::string index, label;  ///< "bed.pvtp", "piece bed_0.vtp"
  std::uint64_t offset = 0;  ///< in the index

  std::string place() const;  ///< "bed.pvtp: line 16: piece bed_0.vtp"
};

struct IndexedSnapshot {
  std::string name;                ///< the path whose numbers tell the step
  double time = unknown;           ///< [s]
  std::vector<IndexedFile> files;  ///< none: a snapshot without particles
};

/// What an index names, indices that it names in turn resolved.
struct FileIndex {
  std::vector<IndexedSnapshot> snapshots;
  std::vector<std::string> named;  ///< every path that it names, indices included
  std::vector<std::string> notes;  ///< worth knowing, nothing wrong
  std::string cut;                 ///< where the list ends early; empty where it does not
  std::string error;               ///< why it cannot be used; empty if it can
};

/// Reads an index and those that it names. Pieces and blocks have to lie below its folder; nothing
/// may name itself. What is wrong is told in `error`, so that `named` is known all the same.
FileIndex read_index(const std::string& path, const IndexForm& form);

}  // namespace bedscope::readers
