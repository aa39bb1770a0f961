// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/feed.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bedscope::coupled {
namespace {

constexpr int attempts = 200;  // random places tried for a particle before it waits

double sphere_mass(const NewParticle& p) { return p.density * M_PI / 6 * std::pow(p.diameter, 3); }

std::vector<double> gather_all(MPI_Comm comm, const std::vector<double>& mine) {
  int ranks;
  MPI_Comm_size(comm, &ranks);
  std::vector<int> count(ranks), offset(ranks, 0);
  const int size = int(mine.size());
  MPI_Allgather(&size, 1, MPI_INT, count.data(), 1, MPI_INT, comm);
  for (int r = 1; r < ranks; ++r) offset[r] = offset[r - 1] + count[r - 1];
  std::vector<double> all(offset.back() + count.back());
  MPI_Allgatherv(mine.data(), size, MPI_DOUBLE, all.data(), count.data(), offset.data(), MPI_DOUBLE,
                 comm);
  return all;
}

}  // namespace

Feed::Feed(const Inventory& inventory, double gas_step, MPI_Comm comm)
    : inventory_(inventory), gas_step_(gas_step), comm_(comm) {
  state.due.assign(inventory.species.size(), 0.0);
}

// Numbered, not seeded once: the state is a count (SplitMix64; Steele, Lea, Flood 2014).
double Feed::random() {
  std::uint64_t z =
      std::uint64_t(inventory_.seed) * 0xd1342543de82ef95u + ++state.draws * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

std::vector<double> Feed::spheres_near_entry(const Particles& particles, double reach) const {
  std::vector<double> near;
  for (int i = 0; i < particles.count(); ++i) {
    bool inside = true;
    for (int a = 0; a < 3; ++a) {
      const double x = particles.position[3 * i + a], margin = reach + particles.radius[i];
      inside =
          inside && x > inventory_.entry_min[a] - margin && x < inventory_.entry_max[a] + margin;
    }
    if (!inside) continue;
    near.insert(near.end(), &particles.position[3 * i], &particles.position[3 * i] + 3);
    near.push_back(particles.radius[i]);
  }
  return gather_all(comm_, near);
}

bool Feed::find_place(NewParticle& particle, std::vector<double>& occupied) {
  const double r = particle.diameter / 2;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Vec3& at = particle.position;
    for (int a = 0; a < 3; ++a) {
      const double low = inventory_.entry_min[a] + r, high = inventory_.entry_max[a] - r;
      at[a] = low + random() * std::max(0.0, high - low);
    }
    bool free = true;
    for (std::size_t n = 0; n < occupied.size() && free; n += 4) {
      const double reach = r + occupied[n + 3];
      const double x = at[0] - occupied[n], y = at[1] - occupied[n + 1],
                   z = at[2] - occupied[n + 2];
      free = x * x + y * y + z * z >= reach * reach;
    }
    if (!free) continue;
    particle.velocity = inventory_.entry_velocity;
    occupied.insert(occupied.end(), {at[0], at[1], at[2], r});
    return true;
  }
  return false;
}

void Feed::take_leavers(const Particles& particles, std::vector<int>& leaving) {
  std::vector<double> kinds;  // type, diameter, density of who leaves
  for (int i = 0; i < particles.count(); ++i) {
    double beyond = 0;
    for (int a = 0; a < 3; ++a)
      beyond += (particles.position[3 * i + a] - inventory_.outlet_point[a]) *
                inventory_.outlet_normal[a];
    if (beyond <= 0) continue;
    leaving.push_back(particles.local[i]);
    const double d = 2 * particles.radius[i];
    kinds.insert(kinds.end(),
                 {double(particles.type[i]), d, particles.mass[i] / (M_PI / 6 * d * d * d)});
  }
  kinds = gather_all(comm_, kinds);
  for (std::size_t n = 0; n < kinds.size(); n += 3) {
    const NewParticle left{int(kinds[n]), kinds[n + 1], kinds[n + 2], {}, {}};
    ++state.left;
    state.mass_left += sphere_mass(left);
    if (inventory_.policy == Policy::constant) state.waiting.push_back(left);
  }
}

double Feed::due() const { return std::accumulate(state.due.begin(), state.due.end(), 0.0); }

bool Feed::look(long step, const Particles& particles, Dem& dem) {
  if (inventory_.policy == Policy::closed) return false;
  const bool fed = inventory_.policy == Policy::fed;
  const std::vector<Species>& species = inventory_.species;
  for (std::size_t s = 0; s < species.size(); ++s)
    state.due[s] += inventory_.mass_flow * species[s].fraction * gas_step_;
  if (step % inventory_.every != 0) return false;

  const long left_before = state.left;
  std::vector<int> leaving;
  take_leavers(particles, leaving);
  std::vector<NewParticle> placed;
  if (fed || !state.waiting.empty()) {  // decided alike on all ranks
    double reach = 0;
    for (const NewParticle& p : state.waiting) reach = std::max(reach, p.diameter / 2);
    for (const Species& s : species) reach = std::max(reach, s.diameter / 2);
    std::vector<double> occupied = spheres_near_entry(particles, reach);
    const auto enter = [&](NewParticle& particle) {
      if (!find_place(particle, occupied)) return false;
      placed.push_back(particle);
      ++state.entered;
      state.mass_entered += sphere_mass(particle);
      return true;
    };
    std::erase_if(state.waiting, enter);
    while (fed) {  // the species that is most particles behind
      NewParticle next;
      double behind = 1;
      std::size_t chosen = species.size();
      for (std::size_t s = 0; s < species.size(); ++s) {
        const NewParticle one{species[s].type, species[s].diameter, species[s].density, {}, {}};
        if (state.due[s] < behind * sphere_mass(one)) continue;
        behind = state.due[s] / sphere_mass(one);
        next = one;
        chosen = s;
      }
      if (chosen == species.size() || !enter(next)) break;
      state.due[chosen] -= sphere_mass(next);
    }
  }
  if (state.left == left_before && placed.empty()) return false;
  dem.remove(std::move(leaving));
  dem.place(placed);
  return true;
}

}  // namespace bedscope::coupled
