// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "readers/error.hpp"

namespace bedscope::analysis {

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  std::error_code error;
  if (const auto status = std::filesystem::status(path_, error);
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw FileError("{}: not a regular file", path_.string());  // a rename would replace /dev/null
  error.clear();
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
  if (error) throw FileError("{}: {}", path_.parent_path().string(), error.message());
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!done_) std::filesystem::remove(part_, ignored);
}

void OutputFile::commit() {
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (error) throw FileError("{}: {}", path_.string(), error.message());
  done_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  OutputFile output(path);
  write_part(output, content);
  output.commit();
}

void write_part(const OutputFile& output, std::string_view content) {
  const auto fail = [&] {
    throw FileError("{}: {}", output.path().string(), std::strerror(errno));
  };
  std::FILE* file = std::fopen(output.part().c_str(), "wb");
  if (file == nullptr) fail();
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int reason = errno;
  const bool closed = std::fclose(file) == 0;  // a full disk may show only here
  if (!written) errno = reason;
  if (!written || !closed) fail();
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw FileError("{}: {}", path.string(), error.message());
}

}  // namespace bedscope::analysis
