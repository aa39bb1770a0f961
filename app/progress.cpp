// SPDX-License-Identifier: BSD-3-Clause
#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

namespace bedscope::app {

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), shown_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(std::size_t done, std::size_t all) {
  if (!shown_ || all == 0) return;
  constexpr auto interval = std::chrono::milliseconds(100);
  const auto now = std::chrono::steady_clock::now();
  if (done < all && now - last_ < interval) return;
  last_ = now;
  drawn_ = true;
  constexpr std::size_t width = 30;
  const std::size_t filled = width * done / all;
  fmt::print(stderr, "\r\033[K{} [{:#<{}}{: <{}}] {}/{} snapshots", label_, "", filled, "",
             width - filled, done, all);
}

}  // namespace bedscope::app
