// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_case.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "readers/openfoam_case_impl.hpp"

namespace bedscope::readers {

namespace fs = std::filesystem;

void OpenFoamCase::Impl::find_regions() {
  std::error_code error;
  const fs::path constant = folders.front().path + "/constant";
  for (auto entry = fs::directory_iterator(constant, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
    if (fs::is_directory(entry->path() / "polyMesh", error))
      regions.push_back(entry->path().filename().string());
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

// Points in the wrong order of bytes, or a mesh that is folded.
void OpenFoamCase::Impl::tell_empty_cells() {
  const auto& volumes = start->mesh.volumes;
  const auto bad = [](double volume) { return !(volume > 0) || std::isinf(volume); };
  const auto first = std::find_if(volumes.begin(), volumes.end(), bad);
  if (first == volumes.end()) return;
  problems.push_back(fmt::format(
      "{}: {} of {} cells have no volume, or one below zero; first: cell {}, {:.3g} m3",
      shown("constant/" + region + "polyMesh"), std::count_if(first, volumes.end(), bad),
      volumes.size(), first - volumes.begin(), *first));
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
  if (options.mesh_optional && !made->has_mesh())
    made->start = std::make_shared<RankedMesh>();
  else
    made->start = made->read_mesh(0);
  made->tell_empty_cells();
  OpenFoamCase foam(made);
  if (made->times.size() == 1) return foam;  // told when the cloud is read
  if (const auto why = made->why_clouds_are_cut(foam); !why.empty()) {
    const auto name = made->times.back().name;
    made->times.pop_back();
    made->problems.push_back(fmt::format("time {} is left out: {}", name, why));
  }
  return foam;
}

const std::vector<GasTime>& OpenFoamCase::times() const { return impl_->times; }
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
bool OpenFoamCase::collated() const { return impl_->folders.front().collated; }

std::vector<std::string> OpenFoamCase::files(std::size_t time, std::string_view field) const {
  std::vector<std::string> found;
  for (const auto& folder : impl_->folders)
    found.push_back(Impl::path_in(folder, impl_->time_folder(time) + std::string(field)));
  return found;
}

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
  // All ranks into their places; where the field is uniform, rank by rank, it is as a whole if the
  // values agree.
  unsigned components = 0;
  std::array<double, 7> dimensions{};
  std::vector<double> value;
  std::vector<double> piece;
  std::size_t non_finite = 0;
  bool uniform = true;
  impl_->for_each_rank(relative, [&](std::size_t rank, FoamBlocks& file) {
    const auto& runs = ranked->runs[rank];
    const FoamPlaces places{runs, ranked->cells[rank], ranked->mesh.cells(), &piece};
    read_field(file, FoamCount{ranked->cells[rank]}, out, &places);
    if (rank > 0 && (out.components != components || out.dimensions != dimensions))
      throw FormatError("{}: processor {}: type or dimensions differ from those of processor 0",
                        file.stream().path(), rank);
    components = out.components;
    dimensions = out.dimensions;
    non_finite += out.non_finite.values;
    if (runs.empty()) return;
    const auto first = out.values.begin() + std::ptrdiff_t{runs[0].place} * components;
    if (value.empty()) value.assign(first, first + components);
    uniform = uniform && out.uniform && std::equal(value.begin(), value.end(), first);
  });
  out.uniform = uniform;
  out.non_finite = {non_finite, 0};
  for (std::size_t c = 0; non_finite > 0; ++c) {  // there is one
    const auto* at = out.values.data() + c * out.components;
    out.non_finite.first = c;
    if (!std::all_of(at, at + out.components, [](double x) { return x - x == 0; })) break;
  }
}

}  // namespace bedscope::readers
