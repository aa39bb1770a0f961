// SPDX-License-Identifier: BSD-3-Clause
#include "readers/vtk_gas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>

#include "readers/error.hpp"
#include "readers/vtk_common.hpp"
#include "readers/vtk_gas_files.hpp"
#include "readers/vtk_grid.hpp"

namespace bedscope::readers {
namespace {

// VTK's order is xx yy zz xy yz xz, OpenFOAM's xx xy xz yy yz zz.
constexpr std::array<std::size_t, 6> symmetric{0, 3, 5, 1, 4, 2};

constexpr std::array<std::pair<std::size_t, std::string_view>, 4> classes{
    {{1, "volScalarField"},
     {3, "volVectorField"},
     {6, "volSymmTensorField"},
     {9, "volTensorField"}}};

std::string_view class_of(std::size_t components) {
  for (const auto& [count, name] : classes)
    if (count == components) return name;
  return {};
}

// The open files of one time.
struct Loaded {
  std::vector<std::shared_ptr<const VtkGrid>> grids;
  std::uint64_t mark = 0;  // of the mesh
  double time = unknown;

  explicit Loaded(const VtkGasTime& from) : time(from.time) {
    for (const auto& file : from.files) {
      auto grid = open_vtk_grid(file);
      if (grid == nullptr) continue;  // a piece without cells
      mark = mark * 31 + grid->mesh_mark();
      if (std::isnan(time)) time = as_written(grid->time);
      grids.push_back(std::move(grid));
    }
    if (grids.empty())
      throw FormatError("{}: expected cells with a volume, found none", from.files.front());
  }
};

class VtkGas final : public GasForm {
 public:
  explicit VtkGas(const std::string& path) : path_(path) {
    files_ = vtk_gas_files(path, problems_);
    for (std::size_t k = 0; k < files_.size(); ++k) {
      try {
        add_time(k);
      } catch (const FormatError& error) {  // counts that the rest cannot hold may be a cut, too
        if (k + 1 < files_.size() || k == 0) throw;
        problems_.push_back(fmt::format("{}: left out", error.what()));
        files_.pop_back();
      }
    }
    order();
    for (auto& line : missing_fields(path, times_)) problems_.push_back(std::move(line));
    cache_.clear();  // its keys were those before they were ordered
    const auto start = load(0);
    first_mark_ = start->mark;
    first_mesh_ = std::make_shared<const Mesh>(make(*start));
  }

  const std::vector<GasTime>& times() const override { return times_; }
  const std::vector<std::string>& problems() const override { return problems_; }
  std::vector<std::string> files(std::size_t time, std::string_view) const override {
    return files_.at(time).files;
  }

  std::shared_ptr<const Mesh> mesh_at(std::size_t time) const override {
    const auto loaded = load(time);
    if (loaded->mark == first_mark_) return first_mesh_;
    return std::make_shared<const Mesh>(make(*loaded));
  }

  void read(std::size_t time, std::string_view field, FieldValues& out) const override {
    const auto loaded = load(time);
    std::vector<std::vector<double>> columns;
    for (const auto& grid : loaded->grids) {
      const auto found = std::find_if(grid->fields.begin(), grid->fields.end(),
                                      [&](const auto& one) { return one.name == field; });
      if (found == grid->fields.end() || class_of(found->components).empty())
        throw InputError("{}: no field {} at time {}, found {}", path_, field, times_[time].name,
                         fmt::join(times_[time].fields, ", "));
      auto part = grid->read(*found);
      if (columns.empty()) {
        columns = std::move(part);
        continue;
      }
      if (part.size() != columns.size())
        throw FormatError("{}: field {} at time {}: {} components in one file, {} in another",
                          path_, field, times_[time].name, columns.size(), part.size());
      for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c].insert(columns[c].end(), part[c].begin(), part[c].end());
    }
    put(columns, out);
    out.binary = loaded->grids.front()->binary;
    out.compressed = loaded->grids.front()->compressed;
  }

 private:
  void add_time(std::size_t k) {
    const auto loaded = load(k);
    GasTime time{fmt::format("{}", loaded->time), loaded->time, {}};
    if (std::isnan(loaded->time)) {
      if (files_.size() > 1)
        throw InputError("{}: no time in it (TimeValue), and no .series or .pvd that tells it",
                         files_[k].files.front());
      time = {"0", 0, {}};
      problems_.push_back(
          fmt::format("{}: no time in it (TimeValue): taken as 0 s", files_[k].files.front()));
    }
    for (const auto& field : loaded->grids.front()->fields)
      if (!class_of(field.components).empty()) time.fields.push_back(field.name);
    std::sort(time.fields.begin(), time.fields.end());
    time.fields.erase(std::unique(time.fields.begin(), time.fields.end()), time.fields.end());
    times_.push_back(std::move(time));
  }

  void order() {
    std::vector<std::size_t> by_time(times_.size());
    for (std::size_t k = 0; k < by_time.size(); ++k) by_time[k] = k;
    std::stable_sort(by_time.begin(), by_time.end(),
                     [&](auto a, auto b) { return times_[a].time < times_[b].time; });
    auto times = std::exchange(times_, {});
    auto files = std::exchange(files_, {});
    for (const auto k : by_time) {
      if (!times_.empty() && times_.back().time == times[k].time)
        throw InputError("{} and {} are the same time, {} s", files_.back().files.front(),
                         files[k].files.front(), times[k].time);
      times_.push_back(std::move(times[k]));
      files_.push_back(std::move(files[k]));
    }
  }

  static void put(const std::vector<std::vector<double>>& columns, FieldValues& out) {
    const auto components = columns.size();
    const auto cells = columns.front().size();
    out = {.class_name = std::string(class_of(components)),
           .components = static_cast<unsigned>(components),
           .values = std::move(out.values)};
    out.values.resize(components * cells);
    for (std::size_t c = 0; c < cells; ++c) {
      bool finite = true;
      for (std::size_t k = 0; k < components; ++k) {
        const double value = columns[components == 6 ? symmetric[k] : k][c];
        out.values[components * c + k] = value;
        finite = finite && std::isfinite(value);
      }
      if (!finite && out.non_finite.values++ == 0) out.non_finite.first = c;
    }
  }

  Mesh make(const Loaded& loaded) const {
    std::vector<VtkCells> pieces;
    for (const auto& grid : loaded.grids) {
      auto more = grid->pieces();
      std::move(more.begin(), more.end(), std::back_inserter(pieces));
    }
    return mesh_of(pieces, files_.front().files.front());
  }

  // Fields of one time are read one after the other, times by several threads at once.
  std::shared_ptr<const Loaded> load(std::size_t time) const {
    const std::size_t kept = std::max(1U, std::thread::hardware_concurrency());
    {
      const std::scoped_lock lock(mutex_);
      for (const auto& [k, loaded] : cache_)
        if (k == time) return loaded;
    }
    auto loaded = std::make_shared<const Loaded>(files_.at(time));
    const std::scoped_lock lock(mutex_);
    if (cache_.size() >= kept) cache_.erase(cache_.begin());
    cache_.emplace_back(time, loaded);
    return loaded;
  }

  std::string path_;
  std::vector<VtkGasTime> files_;
  std::vector<GasTime> times_;
  std::vector<std::string> problems_;
  std::uint64_t first_mark_ = 0;
  std::shared_ptr<const Mesh> first_mesh_;
  mutable std::mutex mutex_;
  mutable std::vector<std::pair<std::size_t, std::shared_ptr<const Loaded>>> cache_;
};

}  // namespace

bool is_vtk_gas(const std::string& path) {
  try {
    const auto file = first_vtk_grid(path);
    if (file.empty()) return false;
    const auto grid = open_vtk_grid(file);
    return grid != nullptr && !grid->fields.empty();  // a triclinic bounding box has none
  } catch (const CutError&) {
    return false;
  } catch (const FormatError&) {
    return false;
  }
}

std::shared_ptr<const GasForm> open_vtk_gas(const std::string& path,
                                            const OpenFoamOptions& options) {
  return std::make_shared<const VtkGas>(options.region.empty() ? path
                                                               : path + "/" + options.region);
}

}  // namespace bedscope::readers
