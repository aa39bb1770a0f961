// SPDX-License-Identifier: BSD-3-Clause
// Which times a case has, with which fields, and whether the last one is whole.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "readers/openfoam_case_impl.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

// Does a plain file end as OpenFOAM ends its files? Then it was not cut. One that ends in NUL bytes
// was: the file system lost its tail.
bool has_footer(const std::string& path) {
  Source source(path);
  if (source.compressed()) return false;
  constexpr std::uint64_t look = 128;
  const auto size = source.size_bound();
  source.seek(size > look ? size - look : 0);
  std::string tail(look, '\0');
  tail.resize(source.read(tail));
  if (tail.ends_with('\0')) throw CutError("{}: ends in NUL bytes", path);
  const auto last = tail.find_last_not_of(" \t\r\n");
  return last != std::string::npos && std::string_view(tail).substr(0, last + 1).ends_with("** //");
}

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

// Nothing in a time but, perhaps, what the solver needs to go on.
bool is_bare(const std::string& directory) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(directory, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
    if (file_name(entry->path().string()) != "uniform") return false;
  return true;
}

}  // namespace

// The times that every folder has; those that some lack are told.
void OpenFoamCase::Impl::find_times() {
  std::map<double, std::pair<FoamTimeName, std::vector<std::string>>> found;  // and who has it
  for (const auto& folder : folders)
    for (auto& time : time_directories(folder.path)) {
      auto& entry = found[time.value];
      entry.second.push_back(file_name(folder.path));
      entry.first = std::move(time);
    }
  for (const auto& [value, entry] : found) {
    const auto& [name, having] = entry;
    if (having.size() == folders.size()) {
      const auto directory = folders.front().path + "/" + name.name;
      times.push_back({name.name, true_time(directory, name, problems), {}});
      continue;
    }
    for (const auto& folder : folders)
      if (std::count(having.begin(), having.end(), file_name(folder.path)) == 0) {
        problems.push_back(fmt::format("{}: time {} is in {} but not in {}: left out", root,
                                       name.name, having.front(), file_name(folder.path)));
        break;
      }
  }
}

// The class of a field by the first time that has a sound file of it; empty where it is no field.
std::string OpenFoamCase::Impl::class_of(const std::string& field) const {
  std::string reason;
  for (std::size_t t = 0; t < times.size(); ++t) {
    if (std::count(times[t].fields.begin(), times[t].fields.end(), field) == 0) continue;
    const auto path = path_in(folders.front(), time_folder(t) + field);
    try {
      FoamBlocks file(path);
      if (!file.next()) continue;
      if (file.header().present) return file.header().class_name;
      if (read_head(path).find("internalField") != std::string::npos) return "no header";
    } catch (const Error& error) {
      reason = error.what();
    }
  }
  if (!reason.empty()) throw FormatError("{}", reason);
  return {};
}

void OpenFoamCase::Impl::find_fields() {
  std::set<std::string> names, doubled;
  for (std::size_t t = 0; t < times.size(); ++t) {
    std::set<std::string> here;
    std::error_code error;
    for (auto entry = fs::directory_iterator(folders.front().path + "/" + time_folder(t), error);
         !error && entry != fs::directory_iterator(); entry.increment(error)) {
      std::error_code unreadable;
      if (!entry->is_regular_file(unreadable)) continue;
      auto name = file_name(entry->path().string());
      if (name.ends_with(".gz")) name.resize(name.size() - 3);
      if (name.empty() || name[0] == '.' || name.ends_with('~')) continue;
      if (!here.insert(name).second)
        problems.push_back(fmt::format("{} and {}.gz both present: the plain one is read",
                                       shown(time_folder(t) + name), name));
    }
    times[t].fields.assign(here.begin(), here.end());
    names.insert(here.begin(), here.end());
  }
  for (const auto& name : names) {
    try {
      const auto class_name = class_of(name);
      if (class_name == "no header" || vol_field_type(class_name) != nullptr)
        classes[name] = class_name;
      if (class_name == "no header")
        problems.push_back(fmt::format("{}: {}: no FoamFile header, read as ascii", root, name));
    } catch (const Error& error) {
      problems.emplace_back(error.what());
    }
  }
  for (auto& time : times)
    std::erase_if(time.fields, [&](const auto& name) { return classes.count(name) == 0; });
  // Times of nothing but a cloud count, too.
  std::erase_if(times, [&](const auto& time) {
    std::error_code error;
    const auto directory = folders.front().path + "/" + time.name;
    if (is_bare(directory))
      problems.push_back(fmt::format("{}: no fields: left out", shown(time.name)));
    return time.fields.empty() && !fs::is_directory(directory + "/" + region + "lagrangian", error);
  });
}

// A field that comes later than the start (a mean) or only belongs to it (an initial value) is as
// it should be; one that comes and goes is not.
void OpenFoamCase::Impl::tell_missing() {
  for (auto& line : missing_fields(root, times)) problems.push_back(std::move(line));
}

// A run that was killed while writing leaves its last time cut.
void OpenFoamCase::Impl::check_last_time() {
  if (times.empty()) return;
  const auto last = times.size() - 1;
  FieldValues unused;
  try {
    for (const auto& field : times[last].fields) {
      const auto relative = time_folder(last) + field;
      const bool sound = std::all_of(folders.begin(), folders.end(), [&](const auto& folder) {
        return !folder.collated && has_footer(path_in(folder, relative));
      });
      if (sound) continue;
      for_each_rank(relative, [&](std::size_t, FoamBlocks& file) {
        if (!file.collated()) read_field(file, std::nullopt, unused);
      });
    }
  } catch (const CutError& error) {
    if (last == 0) throw;
    problems.push_back(fmt::format("time {} is left out: {}", times[last].name, error.what()));
    times.pop_back();
  } catch (const Error&) {
    // Not a matter of being cut: told when the field is read.
  }
}

// The same for its clouds: a file that is cut, or one that the time before has and this one lacks.
std::string OpenFoamCase::Impl::why_clouds_are_cut(const OpenFoamCase& foam) const {
  const auto last = times.size() - 1;
  Snapshot unused;
  for (const auto& cloud : foam.clouds_at(last)) try {
      const auto here = foam.cloud_columns(last, cloud);
      const auto before = foam.parcels(last - 1, cloud).value_or(0) > 0
                              ? foam.cloud_columns(last - 1, cloud)
                              : here;
      if (foam.parcels(last, cloud).value_or(0) == 0) continue;
      for (const auto& column : before)
        if (std::count(here.begin(), here.end(), column) == 0)
          return fmt::format("{}: {} is missing", shown(cloud_path(last, cloud)), column);
      std::set<std::string> all_names;
      const auto sound = [&](const FoamFolder& folder) {
        std::error_code error;
        std::set<std::string> names;
        auto entry = fs::directory_iterator(folder.path + "/" + cloud_path(last, cloud), error);
        for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
          if (folder.collated || !has_footer(entry->path().string())) return false;
          names.insert(file_name(entry->path().string()));
        }
        if (all_names.empty()) all_names = names;
        return names == all_names;  // a rank that lacks one has no parcels, or was cut
      };
      if (std::all_of(folders.begin(), folders.end(), sound)) continue;
      Request all;
      for (const auto& column : here) all.push_back({column});
      foam.read_cloud(last, cloud, all, unused);
    } catch (const CutError& error) {
      return error.what();
    } catch (const FileError& error) {  // another rank has it
      return error.what();
    } catch (const Error&) {
      // Told when the cloud is read.
    }
  return {};
}

}  // namespace bedscope::readers
