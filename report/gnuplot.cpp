// SPDX-License-Identifier: BSD-3-Clause
#include "report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "analysis/output_file.hpp"
#include "readers/error.hpp"

namespace bedscope::report {
namespace {

struct Process {
  pid_t id = 0;
  std::filesystem::path errors;  ///< where its stderr goes
};

/// Returns errno of the start, 0 where the process runs.
int start(const std::string& driver, const std::filesystem::path& folder, Process& process) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  // Seen from the new folder, as the driver is.
  const std::string errors = process.errors.filename().string();
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::string program = "gnuplot", defaults = "-d", script = driver;
  char* const arguments[] = {program.data(), defaults.data(), script.data(), nullptr};
  const int failed =
      posix_spawnp(&process.id, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed;
}

/// The last line that says something: gnuplot echoes the command first, then its complaint.
std::string complaint(const std::filesystem::path& errors) {
  std::ifstream file(errors);
  std::string line, last = "no reason given: is the disk full?";
  while (std::getline(file, line)) {
    if (line.find_first_not_of(" \t^") == std::string::npos) continue;
    if (line.find("warning:") == std::string::npos) last = line;
  }
  return last;
}

int wait_for(pid_t id) {
  int status = 0;
  while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

void run_gnuplot(std::span<const std::string> drivers, const std::filesystem::path& folder) {
  std::vector<Process> processes;
  int not_started = 0;
  for (std::size_t i = 0; i < drivers.size() && not_started == 0; ++i) {
    const std::string name = fmt::format("driver{}.gp", i);
    analysis::write_file(folder / name, drivers[i]);
    Process process{0, folder / fmt::format("driver{}.errors", i)};
    not_started = start(name, folder, process);
    if (not_started == 0) processes.push_back(process);
  }
  const Process* failed = nullptr;
  for (const Process& process : processes) {
    if (wait_for(process.id) != 0 && failed == nullptr) failed = &process;
  }
  if (not_started == ENOENT) {
    throw InputError(
        "gnuplot: expected the program for the figures, found none: install the package "
        "gnuplot-nox");
  }
  if (not_started != 0) throw FileError("gnuplot: {}", std::strerror(not_started));
  if (failed != nullptr)
    throw FileError("{}: gnuplot: {}", folder.string(), complaint(failed->errors));
}

}  // namespace bedscope::report
