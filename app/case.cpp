// SPDX-License-Identifier: BSD-3-Clause
// bedscope case: decks of a scene, its limits, and the scaling rule.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>

#include "analysis/output_file.hpp"
#include "app/case_run.hpp"
#include "app/case_text.hpp"
#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "cases/deck.hpp"
#include "cases/scene_file.hpp"
#include "readers/error.hpp"

namespace bedscope::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  Common common;
  std::string scene, output, condition, of_run;
  double factor = 0;
  bool force = false;
};

void make(const Options& options) {
  const auto scene = cases::read_scene(options.scene);
  const auto limits = cases::scene_limits(scene);
  const auto broken = cases::what_cannot_run(limits);
  if (!broken.empty() && !options.force)
    throw InputError("{}: cannot run: {} (--force writes the decks all the same)", options.scene,
                     fmt::join(broken, "; "));
  auto files = cases::make_deck(scene);
  files.push_back({"scene.toml", cases::scene_text(scene)});
  OutputFolder folder(options.output);
  for (const auto& file : files) {
    const auto path = folder.part() / file.path;
    analysis::write_file(path, file.content);
    if (file.executable)
      fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
  }
  folder.commit();
  if (options.common.quiet) return;
  for (const auto& limit : limits)
    if (!limit.ok)
      fmt::print(stderr, "bedscope: beyond a limit: {}: {:.4g}, the limit is {:.4g}: {}\n",
                 limit.name, limit.value, limit.limit, limit.rule);
  fmt::print("{}: {} files of \"{}\"; run them by {}/run.sh\n", options.output, files.size(),
             scene.title, options.output);
}

void scale(const Options& options) {
  const auto scene = cases::read_scene(options.scene);
  const auto condition = physics::mapping_condition(options.condition);
  const auto scaled = cases::scale_scene(scene, options.factor, condition);
  const auto report = cases::scaling_report(scene, options.factor, condition);
  if (!options.output.empty()) analysis::write_file(options.output, cases::scene_text(scaled));
  if (options.common.json)
    fmt::print("{}", scale_json(scaled, report));
  else if (!options.common.quiet)
    fmt::print("{}", scale_text(scaled, report));
}

void check(const Options& options) {
  std::vector<std::string> remarks;
  const auto scene = is_run(options.scene) ? scene_of_run(options.scene, options.of_run, remarks)
                                           : cases::read_scene(options.scene);
  const auto report = cases::check_scene(scene);
  if (options.common.json)
    fmt::print("{}", check_json(scene, report, remarks));
  else if (!options.common.quiet)
    fmt::print("{}", check_text(scene, report, remarks));
}

}  // namespace

void add_case(CLI::App& app) {
  auto* command = app.add_subcommand("case", "scenes: their decks, their limits, the scaling rule");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* what, void (*run)(const Options&)) {
    auto options = std::make_shared<Options>();
    auto* sub = command->add_subcommand(name, what);
    sub->add_option("scene", options->scene, "a scene (.toml)")->required();
    add_common(*sub, options->common);
    sub->callback([options, run] { run(*options); });
    return std::pair(sub, options);
  };
  auto [decks, of_decks] = add("make", "decks for LIGGGHTS, OpenFOAM and the coupled solver", make);
  decks->add_option("-o,--output", of_decks->output, "folder of the decks")->required();
  decks->add_flag("--force", of_decks->force, "also for a scene that cannot run");
  auto [scaled, of_scaled] = add("scale", "the scene with fewer, larger particles", scale);
  scaled->add_option("--factor", of_scaled->factor, "K: of the diameter")->required();
  scaled
      ->add_option("--condition", of_scaled->condition,
                   "a: nothing else; b: the grid; c: the depth; d: both are scaled")
      ->required()
      ->check(CLI::IsMember({"a", "b", "c", "d"}));
  scaled->add_option("-o,--output", of_scaled->output, "write the scaled scene to this file");
  auto [checked, of_check] =
      add("check", "numbers, limits with their margins, and the models that are needed", check);
  checked->get_option("scene")->description(
      "a scene (.toml), or a run: dumps, a study, results.h5");
  checked->add_option("--scene", of_check->of_run,
                      "of a run: its scene; else a scene.toml in its folder or above");
}

}  // namespace bedscope::app
