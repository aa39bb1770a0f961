// SPDX-License-Identifier: BSD-3-Clause
// The analysis of one run from dumps to result: the only file that knows of threads.
#pragma once

#include <functional>
#include <memory>

#include "analysis/result.hpp"
#include "analysis/settings.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {

/// No snapshot lies in the averaging window: for a running simulation, not yet.
class EmptyWindow : public InputError {
 public:
  using InputError::InputError;
};

struct AnalysisOptions {
  int threads = 0;       ///< 0: all cores; the result does not depend on it, to the bit
  bool pictures = true;  ///< keep some snapshots whole for the strip of them, and cluster outlines
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// Reads every snapshot of the run once and reduces it to its result.
/// Throws FileError, FormatError, InputError.
RunResult analyse_run(const RunSettings& settings, const AnalysisOptions& options);

/// The same on a run that goes on: each call takes the snapshots that are new since the last one.
/// With a fixed start of the window nothing is read twice; results equal those of a fresh analysis.
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
