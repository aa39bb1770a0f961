// SPDX-License-Identifier: BSD-3-Clause
// bedscope validate: analyse, then judge the study's checks.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "analysis/analyse_run.hpp"
#include "analysis/output_file.hpp"
#include "analysis/tables.hpp"
#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/progress.hpp"
#include "app/study.hpp"
#include "readers/error.hpp"
#include "report/validation_page.hpp"
#include "report/validation_summary.hpp"
#include "validation/curves.hpp"
#include "validation/reference.hpp"
#include "validation/verdict.hpp"

namespace bedscope::app {
namespace {

using analysis::RunResult;
using validation::Outcome;
using validation::Verdict;

struct Options {
  Common common;
  std::string study;
  std::string folder = "bedscope-validation";
  std::vector<std::string> curves;
  std::string earlier;  // summary.json
  bool allow_undecided = false;
};

/// Lateral profiles are computed where a check asks for one.
void add_heights(Study& study) {
  for (const auto& check : study.checks) {
    const auto height = check.place.at.find("height");
    if (height == check.place.at.end()) continue;
    const bool of_all = check.run.empty() || check.against.starts_with("run:");
    for (auto& run : study.runs) {
      if (!of_all && run.settings.label != check.run) continue;
      auto& heights = run.settings.heights;
      if (std::find(heights.begin(), heights.end(), height->second) == heights.end())
        heights.push_back(height->second);
    }
  }
}

RunResult result_of(const StudyRun& run, const Options& options) {
  if (!run.tables.empty()) {
    auto result = analysis::read_tables(run.tables, run.settings.label);
    analysis::choose_window(result, run.settings.average);
    return result;
  }
  Progress progress(run.settings.label, options.common.quiet);
  return analysis::analyse_run(run.settings, {.threads = options.common.threads,
                                              .pictures = false,
                                              .progress = [&](std::size_t done, std::size_t all) {
                                                progress.show(done, all);
                                              }});
}

validation::Curves open_curves(const Study& study, const Options& options) {
  auto folders = study.curves;
  folders.insert(folders.end(), options.curves.begin(), options.curves.end());
  folders.push_back(curves_folder());
  return validation::Curves::open(folders, std::filesystem::path(options.study).parent_path());
}

/// What can be wrong with a check whatever the runs hold is found before hours of reading dumps.
void look_ahead(const Study& study, const validation::Curves& curves, const Options& options) {
  std::vector<std::string> labels;
  for (const auto& run : study.runs) labels.push_back(run.settings.label);
  for (const auto& check : study.checks)
    validation::require_reference(check, labels, curves, options.study);
}

std::vector<Verdict> judge_all(const Study& study, std::span<const RunResult> results,
                               const validation::Curves& curves, const Options& options) {
  std::vector<Verdict> verdicts;
  for (const auto& check : study.checks) {
    auto of_check = validation::evaluate(check, results, curves, options.study);
    std::move(of_check.begin(), of_check.end(), std::back_inserter(verdicts));
  }
  return verdicts;
}

void write_all(const Study& study, const std::vector<RunResult>& results,
               const std::vector<Verdict>& verdicts,
               const std::vector<report::EarlierVerdict>& earlier, const Options& options,
               OutputFolder& output) {
  const auto& folder = output.part();
  const report::ValidationReport report{.title = study.title,
                                        .study = options.study,
                                        .runs = results,
                                        .verdicts = verdicts,
                                        .earlier = earlier,
                                        .earlier_name = options.earlier};
  output.show_earlier();
  analysis::write_tables(results, folder / "tables");
  report::write_validation_page(report, folder);
  analysis::write_file(folder / "junit.xml", report::junit_text(verdicts, study.title));
  analysis::write_file(folder / "summary.md",
                       report::markdown_text(results, verdicts, study.title));
  analysis::write_file(folder / "summary.json", report::summary_with_checks(results, verdicts));
  output.commit();
}

/// Each note and assumption is told once, however many checks rest on it.
void tell(const std::vector<RunResult>& results, const std::vector<Verdict>& verdicts) {
  std::set<std::string> notes, assumptions;
  const auto keys = report::check_keys(verdicts);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    const auto& verdict = verdicts[k];
    fmt::print("{:<14} {}: {}\n", name_of(verdict.outcome), keys[k], verdict.reason);
    notes.insert(verdict.notes.begin(), verdict.notes.end());
    assumptions.insert(verdict.assumptions.begin(), verdict.assumptions.end());
  }
  for (const auto& assumption : assumptions) fmt::print("assumed: {}\n", assumption);
  for (const auto& note : notes) fmt::print("note: {}\n", note);
  for (const auto& result : results)
    for (const auto& problem : result.problems) fmt::print("note: {}: {}\n", result.label, problem);
}

int code_of(const std::vector<Verdict>& verdicts, const Options& options) {
  const auto bad = [&](const Verdict& verdict) {
    return verdict.outcome == Outcome::does_not_hold ||
           (verdict.outcome != Outcome::holds && !options.allow_undecided);
  };
  return std::any_of(verdicts.begin(), verdicts.end(), bad) ? does_not_hold : done;
}

int run(const Options& options) {
  auto study = read_study(options.study);
  if (study.checks.empty())
    throw InputError("{}: no [[check]]: expected at least one", options.study);
  add_heights(study);
  const auto curves = open_curves(study, options);
  look_ahead(study, curves, options);
  std::vector<report::EarlierVerdict> earlier;
  if (!options.earlier.empty()) earlier = report::read_earlier(options.earlier);
  OutputFolder output(options.folder);
  std::vector<RunResult> results;
  for (const auto& each : study.runs) results.push_back(result_of(each, options));
  const auto verdicts = judge_all(study, results, curves, options);
  write_all(study, results, verdicts, earlier, options, output);
  if (options.common.json)
    fmt::print("{}", report::summary_with_checks(results, verdicts));
  else if (!options.common.quiet)
    tell(results, verdicts);
  return code_of(verdicts, options);
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command =
      app.add_subcommand("validate", "analyse, then judge the study's checks: report, JUnit");
  command->add_option("study", options->study, "a study (.toml) with [[check]]s")->required();
  command->add_option("-o,--output", options->folder, "folder of the results")
      ->capture_default_str();
  command->add_option("--curves", options->curves, "more folders of curves");
  command->add_option("--earlier", options->earlier,
                      "an earlier summary.json, shown beside the new verdicts");
  command->add_flag("--allow-undecided", options->allow_undecided,
                    "a check that cannot be decided does not fail the command");
  add_common(*command, options->common);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace bedscope::app
