// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/kept_run.hpp"

#include <algorithm>
#include <utility>

#include "readers/archive.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::string_view kind = "bedscope state of a run, version 2\n";

/// Settings by their names, as most have a neighbour of the same type. Left out are those that only
/// decide which dumps, their times or their weights: these are compared themselves; the label; and
/// what is made of the sums or beside them: spectra, probes and gas.
template <class Archive>
void archive_settings(Archive& ar, RunSettings& s) {
  ar(s.repeated, s.every, s.wanted, s.columns, s.domain, s.up, s.lateral, s.cell, s.cells,
     s.periodic, s.density, s.radius, s.species, s.mapping, s.gaussian_width, s.heights, s.band,
     s.clusters, s.bubbles, s.bed, s.height_at_rest, s.temperature_column, s.temperature,
     s.temperature_bins);
  bool automatic = !s.average;
  ar(automatic);
  // A name for each member, so that the compiler asks here about one that is added.
  [[maybe_unused]] const auto& [label, particles, every, repeated, wanted, columns, time_step,
                                time_required, step_zero, domain, up_axis, lateral_axis, cell,
                                cells, periodic, density, radius, species, average, mapping,
                                gaussian_width, heights, band, clusters, bubbles, bed, spectra,
                                height_at_rest, segment, probes, temperature_column, temperature,
                                temperature_bins, gas] = s;
}

/// What the dumps made of the settings. The rest follows from these, or is compared itself.
template <class Archive>
void archive_setup(Archive& ar, RunSetup& s) {
  archive_settings(ar, s.settings);
  ar(s.grid.min, s.grid.max, s.grid.cells, s.grid.periodic);
  for (auto& column : s.request) ar(column.name, column.required);
  ar(s.domain_assumed, s.has_velocity, s.radius_in_dumps, s.has_temperature, s.time_known,
     s.density_from, s.density, s.heights, s.band, s.band_weights);
  for (auto& band : s.bubble_bands) ar(band.height, band.width, band.weights);
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
  for (const auto& path : series.files()) mark.files.push_back(readers::mark_of(path));
  std::vector<std::size_t> held(mark.files.size());
  std::vector<std::uint64_t> end(mark.files.size());
  for (std::size_t i = 0; i < series.size(); ++i) {
    auto& snapshot = mark.snapshots.emplace_back();
    snapshot.step = series.step(i);
    snapshot.time = setup.times[i];
    for (const auto& [file, where] : series.pieces(i)) {
      snapshot.pieces.push_back({file, where.offset, where.bytes});
      ++held[file];
      end[file] = std::max(end[file], where.offset + where.bytes);
    }
  }
  // All-in-one dumps may grow; of the others each holds one snapshot, and shall not change.
  for (std::size_t k = 0; k < mark.files.size(); ++k)
    if (held[k] > 1 || (mark.files.size() == 1 && series.form().extend != nullptr))
      readers::let_grow(mark.files[k], end[k]);
  return mark;
}

std::size_t unchanged(const SeriesMark& then, const SeriesMark& now) {
  using readers::Change;
  std::vector<std::optional<Change>> changes(then.files.size());
  const auto same_piece = [&](const SeriesMark::Piece& a, const SeriesMark::Piece& b) {
    const auto &before = then.files[a.file], &file = now.files[b.file];
    auto& change = changes[a.file];
    if (!change) change = readers::change_since(before, file);
    return *change != Change::other && before.path == file.path && a.offset == b.offset &&
           (*change == Change::none || a.bytes == b.bytes);
  };
  const auto same = [&](const SeriesMark::Snapshot& a, const SeriesMark::Snapshot& b) {
    return a.step == b.step && a.time == b.time &&
           std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(),
                      same_piece);
  };
  const auto [at, ignored] = std::mismatch(then.snapshots.begin(), then.snapshots.end(),
                                           now.snapshots.begin(), now.snapshots.end(), same);
  return static_cast<std::size_t>(at - then.snapshots.begin());
}

std::string KeptRun::adapt(std::string fingerprint_now, SeriesMark dumps_now) {
  std::string why;
  const bool any = whole.snapshots() > 0 || whole.last;
  const auto same = unchanged(dumps, dumps_now);
  changed = fingerprint != fingerprint_now || same < dumps.snapshots.size();
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
    const auto& lost = dumps.snapshots[same];
    why = fmt::format("{}: step {} is not what it was, or no longer there",
                      dumps.files[lost.pieces.front().file].path, lost.step);
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
