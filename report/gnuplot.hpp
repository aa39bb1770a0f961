// SPDX-License-Identifier: BSD-3-Clause
// Runs gnuplot. The only file that starts a process.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace bedscope::report {

/// Runs each driver script (a list of gnuplot commands) in a gnuplot process of its own, all at
/// once, with `folder` as the current one and without the user's start-up files.
/// Throws InputError where there is no gnuplot, naming the package, FileError with gnuplot's own
/// words where it fails.
void run_gnuplot(std::span<const std::string> drivers, const std::filesystem::path& folder);

}  // namespace bedscope::report
