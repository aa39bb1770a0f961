// SPDX-License-Identifier: BSD-3-Clause
#include "readers/series.hpp"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>

#include "readers/error.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

using NameParts = Series::NameParts;

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

NameParts split_name(const std::string& name) {
  NameParts parts;
  for (std::size_t i = 0; i < name.size();) {
    const auto digits = name.find_first_not_of("0123456789", i);
    const auto end = digits == name.npos ? name.size() : digits;
    if (end > i) {
      parts.stem += '*';
      parts.numbers.push_back(name.substr(i, end - i));
      i = end;
    } else {
      parts.stem += name[i++];
    }
  }
  return parts;
}

std::optional<std::int64_t> to_step(const std::string& digits) {
  if (digits.size() > 18) return std::nullopt;
  return std::stoll(digits);
}

/// Which run of digits of the names of one stem is the step: the last one that differs from file to
/// file, or the last one where none does.
std::size_t step_position(const std::vector<NameParts>& names) {
  const auto count = names.front().numbers.size();
  for (std::size_t k = count; k-- > 0;)
    for (const auto& name : names)
      if (name.numbers[k] != names.front().numbers[k]) return k;
  return count - 1;
}

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

}  // namespace

/// Files of one form whose names differ in their numbers only.
struct Series::Group {
  const Form* form = nullptr;
  std::vector<std::string> paths;
  std::vector<NameParts> names;
};

Series Series::open(const std::string& where, const SeriesOptions& options) {
  Series series;
  std::error_code error;
  const auto status = fs::status(where, error);
  if (fs::is_directory(status))
    series.open_files(where, files_of_folder(where));
  else if (fs::exists(status) || where.find_first_of("*?[") == where.npos)
    series.open_file(where);
  else
    series.open_files(where, files_of_pattern(where));
  series.order(options);
  series.compare_snapshots();
  if (series.entries_.front().where.columns != nullptr)
    series.columns_ = *series.entries_.front().where.columns;
  return series;
}

void Series::open_file(const std::string& path) {
  form_ = &identify(path);
  auto scan = form_->scan(path, true);
  if (!scan.not_particles.empty()) throw FormatError("{}: {}", path, scan.not_particles);
  const auto name = split_name(file_name(path));
  const auto step = name.numbers.empty() ? std::nullopt : to_step(name.numbers.back());
  if (!scan.cut.empty()) {
    cut_ = true;
    problems_.push_back(fmt::format("{}: {}", path, scan.cut));
  }
  add(path, std::move(scan), step.value_or(0));
}

void Series::open_files(const std::string& where, std::vector<std::string> paths) {
  if (paths.empty()) throw FileError("{}: no files in this folder", where);
  std::sort(paths.begin(), paths.end());
  std::map<std::pair<std::string, std::string>, Group> groups;  // by form and stem of the name
  std::vector<std::string> empty_files;
  std::vector<std::pair<NameParts, std::string>> strangers;  // with what is said of them
  for (const auto& path : paths) {
    std::error_code no_file;
    if (fs::file_size(path, no_file) == 0) {
      empty_files.push_back(path);
      continue;
    }
    try {
      const auto& form = identify(path);
      auto name = split_name(file_name(path));
      auto& group = groups[{std::string(form.name), name.stem}];
      group.form = &form;
      group.paths.push_back(path);
      group.names.push_back(std::move(name));
    } catch (const FormatError& stranger) {
      strangers.emplace_back(split_name(file_name(path)), stranger.what());
    }
  }
  // One thorough look into a group tells particles from companions. Its last file by name may be a
  // half-written one, so the first is taken; the others are checked when their turn comes.
  std::erase_if(groups, [&](auto& item) {
    auto& group = item.second;
    for (std::size_t i = 0; i < group.paths.size(); ++i) {
      try {
        const auto scan = group.form->scan(group.paths[i], true);
        if (scan.not_particles.empty()) return false;
        for (const auto& path : group.paths)
          left_out_.push_back(fmt::format("{}: {}", path, scan.not_particles));
        return true;
      } catch (const CutError&) {
        if (i + 1 == group.paths.size()) return false;
      }
    }
    return false;
  });
  // A stranger that bears the name of a dump would leave a gap in the series.
  std::vector<std::pair<NameParts, std::string>> broken;
  for (auto& stranger : strangers) {
    if (std::any_of(groups.begin(), groups.end(),
                    [&](const auto& item) { return item.first.second == stranger.first.stem; }))
      broken.push_back(std::move(stranger));
    else
      left_out_.push_back(std::move(stranger.second));
  }
  if (groups.empty())
    throw FileError("{}: no particle dumps among {} files{}", where, paths.size(),
                    left_out_.empty() ? "" : fmt::format(" (first: {})", left_out_.front()));
  const auto& first = *groups.begin();
  for (const auto& [key, group] : groups)
    if (group.form != first.second.form)
      throw InputError(
          "{}: dumps of two forms, {} ({}) and {} ({}): name one of them with a pattern", where,
          first.first.second, first.second.form->name, key.second, group.form->name);
  form_ = first.second.form;

  // The file with the highest number in its name is the one that a killed run leaves cut.
  std::string last;
  std::int64_t last_step = std::numeric_limits<std::int64_t>::min();
  for (const auto& [key, group] : groups) {
    const auto position = group.names.front().numbers.empty() ? 0 : step_position(group.names);
    for (std::size_t i = 0; i < group.paths.size(); ++i) {
      const auto& numbers = group.names[i].numbers;
      const auto step = numbers.empty() ? std::nullopt : to_step(numbers[position]);
      if (step.value_or(0) >= last_step) {
        last_step = step.value_or(0);
        last = group.paths[i];
      }
    }
  }
  for (const auto& [name, what] : broken) {
    const auto& like =
        *std::find_if(groups.begin(), groups.end(),
                      [&, &stem = name.stem](auto& item) { return item.first.second == stem; });
    const auto step = name.numbers.empty()
                          ? std::nullopt
                          : to_step(name.numbers[step_position(like.second.names)]);
    if (step.value_or(last_step) <= last_step) throw FormatError("{}", what);
    cut_ = true;
    problems_.push_back(fmt::format("{}: left out", what));
  }
  for (const auto& [key, group] : groups) {
    const auto position = group.names.front().numbers.empty() ? 0 : step_position(group.names);
    for (std::size_t i = 0; i < group.paths.size(); ++i) {
      const auto& path = group.paths[i];
      const auto& numbers = group.names[i].numbers;
      const auto named = numbers.empty() ? std::nullopt : to_step(numbers[position]);
      try {
        auto scan = form_->scan(path, path == last || paths.size() == 1);
        if (!scan.cut.empty()) {
          if (path != last) throw FormatError("{}: {}", path, scan.cut);
          cut_ = true;
          problems_.push_back(fmt::format("{}: {}", path, scan.cut));
        }
        if (scan.snapshots.size() == 1 && scan.snapshots[0].step != no_step)
          judge_name(path, group.names[i], scan.snapshots[0]);
        add(path, std::move(scan), named.value_or(0));
      } catch (const CutError& error) {
        if (path != last || group.paths.size() == 1) throw;
        cut_ = true;
        problems_.push_back(fmt::format("{}: left out", error.what()));
      }
    }
  }
  for (const auto& path : empty_files) {
    cut_ = true;
    problems_.push_back(fmt::format("{}: file is empty: left out", path));
  }
}

/// The step inside a file wins over its name; a name that tells another story is worth a word.
void Series::judge_name(const std::string& path, const NameParts& name, const Located& located) {
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
    const auto step = located.step == no_step ? step_of_name : located.step;
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
    const bool other_columns =
        a.columns != nullptr && b.columns != nullptr && *a.columns != *b.columns;
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
