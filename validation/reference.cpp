// SPDX-License-Identifier: BSD-3-Clause
#include "validation/reference.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/fluctuations.hpp"
#include "analysis/tables.hpp"
#include "readers/error.hpp"
#include "validation/theory.hpp"

namespace bedscope::validation {

using analysis::RunResult;

const RunResult& run_of(std::span<const RunResult> runs, const std::string& label) {
  for (const auto& run : runs)
    if (run.label == label) return run;
  std::string labels;
  for (const auto& run : runs) labels += (labels.empty() ? "\"" : ", \"") + run.label + "\"";
  throw InputError("no run \"{}\", there are {}", label, labels);
}

namespace {

constexpr double coverage_factor = 1.96;

/// What `against` means, and the name in it. `number`: nothing to look up, as for a shape too.
enum class Kind { number, theory, other_runs, run, baseline, curve };

std::pair<Kind, std::string> source_of(const Check& check) {
  if (check.against.empty()) return {Kind::number, ""};
  if (check.against == "run:others") return {Kind::other_runs, ""};
  for (const auto& [prefix, kind] : {std::pair<std::string_view, Kind>{"theory:", Kind::theory},
                                     {"run:", Kind::run},
                                     {"baseline:", Kind::baseline}})
    if (check.against.starts_with(prefix)) return {kind, check.against.substr(prefix.size())};
  return {Kind::curve, check.against};
}

Curve constant(const Check& check, const Sampled& result) {
  Curve curve{.name = number_name(*check.number), .x = result.x, .y = result.y};
  for (const double x : result.at) curve.points.push_back({x, *check.number, 0, check.number_u});
  if (check.number_u == 0)
    curve.assumptions.emplace_back(
        "the number in the study is taken as exact (no uncertainty key)");
  return curve;
}

std::filesystem::path baseline_folder(const std::string& path, const std::string& study) {
  namespace fs = std::filesystem;
  const fs::path file =
      fs::path(path).is_absolute() ? fs::path(path) : fs::path(study).parent_path() / path;
  if (!fs::exists(file))
    throw InputError("baseline:{}: no such file, expected a summary.json or its folder", path);
  return fs::is_directory(file) ? file : file.parent_path();
}

/// Equal but for the digits that a table leaves out.
bool equal(double a, double b) {
  return std::abs(a - b) <= 1e-5 * std::max(std::abs(a), std::abs(b));
}

/// By the mean heights of all snapshots, which no two realisations share unless nothing moves.
bool same_snapshots(const RunResult& a, const RunResult& b) {
  const bool moves = std::any_of(a.inventory.begin(), a.inventory.end(), [&](const auto& row) {
    return row.mean_height != a.inventory.front().mean_height;
  });
  return moves && std::equal(a.inventory.begin(), a.inventory.end(), b.inventory.begin(),
                             b.inventory.end(), [](const auto& one, const auto& other) {
                               return one.type == other.type && equal(one.time, other.time) &&
                                      one.particles == other.particles &&
                                      equal(one.mean_height, other.mean_height);
                             });
}

/// An earlier result: the tables that lie beside its summary.json.
Curve baseline(const std::string& path, const Check& check, const RunResult& run,
               const Sampled& result, const std::string& study) {
  const auto folder = baseline_folder(path, study);
  const auto earlier = analysis::read_tables(folder, run.label);
  const auto sampled = sample(earlier, check.place);
  auto curve = as_curve(sampled, "baseline " + path);
  curve.of_same_snapshots =
      same_snapshots(run, earlier) || (sampled.at == result.at && sampled.value == result.value);
  if (curve.of_same_snapshots)
    curve.assumptions = {curve.name +
                         ": of the same snapshots; errors of averages are common and drop out"};
  return curve;
}

/// The mean of all other runs at the abscissae of this one: how far a family of runs falls
/// together.
Curve mean_of_others(const Check& check, const RunResult& run, const Sampled& result,
                     std::span<const RunResult> runs) {
  Curve mean{.name = "mean of the other runs", .x = result.x, .y = result.y};
  std::vector<Comparison> others;
  const auto here = as_curve(result, run.label);
  for (const auto& other : runs)
    if (other.label != run.label) others.push_back(compare(sample(other, check.place), here));
  if (others.empty()) throw InputError("run:others: expected a second run in the study");
  for (const double x : result.at) {
    double sum = 0, u = 0, count = 0;
    for (const auto& other : others) {
      auto point = std::lower_bound(
          other.points.begin(), other.points.end(), x,
          [](const ComparedPoint& compared, double wanted) { return compared.x < wanted; });
      for (; point != other.points.end() && point->x == x; ++point) {
        sum += point->result;
        u += point->u_result * point->u_result + point->u_interpolation * point->u_interpolation;
        count += 1;
      }
    }
    if (count == static_cast<double>(others.size()))
      mean.points.push_back({x, sum / count, 0, std::sqrt(u) / count});
  }
  if (mean.points.empty()) throw InputError("run:others: the runs have no abscissa in common");
  return mean;
}

/// A series in time against a single value of a run: the same statistic of it.
Curve reduced(Curve curve, const Sampled& result) {
  if (!result.is_scalar || curve.points.size() < 2) return curve;
  if (!curve.x.is_time())
    throw InputError("{}: {} points along {}: expected one, {} is a single value", curve.name,
                     curve.points.size(), curve.x.text(), result.y.name);
  analysis::Signal signal{curve.name, curve.y.unit, {}, {}};
  double u = 0;  // errors of reading a plot may well be common to all points
  for (const auto& point : curve.points) {
    if (!signal.times.empty() && point.x == signal.times.back()) continue;
    signal.times.push_back(point.x);
    signal.values.push_back(point.y);
    u = std::max(u, point.u_y);
  }
  std::vector<std::string> of_spectrum;
  const auto found = analysis::fluctuation_of(signal, 0, of_spectrum);
  analysis::Estimate estimate = found.mean;
  const char* words = "mean";
  if (result.statistic == Statistic::deviation) {
    estimate = found.deviation;
    words = "standard deviation";
    u = 0;  // not moved by a common error
  } else if (result.statistic == Statistic::frequency) {
    estimate = found.dominant;
    words = "dominant frequency";
    curve.y = {"dominant frequency", "Hz"};
    curve.assumptions.insert(curve.assumptions.end(), of_spectrum.begin(), of_spectrum.end());
    u = 0;
  }
  if (!std::isfinite(estimate.value))
    throw InputError("{}: {} points are too few for a {}", curve.name, curve.points.size(), words);
  if (!std::isfinite(estimate.ci95)) estimate.ci95 = 0;
  curve.assumptions.push_back(
      fmt::format("{}: its {} from {:.4g} to {:.4g} s, with the error of a "
                  "{:.3g} s record",
                  curve.name, words, signal.times.front(), signal.times.back(),
                  signal.times.back() - signal.times.front()));
  curve.points = {{0, estimate.value, 0, std::hypot(estimate.ci95 / coverage_factor, u)}};
  return curve;
}

}  // namespace

std::string number_name(double number) { return fmt::format("{:.6g}", number); }

Curve reference_of(const Check& check, const RunResult& run, const Sampled& result,
                   std::span<const RunResult> runs, const Curves& curves,
                   const std::string& study) {
  const auto [kind, name] = source_of(check);
  switch (kind) {
    case Kind::number:
      return constant(check, result);
    case Kind::theory:
      return theory_curve(name, check.with, run, result);
    case Kind::other_runs:
      return mean_of_others(check, run, result, runs);
    case Kind::run:
      return as_curve(sample(run_of(runs, name), check.place), "run " + name);
    case Kind::baseline:
      return baseline(name, check, run, result, study);
    case Kind::curve:
      break;
  }
  return reduced(curves.curve(name, check.place), result);
}

void require_reference(const Check& check, std::span<const std::string> labels,
                       const Curves& curves, const std::string& study) {
  const auto require_run = [&](const std::string& label) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end())
      throw InputError("no run \"{}\", there are \"{}\"", label, fmt::join(labels, "\", \""));
  };
  try {
    if (!check.run.empty()) require_run(check.run);
    const auto [kind, name] = source_of(check);
    if (kind == Kind::curve) {
      curves.curve(name, check.place);  // which may have keys of its own
      return;
    }
    require_place_keys(check.place);
    if (kind == Kind::theory) require_theory(name, check.with);
    if (kind == Kind::baseline) baseline_folder(name, study);
    if (kind == Kind::run) {
      require_run(name);
      if (check.run == name || (check.run.empty() && labels.size() == 1))
        throw InputError("run:{}: a run against itself, expected another one", name);
    }
  } catch (const MissingCurve&) {
    return;
  } catch (const InputError& error) {
    throw InputError("{}: line {}: check: {}", study, check.line, error.what());
  }
}

}  // namespace bedscope::validation
