// SPDX-License-Identifier: BSD-3-Clause
// The folder of the results: what an analysis writes appears in it together, or not at all.
#pragma once

#include <filesystem>
#include <vector>

namespace bedscope::app {

/// Files are made in a folder of their own inside, `.part`, and moved when all of them are whole: a
/// full disk or a killed program leaves the earlier results as they were. What is in the folder
/// beside the results is not touched.
class OutputFolder {
 public:
  /// Makes the folder, so that one that cannot be written shows before the work. Throws FileError.
  explicit OutputFolder(std::filesystem::path folder);
  /// Removes what was not committed, and the folder where it was not there before and is empty.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write.
  const std::filesystem::path& part() const { return part_; }

  /// Shows the earlier results in part(), for writers that remove what is out of date.
  void show_earlier();

  /// Moves all files of part() to their place, and removes earlier results that were removed there.
  /// Throws FileError.
  void commit();

 private:
  std::filesystem::path folder_, part_;
  std::filesystem::path made_;                  // the first folder that was not there; or empty
  std::vector<std::filesystem::path> earlier_;  // relative
};

}  // namespace bedscope::app
