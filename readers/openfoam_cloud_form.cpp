// SPDX-License-Identifier: BSD-3-Clause
// A Lagrangian cloud of an OpenFOAM case as a run of particles: one snapshot for each time.
#include <algorithm>
#include <filesystem>
#include <set>

#include "readers/columns.hpp"
#include "readers/error.hpp"
#include "readers/forms.hpp"
#include "readers/openfoam_case.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

// What a user names: CASE, CASE/cloud, CASE/region, CASE/region/cloud. The last three but regions
// are no folders on disk, as every time has its own.
struct CloudName {
  std::string root, region, cloud;
};

bool has_cloud(const std::string& root, const std::string& region, const std::string& cloud) {
  std::error_code error;
  for (auto folder = fs::directory_iterator(root, error);
       !error && folder != fs::directory_iterator(); folder.increment(error)) {
    const auto of_time = [&](const fs::path& time) {
      std::error_code ignored;
      return fs::is_directory(time / region / "lagrangian" / cloud, ignored);
    };
    if (of_time(folder->path())) return true;
    std::error_code ignored;
    if (!folder->path().filename().string().starts_with("processor")) continue;
    for (auto time = fs::directory_iterator(folder->path(), ignored);
         !ignored && time != fs::directory_iterator(); time.increment(ignored))
      if (of_time(time->path())) return true;
  }
  return false;
}

std::optional<CloudName> split(std::string path) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  if (is_openfoam_case(path)) return CloudName{path, {}, {}};
  // CFDEM in serial: a case of nothing but a cloud, in a folder of this name.
  if (is_openfoam_case(path + "/lagrangian")) return CloudName{path + "/lagrangian", {}, {}};
  const fs::path whole(path);
  std::error_code error;
  if (fs::exists(whole, error) || whole.filename().empty()) return std::nullopt;
  const auto name = whole.filename().string();
  const auto parent = whole.has_parent_path() ? whole.parent_path() : fs::path(".");
  const auto in_regions = [&](const std::string& root, const std::string& region) {
    const auto regions = openfoam_regions(root);
    return std::find(regions.begin(), regions.end(), region) != regions.end();
  };
  if (is_openfoam_case(parent.string())) {
    if (has_cloud(parent.string(), {}, name)) return CloudName{parent.string(), {}, name};
    if (in_regions(parent.string(), name)) return CloudName{parent.string(), name, {}};
    return std::nullopt;
  }
  const auto region = parent.filename().string();
  const auto root = parent.has_parent_path() ? parent.parent_path().string() : std::string(".");
  if (!region.empty() && is_openfoam_case(root) && in_regions(root, region) &&
      has_cloud(root, region, name))
    return CloudName{root, region, name};
  return std::nullopt;
}

// What read() needs of a snapshot.
struct OpenCloud {
  OpenFoamCase foam;
  std::string cloud;
  std::size_t time;
};

std::string chosen_cloud(const OpenFoamCase& foam, const CloudName& name) {
  std::set<std::string> clouds;
  for (std::size_t t = 0; t < foam.times().size(); ++t)
    for (auto& cloud : foam.clouds_at(t)) clouds.insert(std::move(cloud));
  if (clouds.empty() && foam.mesh().cells() == 0)
    throw FormatError("{}: an OpenFOAM case without constant/polyMesh", name.root);
  if (clouds.empty())
    throw InputError("{}: an OpenFOAM case without a Lagrangian cloud, expected particles",
                     name.root);
  if (name.cloud.empty() && clouds.size() > 1)
    throw InputError("{}: several clouds ({}), name one: {}/{}", name.root, fmt::join(clouds, ", "),
                     name.root, *clouds.begin());
  return name.cloud.empty() ? *clouds.begin() : name.cloud;
}

using Names = std::shared_ptr<const std::vector<std::string>>;

// The names without those that are only ours for a column beside it (radius for r, id for origId).
Names on_disk(const std::vector<std::string>& parts) {
  std::vector<std::string> names;
  for (const auto& part : parts)
    if (part != "radius" && part != "diameter" && part != "id" && part != "type")
      names.push_back(part);
  return std::make_shared<const std::vector<std::string>>(std::move(names));
}

Box box_of(const Mesh& mesh) {
  Box box;
  box.min = mesh.min;
  box.max = mesh.max;
  box.known = mesh.cells() > 0;
  return box;
}

bool has_name(const Located& located, std::string_view name) {
  return located.columns != nullptr && std::find(located.columns->begin(), located.columns->end(),
                                                 name) != located.columns->end();
}

FileScan scan(const std::string& path, bool) {
  const auto name = split(path);
  if (!name) throw FileError("{}: expected an OpenFOAM case, or CASE/cloud", path);
  OpenFoamOptions options;
  options.region = name->region;
  options.mesh_optional = true;
  const auto foam = OpenFoamCase::open(name->root, options);
  const auto cloud = chosen_cloud(foam, *name);
  FileScan found;
  found.problems = foam.problems();
  std::vector<std::string> lacking;
  Names parts, columns;
  for (std::size_t t = 0; t < foam.times().size(); ++t) {
    const auto parcels = foam.parcels(t, cloud);
    if (!parcels) {  // before the first: initial fields come without a cloud
      if (!found.snapshots.empty()) lacking.push_back(foam.times()[t].name);
      continue;
    }
    Located located;
    located.time = foam.times()[t].time;
    located.particles = static_cast<std::int64_t>(*parcels);
    located.box = box_of(foam.mesh());
    if (*parcels > 0) {
      auto here = foam.cloud_columns(t, cloud);
      if (parts == nullptr || *parts != here) {
        columns = on_disk(here);
        parts = std::make_shared<const std::vector<std::string>>(std::move(here));
      }
      located.columns = columns;
      located.parts = parts;
    }
    located.context = std::make_shared<const OpenCloud>(OpenCloud{foam, cloud, t});
    found.snapshots.push_back(std::move(located));
  }
  if (found.snapshots.empty())
    throw FormatError("{}: cloud {} is at none of {} times", name->root, cloud,
                      foam.times().size());
  if (!lacking.empty())
    found.problems.push_back(fmt::format("cloud {} is missing at {} of {} times, first at {}",
                                         cloud, lacking.size(), foam.times().size(),
                                         lacking.front()));
  // Snapshots without parcels have the columns of the others.
  for (auto& located : found.snapshots) {
    if (located.parts != nullptr) continue;
    located.columns = columns;
    located.parts = parts;
  }
  return found;
}

// An identity is both the id and the rank that gave it: the place of the id in the request, or -1.
std::ptrdiff_t id_of_ranks(const Located& where, const Request& request) {
  const auto id = std::find_if(request.begin(), request.end(),
                               [](const ColumnRequest& item) { return item.name == "id"; });
  return id == request.end() || !has_name(where, "origProcId") ? -1 : id - request.begin();
}

void read(const std::string&, const Located& where, const Request& request, Snapshot& out,
          Scratch&) {
  const auto& open = *static_cast<const OpenCloud*>(where.context.get());
  out.time = where.time;
  out.step = no_step;
  out.box = where.box;
  out.particles = 0;
  out.columns.assign(request.size(), {});
  out.bytes_read = 0;
  if (where.particles == 0) return;
  auto with_rank = request;
  const auto id = id_of_ranks(where, request);
  if (id >= 0) with_rank.push_back({"origProcId"});
  open.foam.read_cloud(open.time, open.cloud, with_rank, out);
  out.box = where.box;
  if (id < 0) return;
  const auto& ranks = out.columns.back();
  auto& ids = out.columns[static_cast<std::size_t>(id)];
  for (std::size_t p = 0; p < ids.size(); ++p)
    ids[p] += 4294967296.0 * ranks[p];  // exact up to 2^21 ranks of 2^32 parcels
  out.columns.pop_back();
}

std::string place(const std::string&, const Located& where, std::size_t row) {
  const auto& open = *static_cast<const OpenCloud*>(where.context.get());
  return fmt::format("time {}: {}: parcel {}", open.foam.times()[open.time].name, open.cloud, row);
}

bool matches(const std::string& folder) { return split(folder).has_value(); }

}  // namespace

extern const Form openfoam_cloud;
const Form openfoam_cloud{.name = "openfoam-cloud",
                          .description = "Lagrangian cloud of an OpenFOAM case",
                          .reference = "OpenFOAM v1912, src/lagrangian/basic: IOPosition, particle",
                          .matches_folder = matches,
                          .scan = scan,
                          .glance_tells = true,
                          .read = read,
                          .place = place};

}  // namespace bedscope::readers
