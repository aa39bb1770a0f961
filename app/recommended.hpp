// SPDX-License-Identifier: BSD-3-Clause
// A study with some of its keys changed, and everything else, comments too, as the user wrote it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/study.hpp"

namespace bedscope::app {

/// What a recommendation changes; what is absent stays as it is.
struct StudyChanges {
  std::optional<std::string> mapping;
  std::optional<std::int64_t> every;
  struct OfRun {
    std::vector<int> cells;  ///< lateral, up or lateral, depth, up; empty: as it is
    std::optional<std::array<double, 2>> average;  ///< from, to [s]
    double band = 0;                               ///< of the profiles, as it was [m]
  };
  std::vector<OfRun> runs;  ///< in the order of the study
};

/// The text of the study at `path` with these changes, for a file in `folder`: relative paths are
/// written anew for there. Throws FileError, InputError. A study may be written so that its keys
/// cannot be changed one by one: whoever asks reads the text again and compares.
std::string changed_study(const std::string& path, const StudyChanges& changes,
                          const std::filesystem::path& folder);

}  // namespace bedscope::app
