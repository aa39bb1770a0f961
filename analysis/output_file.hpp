// SPDX-License-Identifier: BSD-3-Clause
// Results appear whole or not at all: written beside, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace bedscope::analysis {

/// Writes a file through "<path>.part" and a rename; makes the folder where it is missing.
/// Throws FileError naming path and reason; nothing half-written stays.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Removes a result of an earlier analysis, which would now be taken for one of this; there may be
/// none. Throws FileError.
void remove_file(const std::filesystem::path& path);

/// A name beside `path` to write to (for libraries that write files themselves), renamed by
/// commit(); removed again where commit() was not reached.
class OutputFile {
 public:
  /// Throws FileError where something stands there that is not a file.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& part() const { return part_; }
  /// Throws FileError where the file cannot be put in its place.
  void commit();

 private:
  std::filesystem::path path_, part_;
  bool done_ = false;
};

/// Writes the whole content to `output.part()`, for files that shall appear together. Throws
/// FileError naming the path and the reason.
void write_part(const OutputFile& output, std::string_view content);

}  // namespace bedscope::analysis
