// SPDX-License-Identifier: BSD-3-Clause
// Kernels that share a particle's volume among the cells of a grid.
#pragma once

#include <variant>

#include "analysis/grid.hpp"

namespace bedscope::analysis {
// A kernel is a value with
//   template <class Add> double share(const Vec3& centre, double radius, Add&& add) const;
// which calls add(std::size_t cell, double volume) for every cell that gets a part and returns the
// volume that was put inside [m3]; 4/3 pi r^3 minus that is counted as outside by the caller.
}  // namespace bedscope::analysis
