// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_survey.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "readers/survey.hpp"

namespace bedscope::readers {
namespace {

class Surveyor {
 public:
  /// `clouds`: the same case, or null where the form has none.
  Surveyor(const GasForm& gas, const OpenFoamCase* clouds) : gas_(gas), clouds_of_(clouds) {
    found_.problems = gas.problems();
  }

  // No quantity of a flow is as large in SI units; floats and doubles with their bytes in the wrong
  // order are.
  static constexpr double implausible = 1e30;

  void count_times() {
    for (std::size_t t = 0; t < gas_.times().size(); ++t) {
      for (const auto& name : gas_.times()[t].fields) ++fields_[name].times;
      for (const auto& name : clouds_at(t)) {
        const auto parcels = clouds_of_->parcels(t, name).value_or(0);
        auto& cloud = clouds_[name];
        cloud.parcels[0] = cloud.times == 0 ? parcels : std::min(cloud.parcels[0], parcels);
        cloud.parcels[1] = std::max(cloud.parcels[1], parcels);
        ++cloud.times;
      }
    }
  }

  void read(std::size_t time) {
    ++found_.times_read;
    for (const auto& name : gas_.times()[time].fields) add_field(time, name);
    for (const auto& name : clouds_at(time)) add_cloud(time, name);
  }

  FoamSurvey finish() {
    for (auto& [name, field] : fields_) {
      field.name = name;
      if (field.non_finite > 0)
        found_.problems.push_back(fmt::format("{}; {} in all times read: left out of the ranges",
                                              first_non_finite_[name], field.non_finite));
      for (const auto& range : field.ranges)
        if (const double most = std::max(range.max, -range.min); most > implausible) {
          found_.problems.push_back(fmt::format(
              "{}: values up to {:.3g} are implausible: is the byte order right (arch), or did the "
              "run blow up?",
              name, most));
          break;
        }
      found_.fields.push_back(std::move(field));
    }
    for (auto& [name, cloud] : clouds_) {
      cloud.name = name;
      found_.clouds.push_back(std::move(cloud));
    }
    return std::move(found_);
  }

 private:
  std::vector<std::string> clouds_at(std::size_t time) const {
    return clouds_of_ != nullptr ? clouds_of_->clouds_at(time) : std::vector<std::string>();
  }

  void add_field(std::size_t time, const std::string& name) {
    auto& field = fields_[name];
    try {
      gas_.read(time, name, values_);
    } catch (const CodeError& error) {  // the start of a case that was never run
      found_.problems.emplace_back(error.what());
      return;
    }
    ++field.times_read;
    if (values_.uniform) ++field.times_uniform;
    field.class_name = values_.class_name;
    field.dimensions = values_.dimensions;
    field.dimensions_known = values_.dimensions_known;
    field.ranges.resize(values_.components);
    add_to_ranges(values_.values, field.ranges);
    if (values_.non_finite.values > 0 && field.non_finite == 0)
      first_non_finite_[name] = fmt::format("{}: time {}: cell {} is nan or inf", name,
                                            gas_.times()[time].name, values_.non_finite.first);
    field.non_finite += values_.non_finite.values;
    if (!values_.uniform)
      found_.format =
          fmt::format("{}{}", values_.binary ? "binary" : "ascii", values_.compressed ? " gz" : "");
  }

  void add_cloud(std::size_t time, const std::string& name) {
    auto& cloud = clouds_[name];
    const auto columns = clouds_of_->cloud_columns(time, name);
    Request request{{"x"}, {"y"}, {"z"}, {"radius", false}, {"nParticle", false}};
    for (const auto& column : columns) request.push_back({column});  // so that all files are read
    for (auto& problem : clouds_of_->read_cloud(time, name, request, snapshot_))
      found_.problems.push_back(std::move(problem));
    tell_lost_columns(time, cloud.columns, columns, name);
    if (columns.size() >= cloud.columns.size()) cloud.columns = columns;
    const auto& particles = snapshot_.columns[4];
    for (std::size_t k = 0; k < 3; ++k)
      for (const double value : snapshot_.columns[k]) cloud.centres[k].add(value);
    for (std::size_t p = 0; p < snapshot_.columns[3].size(); ++p)  // of one particle of the parcel
      cloud.radius.add(snapshot_.columns[3][p] / (particles.empty() ? 1 : std::cbrt(particles[p])));
    for (const double value : particles) cloud.particles.add(value);
  }

  // What a time before had and this one, with parcels, has not.
  void tell_lost_columns(std::size_t time, const std::vector<std::string>& before,
                         const std::vector<std::string>& here, const std::string& cloud) {
    if (snapshot_.particles == 0) return;
    std::string lost;
    for (const auto& column : before)
      if (std::find(here.begin(), here.end(), column) == here.end()) lost += " " + column;
    if (!lost.empty())
      found_.problems.push_back(fmt::format("{}: time {}: lacks{}, which earlier times have", cloud,
                                            gas_.times()[time].name, lost));
  }

  const GasForm& gas_;
  const OpenFoamCase* clouds_of_;
  FoamSurvey found_;
  std::map<std::string, FoamFieldSurvey> fields_;
  std::map<std::string, std::string> first_non_finite_;
  std::map<std::string, FoamCloudSurvey> clouds_;
  FieldValues values_;
  Snapshot snapshot_;
};

}  // namespace

void FoamRange::add(double value) {
  if (!std::isfinite(value)) return;
  min = std::min(min, value);
  max = std::max(max, value);
  sum += value;
  ++count;
}

void add_to_ranges(const std::vector<double>& values, std::vector<FoamRange>& ranges) {
  for (std::size_t i = 0; i < values.size(); ++i) ranges[i % ranges.size()].add(values[i]);
}

bool FoamFieldSurvey::kinematic_pressure() const {
  return dimensions_known && ranges.size() == 1 && dimensions[0] == 0 && dimensions[1] == 2 &&
         dimensions[2] == -2 && (name == "p" || name.starts_with("p_") || name.starts_with("p."));
}

namespace {

FoamSurvey survey(const GasForm& gas, const OpenFoamCase* clouds, bool full) {
  Surveyor surveyor(gas, clouds);
  surveyor.count_times();
  for (const auto time : chosen_snapshots(gas.times().size(), full)) surveyor.read(time);
  return surveyor.finish();
}

}  // namespace

FoamSurvey survey(const OpenFoamCase& foam, bool full) { return survey(foam, &foam, full); }
FoamSurvey survey(const GasForm& gas, bool full) { return survey(gas, nullptr, full); }

}  // namespace bedscope::readers
