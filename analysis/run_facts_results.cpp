// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/hdf5_file.hpp"
#include "analysis/run_facts.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

class ResultsReader {
 public:
  explicit ResultsReader(const std::filesystem::path& path)
      : path_(path.string()), file_(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (file_ < 0) throw FileError("{}: cannot be read as HDF5", path_);
    if (H5Lexists(file_, "/runs", H5P_DEFAULT) <= 0 ||
        H5Lexists(file_, "/runs/1", H5P_DEFAULT) <= 0)
      missing("/runs/1");
  }

  std::vector<double> numbers(const char* name) {
    const auto data = open(name);
    const Hdf5Handle space(H5Dget_space(data), H5Sclose);
    std::vector<double> values(static_cast<std::size_t>(few(H5Sget_simple_extent_npoints(space))));
    if (H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      missing(name);
    return values;
  }

  std::vector<std::string> texts(const char* name) {
    const auto data = open(name);
    const Hdf5Handle space(H5Dget_space(data), H5Sclose), type(H5Dget_type(data), H5Tclose);
    const auto size = H5Tget_size(type),
               count = static_cast<std::size_t>(few(H5Sget_simple_extent_npoints(space)));
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size > 4096)
      missing(name);
    std::string bytes(size * count, '\0');
    if (H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) missing(name);
    std::vector<std::string> list(count);
    for (std::size_t i = 0; i < count; ++i) list[i] = bytes.substr(i * size, size).c_str();
    return list;
  }

 private:
  [[noreturn]] void missing(const std::string& what) {
    throw FormatError("{}: expected the results of an analysis, found no readable {}", path_, what);
  }

  /// A count that memory can hold.
  hssize_t few(hssize_t points) {
    if (points < 0 || points > 100'000'000) missing("count");
    return points;
  }

  Hdf5Handle open(const char* name) {
    Hdf5Handle data(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose);
    if (data < 0) missing(name);
    return data;
  }

  std::string path_;
  Hdf5Handle file_;
};

}  // namespace

RunFacts facts_of_results(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told in one line, by us
  ResultsReader file(path);
  const auto low = file.numbers("/runs/1/grid/min"), high = file.numbers("/runs/1/grid/max");
  if (low.size() != 3 || high.size() != 3)
    throw FormatError("{}: expected a grid of three axes", path.string());
  RunFacts facts;
  for (std::size_t k = 0; k < 3; ++k) facts.extent[k] = high[k] - low[k];
  const double volume = facts.extent[0] * facts.extent[1] * facts.extent[2];
  const auto types = file.texts("/runs/1/inventory/type");
  const auto number = file.numbers("/runs/1/inventory/particles");
  const auto holdup = file.numbers("/runs/1/inventory/holdup");
  const auto mass = file.numbers("/runs/1/inventory/solids_mass");
  const auto rows = std::min({types.size(), number.size(), holdup.size(), mass.size()});
  for (std::size_t row = rows; row-- > 0;) {  // the last snapshot has a row for each type
    const auto known = [&](const auto& species) { return species.type == types[row]; };
    if (std::any_of(facts.species.begin(), facts.species.end(), known)) break;
    const double solids = holdup[row] * volume;
    RunFacts::Species s{types[row], number[row]};
    if (number[row] > 0 && solids > 0)
      s.diameter = std::cbrt(6 / std::numbers::pi * solids / number[row]);
    s.smallest = s.largest = s.diameter;
    if (std::isfinite(mass[row]) && solids > 0) s.density = mass[row] / solids;
    facts.species.insert(facts.species.begin(), s);
  }
  if (facts.species.size() > 1)  // "all" and each by itself
    std::erase_if(facts.species, [](const auto& s) { return s.type == "all"; });
  facts.remarks.emplace_back(
      "sizes are those of spheres of each type's mean volume in the last snapshot; velocities of "
      "single particles are not in results.h5");
  return facts;
}

}  // namespace bedscope::analysis
