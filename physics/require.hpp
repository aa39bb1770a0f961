// SPDX-License-Identifier: BSD-3-Clause
// What a formula may be given; of use inside this room only.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace bedscope::physics {

inline void require_positive(double value, const char* what) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::domain_error(fmt::format("expected a positive {}, found {}", what, value));
}

/// Both ends allowed; NaN is not.
inline void require_between(double value, double low, double high, const char* what) {
  if (!(value >= low && value <= high))
    throw std::domain_error(
        fmt::format("expected a {} from {} to {}, found {}", what, low, high, value));
}

inline void require_not_negative(double value, const char* what) {
  if (!(value >= 0) || !std::isfinite(value))
    throw std::domain_error(fmt::format("expected a {} of at least 0, found {}", what, value));
}

/// A voidage in (0, 1].
inline void require_voidage(double value) {
  if (!(value > 0 && value <= 1))
    throw std::domain_error(fmt::format("expected a voidage above 0 and up to 1, found {}", value));
}

}  // namespace bedscope::physics
