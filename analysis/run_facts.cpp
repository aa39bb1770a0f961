// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/run_facts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "readers/flaws.hpp"
#include "readers/series.hpp"

namespace bedscope::analysis {
namespace {

constexpr double per_diameter_cubed = std::numbers::pi / 6;
constexpr std::size_t most_looks = 10;  // snapshots

struct Sums {
  double number = 0, cubes = 0, smallest = 0, largest = 0, mass = 0;

  void add(double diameter, double particle_mass) {
    smallest = number == 0 ? diameter : std::min(smallest, diameter);
    largest = std::max(largest, diameter);
    ++number;
    cubes += diameter * diameter * diameter;
    mass += particle_mass;
  }
};

using Column = std::vector<double>;

double value(const Column& column, std::size_t row, double otherwise) {
  return column.empty() ? otherwise : column[row];
}

/// Of x, y and z.
std::array<double, 3> means(const std::array<const Column*, 3>& v) {
  std::array<double, 3> mean{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double x : *v[k]) mean[k] += x;
    if (!v[k]->empty()) mean[k] /= static_cast<double>(v[k]->size());
  }
  return mean;
}

void add_speeds(const std::array<const Column*, 3>& v, std::vector<double>& speeds) {
  if (v[0]->empty() || v[1]->empty() || v[2]->empty()) return;
  const auto mean = means(v);
  for (std::size_t i = 0; i < v[0]->size(); ++i) {
    const double speed =
        std::hypot((*v[0])[i] - mean[0], (*v[1])[i] - mean[1], (*v[2])[i] - mean[2]);
    if (std::isfinite(speed)) speeds.push_back(speed);
  }
}

double exceeded_by_one_in_a_hundred(std::vector<double>& speeds) {
  if (speeds.empty()) return 0;
  const auto at =
      speeds.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(speeds.size() - 1) * 0.99);
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

void add_extent(const RunSettings& settings, const readers::Box& box, RunFacts& facts) {
  std::array<double, 3> size{};
  for (std::size_t k = 0; k < 3; ++k)
    if (settings.domain)
      size[k] = (*settings.domain)[1][k] - (*settings.domain)[0][k];
    else if (box.known)
      size[k] = box.max[k] - box.min[k];
  const int depth = 3 - settings.up - settings.lateral;
  facts.extent = {size[static_cast<std::size_t>(settings.lateral)],
                  size[static_cast<std::size_t>(depth)],
                  size[static_cast<std::size_t>(settings.up)]};
  if (!settings.domain && box.known)
    facts.remarks.emplace_back("the domain is the dump's box: give it in a study, or a scene");
}

}  // namespace

RunFacts facts_of_dumps(const RunSettings& settings) {
  readers::SeriesOptions options;
  options.repeated = settings.repeated;
  options.columns = settings.columns;
  options.names_needed = true;
  const auto series = readers::Series::open(settings.particles, options);
  const readers::Request request{{"type", false}, {"radius", false},  {"vx", false},  {"vy", false},
                                 {"vz", false},   {"density", false}, {"mass", false}};
  RunFacts facts;
  readers::Snapshot snapshot;
  readers::Scratch scratch;
  std::vector<double> speeds;
  std::map<int, Sums> last;
  const auto looks = readers::evenly_spread(series.size(), most_looks);
  for (const auto i : looks) {
    series.read(i, request, snapshot, scratch);
    const auto& c = snapshot.columns;
    last.clear();
    for (std::size_t row = 0; row < snapshot.particles; ++row) {
      const int type = readers::whole_type(value(c[0], row, 1));
      const double radius = value(c[1], row, settings.radius.at(type));
      const double d = std::isfinite(radius) ? 2 * radius : 0;
      const double volume = per_diameter_cubed * d * d * d;
      double density = value(c[5], row, c[6].empty() || volume == 0 ? 0 : c[6][row] / volume);
      if (const double given = settings.density.at(type); std::isfinite(given)) density = given;
      last[type].add(d, density * volume);
    }
    add_speeds({&c[2], &c[3], &c[4]}, speeds);
  }
  for (const auto& [type, sums] : last)
    facts.species.push_back({std::to_string(type), sums.number, std::cbrt(sums.cubes / sums.number),
                             sums.smallest, sums.largest,
                             sums.cubes > 0 ? sums.mass / (per_diameter_cubed * sums.cubes) : 0});
  add_extent(settings, snapshot.box, facts);
  facts.impact_velocity = exceeded_by_one_in_a_hundred(speeds);
  facts.remarks.push_back(fmt::format(
      "sizes and numbers are those of the last of {} snapshots; particles are taken to meet at "
      "{:.3g} m/s, which one of a hundred exceeds relative to the mean velocity in {} snapshots",
      series.size(), facts.impact_velocity, looks.size()));
  return facts;
}

}  // namespace bedscope::analysis
