// SPDX-License-Identifier: BSD-3-Clause
// The gas side of a run: fields on a mesh at ascending times, whatever is on disk behind it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readers/gas_form.hpp"
#include "readers/openfoam_case.hpp"

namespace bedscope::readers {

using GasOptions = OpenFoamOptions;

/// All reading is const, thread-safe, and keeps no file open.
class GasSeries {
 public:
  /// An OpenFOAM case, or what foamToVTK and others made of one (vtk_gas.hpp).
  /// Throws what OpenFoamCase::open and open_vtk_gas do.
  static GasSeries open(const std::string& path, const GasOptions& options = {});

  const std::string& path() const { return path_; }
  const std::vector<GasTime>& times() const { return form_->times(); }
  const std::vector<std::string>& fields_at(std::size_t time) const {
    return times().at(time).fields;
  }
  bool has(std::size_t time, std::string_view field) const;
  /// The same object for times that share a mesh.
  std::shared_ptr<const Mesh> mesh_at(std::size_t time) const { return form_->mesh_at(time); }
  /// One field, values in the order of the mesh. `out` is re-used.
  /// Throws InputError for a field that is not there, FormatError for one that is wrong or has not
  /// as many components as asked for.
  void read(std::size_t time, std::string_view field, unsigned components, FieldValues& out) const;
  /// The files that read() opens.
  std::vector<std::string> files(std::size_t time, std::string_view field) const {
    return form_->files(time, field);
  }
  const std::vector<std::string>& problems() const { return form_->problems(); }

 private:
  GasSeries(std::string path, std::shared_ptr<const GasForm> form)
      : path_(std::move(path)), form_(std::move(form)) {}
  std::string path_;
  std::shared_ptr<const GasForm> form_;
};

}  // namespace bedscope::readers
