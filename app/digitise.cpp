// SPDX-License-Identifier: BSD-3-Clause
// bedscope digitise: hands over to the program bedscope-digitise beside this one, so that no other
// command loads OpenCV's imgcodecs when it starts.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "readers/error.hpp"

namespace bedscope::app {
namespace {

[[noreturn]] void hand_over(std::vector<std::string> words) {
  const auto program =
      (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "bedscope-digitise")
          .string();
  words.insert(words.begin(), program);
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw FileError("{}: cannot be run: {}", program, std::strerror(errno));
}

}  // namespace

void add_digitise(CLI::App& app) {
  auto* command = app.add_subcommand("digitise", "a curve out of a picture of a plot");
  command->prefix_command();
  command->set_help_flag();  // the other program's
  command->callback([command] { hand_over(command->remaining()); });
}

}  // namespace bedscope::app
