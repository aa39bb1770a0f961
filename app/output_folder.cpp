// SPDX-License-Identifier: BSD-3-Clause
#include "app/output_folder.hpp"

#include <utility>

#include "readers/error.hpp"

namespace bedscope::app {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw FileError("{}: {}", path.string(), error.message());
}

/// The topmost folder that has to be made for `path`; empty where it is there.
fs::path first_missing(fs::path path) {
  std::error_code ignored;
  fs::path missing;
  for (; !path.empty() && !fs::exists(path, ignored); path = path.parent_path()) missing = path;
  return missing;
}

/// Files in `folder` (none where it is not there), relative to `root`.
void list_files(const fs::path& root, const fs::path& folder, std::vector<fs::path>& files) {
  std::error_code error;
  for (fs::directory_iterator item(folder, error), end; !error && item != end;
       item.increment(error))
    if (std::error_code ignored; item->is_regular_file(ignored))
      files.push_back(item->path().lexically_relative(root));
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder)
    : folder_(std::move(folder)), part_(folder_ / ".part"), made_(first_missing(folder_)) {
  std::error_code error;
  fs::remove_all(part_, error);  // of a program that was killed
  fs::create_directories(part_, error);
  if (error) fail(folder_, error);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  for (auto folder = folder_; !made_.empty() && fs::is_empty(folder, ignored) && !ignored;
       folder = folder.parent_path()) {
    fs::remove(folder, ignored);
    if (folder == made_) break;
  }
}

void OutputFolder::show_earlier() {
  earlier_.clear();
  for (const auto* name : {"tables", "figures", "checks"})
    list_files(folder_, folder_ / name, earlier_);
  list_files(folder_, folder_, earlier_);
  std::erase_if(earlier_, [](const fs::path& file) {
    return !file.has_parent_path() && !file.filename().string().starts_with("results");
  });
  std::error_code ignored;  // without links an outdated table may stay
  for (const auto& file : earlier_) {
    fs::create_directories((part_ / file).parent_path(), ignored);
    fs::create_hard_link(folder_ / file, part_ / file, ignored);
  }
  std::erase_if(earlier_, [&](const fs::path& file) {
    std::error_code none;
    return !fs::exists(part_ / file, none);
  });
}

void OutputFolder::commit() {
  std::error_code error;
  for (const auto& file : earlier_)
    if (!fs::exists(part_ / file, error)) fs::remove(folder_ / file, error);
  std::vector<fs::path> files;
  for (const auto& item : fs::recursive_directory_iterator(part_))
    if (item.is_regular_file()) files.push_back(item.path().lexically_relative(part_));
  for (const auto& file : files) {
    if (std::error_code ignored; fs::equivalent(part_ / file, folder_ / file, ignored)) {
      fs::remove(part_ / file, ignored);  // as it was
      continue;
    }
    fs::create_directories((folder_ / file).parent_path(), error);
    if (!error) fs::rename(part_ / file, folder_ / file, error);
    if (error) fail(folder_ / file, error);
  }
  earlier_.clear();
}

}  // namespace bedscope::app
