// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/read_bed_tables.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/table_rows.hpp"

namespace bedscope::analysis {
namespace {

namespace fs = std::filesystem;

struct GasRow {
  double coordinate = 0;
  Estimate voidage, velocity_z, temperature, pressure, slip_z;
};

class GasRows : public RunRows {
 public:
  GasRows(const fs::path& path, const RunName& run, std::string_view coordinate)
      : RunRows(path, run), at_(needed(coordinate)) {}

  GasRow row() const {
    return {finite(at_, "coordinate"), estimate(voidage_),  estimate(velocity_),
            estimate(temperature_),    estimate(pressure_), estimate(slip_)};
  }

 private:
  std::size_t at_;
  Pair voidage_ = pair("voidage", "-"), velocity_ = pair("velocity_z", "m/s"),
       temperature_ = pair("temperature", "K"), pressure_ = pair("pressure", "Pa"),
       slip_ = pair("slip_z", "m/s");
};

/// Into its place by ascending coordinate, which none else may have.
void insert(const RunRows& table, const GasRow& row, GasProfile& profile) {
  const auto at =
      std::lower_bound(profile.coordinate.begin(), profile.coordinate.end(), row.coordinate);
  if (at != profile.coordinate.end() && *at == row.coordinate)
    table.fail("one row for each place", fmt::format("a second at {} m", row.coordinate));
  const auto k = at - profile.coordinate.begin();
  profile.coordinate.insert(at, row.coordinate);
  profile.voidage.insert(profile.voidage.begin() + k, row.voidage);
  profile.velocity_z.insert(profile.velocity_z.begin() + k, row.velocity_z);
  profile.temperature.insert(profile.temperature.begin() + k, row.temperature);
  profile.pressure.insert(profile.pressure.begin() + k, row.pressure);
  profile.slip_z.insert(profile.slip_z.begin() + k, row.slip_z);
}

void note_fields(const GasRow& row, GasResult& gas) {
  gas.present = true;
  gas.has_velocity = gas.has_velocity || std::isfinite(row.velocity_z.value);
  gas.has_temperature = gas.has_temperature || std::isfinite(row.temperature.value);
  gas.has_pressure = gas.has_pressure || std::isfinite(row.pressure.value);
}

}  // namespace

void read_gas_axial(const fs::path& path, const RunName& run_name, RunResult& run) {
  GasRows table(path, run_name, "z [m]");
  while (table.next()) {
    const auto row = table.row();
    insert(table, row, run.gas.axial);
    note_fields(row, run.gas);
  }
}

void read_gas_lateral(const fs::path& path, const RunName& run_name, RunResult& run) {
  GasRows table(path, run_name, "x [m]");
  const std::size_t height = table.needed("height [m]");
  while (table.next()) {
    const auto row = table.row();
    const double z = table.finite(height, "height");
    auto place = std::find(run.heights.begin(), run.heights.end(), z);
    if (place == run.heights.end()) place = run.heights.insert(place, z);
    run.gas.lateral.resize(run.heights.size());
    insert(table, row, run.gas.lateral[static_cast<std::size_t>(place - run.heights.begin())]);
    note_fields(row, run.gas);
  }
}

void read_pressure_drop(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]");
  const auto drop = table.column("pressure_drop [Pa]"),
             weight = table.column("bed_weight_over_area [Pa]");
  while (table.next())
    run.gas.pressure.push_back({table.number(time), table.number(drop), table.number(weight)});
  if (!run.gas.pressure.empty()) run.gas.present = run.gas.has_pressure = true;
}

void read_bed_height(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]");
  const auto centre = table.column("height [m]"), solids = table.column("height_solids [m]"),
             surface = table.column("height_surface [m]"),
             expansion = table.column("expansion [-]");
  while (table.next())
    run.bed.samples.push_back({table.number(time), table.number(centre), table.number(solids),
                               table.number(surface), table.number(expansion)});
}

void read_bubbles(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t time = table.needed("time [s]"), x = table.needed("x [m]"),
                    z = table.needed("z [m]");
  const auto area = table.column("area [m2]"), velocity = table.column("velocity_z [m/s]");
  if (!run.bubbles) run.bubbles.emplace();
  while (table.next()) {
    Cluster bubble;
    bubble.time = table.number(time);
    bubble.centre = {table.number(x), table.number(z)};
    bubble.area = table.number(area);
    bubble.track_velocity_z = table.number(velocity);
    bubble.velocity_x = bubble.velocity_z = table.number(std::nullopt);
    run.bubbles->bubbles.push_back(std::move(bubble));
  }
}

void read_bubble_profile(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t height = table.needed("height [m]");
  const auto width = table.column("band [m]");
  const auto number = table.pair("bubbles", "-"), diameter = table.pair("diameter", "m"),
             velocity = table.pair("velocity_z", "m/s"), frequency = table.pair("frequency", "1/s"),
             area = table.pair("area_fraction", "-");
  if (!run.bubbles) run.bubbles.emplace();
  while (table.next())
    run.bubbles->bands.push_back({table.finite(height, "height"), table.number(width),
                                  table.estimate(number), table.estimate(diameter),
                                  table.estimate(velocity), table.estimate(frequency),
                                  table.estimate(area)});
}

void read_fluctuation(const fs::path& path, const RunName& run_name, RunResult& run) {
  RunRows table(path, run_name);
  const std::size_t signal = table.needed("signal"), unit = table.needed("unit");
  const auto mean = table.pair("mean", "unit"), deviation = table.pair("std", "unit");
  const auto dominant = table.column("dominant_frequency [Hz]"),
             width = table.column("dominant_frequency_half_width [Hz]");
  while (table.next()) {
    Fluctuation one;
    one.signal = table.text(signal);
    one.unit = table.text(unit);
    one.mean = table.estimate(mean);
    one.deviation = table.estimate(deviation);
    one.dominant = {table.number(dominant), table.number(width)};
    run.fluctuations.push_back(std::move(one));
  }
}

}  // namespace bedscope::analysis
