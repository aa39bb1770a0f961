// SPDX-License-Identifier: BSD-3-Clause
// The snapshots of one simulation, in the order of their steps, read one at a time.
#pragma once

#include <string>
#include <vector>

#include "readers/dump_folder.hpp"
#include "readers/dump_index.hpp"
#include "readers/forms.hpp"

namespace bedscope::readers {

/// What to do with a step that occurs twice (after a restart): refuse, or take one of them.
enum class Repeated { refuse, first, last };

struct SeriesOptions {
  Repeated repeated = Repeated::refuse;
  DumpIndex* index = nullptr;  ///< of all-in-one dumps looked at before
};

/// A series of particle snapshots. Opening it looks at the headers only, and makes sure that the
/// last snapshot is whole; rows are read by read(). Constant after opening, and thread-safe.
class Series {
 public:
  /// Opens a file, all particle dumps of a folder, or those that match a pattern
  /// (`post/dump*.vtk`). Companion files (bounding boxes, wall meshes, contacts) are known by their
  /// content and left out. Throws FileError, FormatError (a repeated step names both places),
  /// InputError (two forms).
  static Series open(const std::string& where, const SeriesOptions& options = {});

  std::size_t size() const { return entries_.size(); }
  const Form& form() const { return *form_; }

  std::int64_t step(std::size_t i) const { return entries_[i].step; }
  /// Stored by the form itself [s], else NaN.
  double time(std::size_t i) const { return entries_[i].where.time; }
  const Located& located(std::size_t i) const { return entries_[i].where; }
  const std::string& path(std::size_t i) const { return files_[entries_[i].file]; }
  const std::vector<std::string>& files() const { return files_; }

  /// Reads the columns asked for. `out.step` is the step of the series.
  void read(std::size_t i, const Request& request, Snapshot& out, Scratch& scratch) const;

  /// Where particle `row` of snapshot i stands, for messages: "post/dump100: line 13".
  std::string place(std::size_t i, std::size_t row) const;

  /// Names of the columns as on disk, of the first snapshot; positions of VTK files not included.
  const std::vector<std::string>& columns() const { return columns_; }

  /// Names that a request can use: positions and components of vectors included.
  const std::vector<std::string>& parts() const { return parts_; }

  /// Things that a user should know, one line each: a cut last dump, steps out of order, two runs.
  const std::vector<std::string>& problems() const { return problems_; }
  /// Files of the folder that are not particle dumps, with what they are.
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// The last file breaks off inside its last snapshot (a run killed, or still writing).
  bool cut() const { return cut_; }

 private:
  struct Entry {
    std::int64_t step = 0;
    std::size_t file = 0;
    Located where;
  };

  void open_file(const std::string& path, const Form& form, DumpIndex* index);
  void open_files(const std::string& where, std::vector<std::string> paths, DumpIndex* index);
  void add(const std::string& path, FileScan scan, std::int64_t step_of_name);
  void note_cut(const std::string& path, const FileScan& scan);
  void judge_name(const DumpFile& file, const Located& located);
  void order(const SeriesOptions& options);
  void compare_snapshots();

  const Form* form_ = nullptr;
  std::vector<std::string> files_;
  std::vector<Entry> entries_;
  std::vector<std::string> columns_, parts_, problems_, left_out_;
  bool cut_ = false;
};

}  // namespace bedscope::readers
