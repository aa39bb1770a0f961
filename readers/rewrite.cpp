// SPDX-License-Identifier: BSD-3-Clause
#include "readers/rewrite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

using Column = std::vector<double>;

/// A request's columns that are there, by name.
class Columns {
 public:
  Columns(const Snapshot& snapshot, const Request& request) {
    for (std::size_t k = 0; k < request.size(); ++k)
      if (!snapshot.columns[k].empty()) all_.emplace_back(&request[k].name, &snapshot.columns[k]);
  }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }
  std::size_t size() const { return all_.size(); }
  /// Null where it was not read.
  const Column* find(std::string_view name) const {
    for (const auto& [own, values] : all_)
      if (*own == name) return values;
    return nullptr;
  }

 private:
  std::vector<std::pair<const std::string*, const Column*>> all_;
};

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

void put_big_endian(std::string& out, double value) {
  char bytes[sizeof(float)];
  const auto single = static_cast<float>(value);
  std::memcpy(bytes, &single, sizeof(float));
  if constexpr (std::endian::native == std::endian::little)
    std::reverse(std::begin(bytes), std::end(bytes));
  out.append(bytes, sizeof(float));
}

/// A box around all particles: the analysis has its own domain.
std::array<std::array<double, 2>, 3> box_of(const Columns& columns) {
  std::array<std::array<double, 2>, 3> box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = 0, high = 1;
    for (const double value : *columns.find(std::string(1, "xyz"[axis]))) {
      low = std::min(low, value - 1);
      high = std::max(high, value + 1);
    }
    box[axis] = {low, high};
  }
  return box;
}

std::string text_of(const Snapshot& snapshot, const Columns& columns) {
  std::string out = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n"
      "ITEM: BOX BOUNDS ff ff ff\n",
      snapshot.step, snapshot.particles);
  for (const auto& [low, high] : box_of(columns)) out += fmt::format("{} {}\n", low, high);
  out += "ITEM: ATOMS";
  for (const auto& [name, values] : columns) out += " " + *name;
  out += " \n";
  for (std::size_t i = 0; i < snapshot.particles; ++i) {
    for (const auto& [name, values] : columns)
      fmt::format_to(std::back_inserter(out), "{:.6g} ", (*values)[i]);
    out += '\n';
  }
  return out;
}

std::string binary_of(const Snapshot& snapshot, const Columns& columns) {
  std::string out;
  put(out, snapshot.step);
  put(out, static_cast<std::int64_t>(snapshot.particles));
  put(out, std::int32_t{0});                              // not triclinic
  for (int k = 0; k < 6; ++k) put(out, std::int32_t{1});  // fixed boundaries
  for (const auto& [low, high] : box_of(columns)) {
    put(out, low);
    put(out, high);
  }
  put(out, static_cast<std::int32_t>(columns.size()));
  put(out, std::int32_t{1});  // one chunk
  put(out, static_cast<std::int32_t>(columns.size() * snapshot.particles));
  for (std::size_t i = 0; i < snapshot.particles; ++i)
    for (const auto& [name, values] : columns) put(out, (*values)[i]);
  return out;
}

std::string vtk_of(const Snapshot& snapshot, const Columns& columns) {
  const auto n = snapshot.particles;
  const auto vectors = [&](std::string& out, const std::array<const Column*, 3>& parts) {
    for (std::size_t i = 0; i < n; ++i)
      for (const auto* part : parts) put_big_endian(out, part != nullptr ? (*part)[i] : 0);
    out += '\n';
  };
  std::string out = fmt::format(
      "# vtk DataFile Version 3.0\nparticles\nBINARY\nDATASET POLYDATA\nPOINTS {} float\n", n);
  vectors(out, {columns.find("x"), columns.find("y"), columns.find("z")});
  out += fmt::format("POINT_DATA {}\n", n);
  const std::array velocity{columns.find("vx"), columns.find("vy"), columns.find("vz")};
  if (velocity[0] != nullptr || velocity[1] != nullptr || velocity[2] != nullptr) {
    out += "VECTORS v float\n";
    vectors(out, velocity);
  }
  for (const auto& [name, values] : columns) {
    if (name->size() == 1 || *name == "vx" || *name == "vy" || *name == "vz") continue;
    out += fmt::format("SCALARS {} float 1\nLOOKUP_TABLE default\n", *name);
    for (const double value : *values) put_big_endian(out, value);
    out += '\n';
  }
  return out;
}

double six_digits(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const int digits = 5 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  const double scale = std::pow(10., std::abs(digits));
  return digits >= 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
}

}  // namespace

void write_dump(const std::filesystem::path& path, DumpForm form, const Snapshot& snapshot,
                const Request& request) {
  const Columns columns(snapshot, request);
  const auto bytes = form == DumpForm::text     ? text_of(snapshot, columns)
                     : form == DumpForm::binary ? binary_of(snapshot, columns)
                                                : vtk_of(snapshot, columns);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw FileError("{}: cannot be written", path.string());
}

void round_as(DumpForm form, Snapshot& snapshot) {
  if (form == DumpForm::as_it_is || form == DumpForm::binary) return;
  for (auto& column : snapshot.columns)
    for (double& value : column)
      value = form == DumpForm::vtk ? static_cast<double>(static_cast<float>(value))
                                    : six_digits(value);
}

const char* name_of(DumpForm form) {
  switch (form) {
    case DumpForm::text:
      return "dumps as text, six digits";
    case DumpForm::binary:
      return "dumps in binary, double precision";
    case DumpForm::vtk:
      return "dumps in binary VTK, single precision";
    default:
      return "dumps as they are";
  }
}

}  // namespace bedscope::readers
