// SPDX-License-Identifier: BSD-3-Clause
// The choices of an analysis that cost time and may cost accuracy: which there are for a run, and
// the settings with which each is analysed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/run_setup.hpp"
#include "readers/rewrite.hpp"

namespace bedscope::analysis {

/// One way to map snapshots. How many of them are taken is another choice: see choice_sums.hpp.
struct Variant {
  std::string name;  ///< "exact, cells x 2"
  std::string mapping = "exact";
  int coarser = 1;  ///< cells so many times as wide as the study's
  readers::DumpForm form = readers::DumpForm::as_it_is;  ///< in which the dumps would be
  RunSettings settings;
  /// False for what is shown only: other thresholds are another definition, the form is the
  /// dumps', and a third dimension beyond the study's is not cheaper.
  bool candidate = true;
  bool present = false;  ///< the study's own
};

/// By how much the cells of a grid can be widened: the whole numbers up to 8 that divide the
/// numbers of cells across and up, and leave at least three cells across and four up. 1 is one.
std::vector<int> fitting_multiples(const Grid& grid);

/// The finest first: exact mapping on the study's cells. Then `centre` and the study's own mapping
/// on cells so many times as wide as `multiples` say, the other mappings on the study's cells, the
/// other number of dimensions, other forms of dumps, and cluster thresholds a tenth lower and
/// higher (area: half and twice). Heights, band and domain are the study's in all of them.
std::vector<Variant> variants_of(const RunSetup& study, std::span<const int> multiples);

/// Every how many snapshots may be taken in a window of so many: each of its sixteen blocks (see
/// choice_sums.hpp) must keep one.
std::vector<int> thinnings(std::size_t snapshots);

}  // namespace bedscope::analysis
