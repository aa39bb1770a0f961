// SPDX-License-Identifier: BSD-3-Clause
// bedscope info: what is on disk, and whether to trust it.
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/info_case.hpp"
#include "app/info_report.hpp"
#include "app/study.hpp"

namespace bedscope::app {
namespace {

struct Options {
  Common common;
  std::string path;
  bool full = false;
  bool study = false;
};

void run(const Options& options) {
  if (info_openfoam(options.path, options.full, options.common.json)) return;
  const auto series = readers::Series::open(options.path);
  const bool one_file = series.files().size() == 1;
  const auto survey = readers::survey(series, options.full || one_file);
  const auto log = readers::find_log(series.path(0));
  if (options.study) {
    const auto settings = settings_with_log(options.path, survey, log);
    fmt::print("{}",
               study_text(options.path, survey, log, make_plan(settings, series, survey, log)));
    return;
  }
  const auto checkup = readers::check_up(survey, log);
  const auto plan =
      make_plan(study_of_path(options.path).runs.front().settings, series, survey, log);
  const InfoReport report{series, survey, log, checkup, plan};
  fmt::print("{}", options.common.json ? info_json(report) : info_text(report));
}

}  // namespace

void add_info(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "info", "a check-up: form, steps, columns, ranges, what is wrong, what analyse would do");
  command
      ->add_option("path", options->path,
                   "a dump, a folder of dumps, a pattern, or an OpenFOAM case")
      ->required();
  command->add_flag("--full", options->full, "read the rows of every snapshot");
  command->add_flag("--study", options->study, "print a study file for this run instead");
  add_common(*command, options->common);
  command->callback([options] { run(*options); });
}

}  // namespace bedscope::app
