// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/kept_run.hpp"

#include <map>
#include <utility>

#include "readers/archive.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::string_view kind = "bedscope state of a run, version 1\n";

/// The names make the compiler ask about each setting that is added.
template <class Archive>
void archive_settings(Archive& ar, RunSettings& settings) {
  auto& [label, particles, repeated, time_step, time_required, step_zero, domain, up_axis,
         lateral_axis, cell, cells, periodic, density, radius, species, average, mapping, heights,
         band, clusters, temperature_column, temperature, temperature_bins] = settings;
  // Not those that only decide which dumps, their times or their weights: these are compared
  // themselves. Not the label.
  ar(repeated, domain, up_axis, lateral_axis, cell, cells, periodic, density, radius, species,
     mapping, heights, band, clusters, temperature_column, temperature, temperature_bins);
  bool automatic = !average;
  ar(automatic);
}

template <class Archive>
void archive_setup(Archive& ar, RunSetup& setup) {
  auto& [settings, grid, kernel, request, request_without_id, domain_assumed, has_velocity,
         radius_in_dumps, has_temperature, times, time_known, time_step, half_step, density_from,
         density, heights, band, band_weights, problems] = setup;
  archive_settings(ar, settings);
  auto& [min, max, cells, periodic] = grid;
  ar(min, max, cells, periodic);
  for (auto& column : request) ar(column.name, column.required);
  ar(domain_assumed, has_velocity, radius_in_dumps, has_temperature, time_known, density_from,
     density, heights, band, band_weights);
}

}  // namespace

std::string fingerprint_of(const RunSetup& setup, bool pictures) {
  readers::ArchiveWriter writer;
  auto copy = setup;
  archive_setup(writer, copy);
  // Another build may compute otherwise. Whoever copies the program makes it another one.
  const std::filesystem::path program = "/proc/self/exe";
  std::error_code ignored;
  auto size = std::filesystem::file_size(program, ignored);
  auto time = std::filesystem::last_write_time(program, ignored).time_since_epoch().count();
  writer(size, time, pictures);
  return writer.bytes();
}

SeriesMark mark_of(const readers::Series& series, const RunSetup& setup) {
  SeriesMark mark;
  if (series.form().matches_folder != nullptr) return mark;  // says nothing of its files
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto& path = series.path(i);
    const auto [at, is_new] = numbers.try_emplace(path, mark.files.size());
    if (is_new) mark.files.push_back(readers::mark_of(path));
    const auto& located = series.located(i);
    mark.snapshots.push_back(
        {at->second, series.step(i), setup.times[i], located.offset, located.bytes});
  }
  // All-in-one dumps may grow; of the others each holds one snapshot, and shall not change.
  std::vector<std::size_t> held(mark.files.size());
  std::vector<std::uint64_t> end(mark.files.size());
  for (const auto& snapshot : mark.snapshots) {
    ++held[snapshot.file];
    end[snapshot.file] = std::max(end[snapshot.file], snapshot.offset + snapshot.bytes);
  }
  for (std::size_t k = 0; k < mark.files.size(); ++k)
    if (held[k] > 1 || (mark.files.size() == 1 && series.form().extend != nullptr))
      readers::let_grow(mark.files[k], end[k]);
  return mark;
}

std::size_t unchanged(const SeriesMark& then, const SeriesMark& now) {
  using readers::Change;
  std::vector<std::optional<Change>> changes(then.files.size());
  std::size_t i = 0;
  for (; i < then.snapshots.size() && i < now.snapshots.size(); ++i) {
    const auto &a = then.snapshots[i], &b = now.snapshots[i];
    if (a.file >= changes.size() || a.step != b.step || a.time != b.time || a.offset != b.offset)
      break;
    auto& change = changes[a.file];
    if (!change) change = readers::change_since(then.files[a.file], now.files[b.file]);
    if (*change == Change::other || (*change == Change::grown && a.bytes != b.bytes)) break;
    if (then.files[a.file].path != now.files[b.file].path) break;
  }
  return i;
}

std::string KeptRun::adapt(std::string fingerprint_now, SeriesMark dumps_now) {
  std::string why;
  const bool any = whole.snapshots() > 0 || whole.last;
  const auto same = unchanged(dumps, dumps_now);
  if (fingerprint != fingerprint_now) {
    if (any) why = "other settings, or another build of the program";
    whole.begin();
    window.begin();
    frames.clear();
  }
  for (auto* pass : {&whole, &window}) {
    if (pass->last && pass->last->snapshot >= same) pass->last.reset();
    if (pass->snapshots() <= same) continue;
    pass->begin();
    if (!why.empty() || same >= dumps.snapshots.size()) continue;
    const auto& changed = dumps.snapshots[same];
    why = fmt::format("{}: step {} is not what it was, or no longer there",
                      dumps.files[changed.file].path, changed.step);
  }
  std::erase_if(frames, [&](const Frame& frame) { return frame.snapshot >= same; });
  fingerprint = std::move(fingerprint_now);
  dumps = std::move(dumps_now);
  return why;
}

void KeptRun::load(const std::filesystem::path& path) {
  readers::ArchiveReader reader(path, kind);
  archive(reader);
  reader.finish();
}

std::uint64_t KeptRun::save(const std::filesystem::path& path) {
  readers::ArchiveWriter writer(path, kind);
  archive(writer);
  writer.finish();
  return writer.size();
}

}  // namespace bedscope::analysis
