// SPDX-License-Identifier: BSD-3-Clause
// What the analysis of one run gives: plain data, written by tables, results_file and summary,
// drawn by report, judged by validation. Undefined values are NaN.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analysis/bed_result.hpp"
#include "analysis/cluster_result.hpp"
#include "analysis/estimate.hpp"
#include "analysis/gas_result.hpp"
#include "analysis/grid.hpp"

namespace bedscope::analysis {

/// A time-averaged curve: holdup [-], solids velocity along `up` [m/s], mass flux [kg/m2/s] at
/// `coordinate` (cell centres [m]); all vectors of one length.
struct Profile {
  std::vector<double> coordinate;
  std::vector<Estimate> holdup, velocity_z, mass_flux_z;
};

/// Time-averaged fields on the grid, one value a cell, lateral fastest.
/// Velocities are <phi v>/<phi> (NaN where no solids were seen), mass fluxes rho <phi v> (NaN
/// throughout where no density is known).
struct MeanFields {
  std::vector<double> holdup, velocity_x, velocity_z, mass_flux_x, mass_flux_z;
};

/// Everything averaged over the window for one type: "all", a LIGGGHTS type, or a rule's name.
struct SpeciesResult {
  std::string type;
  Profile axial;
  std::vector<Profile> lateral;  ///< one for each of RunResult::heights
  MeanFields fields;
  std::vector<Estimate> axial_temperature;   ///< of the solids, <v T>/<v> by layer [K]; or empty
  std::vector<double> temperature_pdf;       ///< [-], per bin; empty without a temperature range
  std::vector<double> temperature_pdf_ci95;  ///< half-widths; empty where not known
  double temperature_outside = 0;            ///< share of particles outside that range
};

/// A row for each snapshot of the dump, inside and outside the window.
struct InventorySample {
  double time = 0;  ///< [s]
  std::string type;
  std::int64_t particles = 0;
  double solids_mass = 0;  ///< [kg]
  double holdup = 0;       ///< of the whole domain [-]
  double mean_height = 0;  ///< of the centre of mass [m]
};

struct TemperatureSample {
  double time = 0;
  std::string type;
  double mean = 0, std = 0, min = 0, max = 0;  ///< over particles [K]; std divides by N
};

struct OccurrenceSample {
  double time = 0;  ///< [s]
  int clusters = 0;
  double area_fraction = 0;  ///< of the domain's front area [-]
};

template <class Archive>
void archive(Archive& ar, OccurrenceSample& sample) {
  auto& [time, clusters, area_fraction] = sample;
  ar(time, clusters, area_fraction);
}

/// One snapshot kept whole for the strip of snapshots.
struct Frame {
  std::size_t snapshot = 0;    ///< index into RunResult::occurrence
  double time = 0;             ///< [s]
  std::vector<double> holdup;  ///< depth-averaged, cells[lateral] x cells[up], lateral fastest
};

template <class Archive>
void archive(Archive& ar, Frame& frame) {
  auto& [snapshot, time, holdup] = frame;
  ar(snapshot, time, holdup);
}

/// The averaging window.
struct Window {
  double from = 0, to = 0;  ///< times of its first and last snapshot [s]
  std::size_t first = 0;    ///< index of its first snapshot
  std::size_t snapshots = 0;
  bool automatic = false;  ///< chosen by `average = "auto"`
  bool steady = true;      ///< false where `auto` found no steady part
};

struct RunResult {
  std::string label;
  Grid grid;
  std::string mapping = "exact";
  bool domain_assumed = false;  ///< taken from the dump's box: say so beside every holdup
  bool time_known = true;       ///< false: `time` counts steps, and is written as nan
  bool density_known = true;

  Window window;
  std::vector<std::string> types;      ///< "all" first
  std::vector<SpeciesResult> species;  ///< in the order of `types`
  std::vector<double> heights;         ///< of the lateral profiles [m]
  double band = 0;                     ///< full height of their band [m]

  std::vector<InventorySample> inventory;
  std::vector<TemperatureSample> temperature;
  double temperature_from = 0, temperature_to = 0;  ///< made 0 and 1 in the PDF [K]
  ClusterThresholds thresholds;
  std::vector<OccurrenceSample> occurrence;  ///< every snapshot
  std::vector<Cluster> clusters;             ///< inside the window, by snapshot
  BedHeight bed;
  std::optional<Bubbles> bubbles;         ///< where the study asks for them
  std::vector<Fluctuation> fluctuations;  ///< of the signals that the study asks for
  std::vector<Signal> series;             ///< other quantities in time, of a run given as tables
  std::vector<Frame> frames;              ///< a few snapshots of the window, evenly spread

  GasResult gas;

  Estimate mean_holdup;      ///< of the domain, over the window [-]
  Estimate inventory_mass;   ///< over the window [kg]
  Estimate mean_occurrence;  ///< clusters a snapshot
  Estimate bed_voidage;      ///< 1 - solids / bed volume, the bed being twice the mean height [-]
  double independent_samples = 0;  ///< of the mean holdup
  double outside_fraction = 0;     ///< share of the solids volume outside the domain, in the window
  std::uint64_t bytes_read = 0;    ///< for all its snapshots, now or by an earlier analysis
  std::size_t snapshots_kept = 0;  ///< so many were not read again: an earlier analysis kept them
  double seconds = 0;
  std::vector<std::string> inputs;    ///< files read, for the hash in the summary
  std::vector<std::string> problems;  ///< one line each, for people
};

}  // namespace bedscope::analysis
