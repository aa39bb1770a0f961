// SPDX-License-Identifier: BSD-3-Clause
// A snapshot written in another form, to measure what reading that form would cost. Not a
// converter: only what an analysis asked for is written.
#pragma once

#include <filesystem>

#include "readers/snapshot.hpp"

namespace bedscope::readers {

enum class DumpForm {
  as_it_is,
  text,    ///< `dump custom` of LIGGGHTS, values of six significant digits
  binary,  ///< the same in binary, values in double precision
  vtk,     ///< legacy VTK in binary, values in single precision
};

/// Writes the columns of `snapshot` (those of `request` that are not empty; x, y, z among them)
/// and, as velocity components that were not read, zeros. Throws FileError.
void write_dump(const std::filesystem::path& path, DumpForm form, const Snapshot& snapshot,
                const Request& request);

/// What such a file would give back: the values rounded as the form does; ids and types are whole.
void round_as(DumpForm form, Snapshot& snapshot);

/// How the form is called: "text, six digits".
const char* name_of(DumpForm form);

}  // namespace bedscope::readers
