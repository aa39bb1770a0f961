// SPDX-License-Identifier: BSD-3-Clause
// Which files of a folder are the dumps of one run, and which of them belong together: told by
// their content, grouped by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "readers/file_index.hpp"
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

/// Files that are read together: one dump with one snapshot or many; the pieces that processors
/// wrote, each with the same steps; or what an index calls one snapshot.
struct DumpUnit {
  std::vector<std::string> files;
  NameParts name;                    ///< of the dump, or of what the index names
  std::vector<IndexedFile> indexed;  ///< where an index names the files; else empty
  std::vector<std::int64_t> pieces;  ///< numbers of the processors; else empty
  std::string of_index;              ///< the path of what an index calls a snapshot; else empty
  double time = unknown;             ///< [s], of the index
  std::optional<std::int64_t> step_of_name;
  bool last = false;  ///< of the highest step: the one that a killed run leaves cut
};

/// Units whose names differ in their numbers only.
struct DumpGroup {
  const Form* form = nullptr;
  std::vector<DumpUnit> units;
};

struct DumpFolder {
  const Form* form = nullptr;
  std::vector<DumpUnit> units;              ///< by stem and name
  std::vector<std::string> left_out;        ///< companions and strangers, with what they are
  std::vector<std::string> unfinished;      ///< later than the last dump and not yet readable
  std::vector<std::string> problems;        ///< worth a warning
  std::vector<std::string> notes;           ///< worth knowing
  std::vector<std::string> columns, parts;  ///< of the first dump: see Located
};

/// Sorts out the files of `where` (a folder, a pattern or an index). Of each group of names one is
/// looked at thoroughly; the others prove what they are when they are read. Throws FileError (no
/// dumps), InputError (dumps of two forms), FormatError (a file in the middle of the series that is
/// no dump; an index that cannot be used).
DumpFolder sort_out(const std::string& where, std::vector<std::string> paths);

/// Puts the files of a group that are pieces of one snapshot into one unit each
/// (dump1000.liggghts_0, dump1000.liggghts_1; split1000_0.bin; p0.1000.dump): names that differ in
/// one number only, the last where it can be, counted from 0, the same steps inside, no particle id
/// in two of them. Says which pieces are missing.
void join_pieces(DumpGroup& group, DumpFolder& found);

}  // namespace bedscope::readers
