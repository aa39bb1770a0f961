// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bed_tables.hpp"

#include <fmt/ranges.h>

#include <cstdint>

#include "analysis/bubbles.hpp"
#include "analysis/csv.hpp"
#include "analysis/table_parts.hpp"

namespace bedscope::analysis {
namespace {

void write_bed_height(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,time [s],height [m],height_solids [m],height_surface [m],expansion [-]");
  for (const RunResult& run : runs)
    for (const BedHeightSample& bed : run.bed.samples)
      table.row(run.label, shown_time(run, bed.time), bed.by_centre, bed.by_solids, bed.surface,
                bed.expansion);
  table.commit();
}

void write_bubbles(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,time [s],bubble,track,x [m],z [m],area [m2],diameter [m],aspect [-],"
                  "voidage [-],velocity_x [m/s],velocity_z [m/s],at_wall,parents");
  for (const RunResult& run : runs) {
    if (!run.bubbles) continue;
    for (const Cluster& b : run.bubbles->bubbles)
      table.row(run.label, shown_time(run, b.time), b.cluster, b.track, b.centre.x, b.centre.z,
                b.area, equivalent_diameter(b), aspect_ratio(b), b.holdup, b.track_velocity_x,
                b.track_velocity_z, static_cast<int>(b.at_wall),
                fmt::format("{}", fmt::join(b.parents, ";")));
  }
  table.commit();
}

void write_bubble_profile(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,height [m],band [m],bubbles [-],bubbles_ci95 [-],diameter [m],"
                  "diameter_ci95 [m],velocity_z [m/s],velocity_z_ci95 [m/s],frequency [1/s],"
                  "frequency_ci95 [1/s],area_fraction [-],area_fraction_ci95 [-]");
  for (const RunResult& run : runs) {
    if (!run.bubbles) continue;
    for (const BubbleBand& band : run.bubbles->bands)
      table.row(run.label, band.height, band.width, band.number.value, band.number.ci95,
                band.diameter.value, band.diameter.ci95, band.velocity.value, band.velocity.ci95,
                band.frequency.value, band.frequency.ci95, band.area_fraction.value,
                band.area_fraction.ci95);
  }
  table.commit();
}

void write_spectrum(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,signal,unit,frequency [Hz],psd [unit2/Hz],psd_lo [unit2/Hz],"
                  "psd_hi [unit2/Hz]");
  for (const RunResult& run : runs)
    for (const Fluctuation& one : run.fluctuations)
      for (std::size_t k = 0; k < one.spectrum.frequency.size(); ++k)
        table.row(run.label, one.signal, one.unit, one.spectrum.frequency[k],
                  one.spectrum.density[k], one.spectrum.low[k], one.spectrum.high[k]);
  table.commit();
}

void write_fluctuation(std::span<const RunResult> runs, const std::filesystem::path& path) {
  CsvWriter table(path,
                  "run,signal,unit,samples,mean [unit],mean_ci95 [unit],std [unit],std_ci95 [unit],"
                  "dominant_frequency [Hz],dominant_frequency_half_width [Hz],resolution [Hz],"
                  "segments,degrees_of_freedom");
  for (const RunResult& run : runs)
    for (const Fluctuation& f : run.fluctuations)
      table.row(run.label, f.signal, f.unit, static_cast<std::int64_t>(f.samples), f.mean.value,
                f.mean.ci95, f.deviation.value, f.deviation.ci95, f.dominant.value, f.dominant.ci95,
                f.spectrum.resolution, f.spectrum.segments, f.spectrum.degrees_of_freedom);
  table.commit();
}

}  // namespace

void write_bed_tables(std::span<const RunResult> runs, const std::filesystem::path& folder) {
  const auto bed = [](const RunResult& run) { return !run.bed.samples.empty(); };
  const auto bubbles = [](const RunResult& run) { return run.bubbles.has_value(); };
  const auto signals = [](const RunResult& run) { return !run.fluctuations.empty(); };
  write_or_remove(runs, folder / "bed_height.csv", bed, write_bed_height);
  write_or_remove(runs, folder / "bubbles.csv", bubbles, write_bubbles);
  write_or_remove(runs, folder / "bubble_profile.csv", bubbles, write_bubble_profile);
  write_or_remove(runs, folder / "spectrum.csv", signals, write_spectrum);
  write_or_remove(runs, folder / "fluctuation.csv", signals, write_fluctuation);
}

}  // namespace bedscope::analysis
