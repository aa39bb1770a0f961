// SPDX-License-Identifier: GPL-3.0-or-later
// Wall clock of a run and its parts, and the CPU time (user and system).
#pragma once

#include <array>
#include <chrono>
#include <ctime>

namespace bedscope::coupled {

enum class Part { dem, mapping, drag, momentum, pressure, energy, inventory, output };
constexpr std::array part_names{"DEM",      "mapping", "drag",      "momentum",
                                "pressure", "energy",  "inventory", "output"};

class Timing {
 public:
  using Clock = std::chrono::steady_clock;
  /// Adds its life to a part.
  class Lap {
   public:
    Lap(Timing& timing, Part part) : timing_(timing), part_(part) {}
    ~Lap() { timing_.add(part_, std::chrono::duration<double>(Clock::now() - start_).count()); }
    Lap(const Lap&) = delete;

   private:
    Timing& timing_;
    Part part_;
    Clock::time_point start_ = Clock::now();
  };

  void add(Part part, double seconds) { seconds_[std::size_t(part)] += seconds; }
  double seconds(Part part) const { return seconds_[std::size_t(part)]; }
  double elapsed() const {  ///< since the start of the run [s]
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  static double cpu() { return double(std::clock()) / CLOCKS_PER_SEC; }  ///< of this process [s]

 private:
  Clock::time_point start_ = Clock::now();
  std::array<double, part_names.size()> seconds_{};
};

}  // namespace bedscope::coupled
