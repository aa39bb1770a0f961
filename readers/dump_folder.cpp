// SPDX-License-Identifier: BSD-3-Clause
#include "readers/dump_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

/// Files of one form whose names differ in their numbers only.
struct Group {
  const Form* form = nullptr;
  std::vector<DumpFile> files;
};
using Groups = std::map<std::pair<std::string, std::string>, Group>;  // by form and stem

struct Stranger {
  NameParts name;
  std::string what;  // with its path
};

/// Which run of digits of the names of one stem is the step: the last one that differs from file to
/// file, or the last one where none does.
std::size_t step_position(const std::vector<DumpFile>& files) {
  const auto& first = files.front().name.numbers;
  for (std::size_t k = first.size(); k-- > 0;)
    for (const auto& file : files)
      if (file.name.numbers[k] != first[k]) return k;
  return first.size() - 1;
}

std::optional<std::int64_t> step_in(const NameParts& name, const Group& group) {
  return name.numbers.empty() ? std::nullopt : to_step(name.numbers[step_position(group.files)]);
}

std::pair<Groups, std::vector<Stranger>> group_by_content(const std::vector<std::string>& paths) {
  Groups groups;
  std::vector<Stranger> strangers;
  for (const auto& path : paths) {
    auto name = split_name(path);
    try {
      const auto& form = identify(path);
      auto& group = groups[{std::string(form.name), name.stem}];
      group.form = &form;
      group.files.push_back({path, std::move(name), {}, false});
    } catch (const FormatError& what) {
      strangers.push_back({std::move(name), what.what()});
    }
  }
  return {std::move(groups), std::move(strangers)};
}

/// What a group holds instead of particles; empty for particles. Its last file by name may be a
/// half-written one, so the first is taken, and the next only where that one is cut or empty.
std::string not_particles(const Group& group, DumpFolder& found) {
  for (const auto& file : group.files) {
    try {
      const auto scan = group.form->scan(file.path, !group.form->glance_tells);
      if (!scan.not_particles.empty()) return scan.not_particles;
      if (scan.snapshots.empty() || scan.snapshots[0].parts == nullptr) return {};
      found.columns = *scan.snapshots[0].columns;
      found.parts = *scan.snapshots[0].parts;
      if (scan.snapshots[0].particles > 0) return {};  // LPP's files of 0 particles have no arrays
    } catch (const CutError&) {
      continue;
    }
  }
  return {};
}

void require_one_form(const std::string& where, const Groups& groups) {
  const auto& [first_key, first] = *groups.begin();
  for (const auto& [key, group] : groups)
    if (group.form != first.form)
      throw InputError(
          "{}: dumps of two forms, {} ({}) and {} ({}): name one of them with a pattern", where,
          first_key.second, first.form->name, key.second, group.form->name);
}

/// A stranger that bears the name of a dump: behind the last one it is not finished yet, before it
/// it would leave a gap in the series.
void judge(const Stranger& stranger, const Groups& groups, std::int64_t last_step,
           DumpFolder& found) {
  const auto like = std::find_if(groups.begin(), groups.end(), [&](const auto& item) {
    return item.first.second == stranger.name.stem;
  });
  if (like == groups.end()) {
    found.left_out.push_back(stranger.what);
    return;
  }
  if (step_in(stranger.name, like->second).value_or(last_step) <= last_step)
    throw FormatError("{}", stranger.what);
  found.unfinished.push_back(stranger.what);
}

}  // namespace

NameParts split_name(const std::string& path) {
  const auto name = fs::path(path).filename().string();
  NameParts parts;
  for (std::size_t i = 0; i < name.size();) {
    const auto after = std::min(name.find_first_not_of("0123456789", i), name.size());
    if (after == i) {
      if (name[i] == '*' || name[i] == '\\') parts.stem += '\\';  // a star of the name's own
      parts.stem += name[i++];
      continue;
    }
    parts.stem += '*';
    parts.numbers.push_back(name.substr(i, after - i));
    i = after;
  }
  return parts;
}

std::optional<std::int64_t> to_step(const std::string& digits) {
  if (digits.size() > 18) return std::nullopt;
  return std::stoll(digits);
}

DumpFolder sort_out(const std::string& where, std::vector<std::string> paths) {
  if (paths.empty()) throw FileError("{}: no files in this folder", where);
  std::sort(paths.begin(), paths.end());
  auto [groups, strangers] = group_by_content(paths);
  DumpFolder found;
  std::erase_if(groups, [&found](const auto& item) {
    const auto what = not_particles(item.second, found);
    for (const auto& file : item.second.files)
      if (!what.empty()) found.left_out.push_back(fmt::format("{}: {}", file.path, what));
    return !what.empty();
  });
  if (groups.empty()) {
    for (const auto& stranger : strangers) found.left_out.push_back(stranger.what);
    throw FileError(
        "{}: no particle dumps among {} files{}", where, paths.size(),
        found.left_out.empty() ? "" : fmt::format(" (first: {})", found.left_out.front()));
  }
  require_one_form(where, groups);
  found.form = groups.begin()->second.form;

  std::int64_t last_step = std::numeric_limits<std::int64_t>::min();
  for (auto& [key, group] : groups)
    for (auto& file : group.files) {
      file.step_of_name = step_in(file.name, group);
      last_step = std::max(last_step, file.step_of_name.value_or(0));
    }
  for (const auto& stranger : strangers) judge(stranger, groups, last_step, found);
  for (auto& [key, group] : groups)
    for (auto& file : group.files) {
      file.last = file.step_of_name.value_or(0) == last_step;
      found.files.push_back(std::move(file));
    }
  return found;
}

}  // namespace bedscope::readers
