// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of bedscope: each file adds one to the command line. They orchestrate and compute
// nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include <string>
#include <vector>

namespace bedscope::app {

inline constexpr int done = 0, does_not_hold = 1, bad_input = 2, internal_error = 3;

/// Options that every command takes.
struct Common {
  int threads = 0;     ///< 0: all cores
  bool quiet = false;  ///< no progress, no advice
  bool json = false;
};

/// Runs `program`: its exit code, or that of what it throws, with one line on stderr.
int exit_code_of(const std::function<int()>& program);

void add_common(CLI::App& command, Common& common);
void add_analyse(CLI::App& app);
void add_case(CLI::App& app);
void add_curves(CLI::App& app);
void add_digitise(CLI::App& app);
void add_info(CLI::App& app);
void add_tradeoff(CLI::App& app);
void add_validate(CLI::App& app, int& exit_code);

/// The curves that come with bedscope: installed beside the program, or in its source tree.
std::string curves_folder();

}  // namespace bedscope::app
