// SPDX-License-Identifier: BSD-3-Clause
// Where the snapshots of an all-in-one dump begin, kept from one look to the next, so that a file
// of 100 GB is opened at once.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "readers/file_mark.hpp"
#include "readers/forms.hpp"

namespace bedscope::readers {

/// What scan() found, in memory and, where folders are given, on disk: a small file for each dump
/// that holds several snapshots (some 100 bytes a snapshot), named after it.
///
/// An unchanged dump (FileMark) is not looked into again; one that has grown is scanned from its
/// last known snapshot on; any other is scanned anew. An index that is damaged, of another version
/// or of another dump counts as none. gzip files have no index: entering one needs the state of
/// its decompression, 32 kB and more a snapshot, and finding it anew costs what reading costs.
class DumpIndex {
 public:
  DumpIndex() = default;
  /// `from`: the folder of earlier indices, need not exist. `to`: where save() writes. Either may
  /// be empty.
  DumpIndex(std::filesystem::path from, std::filesystem::path to)
      : from_(std::move(from)), to_(std::move(to)) {}

  /// As form.scan(path, thorough), with the same result.
  FileScan scan(const Form& form, const std::string& path, bool thorough);

  /// Writes the indices that are new or have changed. Throws FileError.
  void save();

 private:
  struct Known {
    std::string form;  ///< its name
    FileMark mark;
    FileScan found;
    bool saved = false;
  };
  void load(const Form& form, const FileMark& mark);

  std::filesystem::path from_, to_;
  std::map<std::string, Known> known_;  // by absolute path
};

}  // namespace bedscope::readers
