// SPDX-License-Identifier: BSD-3-Clause
// summary.json: the few numbers of each run, for scripts and CI, documented in docs/results.md.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "analysis/result.hpp"

namespace bedscope::analysis {

/// The summary as JSON text, indented, ending in a line break; `checks` is empty. What is undefined
/// (NaN) is null. Bytes that are no UTF-8 (paths may have them) become U+FFFD.
std::string summary_text(std::span<const RunResult> runs);

/// Writes summary_text to a file. Throws FileError.
void write_summary(std::span<const RunResult> runs, const std::filesystem::path& path);

/// A fingerprint of input files, 16 hexadecimal digits: 64-bit FNV-1a (Fowler, Noll and Vo) over,
/// for each file in order, its name without the folder, a zero byte, its size (8 bytes, low byte
/// first), its first and its last 4096 bytes (the whole file once, up to 8192). It costs two small
/// reads a file; a change in the middle of a file that keeps its size goes unnoticed.
/// Empty where a file cannot be read, or there is none.
std::string fingerprint(const std::vector<std::string>& files);

}  // namespace bedscope::analysis
