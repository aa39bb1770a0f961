// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "cases/scene_file.hpp"
#include "cases/scene_names.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::cases {
namespace {

using readers::toml_number;
using readers::toml_text;

class Writer {
 public:
  void table(std::string_view name) { pending_ = fmt::format("\n[{}]\n", name); }
  void species() {
    text_ += "\n[[species]]\n";
    pending_.clear();
  }
  void line(std::string_view key, const std::string& value) {
    text_ += pending_;
    pending_.clear();
    text_ += fmt::format("{} = {}\n", key, value);
  }
  void value(std::string_view key, double value, double otherwise = std::nan("")) {
    if (value != otherwise) line(key, toml_number(value));
  }
  template <class T, std::size_t N>
  void word(std::string_view key, T value, const Words<T, N>& words, T otherwise) {
    if (value != otherwise) line(key, toml_text(word_of(value, words)));
  }
  void vector(std::string_view key, const Vector& v) {
    if (v != Vector{})
      line(key,
           fmt::format("[{}, {}, {}]", toml_number(v[0]), toml_number(v[1]), toml_number(v[2])));
  }
  void counts(std::string_view key, const std::array<int, 3>& n) {
    if (n[0] != 0) line(key, fmt::format("[{}]", fmt::join(n, ", ")));
  }
  std::string text() const { return text_; }

 private:
  std::string text_, pending_;  // a table without lines is left out
};

void write_species(Writer& w, const Scene& scene) {
  for (const auto& s : scene.species) {
    w.species();
    w.line("name", toml_text(s.name));
    w.value("diameter", s.diameter);
    w.value("spread", s.spread, 0);
    w.value("density", s.density);
    w.value("fraction", s.fraction);
    w.value("heat_capacity", s.heat_capacity, 0);
    w.value("conductivity", s.conductivity, 0);
    w.value("source", s.source, 0);
  }
}

void write_particles(Writer& w, const Particles& p) {
  w.table("particles");
  w.word("arrangement", p.arrangement, arrangement_words, Arrangement::bed);
  if (p.arrangement == Arrangement::lattice)
    w.counts("lattice", p.lattice);
  else if (p.arrangement != Arrangement::single)
    w.line("number", fmt::format("{}", p.number));
  if (p.arrangement == Arrangement::single)
    w.line("position", fmt::format("[{}, {}, {}]", toml_number(p.position[0]),
                                   toml_number(p.position[1]), toml_number(p.position[2])));
  w.vector("velocity", p.velocity);
  if (p.fixed) w.line("fixed", "true");
  w.value("temperature", p.temperature, Particles{}.temperature);
  if (p.seed != 1) w.line("seed", fmt::format("{}", p.seed));
}

void write_contact(Writer& w, const Contact& c, const Contact& otherwise) {
  w.value("normal_stiffness", c.normal_stiffness, otherwise.normal_stiffness);
  w.value("young", c.young, otherwise.young);
  w.value("poisson", c.poisson, otherwise.poisson);
  w.value("restitution", c.restitution, otherwise.restitution);
  w.value("tangential_restitution", c.tangential_restitution, otherwise.tangential_restitution);
  w.value("friction", c.friction, otherwise.friction);
}

void write_contacts(Writer& w, const Contacts& c) {
  w.table("contact");
  w.word("model", c.model, contact_words, ContactModel::linear);
  Contact absent;
  absent.poisson = c.model == ContactModel::hertz ? std::nan("") : 0;  // needed there, even 0
  write_contact(w, c.particle, absent);
  w.value("impact_velocity", c.impact_velocity, 0);
  w.table("contact.wall");
  write_contact(w, c.wall, c.particle);
}

void write_boundaries(Writer& w, const Scene& scene) {
  const auto& in = scene.inlet;
  w.table("inlet");
  w.word("particles", in.particles, supply_words, Supply::closed);
  w.value("flux", in.flux, 0);
  w.word("place", in.place, inlet_words, Place::bottom);
  w.value("from", in.from, 0);
  w.value("to", in.to, 0);
  w.vector("velocity", in.velocity);
  const auto& out = scene.outlet;
  w.table("outlet");
  w.word("place", out.place, outlet_words, Place::top);
  w.value("height", out.height, 0);
  w.word("head", out.head, head_words, Head::box);
  w.table("walls");
  w.word("sides", scene.walls.sides_slip, slip_words, false);
  w.word("front_back", scene.walls.front_back_slip, slip_words, false);
}

}  // namespace

std::string scene_text(const Scene& scene) {
  Writer w;
  if (!scene.title.empty()) w.line("title", toml_text(scene.title));
  if (!scene.notes.empty()) {
    std::string notes;
    for (const auto& note : scene.notes) notes += "\n  " + toml_text(note) + ",";
    w.line("notes", "[" + notes + "\n]");
  }
  w.value("gravity", scene.gravity);
  w.value("smallest_cluster", scene.smallest_cluster, Scene{}.smallest_cluster);
  w.table("geometry");
  w.value("width", scene.geometry.width);
  w.value("depth", scene.geometry.depth);
  w.value("height", scene.geometry.height);
  if (scene.gas) {
    w.table("gas");
    w.value("density", scene.gas->density);
    w.value("viscosity", scene.gas->viscosity);
    w.value("velocity", scene.gas->velocity);
    w.value("heat_capacity", scene.gas->heat_capacity, 0);
    w.value("conductivity", scene.gas->conductivity, 0);
    w.value("temperature", scene.gas->temperature, GasPhase{}.temperature);
  }
  write_species(w, scene);
  write_particles(w, scene.particles);
  write_contacts(w, scene.contacts);
  write_boundaries(w, scene);
  const auto& n = scene.numerics;
  w.table("numerics");
  w.counts("grid", n.grid);
  w.value("dem_step", n.dem_step);
  w.value("gas_step", n.gas_step);
  w.value("output", n.output);
  w.value("end", n.end);
  w.value("average_from", n.average_from, 0);
  const auto& m = scene.models;
  w.table("models");
  if (m.drag != Models{}.drag) w.line("drag", toml_text(m.drag));
  w.word("void_fraction", m.void_fraction, void_fraction_words, VoidFraction::divided);
  w.word("coupling", m.implicit_drag, coupling_words, true);
  if (m.energy) w.line("energy", "true");
  return w.text();
}

}  // namespace bedscope::cases
