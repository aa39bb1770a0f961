// SPDX-License-Identifier: BSD-3-Clause
// Ghost points of a VTK XML file: copies of points that another file of the snapshot owns.
// Source: vtkDataSetAttributes::PointGhostTypes; vtkGhostLevels is that array before
// VTK 6.3.
#include "readers/vtk_xml.hpp"

namespace bedscope::readers::vtk_xml_file {

std::vector<bool> ghost_points(const Document& document, Decoder& decoder) {
  constexpr unsigned duplicate = 1;
  std::vector<bool> ghosts;
  std::vector<double> values;
  std::size_t row = 0;
  for (const Piece& piece : document.pieces) {
    const DataArray* types = find(piece.point_data, "vtkGhostType");
    const DataArray* levels = find(piece.point_data, "vtkGhostLevels");
    if (piece.points > 0 && (types != nullptr || levels != nullptr)) {
      decoder.decode(types != nullptr ? *types : *levels, piece.points, values);
      ghosts.resize(document.points());
      for (std::size_t i = 0; i < values.size(); ++i) {
        const bool small = values[i] >= 0 && values[i] <= 255;
        ghosts[row + i] = types == nullptr
                              ? values[i] > 0
                              : small && (static_cast<unsigned>(values[i]) & duplicate);
      }
    }
    row += piece.points;
  }
  return ghosts;
}

}  // namespace bedscope::readers::vtk_xml_file
