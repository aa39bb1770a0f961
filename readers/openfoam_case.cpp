// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_case.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "readers/openfoam_folders.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

// A mesh together with where the cells of each rank go.
struct RankedMesh {
  Mesh mesh;
  std::vector<std::size_t> cells;                  // of each rank
  std::vector<std::vector<std::int32_t>> address;  // of each rank's cells in the case
};

// Does a plain file end as OpenFOAM ends its files? Then it was not cut.
bool has_footer(const std::string& path) {
  Source source(path);
  if (source.compressed()) return false;
  constexpr std::uint64_t look = 128;
  const auto size = source.size_bound();
  source.seek(size > look ? size - look : 0);
  std::string tail(look, '\0');
  tail.resize(source.read(tail));
  const auto last = tail.find_last_not_of(" \t\r\n");
  return last != std::string::npos &&
         std::string_view(tail).substr(0, last + 1).ends_with("* * //") |
             std::string_view(tail).substr(0, last + 1).ends_with("** //");
}

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

}  // namespace

struct OpenFoamCase::Impl {
  std::string root;
  std::string region;  // with a "/" behind it, or empty
  std::vector<FoamFolder> folders;
  std::size_t ranks = 0;
  std::vector<OpenFoamTime> times;
  std::vector<std::string> regions;
  std::vector<std::string> problems;
  std::map<std::string, std::string, std::less<>> classes;  // of the fields, by name
  bool moving = false;
  std::shared_ptr<const RankedMesh> start;  // the mesh at the first time

  std::string shown(std::string_view relative) const {
    return fmt::format("{}/{}", root, relative);
  }
  std::string time_folder(std::size_t time) const { return times[time].name + "/" + region; }

  // The path of a file of a folder; where there is none, the plain name, which Source refuses.
  static std::string path_in(const FoamFolder& folder, const std::string& relative) {
    const auto path = folder.path + "/" + relative;
    const auto found = plain_or_gz(path);
    return found.empty() ? path : found;
  }

  // Calls what(rank, file) with the file open at the block of each rank.
  template <class What>
  void for_each_rank(const std::string& relative, What&& what) const {
    for (const auto& folder : folders) {
      FoamBlocks file(path_in(folder, relative));
      if (folder.collated != file.collated())
        throw FormatError("{}: expected class {}, found {}", file.stream().path(),
                          folder.collated ? "decomposedBlockData" : "of one block",
                          file.header().class_name);
      for (std::size_t k = 0; k < folder.ranks; ++k) {
        if (!file.next())
          throw CutError("{}: expected {} blocks, found {}", file.stream().path(), folder.ranks, k);
        try {
          what(folder.first_rank + k, file);
        } catch (const FormatError& error) {
          if (!folder.collated) throw;
          file.close();  // a wrong length of the block is the better explanation
          throw FormatError("{} (block {})", error.what(), k);
        }
      }
      if (folder.collated && file.next())
        throw FormatError("{}: expected {} blocks, found more", file.stream().path(), folder.ranks);
    }
  }

  void find_regions();
  void count_ranks();
  void find_times();
  void find_fields();
  std::string class_of(const std::string& field) const;
  void tell_missing();
  void check_last_time();
  std::string mesh_file(const FoamFolder& folder, std::size_t time, std::string_view name) const;
  std::shared_ptr<const RankedMesh> read_mesh(std::size_t time) const;
  void read_addresses(std::size_t time, RankedMesh& mesh) const;
  std::shared_ptr<const RankedMesh> mesh_at(std::size_t time) const {
    return moving ? read_mesh(time) : start;
  }
};

void OpenFoamCase::Impl::find_regions() {
  std::error_code error;
  const fs::path constant = folders.front().path + "/constant";
  for (auto entry = fs::directory_iterator(constant, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
    if (fs::is_directory(entry->path() / "polyMesh", error))
      regions.push_back(file_name(entry->path().string()));
  std::sort(regions.begin(), regions.end());
  std::string list;
  for (const auto& name : regions) list += (list.empty() ? "" : ", ") + name;
  if (!region.empty() &&
      std::count(regions.begin(), regions.end(), region.substr(0, region.size() - 1)) == 0)
    throw InputError("{}: expected a region of the case ({}), found {}", root,
                     list.empty() ? "it has none" : list, region.substr(0, region.size() - 1));
  if (region.empty() && !regions.empty() && !fs::is_directory(constant / "polyMesh", error))
    throw InputError("{}: several regions and no default one, name one of {}", root, list);
}

// A folder called `processors` does not say how many ranks it holds: its files do.
void OpenFoamCase::Impl::count_ranks() {
  for (auto& folder : folders) {
    if (folder.collated && folder.ranks == 0) {
      auto path = path_in(folder, "constant/" + region + "polyMesh/owner");
      FoamBlocks file(path);
      while (file.next()) ++folder.ranks;
    }
    ranks += folder.ranks;
  }
}

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
  std::erase_if(times, [](const auto& time) { return time.fields.empty(); });
}

// A field that comes later than the start (a mean) or only belongs to it (an initial value) is as
// it should be; one that comes and goes is not.
void OpenFoamCase::Impl::tell_missing() {
  for (const auto& [name, class_name] : classes) {
    std::vector<std::string> lacking;
    std::size_t having = 0;
    bool first = false;
    for (std::size_t t = 0; t < times.size(); ++t) {
      const bool there = std::binary_search(times[t].fields.begin(), times[t].fields.end(), name);
      if (there && t == 0) first = true;
      if (there) ++having;
      if (!there && having > 0) lacking.push_back(times[t].name);
    }
    if (lacking.empty() || (first && having == 1)) continue;
    problems.push_back(fmt::format("{}: field {} is missing at {} of {} times, first at {}", root,
                                   name, lacking.size(), times.size(), lacking.front()));
  }
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

// The newest file of a mesh at or before a time: times with points of their own move the mesh.
std::string OpenFoamCase::Impl::mesh_file(const FoamFolder& folder, std::size_t time,
                                          std::string_view name) const {
  const auto file = fmt::format("{}polyMesh/{}", region, name);
  for (std::size_t t = time + 1; t-- > 0 && moving;) {
    const auto found = plain_or_gz(fmt::format("{}/{}/{}", folder.path, times[t].name, file));
    if (!found.empty()) return found;
  }
  return plain_or_gz(fmt::format("{}/constant/{}", folder.path, file));
}

void OpenFoamCase::Impl::read_addresses(std::size_t time, RankedMesh& mesh) const {
  std::size_t total = 0, with = 0;
  for (const auto cells : mesh.cells) total += cells;
  std::vector<bool> taken(total);
  mesh.address.resize(ranks);
  for (const auto& folder : folders) {
    const auto path = mesh_file(folder, time, "cellProcAddressing");
    if (path.empty()) continue;
    FoamBlocks file(path);
    for (std::size_t k = 0; k < folder.ranks; ++k, ++with) {
      const auto rank = folder.first_rank + k;
      if (!file.next()) throw CutError("{}: expected {} blocks, found {}", path, folder.ranks, k);
      auto& address = mesh.address[rank];
      read_labels(file.stream(), layout_of(file.header(), path), address);
      if (address.size() != mesh.cells[rank])
        throw FormatError("{}: processor {}: {} cells, its mesh has {}", path, rank, address.size(),
                          mesh.cells[rank]);
      for (const auto cell : address) {
        if (cell < 0 || static_cast<std::size_t>(cell) >= total)
          throw FormatError(
              "{}: processor {} names cell {}, all processors have {}: is one missing?", path, rank,
              cell, total);
        if (taken[static_cast<std::size_t>(cell)])
          throw FormatError("{}: processor {} names cell {} a second time", path, rank, cell);
        taken[static_cast<std::size_t>(cell)] = true;
      }
    }
  }
  if (with > 0 && with < ranks)
    throw FormatError("{}: expected cellProcAddressing of {} processors, found {}", root, ranks,
                      with);
  if (with > 0) return;
  std::int32_t next = 0;  // rank after rank, the mesh and the fields alike
  for (std::size_t rank = 0; rank < ranks; ++rank)
    for (std::size_t c = 0; c < mesh.cells[rank]; ++c) mesh.address[rank].push_back(next++);
}

std::shared_ptr<const RankedMesh> OpenFoamCase::Impl::read_mesh(std::size_t time) const {
  auto made = std::make_shared<RankedMesh>();
  std::vector<CellGeometry> parts(ranks);
  for (const auto& folder : folders) {
    for (std::size_t k = 0; k < folder.ranks; ++k) {
      const auto open = [&](std::string_view name) -> std::unique_ptr<FoamBlocks> {
        const auto path = mesh_file(folder, time, name);
        if (path.empty() && name == "boundary") return nullptr;
        if (path.empty())
          throw FileError("{}/constant/{}polyMesh/{}: no such file", folder.path, region, name);
        auto file = std::make_unique<FoamBlocks>(path);
        for (std::size_t block = 0; block <= k; ++block)
          if (!file->next())
            throw CutError("{}: expected {} blocks, found {}", path, folder.ranks, block);
        return file;
      };
      parts[folder.first_rank + k] = cell_geometry(read_poly_mesh(open));
    }
  }
  for (const auto& part : parts) made->cells.push_back(part.volumes.size());
  if (ranks == 1) {
    made->mesh = make_mesh(std::move(parts.front()));
    return made;
  }
  read_addresses(time, *made);
  CellGeometry all;
  std::size_t total = 0;
  for (const auto cells : made->cells) total += cells;
  all.centres.resize(total);
  all.volumes.resize(total);
  all.low.resize(total);
  all.high.resize(total);
  for (std::size_t rank = 0; rank < ranks; ++rank)
    for (std::size_t c = 0; c < made->cells[rank]; ++c) {
      const auto cell = static_cast<std::size_t>(made->address[rank][c]);
      all.centres[cell] = parts[rank].centres[c];
      all.volumes[cell] = parts[rank].volumes[c];
      all.low[cell] = parts[rank].low[c];
      all.high[cell] = parts[rank].high[c];
    }
  made->mesh = make_mesh(std::move(all));
  return made;
}

OpenFoamCase OpenFoamCase::open(const std::string& path, const OpenFoamOptions& options) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    throw FileError("{}: expected the folder of an OpenFOAM case", path);
  auto made = std::make_shared<Impl>();
  made->root = path;
  while (made->root.size() > 1 && made->root.ends_with('/')) made->root.pop_back();
  if (!options.region.empty()) made->region = options.region + "/";
  made->folders = find_folders(made->root, options.decomposition);
  made->find_regions();
  made->count_ranks();
  made->find_times();
  made->find_fields();
  if (made->times.empty())
    throw InputError("{}: expected a time with fields of cells, found none{}", made->root,
                     made->problems.empty() ? "" : "; " + made->problems.front());
  made->check_last_time();
  made->tell_missing();
  for (const auto& folder : made->folders)
    for (const auto& time : made->times)
      for (const auto* name : {"points", "faces", "owner"})
        if (!plain_or_gz(
                 fmt::format("{}/{}/{}polyMesh/{}", folder.path, time.name, made->region, name))
                 .empty())
          made->moving = true;
  made->start = made->read_mesh(0);
  return OpenFoamCase(std::move(made));
}

const std::vector<OpenFoamTime>& OpenFoamCase::times() const { return impl_->times; }
const std::vector<std::string>& OpenFoamCase::fields_at(std::size_t time) const {
  return impl_->times.at(time).fields;
}
const Mesh& OpenFoamCase::mesh() const { return impl_->start->mesh; }
bool OpenFoamCase::moving() const { return impl_->moving; }
std::shared_ptr<const Mesh> OpenFoamCase::mesh_at(std::size_t time) const {
  const auto ranked = impl_->mesh_at(time);
  return {ranked, &ranked->mesh};
}
const std::vector<std::string>& OpenFoamCase::problems() const { return impl_->problems; }
const std::vector<std::string>& OpenFoamCase::regions() const { return impl_->regions; }
std::size_t OpenFoamCase::ranks() const { return impl_->ranks; }

void OpenFoamCase::read(std::size_t time, std::string_view field, FieldValues& out) const {
  const auto& fields = impl_->times.at(time).fields;
  const std::string name(field);
  if (!std::binary_search(fields.begin(), fields.end(), name))
    throw InputError("{}: no field {} at time {}, found {}", impl_->root, name,
                     impl_->times[time].name, fmt::join(fields, ", "));
  const auto ranked = impl_->mesh_at(time);
  const auto relative = impl_->time_folder(time) + name;
  if (impl_->ranks == 1) {
    impl_->for_each_rank(relative, [&](std::size_t, FoamBlocks& file) {
      read_field(file, FoamCount{ranked->cells[0]}, out);
    });
    return;
  }
  FieldValues part;
  std::vector<double> value;  // of the first rank, where that is uniform
  const auto head = [](const FieldValues& from) {
    return std::vector<double>(
        from.values.begin(),
        from.values.begin() + static_cast<std::ptrdiff_t>(
                                  std::min<std::size_t>(from.values.size(), from.components)));
  };
  bool first = true;
  impl_->for_each_rank(relative, [&](std::size_t rank, FoamBlocks& file) {
    read_field(file, FoamCount{ranked->cells[rank]}, part);
    const auto n = part.components;
    if (first) {
      out.class_name = part.class_name;
      out.components = n;
      out.dimensions = part.dimensions;
      out.dimensions_known = part.dimensions_known;
      out.uniform = part.uniform;
      out.no_header = part.no_header;
      out.non_finite = {};
      out.values.resize(ranked->mesh.cells() * n);
    } else if (n != out.components || part.dimensions != out.dimensions) {
      throw FormatError("{}: processor {}: type or dimensions differ from those of processor 0",
                        file.stream().path(), rank);
    }
    const auto& address = ranked->address[rank];
    for (std::size_t c = 0; c < address.size(); ++c)
      for (std::size_t k = 0; k < n; ++k)
        out.values[static_cast<std::size_t>(address[c]) * n + k] = part.values[c * n + k];
    out.non_finite.values += part.non_finite.values;
    out.uniform =
        out.uniform && part.uniform && (first || part.values.empty() || value == head(part));
    if (first) value = head(part);
    first = false;
  });
  for (std::size_t c = 0; out.non_finite.values > 0; ++c) {  // there is one
    const auto* at = out.values.data() + c * out.components;
    out.non_finite.first = c;
    if (!std::all_of(at, at + out.components, [](double x) { return x - x == 0; })) break;
  }
}

}  // namespace bedscope::readers
