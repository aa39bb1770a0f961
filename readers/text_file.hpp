// SPDX-License-Identifier: BSD-3-Clause
// A file of text that is read as a whole: studies, sidecars, indices, tables.
#pragma once

#include <cstddef>
#include <string>

namespace bedscope::readers {

/// The text of a regular file, plain or gzip. Throws FormatError where it is longer than `most`
/// bytes, CutError where its gzip stream is cut, FileError (a pipe would be waited for, a device
/// never ends).
std::string read_text(const std::string& path, std::size_t most = ~std::size_t{0});

}  // namespace bedscope::readers
