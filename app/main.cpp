// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
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

}  // namespace bedscope::app

namespace {

/// What was printed is complete only when it has left the program: into a pipe that is closed, or a
/// file on a full disk, it may not.
bool printed() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

int cannot_print() {
  fmt::print(stderr, "bedscope: standard output: {}\n", std::strerror(errno));
  return bedscope::app::bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace bedscope;
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error like a full disk
  try {
    CLI::App app(
        "Gas-solid fluidised beds and risers: what LIGGGHTS and OpenFOAM wrote, reduced to "
        "holdup, flux, profiles and clusters with their errors");
    app.name("bedscope");
    app.set_version_flag("--version", "bedscope " BEDSCOPE_VERSION);
    app.require_subcommand(1);
    int exit_code = app::done;
    app::add_info(app);
    app::add_analyse(app);
    app::add_validate(app, exit_code);
    app::add_curves(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
      return app.exit(asked);
    } catch (const CLI::ParseError& error) {
      fmt::print(stderr, "bedscope: {} (see bedscope --help)\n", error.what());
      return app::bad_input;
    }
    return printed() ? exit_code : cannot_print();
  } catch (const Error& error) {
    fmt::print(stderr, "bedscope: {}\n", error.what());
    return app::bad_input;
  } catch (const std::filesystem::filesystem_error& error) {  // the disk's, where nobody asked
    fmt::print(stderr, "bedscope: {}\n", one_line(error.what()));
    return app::bad_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "bedscope: out of memory\n");
    return app::internal_error;
  } catch (const std::exception& error) {
    if (!printed()) return cannot_print();
    fmt::print(stderr, "bedscope: internal error: {}\n", error.what());
    return app::internal_error;
  }
}
