// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/bed_tables.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "analysis/bubbles.hpp"
#include "analysis/csv.hpp"
#include "analysis/output_file.hpp"

namespace bedscope::analysis {
namespace {

double shown_time(const RunResult& run, double time) {
  return run.time_known ? time : std::numeric_limits<double>::quiet_NaN();
}

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

template <class Row, class Member>
std::vector<double> numbers(const std::vector<Row>& rows, Member member) {
  std::vector<double> result;
  for (const Row& row : rows) result.push_back(std::invoke(member, row));
  return result;
}

void write_profile(Hdf5Group group, const std::vector<BubbleBand>& bands) {
  group.write("height", numbers(bands, &BubbleBand::height), "m");
  group.write("band", numbers(bands, &BubbleBand::width), "m");
  const auto write = [&](const std::string& name, Estimate BubbleBand::*member, const char* unit) {
    group.write(name, numbers(bands, [&](const auto& band) { return (band.*member).value; }), unit);
    group.write(name + "_ci95",
                numbers(bands, [&](const auto& band) { return (band.*member).ci95; }), unit);
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
  const auto write = [&](const char* name, const Estimate& estimate, const std::string& unit) {
    group.write(name, std::array{estimate.value, estimate.ci95}, unit);
  };
  write("mean", one.mean, one.unit);
  write("std", one.deviation, one.unit);
  write("dominant_frequency", one.dominant, "Hz");
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

void write_bed_tables(std::span<const RunResult> runs, const std::filesystem::path& folder) {
  const auto table = [&](const char* name, auto&& has, auto&& write) {
    const auto path = folder / name;
    std::any_of(runs.begin(), runs.end(), has) ? write(runs, path) : remove_file(path);
  };
  const auto bed = [](const RunResult& run) { return !run.bed.samples.empty(); };
  const auto bubbles = [](const RunResult& run) { return run.bubbles.has_value(); };
  const auto signals = [](const RunResult& run) { return !run.fluctuations.empty(); };
  table("bed_height.csv", bed, write_bed_height);
  table("bubbles.csv", bubbles, write_bubbles);
  table("bubble_profile.csv", bubbles, write_bubble_profile);
  table("spectrum.csv", signals, write_spectrum);
  table("fluctuation.csv", signals, write_fluctuation);
}

void write_bed_groups(Hdf5Group& group, const RunResult& run) {
  if (!run.bed.samples.empty()) {
    Hdf5Group bed = group.group("bed_height");
    const auto write = [&](const char* name, double BedHeightSample::*member, const char* unit) {
      bed.write(name, numbers(run.bed.samples, member), unit);
    };
    bed.attribute("at_rest", run.bed.at_rest);
    bed.write(
        "time",
        numbers(run.bed.samples, [&](const auto& sample) { return shown_time(run, sample.time); }),
        "s");
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
