// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands.hpp"
namespace bedscope::app {
void add_analyse(CLI::App&) {}
}  // namespace bedscope::app
