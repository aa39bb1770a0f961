// SPDX-License-Identifier: BSD-3-Clause
// Numeric lists of OpenFOAM, ascii and binary: `N ( ... )`, `N{v}`, `0()`, `0`, `( ... )`.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_dictionary.hpp"

namespace bedscope::readers {

/// How numbers lie in a file: from `format` and `arch` of its header. Without arch the usual build
/// is assumed (little-endian, 32-bit labels, 64-bit scalars) and proved by the closing parenthesis.
struct FoamLayout {
  bool binary = false;
  bool big_endian = false;
  unsigned label_bytes = 4;
  unsigned scalar_bytes = 8;
  std::string arch;  ///< as said, or "no arch: LSB;label=32;scalar=64 assumed"; for errors
};

/// Throws FormatError for sizes other than 32 and 64 bits.
FoamLayout layout_of(const FoamHeader& header, const std::string& where);

/// A type of values: name as in List<name>, numbers a value, whether ascii puts it in parentheses.
struct FoamType {
  std::string_view name;
  unsigned components;
  bool bracketed;
};
inline constexpr std::array<FoamType, 5> foam_types{{{"scalar", 1, false},
                                                     {"vector", 3, true},
                                                     {"sphericalTensor", 1, true},
                                                     {"symmTensor", 6, true},
                                                     {"tensor", 9, true}}};
/// The type of this name, or null.
const FoamType* foam_type(std::string_view name);

/// What a list must hold, where that is known before it is read.
struct FoamCount {
  std::uint64_t count;
  std::string_view whole = "mesh";  ///< "list declares 199 values, mesh has 200 cells"
  std::string_view parts = "cells";
};

/// Numbers that are nan or infinite: they must never reach a mean.
struct NonFinite {
  std::size_t values = 0;
  std::size_t first = 0;  ///< index of the first value (cell) with one
};

/// Values that follow one another in a list and in the longer one where they belong.
struct FoamRun {
  std::int32_t place;  ///< of the first
  std::int32_t count;
};

/// Where the values of a list belong in one of `size` values; all runs end within it. Runs, since
/// cells of a rank come in rows: to copy these costs a third of putting each value to its place.
struct FoamPlaces {
  std::span<const FoamRun> runs;
  std::size_t count = 0;  ///< values of all runs
  std::size_t size = 0;
  std::vector<double>* piece = nullptr;  ///< memory on the way there, kept from list to list
};

/// Reads a list of scalars, vectors ... into `out`, components of a value together; with `places`
/// into those of `out`, whose others are left as they are (and `expected` is their count). A count
/// is a claim: nothing is allocated that the file (or `expected`) cannot fill. Throws FormatError
/// naming line or offset, CutError where the file ends inside.
NonFinite read_values(FoamStream& stream, const FoamLayout& layout, const FoamType& type,
                      std::optional<FoamCount> expected, std::vector<double>& out,
                      const FoamPlaces* places = nullptr);

/// Reads a list of labels.
void read_labels(FoamStream& stream, const FoamLayout& layout, std::vector<std::int32_t>& out,
                 std::optional<FoamCount> expected = std::nullopt);

/// Reads faceList (ascii: `N ( 4(0 1 2 3) ... )`) or faceCompactList (offsets, then labels). The
/// points of face f are points[starts[f]] ... points[starts[f + 1] - 1].
void read_faces(FoamStream& stream, const FoamLayout& layout, bool compact,
                std::vector<std::int32_t>& starts, std::vector<std::int32_t>& points);

/// Steps over the list behind `List<type>`: binary ones by their count, never by looking for ")".
void skip_list(FoamStream& stream, const FoamLayout& layout, std::string_view list_type);

}  // namespace bedscope::readers
