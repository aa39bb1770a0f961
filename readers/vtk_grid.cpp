// SPDX-License-Identifier: BSD-3-Clause
#include "readers/vtk_grid.hpp"

#include "readers/source.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers {
namespace {

constexpr std::string_view legacy = "# vtk DataFile Version";

}  // namespace

bool is_vtk_grid(std::string_view head) {
  if (head.starts_with(legacy)) return head.find("UNSTRUCTURED_GRID") != head.npos;
  return xml_root_type(head) == "UnstructuredGrid";
}

std::shared_ptr<const VtkGrid> open_vtk_grid(const std::string& path) {
  const auto head = read_head(path);
  if (!is_vtk_grid(head)) return nullptr;
  return head.starts_with(legacy) ? open_legacy_grid(path) : open_xml_grid(path);
}

}  // namespace bedscope::readers
