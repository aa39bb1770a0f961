// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/record.hpp"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>

namespace bedscope::coupled {
namespace {

constexpr const char* history_file = "history.csv";
constexpr const char* header =
    "time [s],particles,solids_mass [kg],entered [kg],left [kg],due [kg],mean_height [m],"
    "pressure_drop [Pa],gas_in [m3/s],gas_out [m3/s],gas_storage [m3/s],drag_x [N],drag_y [N],"
    "drag_z [N],pressure_force_z [N],gas_temperature_out [K],particle_temperature [K],"
    "heat_to_particles [W]";

double norm(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

void replace_file(const std::string& name, const std::string& text) {
  std::ofstream(name + ".new") << text;
  std::filesystem::rename(name + ".new", name);
}

// Of a checkpoint that a program wrote which did not count it, or passed on that one had not.
double number_or_nan(const nlohmann::json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? double(json[key]) : NAN;
}

// The header and the rows up to a time.
std::string rows_until(double time) {
  std::ifstream file(history_file);
  std::string line, kept;
  if (!std::getline(file, line)) return std::string(header) + '\n';
  kept = line + '\n';
  while (std::getline(file, line))
    if (std::strtod(line.c_str(), nullptr) <= time * (1 + 1e-12)) kept += line + '\n';
  return kept;
}

}  // namespace

Record::Record(MPI_Comm comm, const Gas& gas) : comm_(comm) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks_);
  first_ = rank == 0;
  cells_ = gas.cells();
  MPI_Allreduce(MPI_IN_PLACE, &cells_, 1, MPI_LONG, MPI_SUM, comm);
}

void Record::start(double resumed_at) {
  start_time_ = std::max(0.0, resumed_at);
  start_steps_ = tally_.steps;
  if (first_)
    replace_file(history_file,
                 resumed_at < 0 ? std::string(header) + '\n' : rows_until(resumed_at));
}

void Record::step(const Gas& gas, const Dem&, const GasBalance& balance, double particles) {
  const Settings& settings = gas.settings();
  ++tally_.steps;
  tally_.dem_steps += settings.dem_steps;
  tally_.particle_steps += particles * settings.dem_steps;
  tally_.gas_in += balance.inflow * settings.time_step;
  tally_.gas_out += balance.outflow * settings.time_step;
  tally_.gas_stored += balance.storage * settings.time_step;
  tally_.heat_carried += (balance.heat_in - balance.heat_out) * settings.time_step;
  tally_.worst_courant = std::max(tally_.worst_courant, balance.courant);
  if (balance.inflow > 0)
    tally_.worst_continuity =
        std::max(tally_.worst_continuity,
                 std::abs(balance.inflow - balance.outflow - balance.storage) / balance.inflow);
  if (settings.energy) tally_.heat_from_gas += gas.heat_to_particles() * settings.time_step;
}

void Record::row(const Gas& gas, const ParticleSums& sums, const GasBalance& balance,
                 const Feed& feed) {
  const Vec3 on_gas = gas.drag_on_particles();
  const Vec3 off{on_gas[0] - sums.drag[0], on_gas[1] - sums.drag[1], on_gas[2] - sums.drag[2]};
  if (norm(sums.drag) > 0)
    tally_.worst_exchange = std::max(tally_.worst_exchange, norm(off) / norm(sums.drag));
  if (!first_) return;
  char line[640];
  std::snprintf(line, sizeof line,
                "%.9g,%ld,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%"
                ".9g,%.9g,%.9g\n",
                gas.time(), sums.count, sums.mass, feed.state.mass_entered, feed.state.mass_left,
                feed.due(), sums.height, balance.pressure_drop, balance.inflow, balance.outflow,
                balance.storage, sums.drag[0], sums.drag[1], sums.drag[2], sums.pressure_force[2],
                gas.settings().energy ? balance.outlet_temperature : NAN,
                gas.settings().energy ? sums.temperature : NAN,
                gas.settings().energy ? sums.heat : NAN);
  std::ofstream(history_file, std::ios::app) << line;
}

void Record::progress(const Gas& gas, long particles, const Timing& timing) {
  const Settings& settings = gas.settings();
  const double elapsed = timing.elapsed();
  if (!first_ || elapsed - last_progress_ < settings.progress_interval) return;
  last_progress_ = elapsed;
  const double done = gas.time() - start_time_;
  const double left = done > 0 ? elapsed * (settings.end_time - gas.time()) / done : 0;
  const std::time_t end = std::time(nullptr) + std::time_t(left);
  char clock[16];
  std::strftime(clock, sizeof clock, "%H:%M", std::localtime(&end));
  std::printf(
      "t = %.4g s of %.4g s, %.0f %%, %ld particles, %.1f ms a step, %.0f min left, ends at %s\n",
      gas.time(), settings.end_time, 100 * gas.time() / settings.end_time, particles,
      1e3 * elapsed / double(std::max(1l, tally_.steps - start_steps_)), left / 60, clock);
  std::fflush(stdout);
}

double Record::cpu_seconds() const {
  double seconds = Timing::cpu();
  MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return tally_.cpu_seconds + seconds;
}

nlohmann::json Record::costs(const Timing& timing, double cpu) const {
  nlohmann::json parts;
  for (std::size_t n = 0; n < part_names.size(); ++n)
    parts[part_names[n]] = tally_.part_seconds[n] + timing.seconds(Part(n));
  const double wall = tally_.seconds + timing.elapsed();
  const double dem = parts["DEM"], flow = double(parts["momentum"]) + double(parts["pressure"]);
  return {{"wall_seconds", wall},
          {"cpu_seconds", cpu},
          {"seconds", parts},
          {"ms_per_step", 1e3 * wall / double(std::max(1l, tally_.steps))},
          {"particle_steps_per_second", dem > 0 ? tally_.particle_steps / dem : 0},
          {"cell_steps_per_second", flow > 0 ? double(cells_) * double(tally_.steps) / flow : 0}};
}

void Record::write_json(const Gas& gas, const ParticleSums& sums, const Feed& feed,
                        const Timing& timing, const std::string& state) const {
  const long floor_hits = gas.floor_hits();
  const double cpu = cpu_seconds();
  if (!first_) return;
  const Settings& settings = gas.settings();
  nlohmann::ordered_json json;
  json["title"] = settings.title;
  json["state"] = state;
  json["versions"] = {{"bedscope", BEDSCOPE_VERSION},
                      {"OpenFOAM", OPENFOAM_PACKAGE},
                      {"LIGGGHTS", LIGGGHTS_PACKAGE}};
  json["time"] = {{"reached", gas.time()},
                  {"end", settings.end_time},
                  {"step", settings.time_step},
                  {"steps", tally_.steps},
                  {"dem_steps", tally_.dem_steps}};
  json["scene"] = {{"gas_density", settings.gas_density},
                   {"gas_viscosity", settings.gas_viscosity},
                   {"gravity", settings.gravity},
                   {"drag", settings.drag},
                   {"drag_coupling", settings.implicit_drag ? "implicit" : "explicit"},
                   {"void_fraction", settings.divided ? "divided" : "centre"},
                   {"cells", cells_},
                   {"particles", sums.count},
                   {"solids_mass", sums.mass}};
  json["ranks"] = ranks_;
  json["inventory"] = {{"left", feed.state.left},
                       {"entered", feed.state.entered},
                       {"mass_left", feed.state.mass_left},
                       {"mass_entered", feed.state.mass_entered},
                       {"mass_due", feed.due()},
                       {"waiting", feed.state.waiting.size()}};
  json["conservation"] = {{"gas_in", tally_.gas_in},
                          {"gas_out", tally_.gas_out},
                          {"gas_stored", tally_.gas_stored},
                          {"gas_worst_step", tally_.worst_continuity},
                          {"momentum_exchange_worst", tally_.worst_exchange},
                          {"voidage_floor_hits", floor_hits},
                          {"largest_courant", tally_.worst_courant}};
  if (settings.energy)
    json["conservation"].update({{"heat_from_gas_to_particles", tally_.heat_from_gas},
                                 {"heat_carried_in_by_gas", tally_.heat_carried}});
  json["costs"] = costs(timing, cpu);
  replace_file("run.json", json.dump(1) + '\n');
}

void Record::print_costs(const Timing& timing) const {
  const double cpu = cpu_seconds();
  if (!first_) return;
  const nlohmann::json cost = costs(timing, cpu);
  const double wall = cost["wall_seconds"];
  std::printf("%ld gas steps, %.1f s, %.1f s of CPU, %.2f ms a step", tally_.steps, wall, cpu,
              double(cost["ms_per_step"]));
  for (const char* name : part_names) {
    const double seconds = cost["seconds"][name];
    if (seconds > 0)
      std::printf("%s%s %.1f %%", name == part_names[0] ? ": " : ", ", name, 100 * seconds / wall);
  }
  std::printf(
      "\n%.3g particle-steps/s, %.3g cell-steps/s; gas volume kept to %.1e a step, momentum "
      "exchange to %.1e\n",
      double(cost["particle_steps_per_second"]), double(cost["cell_steps_per_second"]),
      tally_.worst_continuity, tally_.worst_exchange);
}

nlohmann::json Record::saved(const Timing& timing) const {
  const Tally& t = tally_;
  nlohmann::json parts;
  for (std::size_t n = 0; n < part_names.size(); ++n)
    parts.push_back(t.part_seconds[n] + timing.seconds(Part(n)));
  return {{"steps", t.steps},
          {"dem_steps", t.dem_steps},
          {"particle_steps", t.particle_steps},
          {"worst_continuity", t.worst_continuity},
          {"worst_exchange", t.worst_exchange},
          {"gas_in", t.gas_in},
          {"gas_out", t.gas_out},
          {"gas_stored", t.gas_stored},
          {"heat_from_gas", t.heat_from_gas},
          {"heat_carried", t.heat_carried},
          {"worst_courant", t.worst_courant},
          {"seconds", t.seconds + timing.elapsed()},
          {"cpu_seconds", cpu_seconds()},
          {"parts", parts}};
}

void Record::restore(const nlohmann::json& j) {
  tally_ = {j.at("steps"),
            j.at("dem_steps"),
            j.at("particle_steps"),
            j.at("worst_continuity"),
            j.at("worst_exchange"),
            j.at("gas_in"),
            j.at("gas_out"),
            j.at("gas_stored"),
            j.at("heat_from_gas"),
            j.at("heat_carried"),
            j.at("worst_courant"),
            j.at("seconds"),
            number_or_nan(j, "cpu_seconds"),
            j.at("parts")};
}

}  // namespace bedscope::coupled
