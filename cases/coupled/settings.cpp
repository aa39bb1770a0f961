// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/settings_reader.hpp"

#include <algorithm>

namespace bedscope::coupled {
namespace {

Vec3 vec3(const Foam::vector& v) { return {v.x(), v.y(), v.z()}; }

[[noreturn]] void refuse(const Foam::dictionary& dict, const std::string& what) {
  throw BadInput(dict.name() + ": " + what);
}

void only(const Foam::dictionary& dict, const std::vector<std::string>& known) {
  for (const Foam::word& key : dict.toc())
    if (std::find(known.begin(), known.end(), std::string(key)) == known.end()) {
      std::string list;
      for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
      refuse(dict, "unknown key '" + std::string(key) + "', expected one of " + list);
    }
}

double positive(const Foam::dictionary& dict, const char* key) {
  const double value = dict.get<Foam::scalar>(key);
  if (!(value > 0))
    refuse(dict, std::string(key) + ": expected a positive number, found " + std::to_string(value));
  return value;
}

std::string choice(const Foam::dictionary& dict, const char* key, const std::string& otherwise,
                   const std::vector<std::string>& choices) {
  const std::string value = dict.getOrDefault<Foam::word>(key, otherwise);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    std::string list;
    for (const std::string& name : choices) list += (list.empty() ? "" : ", ") + name;
    refuse(dict, std::string(key) + ": expected one of " + list + ", found '" + value + "'");
  }
  return value;
}

Inventory read_inventory(const Foam::dictionary& dict) {
  only(dict, {"policy", "outlet", "entry", "massFlow", "species", "every", "seed"});
  Inventory inventory;
  const std::string policy = choice(dict, "policy", "closed", {"closed", "constant", "fed"});
  inventory.policy = policy == "closed"     ? Policy::closed
                     : policy == "constant" ? Policy::constant
                                            : Policy::fed;
  inventory.every = dict.getOrDefault<Foam::label>("every", 5);
  inventory.seed = dict.getOrDefault<Foam::label>("seed", 1);
  if (inventory.every < 1) refuse(dict, "every: expected at least 1");
  if (inventory.policy == Policy::closed) return inventory;

  const Foam::dictionary& outlet = dict.subDict("outlet");
  only(outlet, {"point", "normal"});
  inventory.outlet_point = vec3(outlet.get<Foam::vector>("point"));
  inventory.outlet_normal = vec3(outlet.get<Foam::vector>("normal"));
  const Foam::dictionary& entry = dict.subDict("entry");
  only(entry, {"min", "max", "velocity"});
  inventory.entry_min = vec3(entry.get<Foam::vector>("min"));
  inventory.entry_max = vec3(entry.get<Foam::vector>("max"));
  inventory.entry_velocity = vec3(entry.getOrDefault<Foam::vector>("velocity", Foam::vector::zero));
  if (inventory.policy != Policy::fed) return inventory;

  inventory.mass_flow = positive(dict, "massFlow");
  double sum = 0;
  for (const Foam::dictionary& one : Foam::List<Foam::dictionary>(dict.lookup("species"))) {
    inventory.species.push_back({int(one.get<Foam::label>("type")), positive(one, "diameter"),
                                 positive(one, "density"),
                                 one.getOrDefault<Foam::scalar>("fraction", 1)});
    sum += inventory.species.back().fraction;
  }
  if (std::abs(sum - 1) > 1e-9)
    refuse(dict, "species: expected fractions that add up to 1, found " + std::to_string(sum));
  return inventory;
}

Energy read_energy(const Foam::dictionary& dict) {
  only(dict, {"heatCapacity", "conductivity", "exchange", "axialConduction"});
  Energy energy{positive(dict, "heatCapacity"), positive(dict, "conductivity"), {}, {}};
  const Foam::token exchange = dict.found("exchange") ? Foam::token(dict.lookup("exchange"))
                                                      : Foam::token(Foam::word("gunn"));
  if (exchange.isNumber())
    energy.exchange = exchange.number();
  else
    choice(dict, "exchange", "gunn", {"gunn"});
  energy.axial_conduction =
      choice(dict, "axialConduction", "effective", {"effective", "molecular", "none"});
  return energy;
}

}  // namespace

Settings read_settings(const Foam::Time& time) {
  const Foam::IOdictionary dict(Foam::IOobject("coupledProperties", time.constant(), time,
                                               Foam::IOobject::MUST_READ,
                                               Foam::IOobject::NO_WRITE));
  only(dict, {"title", "gas", "gravity", "drag", "dragCoupling", "voidFraction", "demSteps",
              "wallTypes", "inventory", "energy", "output", "FoamFile"});
  Settings settings;
  settings.title = dict.getOrDefault<Foam::string>("title", "");
  const Foam::dictionary& gas = dict.subDict("gas");
  only(gas, {"density", "viscosity"});
  settings.gas_density = positive(gas, "density");
  settings.gas_viscosity = positive(gas, "viscosity");
  settings.gravity = vec3(dict.get<Foam::vector>("gravity"));
  settings.drag =
      choice(dict, "drag", "", {"beetstra", "gidaspow", "di_felice", "wen_yu", "ergun", "none"});
  settings.implicit_drag =
      choice(dict, "dragCoupling", "implicit", {"implicit", "explicit"}) == "implicit";
  const Foam::dictionary voids = dict.subOrEmptyDict("voidFraction");
  only(voids, {"method", "floor"});
  settings.divided = choice(voids, "method", "divided", {"divided", "centre"}) == "divided";
  settings.voidage_floor = voids.getOrDefault<Foam::scalar>("floor", 0.25);
  if (!(settings.voidage_floor > 0 && settings.voidage_floor < 1))
    refuse(dict, "voidFraction.floor: expected a number between 0 and 1");
  settings.dem_steps = dict.get<Foam::label>("demSteps");
  if (settings.dem_steps < 1) refuse(dict, "demSteps: expected at least 1");
  for (const Foam::label type : dict.getOrDefault<Foam::labelList>("wallTypes", Foam::labelList()))
    settings.wall_types.push_back(type);
  settings.inventory = read_inventory(dict.subOrEmptyDict("inventory"));
  if (dict.found("energy")) settings.energy = read_energy(dict.subDict("energy"));

  const Foam::dictionary output = dict.subOrEmptyDict("output");
  only(output, {"checkpoint", "history", "inlet", "outlet", "progress"});
  settings.checkpoint_interval = output.getOrDefault<Foam::scalar>("checkpoint", 0);
  settings.history_interval = output.getOrDefault<Foam::scalar>("history", 0);
  settings.progress_interval = output.getOrDefault<Foam::scalar>("progress", 10);
  settings.inlet = output.getOrDefault<Foam::word>("inlet", "inlet");
  settings.outlet = output.getOrDefault<Foam::word>("outlet", "outlet");

  const Foam::dictionary& control = time.controlDict();
  settings.time_step = positive(control, "deltaT");
  settings.end_time = positive(control, "endTime");
  settings.write_interval = positive(control, "writeInterval");
  return settings;
}

}  // namespace bedscope::coupled
