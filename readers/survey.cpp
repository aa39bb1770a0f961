// SPDX-License-Identifier: BSD-3-Clause
#include "readers/survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bedscope::readers {
namespace {

constexpr std::size_t sample = 10;

}  // namespace

std::vector<std::size_t> chosen_snapshots(std::size_t count, bool full) {
  std::vector<std::size_t> chosen;
  const std::size_t picks = full ? count : std::min(count, sample);
  for (std::size_t k = 0; k < picks; ++k)
    chosen.push_back(picks == 1 ? 0 : k * (count - 1) / (picks - 1));
  return chosen;
}

Survey survey(const Series& series, bool full) {
  Survey found;
  found.problems = series.problems();
  found.particles = {std::numeric_limits<std::int64_t>::max(), 0};
  for (std::size_t i = 0; i < series.size(); ++i) {
    found.particles[0] = std::min(found.particles[0], series.located(i).particles);
    found.particles[1] = std::max(found.particles[1], series.located(i).particles);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  found.radius = {infinity, -infinity};
  found.min.fill(infinity);
  found.max.fill(-infinity);

  const Request request{{"x"},
                        {"y"},
                        {"z"},
                        {"vx", false},
                        {"vy", false},
                        {"vz", false},
                        {"radius", false},
                        {"type", false},
                        {"id", false}};
  Snapshot snapshot;
  Scratch scratch;
  std::vector<std::uint64_t> marks;
  Flaws flaws;
  for (const std::size_t i : chosen_snapshots(series.size(), full)) {
    series.read(i, request, snapshot, scratch);
    ++found.snapshots_read;
    const auto& c = snapshot.columns;
    const auto& radius = c[6];
    const auto& type = c[7];
    const auto& id = c[8];
    Flaws here;
    for (std::size_t row = 0; row < snapshot.particles; ++row) {
      bool finite = true;
      for (std::size_t k = 0; k < 7; ++k)
        finite = finite && (c[k].empty() || std::isfinite(c[k][row]));
      const double name = id.empty() ? unknown : id[row];
      if (!finite) {
        here.not_finite.add(i, row, name);
        continue;
      }
      if (!radius.empty()) {
        found.has_radius = true;
        found.radius[0] = std::min(found.radius[0], radius[row]);
        found.radius[1] = std::max(found.radius[1], radius[row]);
        if (radius[row] <= 0) here.no_size.add(i, row, name);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        found.min[axis] = std::min(found.min[axis], c[axis][row]);
        found.max[axis] = std::max(found.max[axis], c[axis][row]);
        here.farthest = std::max(here.farthest, std::abs(c[axis][row]));
      }
      found.has_particles = true;
      if (!type.empty() && std::abs(type[row]) < 1e9)
        ++found.types[static_cast<std::int64_t>(type[row])];
    }
    if (!id.empty()) find_doubled_ids(id, i, marks, here);
    flaws.merge(here);
  }
  for (auto& line : flaws.describe(series)) found.problems.push_back(std::move(line));
  return found;
}

}  // namespace bedscope::readers
