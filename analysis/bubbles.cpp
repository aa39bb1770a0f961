// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bubbles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "analysis/statistics.hpp"

namespace bedscope::analysis {
namespace {

/// Sums over the bubbles of each snapshot, a value a snapshot.
struct Tally {
  explicit Tally(std::size_t snapshots)
      : number(snapshots, 0), diameter(number), moving(number), velocity(number) {}

  void add(std::size_t snapshot, const Cluster& bubble) {
    number[snapshot] += 1;
    diameter[snapshot] += equivalent_diameter(bubble);
    if (!std::isfinite(bubble.track_velocity_z)) return;
    moving[snapshot] += 1;
    velocity[snapshot] += bubble.track_velocity_z;
  }

  std::vector<double> number, diameter, moving, velocity;
};

/// Each track's height in the snapshot before and in this one.
struct Step {
  std::size_t snapshot = 0;
  double from = 0, to = 0;
};

std::vector<Step> steps_of(const std::vector<Cluster>& bubbles) {
  std::vector<Step> steps;
  std::map<int, const Cluster*> last;  // by track
  for (const Cluster& bubble : bubbles) {
    const Cluster*& before = last[bubble.track];
    if (before != nullptr) steps.push_back({bubble.snapshot, before->centre.z, bubble.centre.z});
    before = &bubble;
  }
  return steps;
}

}  // namespace

double equivalent_diameter(const Cluster& bubble) {
  return std::sqrt(4 * bubble.area / std::numbers::pi);
}

double aspect_ratio(const Cluster& bubble) {
  const double along = std::sin(bubble.angle), across = std::cos(bubble.angle);
  return std::hypot(bubble.major * along, bubble.minor * across) /
         std::hypot(bubble.major * across, bubble.minor * along);
}

BubbleProduct make_bubbles(const RunSetup& setup, std::span<const double> holdup, double surface) {
  std::vector<double> voidage(holdup.size());
  std::transform(holdup.begin(), holdup.end(), voidage.begin(), [](double phi) { return 1 - phi; });
  BubbleProduct product;
  product.image = find_bubbles(setup.grid, voidage, surface, *setup.settings.bubbles);

  const auto columns = static_cast<std::size_t>(setup.grid.cells[lateral]);
  std::vector<double> layers(static_cast<std::size_t>(setup.grid.cells[up]), 0);
  for (std::size_t cell = 0; cell < holdup.size(); ++cell)
    if (product.image.labels[cell] != 0) layers[cell / columns] += 1 / static_cast<double>(columns);
  for (const Band& band : setup.bubble_bands) {
    double covered = 0;
    for (std::size_t k = 0; k < layers.size(); ++k) covered += band.weights[k] * layers[k];
    product.covered.push_back(covered);
  }
  return product;
}

void BubbleSums::add(BubbleProduct& product, std::size_t snapshot, double time, double weight,
                     bool keep_contours) {
  for (Cluster& bubble : product.image.clusters) {
    bubble.snapshot = snapshot;
    bubble.time = time;
    if (!keep_contours) bubble.contours = {};
  }
  tracker_.link(product.image, time);
  std::move(product.image.clusters.begin(), product.image.clusters.end(),
            std::back_inserter(bubbles_));
  samples_.push_back({snapshot, time, weight, std::move(product.covered)});
}

Bubbles BubbleSums::finish(const RunSetup& setup, std::size_t first,
                           std::vector<std::string>& problems) && {
  Bubbles result;
  result.thresholds = *setup.settings.bubbles;
  keep_from(bubbles_, first);
  std::erase_if(samples_, [&](const Sample& sample) { return sample.snapshot < first; });
  const std::size_t n = samples_.size();
  std::vector<double> weights, gaps;
  for (std::size_t i = 0; i < n; ++i) {
    weights.push_back(samples_[i].weight);
    if (i > 0) gaps.push_back(samples_[i].time - samples_[i - 1].time);
  }
  const bool time_known = std::all_of(gaps.begin(), gaps.end(), [](double gap) { return gap > 0; });
  const auto steps = steps_of(bubbles_);

  Tally all(n);
  for (const Cluster& bubble : bubbles_) all.add(bubble.snapshot - first, bubble);
  result.number = estimate_mean(all.number, weights).estimate();
  result.diameter = estimate_ratio(all.diameter, all.number, weights);
  result.velocity = estimate_ratio(all.velocity, all.moving, weights);

  for (std::size_t b = 0; b < setup.bubble_bands.size(); ++b) {
    const Band& band = setup.bubble_bands[b];
    Tally inside(n);
    for (const Cluster& bubble : bubbles_)
      if (bubble.centre.z >= band.height - band.width / 2 &&
          bubble.centre.z < band.height + band.width / 2)
        inside.add(bubble.snapshot - first, bubble);
    std::vector<double> covered, passed(gaps.size(), 0);
    for (const Sample& sample : samples_) covered.push_back(sample.covered[b]);
    for (const Step& step : steps)
      if ((step.from < band.height) != (step.to < band.height) && time_known)
        passed[step.snapshot - first - 1] +=
            (step.to > step.from ? 1 : -1) / gaps[step.snapshot - first - 1];

    BubbleBand found{band.height, band.width, {}, {}, {}, {}, {}};
    found.number = estimate_mean(inside.number, weights).estimate();
    found.diameter = estimate_ratio(inside.diameter, inside.number, weights);
    found.velocity = estimate_ratio(inside.velocity, inside.moving, weights);
    if (time_known && !gaps.empty()) found.frequency = estimate_mean(passed, gaps).estimate();
    found.area_fraction = estimate_mean(covered, weights).estimate();
    result.bands.push_back(found);
  }

  // Links, not velocities: those are undefined at merges and splits too.
  std::size_t later = 0;
  for (const Cluster& bubble : bubbles_) later += bubble.snapshot > first;
  if (time_known && later >= 20 && 2 * steps.size() < later)
    problems.push_back(fmt::format(
        "bubbles: only {} of {} were seen in the snapshot before: snapshots are too far apart to "
        "follow them, and velocities and frequencies too low",
        steps.size(), later));
  result.bubbles = std::move(bubbles_);
  return result;
}

}  // namespace bedscope::analysis
