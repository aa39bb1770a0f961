// SPDX-License-Identifier: BSD-3-Clause
// bedscope tradeoff: the choices of the analysis weighed, accuracy against cost.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "analysis/analyse_run.hpp"
#include "analysis/choice_cost.hpp"
#include "analysis/choice_sums.hpp"
#include "analysis/output_file.hpp"
#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/progress.hpp"
#include "app/recommended.hpp"
#include "app/study.hpp"
#include "readers/error.hpp"
#include "readers/toml_table.hpp"
#include "report/tradeoff_page.hpp"
#include "validation/tradeoff.hpp"

namespace bedscope::app {
namespace {

using analysis::RunSetup;
using analysis::Variant;
using validation::Tradeoff;

struct Options {
  Common common;
  std::string study;
  std::string folder = "bedscope-tradeoff";
};

/// A run that is open, with its window.
struct OpenRun {
  readers::Series series;
  RunSetup study;  ///< with the study's settings
  analysis::RunResult result;
  std::vector<Variant> variants;
};

OpenRun open_run(const StudyRun& run, const Options& options) {
  if (!run.tables.empty())
    throw InputError("run \"{}\": tradeoff: expected particles, found tables", run.settings.label);
  auto settings = run.settings;
  settings.every = 1;
  auto series = readers::Series::open(
      settings.particles,
      {.repeated = settings.repeated, .columns = settings.columns, .names_needed = true});
  settings.gas.path.clear();
  settings.probes.clear();
  settings.spectra = false;
  Progress progress(settings.label, options.common.quiet);
  analysis::AnalysisOptions how;
  how.threads = options.common.threads;
  how.pictures = false;
  how.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  auto result = analysis::analyse_run(settings, how);
  if (result.window.snapshots < analysis::window_blocks)
    throw InputError(
        "run \"{}\": tradeoff: expected at least {} snapshots in the averaging window, "
        "found {}",
        settings.label, analysis::window_blocks, result.window.snapshots);
  auto setup = analysis::set_up(settings, series);
  return {std::move(series), std::move(setup), std::move(result), {}};
}

/// What all runs have in common, so that a setting is one for the whole study.
template <class Of>
std::vector<int> in_all(const std::vector<OpenRun>& runs, const Of& of) {
  auto common = of(runs.front());
  for (const auto& run : runs) {
    const auto other = of(run);
    std::erase_if(common,
                  [&](int n) { return std::find(other.begin(), other.end(), n) == other.end(); });
  }
  return common;
}

validation::TradeoffRun measure(const OpenRun& run, const std::vector<int>& everies,
                                const Options& options) {
  std::vector<RunSetup> setups;
  for (const auto& variant : run.variants)
    setups.push_back(analysis::set_up(variant.settings, run.series));
  Progress progress(run.result.label, options.common.quiet);
  validation::TradeoffRun found;
  found.label = run.result.label;
  found.sums = analysis::sum_choices(
      run.series, setups, run.variants, run.result.window, everies, options.common.threads,
      [&](std::size_t done, std::size_t all) { progress.show(done, all); });
  found.costs = analysis::time_choices(run.series, setups, run.variants, run.result.window);
  found.products = analysis::products_of(found.sums.variants.front().layout, setups.front());
  return found;
}

/// A setting means the same in all runs where their variants are the same.
void require_alike(const std::vector<OpenRun>& runs) {
  const auto alike = [](const Variant& a, const Variant& b) {
    return a.mapping == b.mapping && a.settings.cells.size() == b.settings.cells.size();
  };
  const auto& first = runs.front().variants;
  for (const auto& run : runs)
    if (!std::equal(first.begin(), first.end(), run.variants.begin(), run.variants.end(), alike))
      throw InputError(
          "run \"{}\": tradeoff: expected the mapping and the dimensions of run \"{}\"",
          run.result.label, runs.front().result.label);
}

void require_products(const Study& study, const std::string& path, Tradeoff& tradeoff) {
  const auto& wished = study.tradeoff.products;
  if (wished.empty()) return;
  tradeoff.required.clear();
  for (const auto& name : wished) {
    const auto at = std::find(tradeoff.products.begin(), tradeoff.products.end(), name);
    if (at == tradeoff.products.end())
      throw InputError(
          "{}: line {}: tradeoff.products: no product \"{}\" in these runs, the nearest is \"{}\"",
          path, study.tradeoff.line, name,
          readers::nearest_name(name, {tradeoff.products.begin(), tradeoff.products.end()}));
    tradeoff.required.push_back(static_cast<std::size_t>(at - tradeoff.products.begin()));
  }
}

/// The keys that differ from the study's.
StudyChanges changes_of(const validation::Setting& setting, const validation::Setting& present,
                        const std::vector<OpenRun>& runs) {
  StudyChanges changes;
  const auto& variant = runs.front().variants[setting.variant];
  if (variant.mapping != runs.front().variants[present.variant].mapping)
    changes.mapping = variant.mapping;
  if (setting.every != present.every) changes.every = setting.every;
  for (const auto& run : runs) {
    auto& of_run = changes.runs.emplace_back();
    const auto& settings = run.variants[setting.variant].settings;
    if (settings.cells != run.variants[present.variant].settings.cells) {
      of_run.cells = settings.cells;
      of_run.band = settings.band;
    }
    if (setting.part > 1)
      of_run.average = analysis::part_of_window(run.study.times, run.result.window, setting.part);
  }
  return changes;
}

/// Comes back as it was meant, or is not written.
void write_recommended(const Options& options, const StudyChanges& changes,
                       const std::string& heading, const std::filesystem::path& path) {
  const auto text = heading + changed_study(options.study, changes, options.folder);
  analysis::write_file(path, text);
  const auto again = read_study(path.string());
  for (std::size_t r = 0; r < again.runs.size(); ++r) {
    const auto& settings = again.runs[r].settings;
    const auto& of_run = changes.runs[r];
    if ((changes.mapping && settings.mapping != *changes.mapping) ||
        (changes.every && settings.every != *changes.every) ||
        (!of_run.cells.empty() && settings.cells != of_run.cells) ||
        (of_run.average && settings.average != of_run.average))
      throw InputError(
          "{}: its keys stand where they cannot be changed one by one: expected [scene] "
          "and [[run]] as tables of their own",
          options.study);
  }
}

void tell(const report::TradeoffReport& report, const Options& options) {
  for (const auto& sentence : report::sentences(report)) fmt::print("{}\n", sentence);
  fmt::print("{}\n", (std::filesystem::path(options.folder) / "index.html").string());
}

void run(const Options& options) {
  const auto study = read_study(options.study);
  OutputFolder output(options.folder);
  std::vector<OpenRun> runs;
  runs.reserve(study.runs.size());
  for (const auto& one : study.runs) runs.push_back(open_run(one, options));
  const auto multiples =
      in_all(runs, [](const OpenRun& r) { return analysis::fitting_multiples(r.study.grid); });
  const auto everies =
      in_all(runs, [](const OpenRun& r) { return analysis::thinnings(r.result.window.snapshots); });
  for (auto& one : runs) one.variants = analysis::variants_of(one.study, multiples);
  require_alike(runs);
  const auto present_every = static_cast<int>(study.runs.front().settings.every);
  for (const auto& one : study.runs)
    if (one.settings.every != present_every ||
        std::find(everies.begin(), everies.end(), present_every) == everies.end())
      throw InputError("run \"{}\": tradeoff: every = {}: expected one of {} for all runs",
                       one.settings.label, one.settings.every, fmt::join(everies, ", "));
  std::vector<validation::TradeoffRun> measured;
  measured.reserve(runs.size());
  for (const auto& one : runs) measured.push_back(measure(one, everies, options));

  report::TradeoffReport report;
  report.title = study.title;
  report.study = options.study;
  report.tradeoff = validation::weigh(measured, runs.front().variants, present_every);
  report.tradeoff.tolerance = study.tradeoff.tolerance;
  require_products(study, options.study, report.tradeoff);
  report.variants = runs.front().variants;
  report.recommendation = validation::recommend(report.tradeoff);
  for (const auto& one : runs) {
    report.runs.push_back(one.result);
    if (one.study.settings.bubbles)
      report.problems.emplace_back("bubbles are not weighed: their min_area follows the cell");
  }
  for (const auto& one : study.runs)
    if (!one.settings.gas.path.empty() || one.settings.spectra || !one.settings.probes.empty())
      report.problems.push_back(one.settings.label + ": gas, probes and spectra are not weighed");

  const auto& settings = report.tradeoff.settings;
  const auto& chosen = settings[report.recommendation.setting];
  const auto& present = settings[report.tradeoff.present()];
  const auto heading =
      fmt::format("# Recommended by bedscope tradeoff from {}: {}.\n",
                  std::filesystem::path(options.study).filename().string(), chosen.name);
  write_recommended(options, changes_of(chosen, present, runs), heading,
                    output.part() / "recommended.toml");
  report::write_tradeoff(report, output.part());
  output.commit();
  if (options.common.json)
    fmt::print("{}", report::tradeoff_summary(report));
  else if (!options.common.quiet)
    tell(report, options);
}

}  // namespace

void add_tradeoff(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "tradeoff", "accuracy against cost of the choices of an analysis; a cheaper study");
  command->add_option("study", options->study, "a study (.toml)")->required();
  command->add_option("-o,--output", options->folder, "folder of the results")
      ->capture_default_str();
  add_common(*command, options->common);
  command->callback([options] { run(*options); });
}

}  // namespace bedscope::app
