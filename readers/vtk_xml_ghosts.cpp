// SPDX-License-Identifier: BSD-3-Clause
// Ghost points of a VTK XML file.
#include "readers/vtk_common.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers::vtk_xml_file {

const DataArray* ghost_array(const Arrays& arrays) {
  const DataArray* types = find(arrays, "vtkGhostType");
  return types != nullptr ? types : find(arrays, "vtkGhostLevels");
}

std::vector<bool> ghost_points(const Document& document, Decoder& decoder) {
  std::vector<bool> ghosts;
  std::vector<double> values;
  std::size_t row = 0;
  for (const Piece& piece : document.pieces) {
    const DataArray* array = ghost_array(piece.point_data);
    if (piece.points > 0 && array != nullptr) {
      decoder.decode(*array, piece.points, values);
      ghosts.resize(document.points());
      mark_ghosts(array->name, values, row, ghosts);
    }
    row += piece.points;
  }
  return ghosts;
}

}  // namespace bedscope::readers::vtk_xml_file
