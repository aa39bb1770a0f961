// SPDX-License-Identifier: BSD-3-Clause
#include "readers/forms.hpp"
namespace bedscope::readers {
extern const Form vtk_xml;
const Form vtk_xml{.name = "vtk-xml",
                   .description = "",
                   .reference = "",
                   .matches = [](std::string_view) { return false; },
                   .scan = nullptr,
                   .read = nullptr};
}  // namespace bedscope::readers
