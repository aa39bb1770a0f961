// SPDX-License-Identifier: BSD-3-Clause
#include "readers/series.hpp"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "readers/columns.hpp"
#include "readers/error.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of_folder(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(folder, error)) {
    std::error_code ignored;
    if (item.is_regular_file(ignored) && !item.path().filename().string().starts_with('.'))
      paths.push_back(item.path().string());
  }
  if (error) throw FileError("{}: {}", folder, error.message());
  return paths;
}

std::vector<std::string> files_of_pattern(const std::string& pattern) {
  glob_t found{};
  const int code = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found);
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + (code == 0 ? found.gl_pathc : 0));
  ::globfree(&found);
  std::error_code ignored;  // what cannot be looked at is no folder; reading it gives the reason
  std::erase_if(paths, [&](const std::string& path) { return fs::is_directory(path, ignored); });
  if (paths.empty())
    throw FileError("{}: no such file, and nothing matches it as a pattern", pattern);
  return paths;
}

/// The form that takes the folder as a whole; null where it is a folder of dumps.
const Form* form_of_folder(const std::string& folder) {
  for (const auto* form : forms())
    if (form->matches_folder != nullptr && form->matches_folder(folder)) return form;
  return nullptr;
}

/// Where rows are parcels numbers are of parcels; told by the first snapshot and the last.
void tell_parcels(const Series& series, std::vector<std::string>& problems) {
  const auto& names = series.parts();
  if (std::find(names.begin(), names.end(), parcel_column) == names.end()) return;
  double least = INFINITY, most = -INFINITY;
  Snapshot rows;
  Scratch scratch;
  for (const std::size_t i : {std::size_t{0}, series.size() - 1}) {
    series.read(i, {{std::string(parcel_column), false}}, rows, scratch);
    for (const double n : rows.columns[0]) {
      least = std::min(least, n);
      most = std::max(most, n);
    }
  }
  if (most < least || (least == 1 && most == 1)) return;
  problems.push_back(fmt::format(
      "{}: one parcel stands for {:.6g} to {:.6g} particles (nParticle): it is taken as one sphere "
      "of their volume, and numbers are of parcels",
      series.path(0), least, most));
}

FileScan scan_file(const Form& form, const std::string& path, bool thorough, DumpIndex* index) {
  return index != nullptr ? index->scan(form, path, thorough) : form.scan(path, thorough);
}

}  // namespace

Series Series::open(const std::string& where, const SeriesOptions& options) {
  Series series;
  series.options_ = options;
  std::error_code error;
  const auto status = fs::status(where, error);
  if (const auto* form = form_of_folder(where)) {
    series.open_file(where, *form);
  } else if (fs::is_directory(status)) {
    series.open_files(where, files_of_folder(where));
  } else if (fs::exists(status) || where.find_first_of("*?[") == where.npos) {
    const auto head = read_head(where);
    if (index_form(head) != nullptr)
      series.open_files(where, {where});
    else
      series.open_file(where, identify(where, head));
  } else {
    series.open_files(where, files_of_pattern(where));
  }
  series.order();
  series.compare_snapshots();
  series.options_.index = nullptr;  // is the caller's, and may be gone
  const auto& first = series.located(0);
  if (first.columns != nullptr) series.columns_ = *first.columns;
  if (first.parts != nullptr) series.parts_ = *first.parts;
  tell_parcels(series, series.problems_);
  for (auto* lines : {&series.problems_, &series.notes_, &series.left_out_})
    for (auto& line : *lines) line = one_line(line);
  return series;
}

void Series::open_file(const std::string& path, const Form& form) {
  form_ = &form;
  DumpUnit unit;
  unit.files.push_back(path);
  unit.name = split_name(path);
  if (!unit.name.numbers.empty() && form.matches_folder == nullptr)
    unit.step_of_name = to_step(unit.name.numbers.back());
  auto scan = scan_file(*form_, path, true, options_.index);
  if (!scan.not_particles.empty()) throw FormatError("{}: {}", path, scan.not_particles);
  std::vector<FileScan> scans;
  scans.push_back(std::move(scan));
  join(unit, std::move(scans));
}

void Series::open_files(const std::string& where, std::vector<std::string> paths) {
  auto folder = sort_out(where, std::move(paths));
  form_ = folder.form;
  left_out_ = std::move(folder.left_out);
  problems_ = std::move(folder.problems);
  notes_ = std::move(folder.notes);
  columns_ = std::move(folder.columns);
  parts_ = std::move(folder.parts);
  for (const auto& unit : folder.units) {
    try {
      open_unit(unit);
    } catch (const CutError& error) {
      if (!unit.last || folder.units.size() == 1) throw;
      folder.unfinished.emplace_back(error.what());
    }
  }
  for (const auto& what : folder.unfinished) {
    cut_ = true;
    problems_.push_back(fmt::format("{}: left out", what));
  }
  if (entries_.empty()) throw FileError("{}: no particle dumps", where);
}

void Series::open_unit(const DumpUnit& unit) {
  std::vector<FileScan> scans;
  auto particles = unit;  // without blocks of something else
  particles.files.clear();
  particles.indexed.clear();
  for (std::size_t k = 0; k < unit.files.size(); ++k) {
    const auto& path = unit.files[k];
    // Only a form whose glance tells all tells the copies of other parts' particles.
    const bool thorough = unit.last || (unit.files.size() > 1 && !form_->glance_tells);
    auto scan = scan_file(*form_, path, thorough, options_.index);
    if (!scan.not_particles.empty()) {
      left_out_.push_back(fmt::format("{}: {}", path, scan.not_particles));
      continue;
    }
    if (!scan.cut.empty() && !unit.last) throw FormatError("{}: {}", path, scan.cut);
    if (unit.files.size() == 1 && unit.indexed.empty() && scan.snapshots.size() == 1 &&
        scan.cut.empty() && scan.snapshots[0].step != no_step)
      judge_name(unit, scan.snapshots[0]);
    particles.files.push_back(path);
    if (!unit.indexed.empty()) particles.indexed.push_back(unit.indexed[k]);
    scans.push_back(std::move(scan));
  }
  if (scans.empty() && !unit.of_index.empty()) {  // LIGGGHTS writes no block of no particles
    particles.files.push_back(unit.of_index);
    scans.emplace_back().snapshots.emplace_back();
  }
  if (!scans.empty()) join(particles, std::move(scans));
}

/// Entries of what the files of a unit hold: the same steps, in each file a part of each.
void Series::join(const DumpUnit& unit, std::vector<FileScan> scans) {
  using Key = std::pair<std::int64_t, std::size_t>;  // step, and how often it came before
  std::map<Key, std::vector<Part>> found;
  std::vector<Key> order;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    auto& scan = scans[k];
    const auto& path = unit.files[k];
    note_cut(path, scan);
    name_columns(path, scan);
    for (const auto& problem : scan.problems) {
      const auto same = [&](const std::string& said) { return said.ends_with(": " + problem); };
      // What stands in every file of a run (its units) is said of the first.
      if (std::none_of(problems_.begin(), problems_.end(), same))
        problems_.push_back(fmt::format("{}: {}", path, problem));
    }
    files_.push_back(path);
    std::map<std::int64_t, std::size_t> seen;
    for (auto& located : scan.snapshots) {
      const Key key{located.step, seen[located.step]++};
      auto& parts = found[key];
      if (parts.empty()) order.push_back(key);
      parts.push_back({files_.size() - 1, std::move(located)});
    }
  }
  for (const auto& key : order) {
    auto& parts = found[key];
    if (parts.size() < scans.size()) {  // a run killed while its processors wrote
      cut_ = true;
      problems_.push_back(fmt::format("{}: step {} is in {} of {} pieces: left out",
                                      files_[parts.front().file], key.first, parts.size(),
                                      scans.size()));
      continue;
    }
    require_same_columns(unit, parts);
    for (auto& [file, where] : parts) {  // by itself a file is taken as it stands
      if (parts.size() == 1 || where.ghosts == 0) continue;
      where.particles -= where.ghosts;
      where.without_ghosts = true;
    }
    // A part without particles may have no columns either: behind the others, and not read.
    std::stable_partition(parts.begin(), parts.end(),
                          [](const Part& part) { return part.where.particles > 0; });
    const auto& first = parts.front().where;
    Entry entry;
    entry.step_inside = first.step != no_step;
    if (entry.step_inside)
      entry.step = first.step;
    else if (order.size() == 1)  // of many, the name of their file tells none
      entry.step = unit.step_of_name.value_or(no_step);
    entry.time = std::isnan(unit.time) ? first.time : unit.time;
    entry.parts = std::move(parts);
    entries_.push_back(std::move(entry));
  }
}

/// Columns that a part lacks would be taken for absent in all, or come from another run.
void Series::require_same_columns(const DumpUnit& unit, const std::vector<Part>& parts) const {
  const auto holds = [](const Part& part) {
    return part.where.particles > 0 && part.where.columns != nullptr;
  };
  const auto first = std::find_if(parts.begin(), parts.end(), holds);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!holds(parts[k]) || *parts[k].where.columns == *first->where.columns) continue;
    for (const auto& [here, there] : {std::pair(&parts[k], &*first), {&*first, &parts[k]}})
      for (const auto& name : *there->where.columns) {
        const auto& own = *here->where.columns;
        if (std::find(own.begin(), own.end(), name) != own.end()) continue;
        const auto index = static_cast<std::size_t>(here - parts.data());
        throw FormatError("{} has no array {}, {} has it",
                          unit.indexed.empty() ? files_[here->file] : unit.indexed[index].place(),
                          name, files_[there->file]);
      }
  }
}

void Series::note_cut(const std::string& path, const FileScan& scan) {
  if (scan.cut.empty()) return;
  cut_ = true;
  problems_.push_back(fmt::format("{}: {}", path, scan.cut));
}

/// The step inside a file wins over its name; a name that tells another story is worth a word.
void Series::judge_name(const DumpUnit& unit, const Located& located) {
  const auto& path = unit.files.front();
  const auto& name = unit.name;
  const auto step = located.step;
  const auto names_step = [&](const std::string& digits) { return to_step(digits) == step; };
  if (name.numbers.empty()) return;
  if (std::none_of(name.numbers.begin(), name.numbers.end(), names_step))
    problems_.push_back(fmt::format("{} holds step {}: the step inside wins", path, step));
  else if (name.stem.ends_with("_*") && !names_step(name.numbers.back()) && lone_pieces_++ == 0)
    problems_.push_back(fmt::format(
        "{}: one file per processor (dump %): piece {} holds {} particles of step {}, the whole "
        "count is in all pieces together",
        path, name.numbers.back(), located.particles, step));
}

/// Puts the names that the user gives where the file has none.
void Series::name_columns(const std::string& path, FileScan& scan) {
  for (auto& located : scan.snapshots) {
    if (located.named) {
      unused_names_ = !options_.columns.empty();
      continue;
    }
    if (options_.columns.empty()) {
      if (form_->names_columns || options_.names_needed)
        throw FormatError("{}: {}: expected their names, columns = [...] in the [[run]]", path,
                          scan.unnamed);
      named_ = false;
      continue;
    }
    const auto found = located.columns->size();
    if (found > 0 && found != options_.columns.size())
      throw FormatError("{}: {} columns, but columns = [...] names {}", path, found,
                        options_.columns.size());
    if (names_ == nullptr)
      names_ = std::make_shared<const std::vector<std::string>>(options_.columns);
    located.columns = located.parts = names_;
  }
}

void Series::thin(std::size_t n) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries_.size(); i += n) {
    if (kept != i) entries_[kept] = std::move(entries_[i]);
    ++kept;
  }
  entries_.resize(kept);
}

std::int64_t Series::particles(std::size_t i) const {
  std::int64_t sum = 0;
  for (const auto& part : entries_[i].parts) sum += part.where.particles;
  return sum;
}

void Series::read(std::size_t i, const Request& request, Snapshot& out, Scratch& scratch) const {
  const auto& entry = entries_[i];
  const auto& [file, where] = entry.parts.front();
  if (particles(i) == 0) {  // nothing to read, and of an index that names nothing no file to do so
    out = {.box = where.box, .columns = std::vector<std::vector<double>>(request.size())};
  } else {
    form_->read(files_[file], where, request, out, scratch);
    if (entry.parts.size() > 1) read_more(entry, request, out, scratch);
  }
  if (static_cast<std::int64_t>(out.particles) != particles(i))
    throw FormatError(
        "{}: expected {} particles, found {}: the file has changed since it was opened", path(i),
        particles(i), out.particles);
  out.step = entry.step;
  out.time = entry.time;
}

/// The parts behind the first that have particles.
void Series::read_more(const Entry& entry, const Request& request, Snapshot& out,
                       Scratch& scratch) const {
  Snapshot part;
  for (std::size_t k = 1; k < entry.parts.size() && entry.parts[k].where.particles > 0; ++k) {
    form_->read(files_[entry.parts[k].file], entry.parts[k].where, request, part, scratch);
    out.bytes_read += part.bytes_read;
    for (std::size_t c = 0; c < request.size(); ++c) {
      auto& to = out.columns[c];
      if (to.empty() != part.columns[c].empty())
        throw FormatError("{}: column {} is only in some of the pieces",
                          files_[entry.parts[k].file], request[c].name);
      to.insert(to.end(), part.columns[c].begin(), part.columns[c].end());
    }
    out.particles += part.particles;
  }
}

std::string Series::place(std::size_t i, std::size_t row) const {
  const auto& parts = entries_[i].parts;
  auto part = parts.begin();
  for (; std::next(part) != parts.end(); ++part) {
    const auto rows = static_cast<std::size_t>(part->where.particles);
    if (row < rows) break;
    row -= rows;
  }
  const auto& path = files_[part->file];
  return fmt::format("{}: {}", path,
                     form_->place != nullptr ? form_->place(path, part->where, row)
                                             : fmt::format("point {}", row));
}

std::vector<std::size_t> evenly_spread(std::size_t count, std::size_t at_most) {
  const std::size_t picks = std::min(count, at_most);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < picks; ++k)
    places.push_back(picks == 1 ? 0 : k * (count - 1) / (picks - 1));
  return places;
}

}  // namespace bedscope::readers
