// SPDX-License-Identifier: BSD-3-Clause
// What the programs have in common: options, and how errors end them.
#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "app/commands.hpp"
#include "readers/error.hpp"

namespace bedscope::app {
namespace {

/// What was printed is complete only when it has left the program: into a pipe that is closed, or a
/// file on a full disk, it may not.
bool printed() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

int cannot_print(int error_number) {
  fmt::print(stderr, "bedscope: standard output: {}\n", std::strerror(error_number));
  return bad_input;
}

int say(const char* what, int exit_code) {
  fmt::print(stderr, "bedscope: {}\n", what);
  return exit_code;
}

int internal(const std::exception& error) {
  fmt::print(stderr, "bedscope: internal error: {}\n", one_line(error.what()));
  return internal_error;
}

}  // namespace

void add_common(CLI::App& command, Common& common) {
  command.add_option("--threads", common.threads, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 4096));
  command.add_flag("--quiet", common.quiet, "say nothing but errors");
  command.add_flag("--json", common.json, "print one JSON object");
}

int exit_code_of(const std::function<int()>& program) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error like a full disk
  try {
    const int code = program();
    return printed() ? code : cannot_print(errno);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "bedscope: {} (see bedscope --help)\n", one_line(error.what()));
    return bad_input;
  } catch (const Error& error) {
    return say(error.what(), bad_input);
  } catch (const std::filesystem::filesystem_error& error) {  // the disk's, where nobody asked
    return say(one_line(error.what()).c_str(), bad_input);
  } catch (const std::bad_alloc&) {
    return say("out of memory", internal_error);
  } catch (const std::system_error& error) {
    // fmt tells of a print that failed; by now errno is that of what was tidied up since.
    if (!printed()) return cannot_print(error.code().value());
    return internal(error);
  } catch (const std::exception& error) {
    return internal(error);
  }
}

}  // namespace bedscope::app
