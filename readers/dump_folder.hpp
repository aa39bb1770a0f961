// SPDX-License-Identifier: BSD-3-Clause
// Which files of a folder are the dumps of one run: told by their content, grouped by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "readers/forms.hpp"

namespace bedscope::readers {

/// The runs of digits of a file's name, and the name with stars in their place: files of one stem
/// are of one dump command.
struct NameParts {
  std::string stem;
  std::vector<std::string> numbers;
};
NameParts split_name(const std::string& path);

/// A run of digits as a step; nothing where it does not fit.
std::optional<std::int64_t> to_step(const std::string& digits);

struct DumpFile {
  std::string path;
  NameParts name;
  std::optional<std::int64_t> step_of_name;
  bool last = false;  ///< of the highest step: the one that a killed run leaves cut
};

struct DumpFolder {
  const Form* form = nullptr;
  std::vector<DumpFile> files;              ///< by stem and name
  std::vector<std::string> left_out;        ///< companions and strangers, with what they are
  std::vector<std::string> unfinished;      ///< later than the last dump and not yet readable
  std::vector<std::string> columns, parts;  ///< of the first dump: see Located
};

/// Sorts out the files of `where` (a folder, or a pattern). Of each group of names one file is
/// looked at thoroughly; the others prove what they are when they are read. Throws FileError (no
/// dumps), InputError (dumps of two forms), FormatError (a file in the middle of the series that is
/// no dump).
DumpFolder sort_out(const std::string& where, std::vector<std::string> paths);

}  // namespace bedscope::readers
