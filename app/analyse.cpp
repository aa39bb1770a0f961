// SPDX-License-Identifier: BSD-3-Clause
// bedscope analyse: from dumps to tables, results.h5, figures and the page.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "analysis/analyse_run.hpp"
#include "analysis/results_file.hpp"
#include "analysis/summary.hpp"
#include "analysis/tables.hpp"
#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/progress.hpp"
#include "app/study.hpp"
#include "readers/error.hpp"
#include "report/page.hpp"

namespace bedscope::app {
namespace {

using analysis::RunResult;

struct Options {
  Common common;
  std::string input;
  std::string folder = "bedscope-results";
  bool follow = false;
  double interval = 5;  // s between two looks at a running simulation
  bool tables_only = false;
  bool fresh = false;
};

volatile std::sig_atomic_t interrupted = 0;

void write_all(const Study& study, const std::vector<RunResult>& results, const Options& options,
               OutputFolder& output) {
  output.show_earlier();
  const auto& folder = output.part();
  analysis::write_tables(results, folder / "tables");
  if (!options.tables_only) {
    analysis::write_results_file(results, folder / "results.h5");
  }
  analysis::write_summary(results, folder / "summary.json");
  if (!options.tables_only) {
    // Live, the page shall be there soon and renew itself; it links what stands beside it already.
    const int refresh = options.follow ? std::max(1, static_cast<int>(options.interval)) : 0;
    report::write_report(results, study.title, folder,
                         {.png = !options.follow, .refresh_seconds = refresh});
  }
  output.commit();
}

void tell(const std::vector<RunResult>& results, const Options& options) {
  if (options.common.json) {
    fmt::print("{}", analysis::summary_text(results));
    return;
  }
  if (options.common.quiet) return;
  for (const auto& result : results) {
    fmt::print("{}: {} snapshots averaged, mean holdup {:.4g} +- {:.2g}, {:.2f} s\n", result.label,
               result.window.snapshots, result.mean_holdup.value, result.mean_holdup.ci95,
               result.seconds);
    if (result.snapshots_kept > 0)
      fmt::print("  {} of {} snapshots were kept by the analysis before\n", result.snapshots_kept,
                 result.bed.samples.size());
    for (const auto& problem : result.problems) fmt::print("  note: {}\n", problem);
  }
  fmt::print("{}\n", (std::filesystem::path(options.folder) /
                      (options.tables_only ? "tables" : "index.html"))
                         .string());
}

using Note = std::function<void(const std::string&)>;

/// Run `number` of the study, from 1.
analysis::AnalysisOptions analysis_options(const Options& options, const OutputFolder& output,
                                           std::size_t number, Progress& progress, Note note) {
  const std::filesystem::path folder = options.folder;
  const auto state = fmt::format("resume/run_{}.state", number);
  analysis::AnalysisOptions how;
  how.threads = options.common.threads;
  how.pictures = !options.tables_only;
  how.progress = [&progress](std::size_t done, std::size_t all) { progress.show(done, all); };
  how.keep.index = output.part() / "index";
  how.keep.state = output.part() / state;
  if (!options.fresh) {
    how.keep.earlier_index = folder / "index";
    how.keep.earlier_state = folder / state;
  }
  how.note = std::move(note);
  return how;
}

RunResult analyse(const StudyRun& run, std::size_t number, const Options& options,
                  const OutputFolder& output, const Note& note) {
  Progress progress(run.settings.label, options.common.quiet);
  return run.tables.empty()
             ? analysis::analyse_run(run.settings,
                                     analysis_options(options, output, number, progress, note))
             : analysis::read_tables(run.tables, run.settings.label);
}

/// Looks again and again; a half-written last dump is left for the next look. Ends by Ctrl-C.
void follow(const Study& study, const Options& options, OutputFolder& output) {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  Progress silent("", true);
  const Note note = [&](const std::string& text) {
    if (!options.common.quiet) fmt::print("note: {}\n", text);
  };
  std::vector<analysis::LiveAnalysis> live;
  for (const auto& run : study.runs) {
    if (!run.tables.empty())
      throw InputError("--follow: run \"{}\" has tables, expected particles", run.settings.label);
    live.emplace_back(run.settings,
                      analysis_options(options, output, live.size() + 1, silent, note));
  }
  std::string waiting;
  const auto wait_for = [&](const Error& error) {
    if (waiting != error.what() && !options.common.quiet) fmt::print("waiting: {}\n", error.what());
    waiting = error.what();
  };
  bool news = false;  // not yet written
  while (interrupted == 0) {
    try {
      for (auto& run : live) news = run.update() || news;
      if (news) {
        std::vector<RunResult> results;
        results.reserve(live.size());
        for (const auto& run : live) results.push_back(run.result());
        write_all(study, results, options, output);
        news = false;
        if (!options.common.quiet)
          for (const auto& result : results)
            fmt::print("{}: {} snapshots, mean holdup {:.4g} +- {:.2g}\n", result.label,
                       result.bed.samples.size(), result.mean_holdup.value,
                       result.mean_holdup.ci95);
      }
    } catch (const FileError& error) {  // nothing there yet, or the disk is full
      wait_for(error);
    } catch (const CutError& error) {  // the first dump is being written
      wait_for(error);
    } catch (const analysis::EmptyWindow& error) {  // the window is still to come
      wait_for(error);
    }
    std::fflush(stdout);
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(options.interval);
    while (interrupted == 0 && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void run(const Options& options) {
  const auto study = study_of(options.input);
  OutputFolder output(options.folder);
  if (options.follow) return follow(study, options, output);
  std::vector<RunResult> results;
  std::vector<std::string> notes;  // told at the end: an error stands alone
  const Note note = [&](const std::string& text) { notes.push_back(text); };
  for (const auto& run : study.runs)
    results.push_back(analyse(run, results.size() + 1, options, output, note));
  write_all(study, results, options, output);
  if (!options.common.quiet)
    for (const auto& text : notes) fmt::print(stderr, "note: {}\n", text);
  tell(results, options);
}

}  // namespace

void add_analyse(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("analyse", "averages, profiles, clusters, figures and a page");
  command
      ->add_option("input", options->input,
                   "a study (.toml), or dumps: a file, a folder, a pattern")
      ->required();
  command->add_option("-o,--output", options->folder, "folder of the results")
      ->capture_default_str();
  command->add_flag("--follow", options->follow, "go on with a running simulation until Ctrl-C");
  command->add_option("--interval", options->interval, "with --follow: seconds between two looks")
      ->check(CLI::Range(0.05, 86400.))
      ->capture_default_str();
  command->add_flag("--tables-only", options->tables_only, "no figures, no page, no results.h5");
  command->add_flag("--fresh", options->fresh,
                    "read all dumps, whatever an earlier analysis kept in the folder");
  add_common(*command, options->common);
  command->callback([options] { run(*options); });
}

}  // namespace bedscope::app
