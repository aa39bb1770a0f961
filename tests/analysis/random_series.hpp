// SPDX-License-Identifier: BSD-3-Clause
// Random series with known means, the same with every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace bedscope::analysis::tests {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  // [0, 1)
  double normal() {  // Marsaglia's polar method
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double a = 0, b = 0, s = 0;
    do {
      a = 2 * uniform() - 1;
      b = 2 * uniform() - 1;
      s = a * a + b * b;
    } while (s >= 1 || s == 0);
    const double scale = std::sqrt(-2 * std::log(s) / s);
    spare_ = b * scale;
    has_spare_ = true;
    return a * scale;
  }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// AR(1) of variance 1 from its stationary distribution.
inline std::vector<double> ar1(Random& random, double rho, std::size_t n) {
  std::vector<double> series(n);
  double state = random.normal();
  for (double& x : series) {
    x = state;
    state = rho * state + std::sqrt(1 - rho * rho) * random.normal();
  }
  return series;
}

}  // namespace bedscope::analysis::tests
