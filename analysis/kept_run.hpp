// SPDX-License-Identifier: BSD-3-Clause
// What the analysis of a run keeps for its next look at the series, in memory or on disk, so that
// only new snapshots are read, and when it may: where the next look equals a fresh analysis to the
// bit.
//
// A new product is kept with RunSums::archive (its sums over snapshots) and `archive` beside its
// struct in SnapshotProduct; a setting that it depends on belongs to fingerprint_of().
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/run_sums.hpp"
#include "readers/file_mark.hpp"

namespace bedscope::analysis {

/// The dumps of a series as they were when they were read.
struct SeriesMark {
  struct Piece {
    std::size_t file = 0;  ///< in `files`
    std::uint64_t offset = 0, bytes = 0;

    template <class Archive>
    void archive(Archive& ar) {
      ar(file, offset, bytes);
    }
  };
  struct Snapshot {
    std::int64_t step = 0;
    double time = 0;  ///< as RunSetup has it
    std::vector<Piece> pieces;

    template <class Archive>
    void archive(Archive& ar) {
      ar(step, time, pieces);
    }
  };
  std::vector<readers::FileMark> files;
  std::vector<Snapshot> snapshots;

  template <class Archive>
  void archive(Archive& ar) {
    ar(files, snapshots);
  }
};

/// To be taken before rows are read: what changes later shows at the next look. Empty for forms
/// that are a folder as a whole, so that these are read anew at each look.
SeriesMark mark_of(const readers::Series& series, const RunSetup& setup);

/// How many snapshots at the start of the series are still what they were.
std::size_t unchanged(const SeriesMark& then, const SeriesMark& now);

/// All that sums depend on but dumps and weights: settings, grid, columns, and the program itself.
std::string fingerprint_of(const RunSetup& setup, bool pictures);

/// The sums of one pass over a series.
class Pass {
 public:
  /// As RunSums.
  Pass(const RunSetup& setup, bool keep_blocks, bool keep_contours)
      : setup_(&setup), keep_blocks_(keep_blocks), keep_contours_(keep_contours) {}

  void begin() {
    sums.emplace(*setup_, keep_blocks_, keep_contours_);
    last.reset();
    read_from = 0;
  }
  std::size_t snapshots() const { return sums ? sums->snapshots() : 0; }

  template <class Archive>
  void archive(Archive& ar) {
    bool any = sums.has_value();
    ar(any);
    if (Archive::loading && any) begin();
    if (any) ar(*sums, last);
    if (Archive::loading) read_from = snapshots() + (last ? 1 : 0);
  }

  std::optional<RunSums> sums;          ///< of the snapshots whose weights are final: not the last
  std::optional<SnapshotProduct> last;  ///< of the last one, whose weight a successor changes
  std::size_t read_from = 0;            ///< snapshots before were read by an earlier analysis

 private:
  const RunSetup* setup_;
  bool keep_blocks_, keep_contours_;
};

struct KeptRun {
  /// `automatic`: the window is chosen afterwards.
  KeptRun(const RunSetup& setup, bool automatic, bool pictures)
      : whole(setup, automatic, pictures), window(setup, false, pictures) {}

  std::string fingerprint;
  SeriesMark dumps;
  Pass whole;   ///< over the series, weighted by the window or, for `auto`, by all
  Pass window;  ///< over the window that `auto` chose, where snapshots are unevenly spaced
  std::vector<Frame> frames;
  bool changed = false;

  /// Forgets what does not fit the setup and the dumps of today, and says why it must begin anew;
  /// empty where it need not. `changed` tells whether any snapshot is not what it was.
  std::string adapt(std::string fingerprint_now, SeriesMark dumps_now);

  /// Throws FileError, or FormatError where the file is damaged or of another version; what is here
  /// is then worth nothing.
  void load(const std::filesystem::path& path);
  /// Returns the size of the file [bytes]. Throws FileError.
  std::uint64_t save(const std::filesystem::path& path);

 private:
  template <class Archive>
  void archive(Archive& ar) {
    ar(fingerprint, dumps, whole, window, frames);
  }
};

}  // namespace bedscope::analysis
