// SPDX-License-Identifier: BSD-3-Clause
// The gas side of a run: fields on a mesh at ascending times, whatever is on disk behind it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_case.hpp"

namespace bedscope::readers {

using GasOptions = OpenFoamOptions;
using GasTime = OpenFoamTime;

/// All reading is const, thread-safe, and keeps no file open.
class GasSeries {
 public:
  /// Throws what OpenFoamCase::open does.
  static GasSeries open(const std::string& path, const GasOptions& options = {}) {
    return {path, OpenFoamCase::open(path, options)};
  }

  const std::string& path() const { return path_; }
  const std::vector<GasTime>& times() const { return case_.times(); }
  const std::vector<std::string>& fields_at(std::size_t time) const {
    return case_.fields_at(time);
  }
  bool has(std::size_t time, std::string_view field) const;
  bool moving() const { return case_.moving(); }  ///< is the mesh not the same at all times?
  std::shared_ptr<const Mesh> mesh_at(std::size_t time) const { return case_.mesh_at(time); }
  /// One field, values in the order of the mesh. `out` is re-used.
  /// Throws InputError for a field that is not there, FormatError for one that is wrong or has not
  /// as many components as asked for.
  void read(std::size_t time, std::string_view field, unsigned components, FieldValues& out) const;
  /// The files that read() opens.
  std::vector<std::string> files(std::size_t time, std::string_view field) const {
    return case_.files(time, field);
  }
  const std::vector<std::string>& problems() const { return case_.problems(); }

 private:
  GasSeries(std::string path, OpenFoamCase foam) : path_(std::move(path)), case_(std::move(foam)) {}
  std::string path_;
  OpenFoamCase case_;
};

}  // namespace bedscope::readers
