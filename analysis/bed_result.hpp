// SPDX-License-Identifier: BSD-3-Clause
// What the analysis of a bed gives beside the averages: its height, its bubbles, its fluctuations.
// Plain data; undefined values are NaN.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "analysis/cluster_result.hpp"
#include "analysis/estimate.hpp"

namespace bedscope::analysis {

/// The height of the bed in one snapshot, above the domain's floor [m]; see bed_height.hpp.
struct BedHeightSample {
  double time = 0;       ///< [s]
  double by_centre = 0;  ///< twice the height of the centre of mass
  double by_solids = 0;  ///< below which 95 % of the solids inside the domain lie
  double surface = 0;    ///< where the holdup falls below half that of the bed
  double expansion = 0;  ///< by_centre / height at rest [-]
};

struct BedHeight {
  bool asked = false;  ///< the study speaks of a bed: worth a figure
  double at_rest = 0;  ///< [m]; of the study, or of the first snapshot with solids
  std::vector<BedHeightSample> samples;  ///< every snapshot
  Estimate by_centre, surface;           ///< over the window [m]
  Estimate expansion;                    ///< over the window [-]
};

/// The bubbles around one height.
struct BubbleBand {
  double height = 0, width = 0;  ///< its middle and its full height [m]
  Estimate number;               ///< of bubbles with their centroid in it, a snapshot [-]
  Estimate diameter;             ///< mean over these [m]
  Estimate velocity;             ///< of rise, mean over these [m/s]
  Estimate frequency;            ///< of bubbles that pass its middle upwards [1/s]
  Estimate area_fraction;        ///< of the band that bubbles cover [-]
};

struct Bubbles {
  ClusterThresholds thresholds;
  std::vector<Cluster> bubbles;  ///< inside the window, by snapshot
  std::vector<BubbleBand> bands;
  Estimate number, diameter, velocity;  ///< over the bed and the window
};

/// Power spectral density, one-sided; see spectrum.hpp.
struct Spectrum {
  std::vector<double> frequency;  ///< [Hz], from 0
  std::vector<double> density;    ///< [unit2/Hz]
  std::vector<double> low, high;  ///< bounds of its 95 % interval
  int segments = 0;
  double resolution = std::numeric_limits<double>::quiet_NaN();  ///< 1 / duration of a segment [Hz]
  double degrees_of_freedom = std::numeric_limits<double>::quiet_NaN();
};

/// A quantity at ascending times [s].
struct Signal {
  std::string name, unit;
  std::vector<double> times, values;
};

/// How one signal fluctuates over the window.
struct Fluctuation {
  std::string signal, unit;
  std::size_t samples = 0;
  Estimate mean;
  Estimate deviation;  ///< standard deviation
  Estimate dominant;   ///< frequency of the largest density and the half-width of its peak [Hz]
  Spectrum spectrum;   ///< empty where the signal is constant or short
};

}  // namespace bedscope::analysis
