// SPDX-License-Identifier: BSD-3-Clause
#include "readers/series.hpp"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <set>

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

}  // namespace

Series Series::open(const std::string& where, const SeriesOptions& options) {
  Series series;
  std::error_code error;
  const auto status = fs::status(where, error);
  if (const auto* form = form_of_folder(where)) {
    series.open_file(where, *form);
  } else if (fs::is_directory(status)) {
    series.open_files(where, files_of_folder(where));
  } else if (fs::exists(status) || where.find_first_of("*?[") == where.npos)
    series.open_file(where, identify(where));
  else
    series.open_files(where, files_of_pattern(where));
  series.order(options);
  series.compare_snapshots();
  const auto& first = series.entries_.front().where;
  if (first.columns != nullptr) series.columns_ = *first.columns;
  if (first.parts != nullptr) series.parts_ = *first.parts;
  return series;
}

void Series::open_file(const std::string& path, const Form& form) {
  form_ = &form;
  auto scan = form_->scan(path, true);
  if (!scan.not_particles.empty()) throw FormatError("{}: {}", path, scan.not_particles);
  const auto name = split_name(path);
  const auto step = name.numbers.empty() ? std::nullopt : to_step(name.numbers.back());
  note_cut(path, scan);
  add(path, std::move(scan), step.value_or(0));
}

void Series::open_files(const std::string& where, std::vector<std::string> paths) {
  auto folder = sort_out(where, std::move(paths));
  form_ = folder.form;
  left_out_ = std::move(folder.left_out);
  columns_ = std::move(folder.columns);
  parts_ = std::move(folder.parts);
  for (const auto& file : folder.files) {
    try {
      auto scan = form_->scan(file.path, file.last);
      if (!scan.cut.empty() && !file.last) throw FormatError("{}: {}", file.path, scan.cut);
      note_cut(file.path, scan);
      if (scan.snapshots.size() == 1 && scan.cut.empty() && scan.snapshots[0].step != no_step)
        judge_name(file, scan.snapshots[0]);
      add(file.path, std::move(scan), file.step_of_name.value_or(0));
    } catch (const CutError& error) {
      if (!file.last || folder.files.size() == 1) throw;
      folder.unfinished.emplace_back(error.what());
    }
  }
  for (const auto& what : folder.unfinished) {
    cut_ = true;
    problems_.push_back(fmt::format("{}: left out", what));
  }
}

void Series::note_cut(const std::string& path, const FileScan& scan) {
  if (scan.cut.empty()) return;
  cut_ = true;
  problems_.push_back(fmt::format("{}: {}", path, scan.cut));
}

/// The step inside a file wins over its name; a name that tells another story is worth a word.
void Series::judge_name(const DumpFile& file, const Located& located) {
  const auto& [path, name] = std::tie(file.path, file.name);
  const auto step = located.step;
  const auto names_step = [&](const std::string& digits) { return to_step(digits) == step; };
  if (name.numbers.empty()) return;
  if (std::none_of(name.numbers.begin(), name.numbers.end(), names_step))
    problems_.push_back(fmt::format("{} holds step {}: the step inside wins", path, step));
  else if (name.stem.ends_with("_*") && !names_step(name.numbers.back()))
    problems_.push_back(fmt::format(
        "{}: one file per processor (dump %): piece {} holds {} particles of step {}, the whole "
        "count is in all pieces together",
        path, name.numbers.back(), located.particles, step));
}

void Series::add(const std::string& path, FileScan scan, std::int64_t step_of_name) {
  files_.push_back(path);
  for (const auto& problem : scan.problems)
    problems_.push_back(fmt::format("{}: {}", path, problem));
  for (auto& located : scan.snapshots) {
    const auto step = form_->stores_times       ? static_cast<std::int64_t>(entries_.size())
                      : located.step == no_step ? step_of_name
                                                : located.step;
    entries_.push_back({step, files_.size() - 1, std::move(located)});
  }
}

void Series::order(const SeriesOptions& options) {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.step < b.step; });
  std::vector<Entry> kept;
  std::size_t dropped = 0;
  for (auto& entry : entries_) {
    if (kept.empty() || kept.back().step != entry.step) {
      kept.push_back(std::move(entry));
      continue;
    }
    if (options.repeated == Repeated::refuse) {
      const auto place = [&](const Entry& e) {
        return e.where.bytes == 0 || e.where.offset == 0
                   ? files_[e.file]
                   : fmt::format("{} (line {})", files_[e.file],
                                 line_at(files_[e.file], e.where.offset));
      };
      throw FormatError(
          "{}: step {} occurs twice, also in {}: say repeated = \"first\" or \"last\", or name one "
          "dump with a pattern",
          place(entry), entry.step, place(kept.back()));
    }
    ++dropped;
    if (options.repeated == Repeated::last) kept.back() = std::move(entry);
  }
  entries_ = std::move(kept);
  if (dropped > 0)
    problems_.push_back(fmt::format("{} repeated steps: the {} of each was taken", dropped,
                                    options.repeated == Repeated::first ? "first" : "last"));
}

/// Two runs in one folder show by a box or columns that change; said once.
void Series::compare_snapshots() {
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    const auto& a = entries_[i - 1].where;
    const auto& b = entries_[i].where;
    std::string changes;
    const bool other_columns = a.columns != nullptr && b.columns != nullptr &&
                               std::set(a.columns->begin(), a.columns->end()) !=
                                   std::set(b.columns->begin(), b.columns->end());
    if (a.box.known && b.box.known && (!b.box.shrink_wrapped || other_columns)) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (a.box.min[axis] != b.box.min[axis] || a.box.max[axis] != b.box.max[axis])
          changes += fmt::format("{}box changes in {} ({}..{} to {}..{})",
                                 changes.empty() ? "" : ", ", "xyz"[axis], a.box.min[axis],
                                 a.box.max[axis], b.box.min[axis], b.box.max[axis]);
    }
    if (other_columns) {
      const auto missing = [](const auto& from, const auto& in) {
        std::string names;
        for (const auto& name : from)
          if (std::find(in.begin(), in.end(), name) == in.end()) names += " " + name;
        return names;
      };
      const auto gone = missing(*a.columns, *b.columns);
      const auto come = missing(*b.columns, *a.columns);
      changes +=
          fmt::format("{}columns change{}{}{}{}", changes.empty() ? "" : ", ",
                      gone.empty() ? "" : ", gone:", gone, come.empty() ? "" : ", new:", come);
    }
    if (changes.empty()) continue;
    problems_.push_back(
        fmt::format("{}: step {}: {}: two runs in one folder?", path(i), step(i), changes));
    return;
  }
}

void Series::read(std::size_t i, const Request& request, Snapshot& out, Scratch& scratch) const {
  const auto& entry = entries_[i];
  form_->read(files_[entry.file], entry.where, request, out, scratch);
  out.step = entry.step;
}

std::string Series::place(std::size_t i, std::size_t row) const {
  const auto& entry = entries_[i];
  const auto& path = files_[entry.file];
  return fmt::format("{}: {}", path,
                     form_->place != nullptr ? form_->place(path, entry.where, row)
                                             : fmt::format("point {}", row));
}

}  // namespace bedscope::readers
