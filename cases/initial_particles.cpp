// SPDX-License-Identifier: BSD-3-Clause
#include "cases/initial_particles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "readers/error.hpp"

namespace bedscope::cases {
namespace {

/// SplitMix64: Steele, Lea and Flood, OOPSLA 2014. The standard library's distributions differ from
/// one implementation to the next.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1p-53;
  }
  std::uint64_t below(std::uint64_t limit) { return next() % limit; }

 private:
  std::uint64_t state_;
};

struct Sites {
  std::array<std::int64_t, 3> number{};
  Vector edge{};  ///< [m]

  std::int64_t all() const { return number[0] * number[1] * number[2]; }
};

std::int64_t fitting(double length, double edge) {
  return static_cast<std::int64_t>(std::floor(length / edge * (1 + 1e-12)));
}

Sites bed_sites(const Scene& scene) {
  const auto& g = scene.geometry;
  const double d = largest_diameter(scene);
  const auto along = [&](double length) {  // a bed thinner than 1.05 d still takes particles
    return std::max(fitting(length, 1.05 * d), fitting(length, d) > 0 ? std::int64_t{1} : 0);
  };
  Sites sites;
  sites.number = {along(g.width), along(g.depth), 0};
  const auto layer = sites.number[0] * sites.number[1];
  if (layer == 0) return sites;
  sites.number[2] = (scene.particles.number + layer - 1) / layer;
  sites.edge = {g.width / static_cast<double>(sites.number[0]),
                g.depth / static_cast<double>(sites.number[1]), 1.05 * d};
  return sites;
}

Sites uniform_sites(const Scene& scene) {
  const auto& g = scene.geometry;
  const double volume = g.width * g.depth * g.height;
  double edge = std::cbrt(volume / static_cast<double>(scene.particles.number));
  Sites sites;
  do {  // near cubic, and at least as many as particles
    sites.number = {std::max<std::int64_t>(1, fitting(g.width, edge)),
                    std::max<std::int64_t>(1, fitting(g.depth, edge)),
                    std::max<std::int64_t>(1, fitting(g.height, edge))};
    edge *= 0.99;
  } while (sites.all() < scene.particles.number);
  const double across = static_cast<double>(sites.number[0] * sites.number[1]);
  sites.number[2] =  // the smallest that does
      static_cast<std::int64_t>(std::ceil(static_cast<double>(scene.particles.number) / across));
  sites.edge = {g.width / static_cast<double>(sites.number[0]),
                g.depth / static_cast<double>(sites.number[1]),
                g.height / static_cast<double>(sites.number[2])};
  return sites;
}

Sites lattice_sites(const Scene& scene) {
  const auto& n = scene.particles.lattice;
  const double x = scene.geometry.width / n[0], y = scene.geometry.depth / n[1];
  return {{n[0], n[1], n[2]}, {x, y, std::min(x, y)}};
}

Sites sites_of(const Scene& scene) {
  switch (scene.particles.arrangement) {
    case Arrangement::bed:
      return bed_sites(scene);
    case Arrangement::lattice:
      return lattice_sites(scene);
    default:
      return uniform_sites(scene);
  }
}

void require_room(const Scene& scene, const Sites& sites) {
  const double d = largest_diameter(scene);
  const double height = static_cast<double>(sites.number[2]) * sites.edge[2];
  const double tight = d * (1 - 1e-9);
  if (sites.number[0] * sites.number[1] == 0 || sites.edge[0] < tight || sites.edge[1] < tight ||
      sites.edge[2] < tight || height > scene.geometry.height * (1 + 1e-9))
    throw InputError(
        "particles: expected {} spheres of {:g} m to fit in {:g} x {:g} x {:g} m before they "
        "settle, found no room",
        scene.particles.number, d, scene.geometry.width, scene.geometry.depth,
        scene.geometry.height);
}

/// The species of each particle, in random order.
std::vector<int> shuffled_species(const Scene& scene, Random& random) {
  std::vector<int> species;
  const auto numbers = species_numbers(scene);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    species.insert(species.end(), static_cast<std::size_t>(numbers[i]), static_cast<int>(i));
  if (numbers.size() > 1)
    for (std::size_t i = species.size(); i > 1; --i)
      std::swap(species[i - 1], species[random.below(i)]);
  return species;
}

}  // namespace

std::vector<InitialParticle> initial_particles(const Scene& scene) {
  const auto& p = scene.particles;
  if (p.arrangement == Arrangement::single) return {{0, scene.species[0].diameter, p.position}};
  constexpr std::int64_t most = 20'000'000;  // their file has 1.5 GB
  if (p.number > most)
    throw InputError("particles: expected {} at most in a deck, found {}", most, p.number);
  const auto sites = sites_of(scene);
  require_room(scene, sites);
  Random random(p.seed);
  const auto species = shuffled_species(scene, random);
  std::vector<InitialParticle> particles;
  particles.reserve(species.size());
  for (std::size_t i = 0; i < species.size(); ++i) {
    const auto& s = scene.species[static_cast<std::size_t>(species[i])];
    const double d =
        s.spread > 0 ? random.between(s.diameter - s.spread, s.diameter + s.spread) : s.diameter;
    // Particle i of N on site floor(i M / N): the empty sites are spread evenly. A bed fills up.
    auto site = static_cast<std::int64_t>(i);
    if (p.arrangement == Arrangement::uniform)
      site = static_cast<std::int64_t>(static_cast<double>(i) * static_cast<double>(sites.all()) /
                                       static_cast<double>(species.size()));
    const std::array<std::int64_t, 3> at{site % sites.number[0],
                                         site / sites.number[0] % sites.number[1],
                                         site / (sites.number[0] * sites.number[1])};
    Vector position{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double free = p.arrangement == Arrangement::lattice ? 0 : (sites.edge[k] - d) / 2;
      position[k] =
          (static_cast<double>(at[k]) + 0.5) * sites.edge[k] + random.between(-free, free);
    }
    particles.push_back({species[i], d, position});
  }
  return particles;
}

double initial_height(const Scene& scene) {
  if (scene.particles.arrangement == Arrangement::single)
    return scene.particles.position[2] + scene.species[0].diameter / 2;
  const auto sites = sites_of(scene);
  return static_cast<double>(sites.number[2]) * sites.edge[2];
}

}  // namespace bedscope::cases
