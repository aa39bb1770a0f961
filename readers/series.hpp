// SPDX-License-Identifier: BSD-3-Clause
// The snapshots of one simulation, in the order of their steps, read one at a time.
#pragma once

#include <memory>
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
  DumpIndex* index = nullptr;             ///< of all-in-one dumps looked at before
  std::vector<std::string> columns = {};  ///< names for dumps that store none
  /// Refuse dumps that store no names where `columns` is empty. Otherwise those of forms that never
  /// do (.bin) are opened, and can be looked at.
  bool names_needed = false;
};

/// A series of particle snapshots. Opening it looks at the headers only, and makes sure that the
/// last snapshot is whole; rows are read by read(). Constant after opening, and thread-safe.
class Series {
 public:
  /// A piece of a snapshot.
  struct Part {
    std::size_t file = 0;  ///< in files()
    Located where;
  };

  /// Opens a file, all particle dumps of a folder, or those that match a pattern
  /// (`post/dump*.vtk`). Companion files (bounding boxes, wall meshes, contacts) are known by their
  /// content and left out; the pieces of one snapshot are put together (one file per processor, or
  /// as a .pvtp, .pvtu, .pvd, .vtm or .series names them). Throws FileError, FormatError (a
  /// repeated step names both places), InputError (two forms).
  static Series open(const std::string& where, const SeriesOptions& options = {});

  /// Keeps every n-th snapshot, from the first on; n >= 1.
  void thin(std::size_t n);

  std::size_t size() const { return entries_.size(); }
  const Form& form() const { return *form_; }

  /// The step that the file stores or its name tells; where no one knows it (has_steps() is false)
  /// the running number in the order of the times.
  std::int64_t step(std::size_t i) const { return entries_[i].step; }
  bool has_steps() const { return has_steps_; }
  /// Stored by the form itself or by an index [s], else NaN.
  double time(std::size_t i) const { return entries_[i].time; }
  /// As declared, of all parts of snapshot i.
  std::int64_t particles(std::size_t i) const;
  /// The first part of snapshot i, and its file.
  const Located& located(std::size_t i) const { return entries_[i].parts.front().where; }
  const std::string& path(std::size_t i) const { return files_[entries_[i].parts.front().file]; }
  const std::vector<std::string>& files() const { return files_; }

  /// All pieces of snapshot i.
  const std::vector<Part>& pieces(std::size_t i) const { return entries_[i].parts; }

  /// Reads the columns asked for, part after part. `out.step` and `out.time` are the series' own.
  void read(std::size_t i, const Request& request, Snapshot& out, Scratch& scratch) const;

  /// Where particle `row` of snapshot i stands, for messages: "post/dump100: line 13".
  std::string place(std::size_t i, std::size_t row) const;

  /// Names of the columns as on disk, of the first snapshot; positions of VTK files not included.
  const std::vector<std::string>& columns() const { return columns_; }

  /// False: the dumps store no names and none were given; columns() are "column 1", ...
  bool named() const { return named_; }

  /// Names that a request can use: positions and components of vectors included.
  const std::vector<std::string>& parts() const { return parts_; }

  /// Things that a user should know, one line each: a cut last dump, steps out of order, two runs.
  const std::vector<std::string>& problems() const { return problems_; }
  /// How it was read, where nothing is wrong: an index whose times only count.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Files of the folder that are not particle dumps, with what they are.
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// The last file breaks off inside its last snapshot (a run killed, or still writing).
  bool cut() const { return cut_; }

 private:
  struct Entry {
    std::int64_t step = no_step;
    double time = unknown;
    bool step_inside = false;  // stored by the file
    std::vector<Part> parts;
  };

  void open_file(const std::string& path, const Form& form);
  void open_files(const std::string& where, std::vector<std::string> paths);
  void open_unit(const DumpUnit& unit);
  void join(const DumpUnit& unit, std::vector<FileScan> scans);
  void require_same_columns(const DumpUnit& unit, const std::vector<Part>& parts) const;
  void note_cut(const std::string& path, const FileScan& scan);
  void judge_name(const DumpUnit& unit, const Located& located);
  void name_columns(const std::string& path, FileScan& scan);
  void order();
  bool order_by_time();
  void take_one_of_repeated(bool by_time);
  void compare_snapshots();
  void read_more(const Entry& entry, const Request& request, Snapshot& out, Scratch& scratch) const;
  std::string origin(const Entry& entry) const;

  SeriesOptions options_;
  const Form* form_ = nullptr;
  std::vector<std::string> files_;
  std::vector<Entry> entries_;
  std::vector<std::string> columns_, parts_, problems_, notes_, left_out_;
  std::shared_ptr<const std::vector<std::string>> names_;  // of options_.columns
  std::size_t lone_pieces_ = 0;
  bool cut_ = false, has_steps_ = true, named_ = true, unused_names_ = false;
};

/// A sample of `count` things in a row: the places of at most so many, ascending, the first and the
/// last among them, the others evenly between.
std::vector<std::size_t> evenly_spread(std::size_t count, std::size_t at_most);

}  // namespace bedscope::readers
