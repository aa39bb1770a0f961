// SPDX-License-Identifier: BSD-3-Clause
#include "readers/dump_folder.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "readers/error.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {

extern const Form vtk_xml;

namespace {

namespace fs = std::filesystem;

using Groups = std::map<std::pair<std::string, std::string>, DumpGroup>;  // by form and stem

struct Stranger {
  NameParts name;
  std::string what;  // with its path
};

/// A file that names others, with what they are.
struct Index {
  std::string path;
  const IndexForm* form;
  FileIndex content;

  bool has_times() const {
    return !content.snapshots.empty() && !std::isnan(content.snapshots.front().time);
  }
};

/// Which run of digits of the names of one stem is the step: the last one that differs from name to
/// name, or the last one where none does.
std::size_t step_position(const std::vector<DumpUnit>& units) {
  const auto& first = units.front().name.numbers;
  for (std::size_t k = first.size(); k-- > 0;)
    for (const auto& unit : units)
      if (unit.name.numbers[k] != first[k]) return k;
  return first.size() - 1;
}

std::optional<std::int64_t> step_in(const NameParts& name, const DumpGroup& group) {
  return name.numbers.empty() ? std::nullopt : to_step(name.numbers[step_position(group.units)]);
}

/// What the paths are by their content.
struct Sorted {
  std::vector<Index> indices;
  std::vector<std::pair<std::string, const Form*>> dumps;
  std::vector<Stranger> strangers;
};

Sorted sort_by_content(const std::vector<std::string>& paths) {
  Sorted sorted;
  for (const auto& path : paths) {
    try {
      const auto head = read_head(path);
      if (const auto* index = index_form(head))
        sorted.indices.push_back({path, index, read_index(path, *index)});
      else
        sorted.dumps.emplace_back(path, &identify(path, head));
    } catch (const FormatError& what) {
      sorted.strangers.push_back({split_name(path), what.what()});
    }
  }
  return sorted;
}

/// Indices that another one names are part of it. Of several that name one file the first is taken
/// of those with times, or of all.
std::vector<Index> choose_indices(std::vector<Index> indices, DumpFolder& found) {
  std::set<std::string> named;
  for (const auto& index : indices)
    if (index.content.error.empty())  // what names itself is not another's part
      named.insert(index.content.named.begin(), index.content.named.end());
  std::erase_if(indices, [&](const Index& index) {
    return named.contains(fs::path(index.path).lexically_normal().string());
  });
  std::stable_partition(indices.begin(), indices.end(),
                        [](const Index& index) { return index.has_times(); });
  std::map<std::string, std::string> owner;
  std::vector<Index> chosen;
  for (auto& index : indices) {
    const auto& names = index.content.named;
    const auto twice = std::find_if(names.begin(), names.end(),
                                    [&](const auto& name) { return owner.contains(name); });
    if (twice != names.end()) {
      found.left_out.push_back(
          fmt::format("{}: names files that {} names too", index.path, owner.at(*twice)));
      continue;
    }
    for (const auto& name : names) owner.emplace(name, index.path);
    chosen.push_back(std::move(index));
  }
  return chosen;
}

/// The files of one snapshot, all of one form.
const Form& form_of(const IndexedSnapshot& snapshot) {
  const Form* form = snapshot.files.empty() ? &vtk_xml : nullptr;  // LIGGGHTS names no pieces then
  for (const auto& file : snapshot.files) {
    const Form* own = nullptr;
    try {
      own = &identify(file.path);
    } catch (const Error& what) {
      throw FormatError("{}: {}", file.place(), what.what());
    }
    if (form != nullptr && form != own)
      throw FormatError("{}: two forms, {} and {}", file.place(), form->name, own->name);
    form = own;
  }
  return *form;
}

/// One group for each stem of what the index names.
void add_units(Index& index, Groups& groups, std::vector<Stranger>& strangers) {
  for (auto& snapshot : index.content.snapshots) {
    DumpUnit unit;
    unit.of_index = snapshot.name;
    unit.name = split_name(snapshot.name);
    unit.time = snapshot.time;
    try {
      const auto& form = form_of(snapshot);
      for (const auto& file : snapshot.files) unit.files.push_back(file.path);
      unit.indexed = std::move(snapshot.files);
      auto& group = groups[{std::string(form.name), unit.name.stem}];
      group.form = &form;
      group.units.push_back(std::move(unit));
    } catch (const FormatError& what) {
      strangers.push_back({std::move(unit.name), what.what()});
    }
  }
}

/// What a group holds instead of particles; empty for particles. Its last file by name may be a
/// half-written one, so the first is taken, and the next only where that one is cut or empty.
std::string not_particles(const DumpGroup& group, DumpFolder& found) {
  std::string instead;
  for (const auto& unit : group.units) {
    try {
      for (const auto& file : unit.files) {
        const auto scan = group.form->scan(file, !group.form->glance_tells);
        if (!scan.not_particles.empty()) {
          if (instead.empty()) instead = scan.not_particles;
          continue;
        }
        instead.clear();
        if (scan.snapshots.empty() || scan.snapshots[0].parts == nullptr) return {};
        found.columns = *scan.snapshots[0].columns;
        found.parts = *scan.snapshots[0].parts;
        if (scan.snapshots[0].particles > 0)
          return {};  // LPP's files of 0 particles have no arrays
      }
      if (!instead.empty() && unit.of_index.empty()) return instead;  // blocks: see the others
    } catch (const CutError&) {
      continue;
    }
  }
  return instead;
}

void require_one_form(const std::string& where, const Groups& groups) {
  const auto& [first_key, first] = *groups.begin();
  for (const auto& [key, group] : groups)
    if (group.form != first.form)
      throw InputError(
          "{}: dumps of two forms, {} ({}) and {} ({}): name one of them with a pattern", where,
          first_key.second, first.form->name, key.second, group.form->name);
}

/// A stranger that bears the name of a dump: of the last step or behind, it is not finished yet;
/// before it would leave a gap in the series.
void judge(const Stranger& stranger, const Groups& groups, std::int64_t last_step,
           DumpFolder& found) {
  const auto like = std::find_if(groups.begin(), groups.end(), [&](const auto& item) {
    return item.first.second == stranger.name.stem;
  });
  if (like == groups.end()) {
    found.left_out.push_back(stranger.what);
    return;
  }
  const auto step = step_in(stranger.name, like->second);
  if (!step || *step < last_step) throw FormatError("{}", stranger.what);
  found.unfinished.push_back(stranger.what);
}

/// Indices to units; what they name is not counted a second time. A list that cannot be used is
/// left out, what it names is then read as it lies; pieces without their index are not.
void take_indices(Sorted& sorted, Groups& groups, DumpFolder& found) {
  if (sorted.dumps.size() + sorted.indices.size() > 1)
    std::erase_if(sorted.indices, [&](const Index& index) {
      const bool broken = !index.form->one_snapshot && !index.content.error.empty();
      if (broken) found.problems.push_back(index.content.error + ": not used");
      return broken;
    });
  std::set<std::string> taken;
  std::vector<std::string> lost;  // what the names of pieces begin with, of an index that is broken
  for (auto& index : choose_indices(std::move(sorted.indices), found)) {
    taken.insert(index.content.named.begin(), index.content.named.end());
    for (auto& note : index.content.notes) found.notes.push_back(std::move(note));
    if (!index.content.cut.empty()) found.problems.push_back(std::move(index.content.cut));
    if (index.content.error.empty()) {
      add_units(index, groups, sorted.strangers);
      continue;
    }
    sorted.strangers.push_back({split_name(index.path), index.content.error});
    lost.push_back(fs::path(index.path).replace_extension().string() + "_");
  }
  const auto is_taken = [&](const auto& dump) {
    return taken.contains(fs::path(dump.first).lexically_normal().string()) ||
           std::any_of(lost.begin(), lost.end(),
                       [&](const auto& begin) { return dump.first.starts_with(begin); });
  };
  std::erase_if(sorted.dumps, is_taken);
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
  DumpFolder found;
  Groups groups;
  auto sorted = sort_by_content(paths);
  const bool alone = paths.size() == 1 && !sorted.indices.empty();
  take_indices(sorted, groups, found);
  for (const auto& [path, form] : sorted.dumps) {
    auto name = split_name(path);
    auto& group = groups[{std::string(form->name), name.stem}];
    group.form = form;
    DumpUnit unit;
    unit.files.push_back(path);
    unit.name = std::move(name);
    group.units.push_back(std::move(unit));
  }
  std::erase_if(groups, [&found](const auto& item) {
    const auto what = not_particles(item.second, found);
    if (what.empty()) return false;
    for (const auto& unit : item.second.units)
      for (const auto& file : unit.files)
        found.left_out.push_back(fmt::format("{}: {}", file, what));
    return true;
  });
  if (groups.empty()) {
    for (const auto& stranger : sorted.strangers) found.left_out.push_back(stranger.what);
    if (alone && !sorted.strangers.empty()) throw FormatError("{}", sorted.strangers[0].what);
    if (alone && !found.left_out.empty())
      throw FormatError("{}: not particles: {}", where, found.left_out.front());
    throw FileError(
        "{}: no particle dumps among {} files{}", where, paths.size(),
        found.left_out.empty() ? "" : fmt::format(" (first: {})", found.left_out.front()));
  }
  require_one_form(where, groups);
  found.form = groups.begin()->second.form;

  std::int64_t last_step = std::numeric_limits<std::int64_t>::min();
  for (auto& [key, group] : groups) {
    join_pieces(group, found);
    for (auto& unit : group.units) {
      unit.step_of_name = step_in(unit.name, group);
      last_step = std::max(last_step, unit.step_of_name.value_or(0));
    }
  }
  for (const auto& stranger : sorted.strangers) judge(stranger, groups, last_step, found);
  for (auto& [key, group] : groups)
    for (auto& unit : group.units) {
      unit.last = unit.step_of_name.value_or(0) == last_step;
      found.units.push_back(std::move(unit));
    }
  return found;
}

}  // namespace bedscope::readers
