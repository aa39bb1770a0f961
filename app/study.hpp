// SPDX-License-Identifier: BSD-3-Clause
// The study file (TOML): which runs, and what is asked of them. docs/study.md lists every key.
#pragma once

#include <string>
#include <vector>

#include "analysis/settings.hpp"
#include "validation/check.hpp"

namespace bedscope::app {

/// The keys of [tradeoff].
struct TradeoffWishes {
  double tolerance = 0.01;            ///< relative error that is accepted
  std::vector<std::string> products;  ///< for which; empty: for all
  std::size_t line = 0;               ///< of `products` in the study
};

/// One [[run]] with the scene's keys put in where it does not say otherwise.
struct StudyRun {
  analysis::RunSettings settings;
  std::string tables;  ///< a folder of tables instead of dumps; else empty
};

struct Study {
  std::string title;
  std::vector<StudyRun> runs;
  std::vector<validation::Check> checks;
  TradeoffWishes tradeoff;
  std::vector<std::string> curves;  ///< folders of curves of the user's own
};

/// Reads a study file. Paths in it are relative to its folder. Throws FileError, or InputError with
/// file, line, key, what was expected and what was found; an unknown key names the nearest known
/// one.
Study read_study(const std::string& path);

/// The study that stands for a bare path: everything by default, unknown things said so.
Study study_of_path(const std::string& path);

/// Of either: what ends in .toml is a study file.
Study study_of(const std::string& input);

}  // namespace bedscope::app
