// SPDX-License-Identifier: BSD-3-Clause
// How the signals of a run fluctuate: those that the analysis makes itself, and pressure probes.
#pragma once

#include <string>
#include <vector>

#include "analysis/result.hpp"
#include "analysis/run_setup.hpp"

namespace bedscope::analysis {

/// Mean and standard deviation with 95 % intervals that take the correlation in time into account,
/// and the power spectral density where the signal is neither constant nor short (least_record).
///
/// The deviation is that from the mean, no trend taken off: sqrt of the mean of (x - mean)^2, its
/// interval that of this mean divided by twice the deviation. `segment`: length of the spectrum's
/// segments [s], 0: segment_length(). Samples that are not evenly spaced to 1 % of their mean gap
/// are interpolated linearly to as many that are, and `problems` says so.
/// `signal` has at least one sample and finite values only.
Fluctuation fluctuation_of(const Signal& signal, double segment,
                           std::vector<std::string>& problems);

/// Fills result.fluctuations from the series in `result`, which is otherwise complete, and from the
/// pressure probes of the study, each over the averaging window; nothing where the study asks for
/// neither. Probes: field p [Pa], or p/rho where the study gives gas_density.
/// Throws what readers throw for the probes.
void add_fluctuations(const RunSetup& setup, RunResult& result);

}  // namespace bedscope::analysis
