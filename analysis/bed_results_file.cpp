// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bed_results_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/hdf5_rows.hpp"

namespace bedscope::analysis {
namespace {

void write_profile(Hdf5Group group, const std::vector<BubbleBand>& bands) {
  group.write("height", numbers(bands, &BubbleBand::height), "m");
  group.write("band", numbers(bands, &BubbleBand::width), "m");
  const auto write = [&](const char* name, Estimate BubbleBand::*member, const char* unit) {
    std::vector<Estimate> curve;
    curve.reserve(bands.size());
    for (const BubbleBand& band : bands) curve.push_back(band.*member);
    write_curve(group, name, curve, unit);
  };
  write("bubbles", &BubbleBand::number, "-");
  write("diameter", &BubbleBand::diameter, "m");
  write("velocity_z", &BubbleBand::velocity, "m/s");
  write("frequency", &BubbleBand::frequency, "1/s");
  write("area_fraction", &BubbleBand::area_fraction, "-");
}

void write_fluctuation_group(Hdf5Group group, const Fluctuation& one) {
  group.attribute("signal", one.signal);
  group.attribute("unit", one.unit);
  write_estimate(group, "mean", one.mean, one.unit);
  write_estimate(group, "std", one.deviation, one.unit);
  write_estimate(group, "dominant_frequency", one.dominant, "Hz");
  group.attribute("segments", static_cast<std::int64_t>(one.spectrum.segments));
  group.attribute("degrees_of_freedom", one.spectrum.degrees_of_freedom);
  if (one.spectrum.frequency.empty()) return;
  const std::string density = one.unit == "-" ? "1/Hz" : one.unit + "2/Hz";
  group.write("frequency", one.spectrum.frequency, "Hz");
  group.write("psd", one.spectrum.density, density);
  group.write("psd_lo", one.spectrum.low, density);
  group.write("psd_hi", one.spectrum.high, density);
}

}  // namespace

void write_bed_groups(Hdf5Group& group, const RunResult& run) {
  if (!run.bed.samples.empty()) {
    Hdf5Group bed = group.group("bed_height");
    const auto write = [&](const char* name, double BedHeightSample::*member, const char* unit) {
      bed.write(name, numbers(run.bed.samples, member), unit);
    };
    bed.attribute("at_rest", run.bed.at_rest);
    bed.write("time", times(run, run.bed.samples), "s");
    write("height", &BedHeightSample::by_centre, "m");
    write("height_solids", &BedHeightSample::by_solids, "m");
    write("height_surface", &BedHeightSample::surface, "m");
    write("expansion", &BedHeightSample::expansion, "-");
  }
  if (run.bubbles) write_profile(group.group("bubble_profile"), run.bubbles->bands);
  if (run.fluctuations.empty()) return;
  Hdf5Group all = group.group("fluctuations");
  for (std::size_t i = 0; i < run.fluctuations.size(); ++i)
    write_fluctuation_group(all.group(std::to_string(i + 1)), run.fluctuations[i]);
}

}  // namespace bedscope::analysis
