// SPDX-License-Identifier: BSD-3-Clause
#include "readers/columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>

#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

/// Spellings of one quantity on disk, best first.
struct Spelling {
  std::string_view field_name;
  std::string_view on_disk;
  double factor = 1;
};

// Sources: LIGGGHTS dump.html; `dump atom/vtk` (radii, velocity_lin); LPP (all vectors without
// index); MFiX .vtp (Diameter, Velocity, Density, Mass, Particle_ID, Particle_Phase_ID); foamToVTK
// of clouds (d, U; of CFDEMcoupling's: r); MercuryDPM's ParticleVtkWriter (Radius, Velocity,
// speciesType); Yade's VTKRecorder (radii, linVelVec).
constexpr std::array spellings{
    Spelling{"radius", "radius"},
    Spelling{"radius", "radii"},
    Spelling{"radius", "Radius"},
    Spelling{"radius", "diameter", 0.5},
    Spelling{"radius", "Diameter", 0.5},
    Spelling{"radius", "d", 0.5},
    Spelling{"radius", "r"},
    Spelling{"type", "type"},
    Spelling{"type", "speciesType"},
    Spelling{"type", "typeId"},
    Spelling{"type", "Particle_Phase_ID"},
    Spelling{"id", "id"},
    Spelling{"id", "Particle_ID"},
    Spelling{"mass", "mass"},
    Spelling{"mass", "Mass"},
    Spelling{"density", "density"},
    Spelling{"density", "rho"},
    Spelling{"density", "Density"},
    Spelling{"vx", "vx"},
    Spelling{"vx", "velocity_lin[1]"},
    Spelling{"vx", "velocity[1]"},
    Spelling{"vx", "Velocity[1]"},
    Spelling{"vx", "U[1]"},
    Spelling{"vx", "linVelVec[1]"},
    Spelling{"vy", "vy"},
    Spelling{"vy", "velocity_lin[2]"},
    Spelling{"vy", "velocity[2]"},
    Spelling{"vy", "Velocity[2]"},
    Spelling{"vy", "U[2]"},
    Spelling{"vy", "linVelVec[2]"},
    Spelling{"vz", "vz"},
    Spelling{"vz", "velocity_lin[3]"},
    Spelling{"vz", "velocity[3]"},
    Spelling{"vz", "Velocity[3]"},
    Spelling{"vz", "U[3]"},
    Spelling{"vz", "linVelVec[3]"},
};

/// The last column of that name: LPP and VTK keep the last of doubled ones too.
int find(std::span<const std::string> names, std::string_view name) {
  for (int i = static_cast<int>(names.size()) - 1; i >= 0; --i)
    if (names[static_cast<std::size_t>(i)] == name) return i;
  return -1;
}

/// `f_Temp[0]`, `f_Temp`, `Temp`, `T`: LIGGGHTS has no fixed name for the temperature. A prefix
/// f_, c_ or v_ and an index 0 mean the same scalar.
bool is_temperature(std::string_view name) {
  if (name.size() > 2 && name[1] == '_' && (name[0] == 'f' || name[0] == 'c' || name[0] == 'v'))
    name.remove_prefix(2);
  if (name.ends_with("[0]")) name.remove_suffix(3);
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower == "temp" || lower == "temperature" || lower == "t" || lower == "t_p" ||
         lower == "tp";
}

/// Which columns on disk give the coordinate along `axis`, as a recipe over indices into `names`.
ColumnPlan::Output find_coordinate(std::span<const std::string> names, int axis) {
  static constexpr std::array<std::array<std::string_view, 3>, 4> sets{
      {{"x", "y", "z"}, {"xs", "ys", "zs"}, {"xu", "yu", "zu"}, {"xsu", "ysu", "zsu"}}};
  ColumnPlan::Output output;
  for (const auto& set : sets) {
    const int column = find(names, set[static_cast<std::size_t>(axis)]);
    if (column < 0) continue;
    output.raw[0] = column;
    if (set[0].size() > 1 && set[0][1] == 's') {
      output.scaled_axis = axis;
      // Triclinic: x = lo + xs Lx + ys xy + zs xz, so the axes behind are needed too.
      for (int other = axis + 1; other < 3; ++other)
        output.raw[static_cast<std::size_t>(other - axis)] =
            find(names, set[static_cast<std::size_t>(other)]);
    }
    return output;
  }
  return output;
}

ColumnPlan::Output find_column(std::span<const std::string> names, const std::string& wanted) {
  ColumnPlan::Output output;
  if (wanted == "x" || wanted == "y" || wanted == "z")
    return find_coordinate(names, wanted[0] - 'x');
  for (const auto& spelling : spellings) {
    if (spelling.field_name != wanted) continue;
    output.raw[0] = find(names, spelling.on_disk);
    output.factor = spelling.factor;
    if (output.raw[0] < 0) continue;
    if (wanted == "radius") output.parcels = find(names, parcel_column);
    return output;
  }
  output.factor = 1;
  output.raw[0] = find(names, wanted);
  // A scalar fix is dumped as f_name or f_name[0] (text) and as f_name[0] or name (VTK, LPP).
  if (output.raw[0] < 0 && wanted.ends_with("[0]"))
    output.raw[0] = find(names, wanted.substr(0, wanted.size() - 3));
  if (output.raw[0] < 0) output.raw[0] = find(names, wanted + "[0]");
  if (output.raw[0] < 0 && wanted == "temperature")
    for (std::size_t i = 0; i < names.size(); ++i)
      if (is_temperature(names[i])) output.raw[0] = static_cast<int>(i);
  return output;
}

}  // namespace

ColumnPlan plan_columns(std::span<const std::string> names, const Request& request,
                        const std::string& where) {
  ColumnPlan plan;
  for (const auto& wanted : request) {
    auto output = find_column(names, wanted.name);
    if (output.raw[0] < 0 && wanted.required) {
      if (wanted.name == "x" || wanted.name == "y" || wanted.name == "z")
        throw FormatError(
            "{}: no position column \"{}\" (x y z, xs ys zs, xu yu zu or xsu ysu zsu)", where,
            wanted.name);
      throw FormatError("{}: expected a column \"{}\", found only: {}", where, wanted.name,
                        fmt::join(names, " "));
    }
    plan.outputs.push_back(output);
    for (const int column : output.raw)
      if (column >= 0) plan.parse.push_back(column);
    if (output.parcels >= 0) plan.parse.push_back(output.parcels);
  }
  std::vector<std::array<int, 2>> doubled;
  for (const int column : std::vector<int>(plan.parse))
    for (int i = 0; i < column; ++i)
      if (names[static_cast<std::size_t>(i)] == names[static_cast<std::size_t>(column)]) {
        plan.parse.push_back(i);
        doubled.push_back({i, column});
      }
  std::sort(plan.parse.begin(), plan.parse.end());
  plan.parse.erase(std::unique(plan.parse.begin(), plan.parse.end()), plan.parse.end());

  // From indices into `names` to positions in `parse`.
  const auto position = [&](int column) {
    if (column < 0) return -1;
    return static_cast<int>(std::lower_bound(plan.parse.begin(), plan.parse.end(), column) -
                            plan.parse.begin());
  };
  for (auto& output : plan.outputs) {
    for (auto& raw : output.raw) raw = position(raw);
    output.parcels = position(output.parcels);
  }
  for (const auto& pair : doubled) plan.twins.push_back({position(pair[0]), position(pair[1])});
  return plan;
}

bool has_column(std::span<const std::string> names, const std::string& wanted) {
  return find_column(names, wanted).raw[0] >= 0;
}

std::string name_on_disk(std::span<const std::string> names, const std::string& wanted) {
  const auto column = find_column(names, wanted).raw[0];
  return column < 0 ? wanted : names[static_cast<std::size_t>(column)];
}

void finish_columns(const ColumnPlan& plan, std::vector<std::vector<double>>& raw, Snapshot& out,
                    const std::string& where) {
  std::vector<int> uses(raw.size(), 0);
  for (const auto& output : plan.outputs)
    for (const int column : {output.raw[0], output.raw[1], output.raw[2], output.parcels})
      if (column >= 0) ++uses[static_cast<std::size_t>(column)];

  out.columns.resize(plan.outputs.size());
  // A box of sheared walls is given by its bounding box; the box itself (LAMMPS read_dump.html):
  const auto& box = out.box;
  const double xy = box.tilt[0], xz = box.tilt[1], yz = box.tilt[2];
  const std::array<double, 3> low{box.min[0] - std::min({0., xy, xz, xy + xz}),
                                  box.min[1] - std::min(0., yz), box.min[2]};
  const std::array<double, 3> high{box.max[0] - std::max({0., xy, xz, xy + xz}),
                                   box.max[1] - std::max(0., yz), box.max[2]};
  for (std::size_t k = 0; k < plan.outputs.size(); ++k) {
    const auto& output = plan.outputs[k];
    auto& column = out.columns[k];
    if (output.raw[0] < 0) {
      column.clear();
      continue;
    }
    auto& first = raw[static_cast<std::size_t>(output.raw[0])];
    if (output.scaled_axis < 0) {
      if (uses[static_cast<std::size_t>(output.raw[0])] == 1)
        column.swap(first);  // the old column becomes the next read's buffer
      else
        column = first;
      if (output.factor != 1)
        for (auto& value : column) value *= output.factor;
      if (output.parcels >= 0) {
        const auto& particles = raw[static_cast<std::size_t>(output.parcels)];
        for (std::size_t row = 0; row < column.size(); ++row)
          if (particles[row] != 1) column[row] *= std::cbrt(particles[row]);
      }
      continue;
    }
    if (!box.known) throw FormatError("{}: scaled coordinates need the box, found none", where);
    const auto axis = static_cast<std::size_t>(output.scaled_axis);
    const std::array<double, 2> shear = axis == 0   ? std::array{xy, xz}
                                        : axis == 1 ? std::array{yz, 0.}
                                                    : std::array{0., 0.};
    column.resize(first.size());
    for (std::size_t i = 0; i < column.size(); ++i)
      column[i] = low[axis] + first[i] * (high[axis] - low[axis]);
    for (std::size_t other = 0; other < 2; ++other) {
      if (shear[other] == 0) continue;
      const int source = output.raw[other + 1];
      if (source < 0) throw FormatError("{}: a triclinic box needs all of xs, ys and zs", where);
      const auto& fraction = raw[static_cast<std::size_t>(source)];
      for (std::size_t i = 0; i < column.size(); ++i) column[i] += shear[other] * fraction[i];
    }
  }
}

std::vector<std::string> component_names(std::string_view array, int components) {
  if (components == 1) return {std::string(array)};
  std::vector<std::string> names;
  static constexpr std::array<std::string_view, 7> liggghts{"v",  "f",      "omega", "i",
                                                            "tq", "angmom", "mu"};
  if (components == 3 && std::find(liggghts.begin(), liggghts.end(), array) != liggghts.end()) {
    for (const char axis : {'x', 'y', 'z'}) names.push_back(std::string(array) + axis);
    return names;
  }
  // c_st1[1-3] holds the components 1 to 3 of a longer list: go on with their own numbers.
  int first = 1;
  std::string_view stem = array;
  if (const auto open = array.rfind('['); open != array.npos && array.ends_with("]")) {
    const auto range = array.substr(open + 1, array.size() - open - 2);
    int from = 0;
    const auto [rest, error] = std::from_chars(range.data(), range.data() + range.size(), from);
    if (error == std::errc() && rest != range.data() + range.size() && *rest == '-') {
      first = from;
      stem = array.substr(0, open);
    }
  }
  for (int k = 0; k < components; ++k) names.push_back(fmt::format("{}[{}]", stem, first + k));
  return names;
}

}  // namespace bedscope::readers
