// SPDX-License-Identifier: BSD-3-Clause
// What a series of steps and a short series of values show: gaps, changes of spacing, a trend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bedscope::readers {

/// How the steps of a series follow each other.
struct StepSpacing {
  struct Gap {
    std::int64_t before = 0, after = 0;  ///< the steps on both sides
    std::int64_t spacing = 0;            ///< that of its neighbours
    std::uint64_t missing() const;
  };
  struct Change {
    std::int64_t step = 0;  ///< where the new spacing begins
    std::int64_t from = 0, to = 0;
  };
  std::int64_t usual = 0;  ///< the most common spacing, the smallest of several; 0: one snapshot
  std::vector<Gap> gaps;   ///< intervals that are a multiple of their neighbours' spacing
  std::vector<Change> changes;  ///< a run of at least three equal intervals after one of another
  std::size_t irregular = 0;    ///< intervals that fit neither

  std::uint64_t missing() const;
  bool even() const { return gaps.empty() && changes.empty() && irregular == 0; }
};

/// Steps ascending. Three equal intervals in a row make a spacing; with fewer of them nothing but
/// "irregular" can be told.
StepSpacing spacing_of(std::span<const std::int64_t> steps);

/// The largest relative change of the number of particles from one snapshot to the next, upwards
/// (`sign` 1) or downwards (-1), where it stands out: beyond a fifth, five times the median of all
/// changes and five times what chance gives. The index of the snapshot before it; fewer than four
/// snapshots: nothing.
std::optional<std::size_t> sudden_change(std::span<const std::int64_t> counts, double sign);

/// A straight line through a series.
struct Trend {
  double mean = 0;
  double change = 0;  ///< of the line from the first to the last point, over the mean
  double ci99 = 0;    ///< half-width of its 99 % interval
  /// Beyond its error, and more than 1 %.
  bool significant() const;
};

/// Least squares through the means of ten batches (fewer for a short series), so that values which
/// hang together in time do not pass for independent ones; Student's t with two degrees of freedom
/// spent. Nothing for fewer than five points, values that are not finite, or a mean of zero.
std::optional<Trend> trend_of(std::span<const double> x, std::span<const double> y);

}  // namespace bedscope::readers
