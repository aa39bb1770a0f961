// SPDX-License-Identifier: BSD-3-Clause
#include "readers/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "readers/columns.hpp"

namespace bedscope::readers {
std::vector<std::size_t> chosen_snapshots(std::size_t count, bool full) {
  constexpr std::size_t sample = 10;
  return evenly_spread(count, full ? count : sample);
}

namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The columns to read: those that the field knows, at fixed places, then the rest by their names
/// on disk.
struct Columns {
  enum { x, y, z, vx, vy, vz, radius, type, id, density, mass, fields };
  Request request{{"x"},
                  {"y"},
                  {"z"},
                  {"vx", false},
                  {"vy", false},
                  {"vz", false},
                  {"radius", false},
                  {"type", false},
                  {"id", false},
                  {"density", false},
                  {"mass", false}};
  std::vector<std::size_t> on_disk;  ///< a name of the dump: its place in the request
  std::size_t body = 0;              ///< 0: none

  explicit Columns(const std::vector<std::string>& parts, Survey& found) {
    for (const auto& name : parts) {
      // XML files of LIGGGHTS have arrays without names.
      if (name.empty() || holds_text(name)) continue;
      auto place = std::find_if(request.begin(), request.end(),
                                [&](const ColumnRequest& item) { return item.name == name; });
      if (place == request.end()) place = request.insert(place, {name, false});
      const auto at = static_cast<std::size_t>(place - request.begin());
      if (std::find(on_disk.begin(), on_disk.end(), at) != on_disk.end()) continue;  // type type
      on_disk.push_back(at);
      found.columns.emplace_back().name = name;
      if (name == "id_multisphere" || (name == "mol" && body == 0)) body = at;
    }
  }
};

/// What the header of each snapshot tells.
void survey_headers(const Series& series, Survey& found) {
  found.particles = {std::numeric_limits<std::int64_t>::max(), 0};
  for (std::size_t i = 0; i < series.size(); ++i) {
    const auto count = series.particles(i);
    found.steps.push_back(series.step(i));
    found.counts.push_back(count);
    if (!std::isnan(series.time(i))) found.times.push_back(series.time(i));
    found.particles[0] = std::min(found.particles[0], count);
    found.particles[1] = std::max(found.particles[1], count);
  }
  if (found.times.size() < series.size()) found.times.clear();
  found.box = series.located(0).box;
  const auto& parts = series.parts();
  if (has_column(parts, "temperature"))
    found.temperature_column = name_on_disk(parts, "temperature");
  found.has_bodies = contains(parts, "id_multisphere") || contains(parts, "mol");
  found.has_shapes =
      contains(parts, "shapex") || contains(parts, "blockiness1") || contains(parts, "shapex[0]");
}

/// Of a tilted box the volume of the one around it, less what the tilt takes of its sides.
double volume_of(const Box& box) {
  const auto [xy, xz, yz] = box.tilt;
  const double tilt_x = std::max({0., xy, xz, xy + xz}) - std::min({0., xy, xz, xy + xz});
  return (box.max[0] - box.min[0] - tilt_x) * (box.max[1] - box.min[1] - std::abs(yz)) *
         (box.max[2] - box.min[2]);
}

/// Takes the rows of one snapshot after the other.
class RowSurvey {
 public:
  RowSurvey(const Series& series, Survey& found)
      : series_(&series), found_(&found), columns_(series.parts(), found) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    found.radius = {infinity, -infinity};
    found.min.fill(infinity);
    found.max.fill(-infinity);
  }

  void add(std::size_t i, bool look_for_overlaps) {
    series_->read(i, columns_.request, snapshot_, scratch_);
    ++found_->snapshots_read;
    for (std::size_t k = 0; k < columns_.on_disk.size(); ++k)
      add_column(i, snapshot_.columns[columns_.on_disk[k]], found_->columns[k]);
    Flaws here;
    SnapshotSurvey sums{.index = i};
    if (has(Columns::radius)) sums.volume = 0;
    if (has(Columns::radius) && (has(Columns::density) || mass_counts())) sums.mass = 0;
    for (std::size_t row = 0; row < snapshot_.particles; ++row) add_row(i, row, sums, here);
    const auto& box = snapshot_.box;
    if (box.known && !box.shrink_wrapped) sums.holdup = sums.volume / volume_of(box);
    found_->read.push_back(sums);
    if (has(Columns::id)) find_doubled_ids(column(Columns::id), i, marks_, here);
    find_no_types(column(Columns::type), column(Columns::id), i, here);
    flaws_.merge(here);
    if (look_for_overlaps && has(Columns::radius)) add_overlaps(i);
  }

  void finish() {
    for (auto& line : flaws_.describe(*series_)) found_->problems.push_back(std::move(line));
    if (found_->fastest > 0) found_->fastest_place = series_->place(fastest_at_[0], fastest_at_[1]);
  }

 private:
  const std::vector<double>& column(std::size_t k) const { return snapshot_.columns[k]; }
  bool has(std::size_t k) const { return !column(k).empty(); }
  double value(std::size_t k, std::size_t row) const { return has(k) ? column(k)[row] : unknown; }
  /// In dumps of bodies each row carries the mass of the whole body.
  bool mass_counts() const { return has(Columns::mass) && !found_->has_bodies; }

  void add_column(std::size_t i, const std::vector<double>& values, ColumnSurvey& to) const {
    to.values += static_cast<std::int64_t>(values.size());
    for (std::size_t row = 0; row < values.size(); ++row) {
      const double x = values[row];
      if (!std::isfinite(x)) {
        if (to.not_finite++ == 0) to.first_not_finite = series_->place(i, row);
        continue;
      }
      to.range.add(x);
      to.sum += x;
      to.zeros += x == 0 ? 1 : 0;
    }
  }

  void add_row(std::size_t i, std::size_t row, SnapshotSurvey& sums, Flaws& here) {
    bool finite = true;
    for (std::size_t k = 0; k <= Columns::radius; ++k)
      finite = finite && (!has(k) || std::isfinite(column(k)[row]));
    const double name = value(Columns::id, row);
    if (!finite) {
      here.not_finite.add(i, row, name);
      return;
    }
    found_->has_particles = true;
    add_place(row, here);
    add_speed(i, row);
    auto* const species = add_type(row);
    if (!has(Columns::radius)) return;
    const double r = column(Columns::radius)[row];
    found_->has_radius = true;
    found_->radius = {std::min(found_->radius[0], r), std::max(found_->radius[1], r)};
    if (species != nullptr) species->radius.add(r);
    if (r <= 0)
      here.no_size.add(i, row, name);
    else
      add_mass(4 * std::numbers::pi / 3 * r * r * r, row, sums, species);
  }

  void add_place(std::size_t row, Flaws& here) {
    const auto& box = snapshot_.box;
    bool outside = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = column(axis)[row];
      found_->min[axis] = std::min(found_->min[axis], x);
      found_->max[axis] = std::max(found_->max[axis], x);
      here.farthest = std::max(here.farthest, std::abs(x));
      // Dumps have 6 digits, the box too. Periodic sides are crossed between two wraps.
      const double edge = 1e-5 * (box.max[axis] - box.min[axis]);
      outside = outside ||
                (!box.periodic[axis] && (x < box.min[axis] - edge || x > box.max[axis] + edge));
    }
    if (outside && box.known && !box.shrink_wrapped) ++found_->outside_box;
  }

  void add_speed(std::size_t i, std::size_t row) {
    double squared = 0;
    for (const std::size_t k : {Columns::vx, Columns::vy, Columns::vz})
      if (has(k)) squared += column(k)[row] * column(k)[row];
    if (squared <= found_->fastest * found_->fastest) return;
    found_->fastest = std::sqrt(squared);
    fastest_at_ = {i, row};
  }

  SpeciesSurvey* add_type(std::size_t row) {
    const double type = value(Columns::type, row);
    if (!has(Columns::type)) return nullptr;
    auto& species = found_->types[whole_type(type)];
    ++species.particles;
    if (has(Columns::density)) species.density.add(column(Columns::density)[row]);
    if (has(Columns::mass)) species.mass.add(column(Columns::mass)[row]);
    return &species;
  }

  void add_mass(double volume, std::size_t row, SnapshotSurvey& sums, SpeciesSurvey* species) {
    sums.volume += volume;
    const double mass = value(Columns::mass, row), density = value(Columns::density, row);
    if (mass_counts()) {
      sums.mass += mass;
      if (species != nullptr) species->implied_density.add(mass / volume);
      if (density > 0) found_->mass_ratio.add(mass / (density * volume));
    } else if (has(Columns::density)) {
      sums.mass += density * volume;
    }
  }

  /// Last of all: the search takes as much memory as the columns, and those that it does not look
  /// at make room for it.
  void add_overlaps(std::size_t i) {
    for (std::size_t k = Columns::vx; k < snapshot_.columns.size(); ++k)
      if (k != Columns::radius && k != columns_.body)
        std::vector<double>().swap(snapshot_.columns[k]);
    Spheres spheres{column(0), column(1), column(2), column(Columns::radius), {}};
    if (columns_.body > 0) spheres.body = column(columns_.body);
    const auto here = find_overlaps(spheres);
    auto& worst = found_->overlap;
    if (worst.tested && here.deepest <= worst.found.deepest) return;
    worst = {true, i, here, here.deepest > 0 ? series_->place(i, here.a) : ""};
  }

  const Series* series_;
  Survey* found_;
  Columns columns_;
  Snapshot snapshot_;
  Scratch scratch_;
  std::vector<std::uint64_t> marks_;
  Flaws flaws_;
  std::array<std::size_t, 2> fastest_at_{};  // snapshot, row
};

}  // namespace

const ColumnSurvey* Survey::column(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const ColumnSurvey& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Survey survey(const Series& series, bool full) {
  Survey found;
  found.problems = series.problems();
  survey_headers(series, found);
  RowSurvey rows(series, found);
  const auto chosen = chosen_snapshots(series.named() ? series.size() : 0, full);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    rows.add(chosen[k], k == 0 || k == chosen.size() / 2 || k + 1 == chosen.size());
  rows.finish();
  return found;
}

}  // namespace bedscope::readers
