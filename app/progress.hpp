// SPDX-License-Identifier: BSD-3-Clause
// A progress bar on the terminal, and nowhere else.
#pragma once

#include <chrono>
#include <string>

namespace bedscope::app {

class Progress {
 public:
  /// Silent unless stderr is a terminal.
  Progress(std::string label, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(std::size_t done, std::size_t all);

 private:
  std::string label_;
  bool shown_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace bedscope::app
