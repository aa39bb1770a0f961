// SPDX-License-Identifier: BSD-3-Clause
// One row for each form of particle dump on disk. To add one: readers/<form>.cpp with a constant
// Form, its name in forms.cpp, the file in readers/CMakeLists.txt, a test in tests/readers.
// A form sees one file at a time. Files that belong together (pieces of processors, what a .pvd or
// .vtm names) are put together by Series, whatever their form; files that only name others are
// forms of index: readers/file_index.hpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/snapshot.hpp"

namespace bedscope::readers {

class Checkpoint;

/// One snapshot inside a file, found without parsing its rows.
struct Located {
  std::int64_t step = no_step;  ///< no_step where the form stores none (VTK: the file's name tells)
  double time = unknown;        ///< [s], where the form stores it
  std::int64_t particles = 0;   ///< as declared
  /// Copies of particles that another file of the snapshot owns (VTK's ghost points), counted in
  /// `particles`; Series sets `without_ghosts` and takes them off where there are other files.
  std::int64_t ghosts = 0;
  bool without_ghosts = false;
  std::uint64_t offset = 0;  ///< [bytes] of the decompressed file
  std::uint64_t bytes = 0;   ///< length of the snapshot, 0: to the end of the file
  std::uint64_t line = 0;    ///< in text, the number of its first line; 0: not known
  std::shared_ptr<const Checkpoint> checkpoint;  ///< where a gzip file can be entered near `offset`
  std::shared_ptr<const void>
      context;  ///< what scan() opened and read() needs again; the form's own
  Box box;
  std::shared_ptr<const std::vector<std::string>> columns;  ///< names as on disk
  /// False where the file names no columns: they are called "column 1", "column 2" ..., and Series
  /// puts the names that the user gives into `columns` and `parts`, where read() finds them.
  bool named = true;
  /// Names that a Request can use, positions and components of vectors included; null where only
  /// scan(thorough) knows them.
  std::shared_ptr<const std::vector<std::string>> parts;
};

/// What scan() found in one file.
struct FileScan {
  std::vector<Located> snapshots;  ///< in the order of the file; only complete ones if `thorough`
  std::string cut;                 ///< why the last snapshot is incomplete; empty if it is whole
  std::vector<std::string> problems;  ///< things worth a warning, with their place
  std::string not_particles;  ///< what it is instead ("a triangle mesh"); empty for particles
  std::string unnamed;        ///< place and reason of the first snapshot that names no columns
};

/// Buffers that a reader re-uses from snapshot to snapshot; one for each thread.
struct Scratch {
  std::vector<char> bytes;
  std::vector<std::vector<double>> raw;  ///< parsed columns, before finish_columns
  std::vector<std::string> names;  ///< columns of the snapshot before: a guess at the next one's
};

/// One form of particle dump. All functions are thread-safe and keep no file open.
struct Form {
  std::string_view name;         ///< as `bedscope info` prints it: "dump-text", "vtk-legacy"
  std::string_view description;  ///< one line for people
  std::string_view reference;    ///< where the form is documented

  /// Is it this form? `head` holds the first bytes of the (decompressed) file, at most 4096.
  bool (*matches)(std::string_view head) = nullptr;
  /// Forms that are a folder as a whole (an OpenFOAM case): is this one? null for forms of files.
  /// Also asked of names that are no folder on disk (a cloud of a case: CASE/kinematicCloud).
  bool (*matches_folder)(const std::string& folder) = nullptr;

  /// Finds the snapshots of a file. `thorough` also makes sure that the last one is complete;
  /// without it only what the headers say is looked at.
  /// Throws FileError, or FormatError where not one snapshot is complete.
  FileScan (*scan)(const std::string& path, bool thorough);
  /// Goes on with what scan() found in a file that has grown since: from the last snapshot in
  /// `known`, which may not have been its end. The result is that of a thorough scan(). Null where
  /// a file holds one snapshot only, or a scan costs next to nothing.
  FileScan (*extend)(const std::string& path, FileScan known) = nullptr;
  /// Does scan() without `thorough` tell particles from other things in this form?
  bool glance_tells = false;
  /// False where no file of the form names its columns: one can look at it all the same.
  bool names_columns = true;

  /// Reads the columns asked for, and no others, of the snapshot that scan() located.
  /// Throws FormatError (path, place, expected, found) on anything that is not as it should be.
  void (*read)(const std::string& path, const Located& where, const Request& request, Snapshot& out,
               Scratch& scratch);

  /// Where a particle stands, for messages ("line 13"); null: "point 4".
  std::string (*place)(const std::string& path, const Located& where, std::size_t row) = nullptr;
};

/// Every form that we read, in alphabetic order.
std::span<const Form* const> forms();

/// The form of a file, by its content. Throws FileError, or FormatError naming what the file is
/// where that can be told (git-lfs pointer, restart file, dump local ...).
const Form& identify(const std::string& path);
/// The same where the first bytes are known already; `head` as read_head() gives them.
const Form& identify(const std::string& path, std::string_view head);

}  // namespace bedscope::readers
