// SPDX-License-Identifier: BSD-3-Clause
// The analysis of one run from dumps to result.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "analysis/result.hpp"
#include "analysis/settings.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {

/// No snapshot lies in the averaging window: for a running simulation, not yet.
class EmptyWindow : public InputError {
 public:
  using InputError::InputError;
};

/// Where an analysis finds what an earlier one kept, and keeps what the next may need: the folder
/// `index` of all-in-one dumps and the file `state`. Any path may be empty. Results do not depend
/// on what is there.
struct KeepOptions {
  std::filesystem::path earlier_index, earlier_state;
  std::filesystem::path index, state;
};

struct AnalysisOptions {
  int threads = 0;       ///< 0: all cores; the result does not depend on it, to the bit
  bool pictures = true;  ///< keep some snapshots whole for the strip of them, and cluster outlines
  std::function<void(std::size_t done, std::size_t all)> progress;
  KeepOptions keep;
  /// Told in one line where an earlier analysis does not serve, or nothing could be kept.
  std::function<void(const std::string&)> note;
};

/// Reads every snapshot of the run once and reduces it to its result.
/// Throws FileError, FormatError, InputError.
RunResult analyse_run(const RunSettings& settings, const AnalysisOptions& options);

/// The same on a run that goes on: each call takes the snapshots that are new since the last one,
/// and nothing is read twice but the last snapshot of the last look, and a few for their pictures
/// (with `auto` and uneven spacing: all where the window moves). Results equal those of a fresh
/// analysis.
class LiveAnalysis {
 public:
  explicit LiveAnalysis(RunSettings settings, AnalysisOptions options);
  ~LiveAnalysis();
  LiveAnalysis(LiveAnalysis&&) noexcept;

  /// True where there are new whole snapshots; result() then holds the analysis with them.
  bool update();
  const RunResult& result() const;

 private:
  friend RunResult analyse_run(const RunSettings& settings, const AnalysisOptions& options);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bedscope::analysis
