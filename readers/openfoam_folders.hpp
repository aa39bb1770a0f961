// SPDX-License-Identifier: BSD-3-Clause
// The folders of a case: where its ranks lie, which of their directories are times.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_case.hpp"

namespace bedscope::readers {

/// A folder with constant/ and times, of one rank (or the whole case) or of several collated ones.
struct FoamFolder {
  std::string path;
  std::size_t first_rank = 0;
  std::size_t ranks = 1;  ///< 0: not said by the name (`processors`)
  bool collated = false;
};

/// The folders to read, by ascending rank. Throws InputError where the options do not decide, and
/// FormatError where a rank is missing.
std::vector<FoamFolder> find_folders(const std::string& root, Decomposition wanted);

struct FoamTimeName {
  std::string name;
  double value;
};
/// The directories in a folder whose names are numbers, ascending.
/// Throws FormatError for two names of one time.
std::vector<FoamTimeName> time_directories(const std::string& folder);

/// The time by `<directory>/uniform/time`; the name's value where that file is absent or is of
/// another time (then with a problem).
double true_time(const std::string& directory, const FoamTimeName& name,
                 std::vector<std::string>& problems);

/// The path of a file, plain or .gz; empty where there is none.
std::string plain_or_gz(const std::string& path);

}  // namespace bedscope::readers
