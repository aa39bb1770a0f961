// SPDX-License-Identifier: BSD-3-Clause
// What the programs have in common: options, and how errors end them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "app/commands.hpp"
#include "readers/error.hpp"

namespace bedscope::app {

void add_common(CLI::App& command, Common& common) {
  command.add_option("--threads", common.threads, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 4096));
  command.add_flag("--quiet", common.quiet, "say nothing but errors");
  command.add_flag("--json", common.json, "print one JSON object");
}

int exit_code_of(const std::function<void()>& program) {
  try {
    program();
    return done;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "bedscope: {} (see bedscope --help)\n", error.what());
    return bad_input;
  } catch (const Error& error) {
    fmt::print(stderr, "bedscope: {}\n", error.what());
    return bad_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "bedscope: out of memory\n");
    return internal_error;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bedscope: internal error: {}\n", error.what());
    return internal_error;
  }
}

}  // namespace bedscope::app
