// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of bedscope: each file adds one to the command line. They orchestrate and compute
// nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace bedscope::app {

inline constexpr int done = 0, bad_input = 2, internal_error = 3;

/// Options that every command takes.
struct Common {
  int threads = 0;     ///< 0: all cores
  bool quiet = false;  ///< no progress, no advice
  bool json = false;
};

/// Runs `program`: its exit code, with one line on stderr where it throws.
int exit_code_of(const std::function<void()>& program);

void add_common(CLI::App& command, Common& common);
void add_analyse(CLI::App& app);
void add_digitise(CLI::App& app);
void add_info(CLI::App& app);

}  // namespace bedscope::app
