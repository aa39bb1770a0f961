// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/tracks.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

namespace bedscope::analysis {
namespace {

constexpr double least_share = 0.25;  // of the smaller cluster
constexpr double longest_gap = 3;     // steps of time: two lost snapshots are bridged

/// A previous and a present cluster (positions, from 0) that overlap enough.
struct Link {
  std::size_t before, now;
  double overlap;  ///< [cells]
};

std::vector<std::vector<int>> cells_of(const ClusterImage& image) {
  std::vector<std::vector<int>> cells(image.clusters.size());
  for (std::size_t cell = 0; cell < image.labels.size(); ++cell)
    if (const int number = image.labels[cell])
      cells[static_cast<std::size_t>(number - 1)].push_back(static_cast<int>(cell));
  return cells;
}

/// Adds to `overlap` what the cells, moved by (x, z) cells, share with each cluster of the labels.
void add_overlap(const Grid& grid, const std::vector<int>& cells, double x, double z,
                 const std::vector<int>& labels, std::vector<double>& overlap) {
  const int columns = grid.cells[lateral], rows = grid.cells[up];
  // Out of the grid, or no number at all: also keeps the conversion to int defined.
  if (!(std::abs(x) < columns && std::abs(z) < rows)) return;
  const int whole_x = static_cast<int>(std::floor(x)), whole_z = static_cast<int>(std::floor(z));
  const std::array part_x{1 - (x - whole_x), x - whole_x};
  const std::array part_z{1 - (z - whole_z), z - whole_z};
  for (const int cell : cells)
    for (int corner = 0; corner < 4; ++corner) {
      const int i = cell % columns + whole_x + corner % 2;
      const int k = cell / columns + whole_z + corner / 2;
      if (i < 0 || i >= columns || k < 0 || k >= rows) continue;
      if (const int number =
              labels[static_cast<std::size_t>(i) +
                     static_cast<std::size_t>(columns) * static_cast<std::size_t>(k)])
        overlap[static_cast<std::size_t>(number - 1)] +=
            part_x[static_cast<std::size_t>(corner % 2)] *
            part_z[static_cast<std::size_t>(corner / 2)];
    }
}

Point expected_velocity(Tracker::Motion motion, const Cluster& cluster) {
  if (motion == Tracker::Motion::of_solids) return {cluster.velocity_x, cluster.velocity_z};
  const bool known = std::isfinite(cluster.track_velocity_z);
  return known ? Point{cluster.track_velocity_x, cluster.track_velocity_z} : Point{};
}

/// All links, by previous and then by present cluster.
std::vector<Link> find_links(const Grid& grid, Tracker::Motion motion, const ClusterImage& before,
                             const ClusterImage& now, double dt) {
  std::vector<Link> links;
  if (before.clusters.empty() || now.clusters.empty()) return links;
  const auto cells_before = cells_of(before), cells_now = cells_of(now);
  std::vector<double> overlap(now.clusters.size());
  for (std::size_t a = 0; a < before.clusters.size(); ++a) {
    std::fill(overlap.begin(), overlap.end(), 0);
    const Cluster& cluster = before.clusters[a];
    const Point velocity = expected_velocity(motion, cluster);
    add_overlap(grid, cells_before[a], velocity.x * dt / grid.width(lateral),
                velocity.z * dt / grid.width(up), now.labels, overlap);
    for (std::size_t b = 0; b < overlap.size(); ++b) {
      const std::size_t smaller = std::min(cells_before[a].size(), cells_now[b].size());
      // Rounding must not decide where the overlap is a quarter exactly.
      if (overlap[b] >= least_share * (1 - 1e-9) * static_cast<double>(smaller))
        links.push_back({a, b, overlap[b]});
    }
  }
  return links;
}

/// The links of one cluster: how many, and the largest.
struct Ties {
  int count = 0;
  const Link* best = nullptr;
  void add(const Link& link) {
    ++count;
    if (best == nullptr || link.overlap > best->overlap) best = &link;
  }
};

}  // namespace

void Tracker::link(ClusterImage& now, double time) {
  assert(before_.labels.empty() || before_.labels.size() == now.labels.size());
  const double dt = time - time_;
  const bool known = std::isfinite(dt) && dt > 0;
  // The longer of two steps: an extra snapshot, such as a restart writes, opens no gap after it.
  const bool gap = known && dt > longest_gap * (1 + 1e-9) * std::fmax(step_, step_before_);

  const auto links =
      gap ? std::vector<Link>{} : find_links(grid_, motion_, before_, now, known ? dt : 0);
  std::vector<Ties> ties_before(before_.clusters.size()), ties_now(now.clusters.size());
  for (const Link& link : links) {
    ties_before[link.before].add(link);
    ties_now[link.now].add(link);
  }

  for (std::size_t b = 0; b < now.clusters.size(); ++b) {
    Cluster& cluster = now.clusters[b];
    const Link* best = ties_now[b].best;
    const bool continued = best != nullptr && ties_before[best->before].best == best;
    cluster.track_velocity_x = cluster.track_velocity_z = unknown;
    cluster.parents.clear();
    cluster.track = continued ? before_.clusters[best->before].track : ++tracks_;
    if (continued && known && ties_now[b].count == 1 && ties_before[best->before].count == 1) {
      const Point from = before_.clusters[best->before].centre;
      cluster.track_velocity_x = (cluster.centre.x - from.x) / dt;
      cluster.track_velocity_z = (cluster.centre.z - from.z) / dt;
    }
  }
  for (const Link& link : links) {
    const int parent = before_.clusters[link.before].track;
    Cluster& cluster = now.clusters[link.now];
    if (parent != cluster.track) cluster.parents.push_back(parent);
  }
  for (Cluster& cluster : now.clusters) std::sort(cluster.parents.begin(), cluster.parents.end());

  before_ = now;
  time_ = time;
  if (known) {
    step_before_ = step_;
    step_ = dt;
  }
}

void keep_from(std::vector<Cluster>& clusters, std::size_t first) {
  std::erase_if(clusters, [&](const Cluster& cluster) { return cluster.snapshot < first; });
  std::map<int, int> numbers;
  for (const Cluster& cluster : clusters)
    numbers.try_emplace(cluster.track, static_cast<int>(numbers.size()) + 1);
  for (Cluster& cluster : clusters) {
    cluster.track = numbers.at(cluster.track);
    std::erase_if(cluster.parents, [&](int parent) { return !numbers.contains(parent); });
    for (int& parent : cluster.parents) parent = numbers.at(parent);
  }
}

}  // namespace bedscope::analysis
