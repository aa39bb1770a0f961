// SPDX-License-Identifier: BSD-3-Clause
// What a form of gas on disk gives: fields on a mesh at ascending times. openfoam_case.hpp and
// vtk_gas.hpp are the two that there are.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_field.hpp"
#include "readers/openfoam_mesh.hpp"

namespace bedscope::readers {

struct GasTime {
  std::string name;                 ///< of its directory in a case: 0.1, 1e-05, 2.000e-03
  double time;                      ///< [s]
  std::vector<std::string> fields;  ///< fields of cells, in alphabetic order
};

/// A line for each field that is there and later is not: a run adds fields, and does not stop to.
/// One that only the first time has was read, not written.
std::vector<std::string> missing_fields(const std::string& path, const std::vector<GasTime>& times);

/// All reading is const, thread-safe, and keeps no file open.
class GasForm {
 public:
  virtual ~GasForm() = default;

  virtual const std::vector<GasTime>& times() const = 0;  ///< ascending
  /// The same object for times that share a mesh.
  virtual std::shared_ptr<const Mesh> mesh_at(std::size_t time) const = 0;
  /// Reads one field, values in the order of the mesh. `out` is re-used.
  /// Throws InputError for a field that is not there, FormatError for one that is wrong.
  virtual void read(std::size_t time, std::string_view field, FieldValues& out) const = 0;
  /// The files that read() opens.
  virtual std::vector<std::string> files(std::size_t time, std::string_view field) const = 0;
  virtual const std::vector<std::string>& problems() const = 0;
};

}  // namespace bedscope::readers
