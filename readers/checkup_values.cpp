// SPDX-License-Identifier: BSD-3-Clause
// Rules on the sizes of values: units, masses, speeds, temperatures, packing.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "readers/checkup.hpp"

namespace bedscope::readers {
namespace {

using Said = std::optional<std::string>;
using enum Rule::Weight;

constexpr double light_speed = 299792458;  // m/s
// Fluidised particles have 10 um to 10 mm (Geldart 1973, groups C to D: up to some mm).
constexpr double large_radius = 0.02, impossible_radius = 5, small_radius = 1e-7;  // m
// Aerogel 100, expanded polystyrene 15 to 30, tungsten 19,250, osmium 22,590 kg/m3.
constexpr double lightest = 10, heaviest = 25000;  // kg/m3
constexpr double too_fast = 1000;                  // m/s
constexpr double cold = 200;                       // K; beds are run in degrees Celsius below
// Scott and Kilgour, Brit. J. Appl. Phys. 2 (1969) 863; pi / sqrt(18) (Kepler, Hales 2005).
constexpr double random_packing = 0.6366, densest_packing = 0.74048;
constexpr double same = 0.01;  // masses and densities that agree, in spite of 6 digits

// --- sizes and units

Said impossible_size(const Facts& facts) {
  const auto& survey = facts.survey;
  if (!survey.has_radius || survey.radius[1] <= impossible_radius) return {};
  return fmt::format("radii up to {:.4g} m: micrometres or millimetres instead of metres?",
                     survey.radius[1]);
}

Said unusual_size(const Facts& facts) {
  const auto& survey = facts.survey;
  if (!survey.has_radius) return {};
  if (survey.radius[1] > large_radius && survey.radius[1] <= impossible_radius)
    return fmt::format(
        "radii up to {:.4g} m are large for a fluidised bed: cm (units cgs) instead "
        "of m?",
        survey.radius[1]);
  if (survey.radius[0] > 0 && survey.radius[0] < small_radius)
    return fmt::format("radii down to {:.4g} m are small for a fluidised bed", survey.radius[0]);
  return {};
}

Said density_out_of_range(const Facts& facts) {
  Range range;
  const char* source = "column density";
  for (const auto& [type, species] : facts.survey.types)
    if (species.density.any()) {
      range.add(species.density.min);
      range.add(species.density.max);
    }
  if (!range.any()) {
    source = "mass and radius";
    for (const auto& [type, species] : facts.survey.types)
      if (species.implied_density.any() && !facts.survey.has_shapes) {
        range.add(species.implied_density.min);
        range.add(species.implied_density.max);
      }
  }
  if (!range.any()) {
    source = "log.liggghts";
    for (const auto& [type, density] : facts.log.density) range.add(density);
  }
  if (!range.any() || (range.min >= lightest && range.max <= heaviest)) return {};
  return fmt::format("densities of {:.4g} to {:.4g} kg/m3 ({}): {}", range.min, range.max, source,
                     range.min > 0.1 && range.max <= heaviest / 1000
                         ? "g/cm3 (units cgs) instead of kg/m3?"
                         : "no solid has them");
}

Said larger_than_box(const Facts& facts) {
  const auto& survey = facts.survey;
  if (!survey.box.known || !survey.has_radius) return {};
  std::array<double, 3> sides{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    sides[axis] = survey.box.max[axis] - survey.box.min[axis];
  std::sort(sides.begin(), sides.end());
  // The shortest side may be thin: two-dimensional beds are one particle deep, or less.
  const double diameter = 2 * survey.radius[1];
  if (!(diameter > sides[1])) return {};
  return fmt::format(
      "particles of {:.4g} m in diameter do not fit into the box of {:.4g} x {:.4g} "
      "x {:.4g} m: two kinds of units?",
      diameter, sides[0], sides[1], sides[2]);
}

Said outside_box(const Facts& facts) {
  if (facts.survey.outside_box == 0) return {};
  return fmt::format("{} centres lie beyond a fixed side of the box", facts.survey.outside_box);
}

// --- mass

Said mass_against_density(const Facts& facts) {
  const auto& ratio = facts.survey.mass_ratio;
  if (!ratio.any() || facts.survey.has_shapes) return {};
  if (ratio.min >= 1 - same && ratio.max <= 1 + same) return {};
  return fmt::format(
      "mass is {:.4g} to {:.4g} times density x 4/3 pi radius^3: not spheres, or "
      "columns of two kinds of units?",
      ratio.min, ratio.max);
}

Said density_against_log(const Facts& facts) {
  for (const auto& [type, species] : facts.survey.types) {
    const auto of_log = facts.log.density.find(static_cast<int>(type));
    const auto& range = species.density.any() ? species.density : species.implied_density;
    if (of_log == facts.log.density.end() || !range.any() || facts.survey.has_shapes) continue;
    if (std::abs(range.min / of_log->second - 1) <= same &&
        std::abs(range.max / of_log->second - 1) <= same)
      continue;
    return fmt::format("type {} has {:.6g} to {:.6g} kg/m3 in the dumps, {:.6g} in {}", type,
                       range.min, range.max, of_log->second, facts.log.path);
  }
  return {};
}

Said bodies(const Facts& facts) {
  if (!facts.survey.has_bodies) return {};
  return std::string(
      "multi-sphere bodies: each row is one sphere of a body, mass is that of the whole body on "
      "each row, and overlapping spheres count twice in every volume");
}

Said shapes(const Facts& facts) {
  if (!facts.survey.has_shapes) return {};
  return std::string("superquadrics: bedscope takes every particle for a sphere of its radius");
}

// --- motion

Said speed(const Facts& facts) {
  const double fastest = facts.survey.fastest;
  if (fastest <= too_fast) return {};
  return fmt::format("a particle at {:.4g} m/s ({}): {}", fastest, facts.survey.fastest_place,
                     fastest > light_speed ? "faster than light" : "did the run blow up?");
}

Said speed_against_step(const Facts& facts) {
  const auto& survey = facts.survey;
  const auto dt = facts.log.time_step;
  if (!dt || !survey.has_radius || !(survey.radius[0] > 0)) return {};
  const double way = survey.fastest * *dt;
  if (way <= survey.radius[0]) return {};
  return fmt::format(
      "at {:.4g} m/s ({}) a particle moves {:.3g} m in a time step of {} s, further "
      "than the smallest radius of {:.4g} m: contacts are missed",
      survey.fastest, survey.fastest_place, way, *dt, survey.radius[0]);
}

// --- temperature

const ColumnSurvey* temperature(const Facts& facts) {
  const auto* column = facts.survey.column(facts.survey.temperature_column);
  return column != nullptr && column->range.any() ? column : nullptr;
}

Said below_zero_kelvin(const Facts& facts) {
  const auto* column = temperature(facts);
  if (column == nullptr || column->range.min >= 0) return {};
  return fmt::format("{} goes down to {:.4g}: below 0 K; degrees Celsius?", column->name,
                     column->range.min);
}

Said celsius(const Facts& facts) {
  const auto* column = temperature(facts);
  if (column == nullptr || column->range.min < 0 || column->range.max >= cold ||
      column->range.max == 0)
    return {};
  return fmt::format("{} lies between {:.4g} and {:.4g}: degrees Celsius instead of K?",
                     column->name, column->range.min, column->range.max);
}

// --- packing

Said overlaps(const Facts& facts) {
  const auto& [tested, snapshot, found, place] = facts.survey.overlap;
  if (!tested || facts.survey.has_shapes || found.deepest <= overlap_rule) return {};
  return fmt::format(
      "overlaps reach {:.2g} % of the smaller radius (step {}, {}): the stiffness rule is {:g} %{}",
      100 * found.deepest, facts.survey.steps[snapshot], place, 100 * overlap_rule,
      found.deep == 0 ? "" : fmt::format("; {} pairs are nearer than 0.9 (r1 + r2)", found.deep));
}

/// The largest holdup of the box among the snapshots read; NaN where none is known.
double largest_holdup(const Facts& facts) {
  double largest = unknown;
  if (facts.survey.has_bodies || facts.survey.has_shapes) return largest;
  for (const auto& snapshot : facts.survey.read) largest = std::fmax(largest, snapshot.holdup);
  return largest;
}

Said denser_than_any(const Facts& facts) {
  const double holdup = largest_holdup(facts);
  if (!(holdup > densest_packing)) return {};
  return fmt::format(
      "the box holds {:.3g} of its volume in solids, more than the densest packing "
      "of equal spheres ({:.3g}): radii or box in other units?",
      holdup, densest_packing);
}

Said denser_than_random(const Facts& facts) {
  const double holdup = largest_holdup(facts);
  if (!(holdup > random_packing && holdup <= densest_packing)) return {};
  return fmt::format(
      "the box holds {:.3g} of its volume in solids, more than a random close "
      "packing of equal spheres ({:.3g})",
      holdup, random_packing);
}

constexpr std::array rules{
    Rule{"impossible size", problem, impossible_size},
    Rule{"unusual size", note, unusual_size},
    Rule{"density out of range", problem, density_out_of_range},
    Rule{"larger than the box", problem, larger_than_box},
    Rule{"outside the box", note, outside_box},
    Rule{"mass against density", problem, mass_against_density},
    Rule{"density against the log", note, density_against_log},
    Rule{"bodies", note, bodies},
    Rule{"shapes", note, shapes},
    Rule{"speed", problem, speed},
    Rule{"speed against the time step", problem, speed_against_step},
    Rule{"below 0 K", problem, below_zero_kelvin},
    Rule{"degrees Celsius", note, celsius},
    Rule{"overlaps", note, overlaps},
    Rule{"denser than any packing", problem, denser_than_any},
    Rule{"denser than a random packing", note, denser_than_random},
};

}  // namespace

std::span<const Rule> value_rules() { return rules; }

}  // namespace bedscope::readers
