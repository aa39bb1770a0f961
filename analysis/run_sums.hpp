// SPDX-License-Identifier: BSD-3-Clause
// The serial end of the analysis: products taken in the order of the series, reduced to short
// series and to sums over the window.
#pragma once

#include <optional>
#include <vector>

#include "analysis/averages.hpp"
#include "analysis/snapshot_products.hpp"
#include "analysis/time_window.hpp"
#include "analysis/tracks.hpp"

namespace bedscope::analysis {

/// Copyable: a live analysis adds what is final, and finishes a copy.
class RunSums {
 public:
  /// `keep_blocks`: the window is chosen afterwards, so field sums stay apart in blocks.
  /// `keep_contours`: outlines of clusters are wanted (they are most of what clusters weigh).
  RunSums(const RunSetup& setup, bool keep_blocks, bool keep_contours);

  /// Takes the product of the next snapshot; `weight`: the time it stands for, 0 outside the
  /// window.
  void add(SnapshotProduct& product, double weight);

  std::size_t snapshots() const { return samples_.size(); }
  /// The first snapshot of the window that `auto` chooses, rounded up to a block.
  Window choose_window() const;

  /// Averages and their errors over `window` (which must be what the weights were for, or begin at
  /// a block where blocks were kept), into a result without label, times of work and inputs.
  /// Uses itself up: short series move into the result.
  RunResult finish(const readers::Series& series, const Window& window) &&;

  /// Whether the snapshots that it holds were added with these weights.
  bool added_with(const std::vector<double>& weights) const;

  /// Into and out of one of the same setup: see readers/archive.hpp. What add() changes is here, so
  /// that an analysis can go on where an earlier one ended; tests/analysis/resume_test.cpp finds
  /// what is missing, given dumps that show it.
  template <class Archive>
  void archive(Archive& ar) {
    ar(slots_, fields_, profiles_, histograms_, warmth_, samples_, occurrence_, clusters_, tracker_,
       bubbles_, sensitivity_, flaws_, without_temperature_, bytes_read_);
  }

 private:
  struct SlotSample {
    SolidsSum solids;
    TemperatureSum temperature;

    template <class Archive>
    void archive(Archive& ar) {
      ar(solids, temperature);
    }
  };
  struct Sample {
    std::vector<SlotSample> slots;  // by number of the slot; later ones are zero
    double volume = 0, volume_inside = 0, temperature_zero = 0;
    double weight = 0;
    BedHeights bed;

    template <class Archive>
    void archive(Archive& ar) {
      ar(slots, volume, volume_inside, temperature_zero, weight, bed);
    }
  };
  /// A name, and the slots whose sum it is.
  struct Species {
    std::string name;
    std::vector<std::size_t> slots;
  };

  std::size_t slot_number(SlotKey key);
  std::vector<double> densities() const;
  bool density_known() const { return setup_->density_from != RunSetup::Density::unknown; }
  std::vector<Species> species() const;
  void inventory_of(const Species& species, RunResult& result) const;
  void profiles_of(const Species& species, const Window& window, SpeciesResult& result,
                   std::vector<std::string>& doubts) const;
  void fields_of(const Species& species, const WeightedSum& sum, SpeciesResult& result) const;
  void pdf_of(const Species& species, const Window& window, SpeciesResult& result) const;
  void axial_temperature_of(const Species& species, const Window& window,
                            SpeciesResult& result) const;
  /// The sums of the window that were kept apart, one sample each for errors.
  std::vector<WeightedSum> samples_of(const Leaves& sums, const Window& window) const;
  void bed_of(const Window& window, RunResult& result) const;
  void means_of(const Window& window, RunResult& result) const;
  // What the sums tell of wrong input, as problems: run_doubts.cpp.
  void tell_missing(const readers::Series& series, const Window& window, RunResult& result) const;
  void tell_losses(const Window& window, RunResult& result) const;
  void tell_packing(const Window& window, RunResult& result) const;

  const RunSetup* setup_;
  bool keep_contours_;
  std::vector<SlotKey> slots_;
  Leaves fields_, profiles_, histograms_, warmth_;
  std::vector<Sample> samples_;
  std::vector<OccurrenceSample> occurrence_;
  std::vector<Cluster> clusters_;
  Tracker tracker_;
  BubbleSums bubbles_;
  ClusterSensitivity sensitivity_;
  readers::Flaws flaws_;
  std::int64_t without_temperature_ = 0;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace bedscope::analysis
