// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "cases/merge_files.hpp"
#include "cases/scale_scene.hpp"
#include "cases/scene_file.hpp"
#include "cases/scene_tables.hpp"

namespace bedscope::cases {
namespace {

/// Reads a table that may be absent, and minds keys that nobody asked for.
bool with_table(Table& root, std::string_view key, const std::function<void(Table&)>& read) {
  auto table = root.table(key);
  if (!table) return false;
  read(*table);
  table->finish();
  return true;
}

void need_table(Table& root, std::string_view key, const std::function<void(Table&)>& read) {
  if (!with_table(root, key, read)) throw InputError("{}: [{}] is missing", root.path(), key);
}

void read_gas(Table& t, Scene& scene) {
  GasPhase gas;
  gas.density = needed(t, "density", "kg/m3");
  gas.viscosity = needed(t, "viscosity", "Pa s");
  gas.velocity = at_least_zero(t, "velocity", 0);
  gas.heat_capacity = t.positive("heat_capacity").value_or(0);
  gas.conductivity = t.positive("conductivity").value_or(0);
  gas.temperature = t.positive("temperature").value_or(gas.temperature);
  scene.gas = gas;
}

/// What a species does not say of itself is as in the one before.
Species read_species(Table& t, const Species& before, std::size_t index, bool only) {
  Species s = before;
  s.name = t.text("name").value_or(fmt::format("{}", index + 1));
  s.diameter = t.positive("diameter").value_or(s.diameter);
  s.density = t.positive("density").value_or(s.density);
  if (index == 0) {
    needed(t, "diameter", "m");
    needed(t, "density", "kg/m3");
  }
  s.spread = at_least_zero(t, "spread", s.spread);
  if (s.spread >= s.diameter)
    t.fail(*t.find("spread"), "{}: expected less than the diameter {}, found {}", t.key("spread"),
           s.diameter, s.spread);
  if (!only && t.find("fraction") == nullptr)
    t.fail(t.raw(),
           "{} is missing: expected the share of the solids' volume, as there are several "
           "species",
           t.key("fraction"));
  s.fraction = up_to(t, "fraction", 1, true, 1);
  s.heat_capacity = t.positive("heat_capacity").value_or(s.heat_capacity);
  s.conductivity = t.positive("conductivity").value_or(s.conductivity);
  s.source = t.number("source").value_or(s.source);
  t.finish();
  return s;
}

void read_all_species(Table& root, Scene& scene) {
  auto tables = root.tables("species");
  if (tables.empty()) throw InputError("{}: no [[species]]: expected at least one", root.path());
  if (tables.size() > 16)
    root.fail(*root.find("species"), "species: expected at most 16, found {}", tables.size());
  double sum = 0;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    scene.species.push_back(
        read_species(tables[i], i == 0 ? Species{} : scene.species.back(), i, tables.size() == 1));
    sum += scene.species.back().fraction;
  }
  if (std::abs(sum - 1) > 1e-9)
    root.fail(*root.find("species"), "species.fraction: expected a sum of 1, found {}", sum);
}

/// How many: by number, by mass [kg], or by the mean holdup of the straight part.
std::int64_t read_number(Table& t, const Scene& scene) {
  constexpr double most = 1e9;
  Scene one = scene;  // a million particles, for their mean volume and mass
  one.particles.number = 1'000'000;
  std::optional<double> number;
  std::string_view from;
  for (const std::string_view key : {"number", "mass", "holdup"}) {
    const auto value = t.positive(key);
    if (!value) continue;
    if (number)
      t.fail(*t.find(key), "{}: expected one of number, mass and holdup, found also {}", t.key(key),
             from);
    from = key;
    number = *value;
    if (key == "number" && *value != std::floor(*value))
      t.fail(*t.find(key), "particles.number: expected a whole number, found {}", *value);
    if (key == "mass") number = *value / solids_mass(one) * 1e6;
    if (key == "holdup") number = *value / mean_holdup(one) * 1e6;
  }
  if (!number)
    t.fail(t.raw(),
           "particles.number is missing: expected it, or particles.mass [kg], or "
           "particles.holdup [-]");
  if (!(std::round(*number) >= 1 && *number <= most))
    t.fail(*t.find(from), "{}: expected 1 to {:g} particles, found {:g}", t.key(from), most,
           *number);
  return std::llround(*number);
}

void read_particles(Table& t, Scene& scene) {
  auto& p = scene.particles;
  p.arrangement = choice(t, "arrangement", arrangement_words, Arrangement::bed);
  p.lattice = counts_of(t, "lattice");
  p.position = vector_of(t, "position", {});
  p.velocity = vector_of(t, "velocity", {});
  const double speed = at_least_zero(t, "speed", 0), angle = up_to(t, "angle", 90, false, 0);
  if (t.find("speed") != nullptr)  // downwards, so many degrees from the vertical towards x
    p.velocity = {speed * std::sin(angle * std::numbers::pi / 180), 0,
                  -speed * std::cos(angle * std::numbers::pi / 180)};
  p.fixed = t.boolean("fixed").value_or(false);
  p.temperature = t.positive("temperature").value_or(p.temperature);
  const auto seed = t.integer("seed").value_or(1);
  if (seed < 0) t.fail(*t.find("seed"), "particles.seed: expected at least 0, found {}", seed);
  p.seed = static_cast<std::uint64_t>(seed);
  const bool counted = p.arrangement == Arrangement::bed || p.arrangement == Arrangement::uniform;
  for (const auto* key : {"number", "mass", "holdup"})
    if (const auto* node = t.find(key); node != nullptr && !counted)
      t.fail(*node, "{}: expected with arrangement \"bed\" or \"uniform\" only", t.key(key));
  if (p.arrangement == Arrangement::single) {
    p.number = 1;
    if (t.find("position") == nullptr)
      t.fail(t.raw(), "particles.position is missing: expected three numbers [m]");
  } else if (p.arrangement == Arrangement::lattice) {
    if (p.lattice[0] == 0)
      t.fail(t.raw(), "particles.lattice is missing: expected particles along x, y and z");
    p.number = std::int64_t{p.lattice[0]} * p.lattice[1] * p.lattice[2];
  } else {
    p.number = read_number(t, scene);
  }
}

Contact read_contact(Table& t, const Contact& otherwise) {
  Contact c = otherwise;
  c.normal_stiffness = t.positive("normal_stiffness").value_or(c.normal_stiffness);
  c.young = t.positive("young").value_or(c.young);
  c.poisson = up_to(t, "poisson", 0.5, false, c.poisson);
  c.restitution = up_to(t, "restitution", 1, true, c.restitution);
  c.tangential_restitution = up_to(t, "tangential_restitution", 1, true, c.tangential_restitution);
  c.friction = at_least_zero(t, "friction", c.friction);
  return c;
}

void read_contacts(Table& t, Scene& scene) {
  auto& c = scene.contacts;
  c.model = choice(t, "model", contact_words, ContactModel::linear);
  c.particle = read_contact(t, {});
  c.wall = c.particle;
  with_table(t, "wall", [&](Table& wall) { c.wall = read_contact(wall, c.particle); });
  c.impact_velocity = t.positive("impact_velocity").value_or(0);
  if (c.model == ContactModel::linear) needed(t, "normal_stiffness", "N/m");
  if (c.model == ContactModel::hertz) {
    needed(t, "young", "Pa");
    needed(t, "poisson", "-");
  }
}

void read_inlet(Table& t, Scene& scene) {
  auto& in = scene.inlet;
  in.particles = choice(t, "particles", supply_words, Supply::closed);
  in.place = choice(t, "place", inlet_words, Place::bottom);
  in.velocity = vector_of(t, "velocity", {});
  in.from = at_least_zero(t, "from", 0);
  in.to = at_least_zero(t, "to", 0);
  if (in.particles == Supply::feed) needed(t, "flux", "kg/m2/s");
  in.flux = t.positive("flux").value_or(0);
  if (in.place != Place::bottom && !(in.from < in.to && in.to <= scene.geometry.height))
    t.fail(t.raw(), "inlet.from, inlet.to: expected a slit below the height {} [m], found {} to {}",
           scene.geometry.height, in.from, in.to);
}

void read_outlet(Table& t, Scene& scene) {
  auto& out = scene.outlet;
  out.place = choice(t, "place", outlet_words, Place::top);
  out.height = t.positive("height").value_or(0);
  out.head = choice(t, "head", head_words, Head::box);
  if (out.lateral()) {
    needed(t, "height", "m");
  } else if (out.height > 0 || out.head != Head::box) {
    t.fail(t.raw(), "outlet.height, outlet.head: expected with place \"left\" or \"right\" only");
  }
  if (out.head != Head::box && std::abs(out.height / scene.geometry.width - 1) > 1e-9)
    t.fail(*t.find("height"), "outlet.height: expected the width {} [m] under a bend, found {}",
           scene.geometry.width, out.height);
}

/// A ratio of two steps that must be whole.
void whole_ratio(Table& t, const char* longer, double a, const char* shorter, double b) {
  const double ratio = a / b;
  if (ratio < 1 - 1e-9 || ratio > 1e9 || std::abs(ratio - std::round(ratio)) > 1e-6 * ratio)
    t.fail(*t.find(longer),
           "numerics.{}: expected a whole number of numerics.{} ({} s), found {} s", longer,
           shorter, b, a);
}

void read_numerics(Table& t, Scene& scene) {
  auto& n = scene.numerics;
  n.grid = counts_of(t, "grid");
  n.dem_step = needed(t, "dem_step", "s");
  n.gas_step = t.positive("gas_step").value_or(n.dem_step);
  n.output = needed(t, "output", "s");
  n.end = needed(t, "end", "s");
  n.average_from = at_least_zero(t, "average_from", 0);
  if (scene.gas && n.grid[0] == 0)
    t.fail(t.raw(), "numerics.grid is missing: expected cells along x, y and z, as there is a gas");
  if (scene.gas) needed(t, "gas_step", "s");
  whole_ratio(t, "gas_step", n.gas_step, "dem_step", n.dem_step);
  whole_ratio(t, "output", n.output, "gas_step", n.gas_step);
  whole_ratio(t, "end", n.end, "output", n.output);
}

void read_models(Table& t, Scene& scene) {
  auto& m = scene.models;
  m.drag = t.text("drag").value_or(m.drag);
  std::set<std::string> laws;
  for (const auto& law : physics::drag_laws()) laws.insert(std::string(law.name));
  if (!laws.contains(m.drag))
    t.fail(*t.find("drag"), "models.drag: unknown law \"{}\"; the nearest known one is \"{}\"",
           m.drag, readers::nearest_name(m.drag, laws));
  m.void_fraction = choice(t, "void_fraction", void_fraction_words, VoidFraction::divided);
  m.implicit_drag = choice(t, "coupling", coupling_words, true);
  m.energy = t.boolean("energy").value_or(false);
}

void need_heat(const Table& root, const Scene& scene) {
  const auto missing = [&](const char* key) {
    throw InputError("{}: {} is missing: expected it, as models.energy is true", root.path(), key);
  };
  if (!scene.gas) missing("[gas]");
  if (scene.gas->heat_capacity == 0) missing("gas.heat_capacity");
  if (scene.gas->conductivity == 0) missing("gas.conductivity");
  for (const auto& s : scene.species)
    if (s.heat_capacity == 0) missing("species.heat_capacity");
}

Scene read_tables(Table& root) {
  Scene scene;
  scene.title = one_line(root.text("title").value_or(""));
  scene.notes = root.texts("notes").value_or(std::vector<std::string>{});
  scene.gravity = at_least_zero(root, "gravity", scene.gravity);
  scene.smallest_cluster = root.positive("smallest_cluster").value_or(scene.smallest_cluster);
  need_table(root, "geometry", [&](Table& t) {
    scene.geometry = {needed(t, "width", "m"), needed(t, "depth", "m"), needed(t, "height", "m")};
  });
  with_table(root, "gas", [&](Table& t) { read_gas(t, scene); });
  read_all_species(root, scene);
  need_table(root, "particles", [&](Table& t) { read_particles(t, scene); });
  const auto contacts = [&](Table& t) { read_contacts(t, scene); };
  if (!scene.particles.fixed)
    need_table(root, "contact", contacts);
  else if (!with_table(root, "contact", contacts))
    scene.contacts.particle.normal_stiffness = scene.contacts.wall.normal_stiffness = 1000;
  with_table(root, "inlet", [&](Table& t) { read_inlet(t, scene); });
  with_table(root, "outlet", [&](Table& t) { read_outlet(t, scene); });
  with_table(root, "walls", [&](Table& t) {
    scene.walls.sides_slip = choice(t, "sides", slip_words, false);
    scene.walls.front_back_slip = choice(t, "front_back", slip_words, false);
  });
  need_table(root, "numerics", [&](Table& t) { read_numerics(t, scene); });
  with_table(root, "models", [&](Table& t) { read_models(t, scene); });
  if (scene.models.energy) need_heat(root, scene);
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path) {
  const auto file = merged_file(path);
  Table root(file, "", path);
  auto scene = read_tables(root);
  with_table(root, "scale", [&](Table& t) {
    const double factor = needed(t, "factor", "-");
    const auto letter = t.text("condition").value_or("");
    if (letter.size() != 1 || letter[0] < 'a' || letter[0] > 'd') {
      const auto* node = t.find("condition");
      t.fail(node != nullptr ? *node : t.raw(),
             "scale.condition: expected \"a\", \"b\", \"c\" or \"d\", found \"{}\"", letter);
    }
    try {
      scene = scale_scene(scene, factor, physics::mapping_condition(letter));
    } catch (const InputError& error) {  // in its words, with the place
      t.fail(*t.find("factor"), "{}", error.what());
    }
  });
  root.finish();
  return scene;
}

}  // namespace bedscope::cases
