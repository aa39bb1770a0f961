// SPDX-License-Identifier: BSD-3-Clause
// One VTK file of cells with values, legacy or XML. Internal to this room.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readers/snapshot.hpp"
#include "readers/vtk_mesh.hpp"

namespace bedscope::readers {

/// An open file: what it holds is known, values are decoded when asked for. Const calls are
/// thread-safe.
class VtkGrid {
 public:
  struct Field {
    std::string name;
    std::size_t components = 1;
  };

  virtual ~VtkGrid() = default;

  double time = unknown;      ///< [s], TimeValue
  std::vector<Field> fields;  ///< of cells
  bool binary = false, compressed = false;

  /// Tells the meshes of two times apart: equal for the same bytes of points and cells.
  virtual std::uint64_t mesh_mark() const = 0;
  virtual std::vector<VtkCells> pieces() const = 0;
  /// Components of a field, a column each, cells in the order of the pieces without ghosts.
  /// Throws FormatError.
  virtual std::vector<std::vector<double>> read(const Field& field) const = 0;
};

/// Whether a file that begins with `head` may hold cells in VTK's legacy or XML form.
bool is_vtk_grid(std::string_view head);

/// Opens a file. Null where it holds no cells with a volume. Throws FileError, FormatError,
/// CutError.
std::shared_ptr<const VtkGrid> open_vtk_grid(const std::string& path);

// The two forms, each in a file of its own.
std::shared_ptr<const VtkGrid> open_legacy_grid(const std::string& path);
std::shared_ptr<const VtkGrid> open_xml_grid(const std::string& path);

}  // namespace bedscope::readers
