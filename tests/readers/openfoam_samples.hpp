// SPDX-License-Identifier: BSD-3-Clause
// Small OpenFOAM files made up in tests, the fixtures, and the developers' corpus.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers::samples {

inline const fs::path data = fs::path(BEDSCOPE_TEST_DATA) / "openfoam";
inline const fs::path shared = BEDSCOPE_SHARED;
inline bool corpus_there() { return fs::exists(shared / "corpus" / "expected_arrays.csv"); }

/// A folder of this test, gone with the object.
class Folder {
 public:
  Folder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::temp_directory_path() / fmt::format("bedscope_{}_{}", ::getpid(), test->name());
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name = {}) const { return (path_ / name).string(); }
  std::string write(const std::string& name, std::string_view content) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
    return path(name);
  }
  void copy(const fs::path& from, const std::string& to = {}) const {
    fs::create_directories((path_ / to).parent_path());
    fs::copy(from, path_ / to, fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(path_))
      fs::permissions(entry, fs::perms::owner_write, fs::perm_options::add);
  }

 private:
  fs::path path_;
};

inline std::string header(std::string_view class_name, std::string_view format = "ascii",
                          std::string_view more = "") {
  return fmt::format("FoamFile {{ version 2.0; format {}; class {}; {} object x; }}\n", format,
                     class_name, more);
}

}  // namespace bedscope::readers::samples
