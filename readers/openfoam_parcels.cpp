// SPDX-License-Identifier: BSD-3-Clause
// Clouds of a case as particles: positions and fields of all ranks.
#include <algorithm>
#include <array>
#include <filesystem>
#include <span>

#include "readers/columns.hpp"
#include "readers/openfoam_case_impl.hpp"
#include "readers/openfoam_list.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

// A column of a cloud: a component of one of its files.
struct CloudColumn {
  std::string name, file;
  std::size_t component = 0;
};

// Names of the field beside those on disk. `d` is a diameter, CFDEM's `r` a radius.
constexpr std::array<std::array<std::string_view, 2>, 4> other_names{
    {{"d", "diameter"}, {"r", "radius"}, {"origId", "id"}, {"typeId", "type"}}};

void add_columns(std::string_view file, std::string_view class_name,
                 std::vector<CloudColumn>& columns) {
  const std::string name(file);
  if (class_name == "vectorField") {
    const bool velocity = name == "U" || name == "v";
    for (std::size_t k = 0; k < 3; ++k)
      columns.push_back(
          {velocity ? fmt::format("v{}", "xyz"[k]) : fmt::format("{}[{}]", name, k + 1), name, k});
  } else if (class_name == "scalarField" || class_name == "labelField") {
    if (name == "x" || name == "y" || name == "z") return;  // positions are those of the parcels
    columns.push_back({name, name, 0});
    for (const auto& [on_disk, ours] : other_names)
      if (on_disk == name) columns.push_back({std::string(ours), name, 0});
  }
}

std::size_t components_of(const std::vector<CloudColumn>& columns, const std::string& file) {
  std::size_t components = 1;
  for (const auto& column : columns)
    if (column.file == file) components = std::max(components, column.component + 1);
  return components;
}

// The folder of a cloud in the first folder of the case that has it: ranks may have no parcels.
std::string cloud_folder(const OpenFoamCase::Impl& impl, const std::string& relative) {
  for (const auto& folder : impl.folders) {
    auto path = fmt::format("{}/{}", folder.path, relative);
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return path;
  }
  return {};
}

// CFDEM in serial names the folder of the cloud after its time: 0.05/lagrangian/0.05.
constexpr std::string_view serial_cloud = "particleCloud";

std::vector<CloudColumn> columns_in(const std::string& folder) {
  std::vector<CloudColumn> columns{{"x", "", 0}, {"y", "", 1}, {"z", "", 2}};
  std::error_code error;
  std::vector<std::string> names;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
    if (fs::is_regular_file(entry->path(), error))
      names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  for (auto& name : names) {
    FoamBlocks file(fmt::format("{}/{}", folder, name));
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    if (file.next()) add_columns(name, file.header().class_name, columns);
  }
  return columns;
}

// Those of the folder with the most files: a rank without parcels may have nothing but positions,
// and what a rank with parcels lacks is an error when it is read.
std::vector<CloudColumn> columns_of(const OpenFoamCase::Impl& impl, const std::string& relative) {
  std::string fullest;
  std::ptrdiff_t most = -1;
  for (const auto& folder : impl.folders) {
    auto path = folder.path + "/" + relative;
    std::error_code none;  // of a rank without the folder
    const auto files = std::distance(fs::directory_iterator(path, none), fs::directory_iterator());
    if (files <= most) continue;
    most = files;
    fullest = std::move(path);
  }
  return columns_in(fullest);
}

// Where the parcels of a folder are; empty where its ranks have none. Fields of parcels that are
// nowhere are an error: these would be missing without a word.
std::string points_file(const FoamFolder& folder, const std::string& relative) {
  const auto cloud = folder.path + "/" + relative;
  for (const auto* name : {"/coordinates", "/positions"})
    if (auto path = plain_or_gz(cloud + name); !path.empty()) return path;
  if (const auto columns = columns_in(cloud); columns.size() > 3)
    throw FileError("{}/coordinates: no such file (nor positions), found {}", cloud,
                    columns.back().file);
  return {};
}

// A field of the cloud, the values of all ranks behind one another, `components` a parcel.
std::vector<double> read_cloud_field(const OpenFoamCase::Impl& impl, const std::string& relative,
                                     const std::string& name, std::span<const std::size_t> parcels,
                                     std::size_t components) {
  std::vector<double> all, values;
  std::vector<std::int32_t> labels;
  for (const auto& folder : impl.folders) {
    if (!folder.collated && parcels[folder.first_rank] == 0) continue;
    const auto path = OpenFoamCase::Impl::path_in(folder, fmt::format("{}/{}", relative, name));
    OpenFoamCase::Impl::for_ranks_of(folder, path, [&](std::size_t rank, FoamBlocks& file) {
      const auto layout = layout_of(file.header(), path);
      const FoamCount expected{parcels[rank], "positions", "entries"};
      const auto& class_name = file.header().class_name;
      if (class_name == "labelField") {
        read_labels(file.stream(), layout, labels, expected);
        values.assign(labels.begin(), labels.end());
      } else {
        read_values(file.stream(), layout,
                    *foam_type(class_name == "vectorField" ? "vector" : "scalar"), expected,
                    values);
      }
      if (values.size() != components * parcels[rank])
        throw FormatError("{}: expected {} a parcel, as other processors have, found a {}", path,
                          components == 1 ? "one number" : "a vector", class_name);
      if (name == "d" || name == "r")
        for (std::size_t p = 0; p < values.size(); ++p)
          if (values[p] < 0)
            throw FormatError("{}: parcel {} has {} {}", path, p,
                              name == "d" ? "diameter" : "radius", values[p]);
      all.insert(all.end(), values.begin(), values.end());
    });
  }
  return all;
}

}  // namespace

std::string OpenFoamCase::Impl::cloud_path(std::size_t time, std::string_view cloud) const {
  const auto path = time_folder(time) + "lagrangian/";
  auto by_time = path + times[time].name;
  if (cloud == serial_cloud && !cloud_folder(*this, by_time).empty()) return by_time;
  return path + std::string(cloud);
}

std::vector<std::string> OpenFoamCase::clouds_at(std::size_t time) const {
  std::vector<std::string> names;
  for (const auto& folder : impl_->folders) {
    std::error_code error;
    const auto path = folder.path + "/" + impl_->time_folder(time) + "lagrangian";
    for (auto entry = fs::directory_iterator(path, error);
         !error && entry != fs::directory_iterator(); entry.increment(error)) {
      auto name = entry->path().filename().string();
      // Ghost parcels of neighbouring processors.
      if (name == "referredParticleCloud" || !fs::is_directory(entry->path(), error)) continue;
      names.push_back(name == impl_->times[time].name ? std::string(serial_cloud) : name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::optional<std::size_t> OpenFoamCase::parcels(std::size_t time, std::string_view cloud) const {
  const auto relative = impl_->cloud_path(time, cloud);
  std::optional<std::size_t> sum;
  for (const auto& folder : impl_->folders) {
    // What the solver keeps of a cloud from run to run, parcels or not.
    const auto state = fmt::format("{}/{}uniform/lagrangian/{}/cloudProperties", folder.path,
                                   impl_->time_folder(time), cloud);
    if (!plain_or_gz(state).empty()) sum = sum.value_or(0);
    const auto path = points_file(folder, relative);
    if (path.empty()) continue;
    Impl::for_ranks_of(folder, path, [&](std::size_t, FoamBlocks& file) {
      sum = sum.value_or(0) + read_cloud_count(file);
    });
  }
  return sum;
}

std::vector<std::string> OpenFoamCase::cloud_columns(std::size_t time,
                                                     std::string_view cloud) const {
  std::vector<std::string> names;
  for (const auto& column : columns_of(*impl_, impl_->cloud_path(time, cloud)))
    names.push_back(column.name);
  return names;
}

std::vector<std::string> OpenFoamCase::read_cloud(std::size_t time, std::string_view cloud,
                                                  const Request& request, Snapshot& out) const {
  const auto relative = impl_->cloud_path(time, cloud);
  const auto where = impl_->shown(relative);
  if (cloud_folder(*impl_, relative).empty())
    throw InputError("{}: no such cloud, found {}", where, fmt::join(clouds_at(time), ", "));
  const auto columns = columns_of(*impl_, relative);
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const auto& column : columns) names.push_back(column.name);
  const auto plan = plan_columns(names, request, where);

  CloudPoints points;
  std::vector<std::size_t> parcels(impl_->ranks);
  std::shared_ptr<const std::vector<CloudMesh>> meshes;
  for (const auto& folder : impl_->folders) {
    const auto path = points_file(folder, relative);
    if (path.empty()) continue;
    Impl::for_ranks_of(folder, path, [&](std::size_t rank, FoamBlocks& file) {
      const auto before = points.at.size();
      const auto mesh = [&]() -> const CloudMesh& {
        if (meshes == nullptr) meshes = impl_->cloud_meshes(time);
        return (*meshes)[rank];
      };
      read_cloud_points(file, mesh, points);
      parcels[rank] = points.at.size() - before;
    });
  }
  out.step = no_step;
  out.time = impl_->times.at(time).time;
  out.particles = points.at.size();
  out.box = {};
  out.bytes_read = 0;
  std::vector<std::vector<double>> raw(plan.parse.size());
  std::string last_file;
  std::vector<double> values;
  for (std::size_t k = 0; k < raw.size(); ++k) {
    const auto& column = columns[static_cast<std::size_t>(plan.parse[k])];
    raw[k].resize(points.at.size());
    if (column.file.empty()) {
      for (std::size_t p = 0; p < raw[k].size(); ++p) raw[k][p] = points.at[p][column.component];
      continue;
    }
    const auto components = components_of(columns, column.file);
    if (column.file != last_file)
      values = read_cloud_field(*impl_, relative, last_file = column.file, parcels, components);
    for (std::size_t p = 0; p < raw[k].size(); ++p)
      raw[k][p] = values[p * components + column.component];
  }
  finish_columns(plan, raw, out, where);
  std::vector<std::string> problems;
  if (points.off_sum > 0)
    problems.push_back(
        fmt::format("{}: {} parcels: barycentric coordinates do not sum to 1; parcel {}: {:.6g}",
                    where, points.off_sum, points.first_off, points.first_sum));
  return problems;
}

}  // namespace bedscope::readers
