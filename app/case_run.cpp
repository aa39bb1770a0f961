// SPDX-License-Identifier: BSD-3-Clause
#include "app/case_run.hpp"

#include <filesystem>

#include "analysis/run_facts.hpp"
#include "app/study.hpp"
#include "cases/merge_files.hpp"
#include "cases/observed.hpp"
#include "cases/scene_file.hpp"
#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::app {
namespace {

namespace fs = std::filesystem;

bool ends_in(const std::string& path, const char* extension) {
  return fs::path(path).extension() == extension;
}

std::optional<cases::Scene> scene_beside(const std::string& path, const std::string& scene_path,
                                         std::vector<std::string>& remarks) {
  if (!scene_path.empty()) return cases::read_scene(scene_path);
  std::error_code error;
  auto folder = fs::absolute(path, error);
  for (int up = 0; up < 4 && !folder.empty(); ++up, folder = folder.parent_path())
    if (const auto file = folder / "scene.toml"; fs::is_regular_file(file, error)) {
      remarks.push_back("the scene is " + file.string());
      return cases::read_scene(file.string());
    }
  return std::nullopt;
}

analysis::RunFacts facts_of(const std::string& path, double& gas_density) {
  if (ends_in(path, ".h5")) return analysis::facts_of_results(path);
  const auto study = study_of(path);
  const auto& run = study.runs.front();
  if (run.settings.particles.empty())
    throw InputError("{}: run \"{}\" has no particles to look at", path, run.settings.label);
  gas_density = run.settings.gas.density.value_or(0);
  auto facts = analysis::facts_of_dumps(run.settings);
  if (study.runs.size() > 1)
    facts.remarks.push_back("the study's first run, \"" + run.settings.label + "\", is checked");
  return facts;
}

}  // namespace

bool is_run(const std::string& path) {
  if (!ends_in(path, ".toml")) return true;
  const auto table = readers::parse_toml(path);
  return table.contains("run");
}

cases::Scene scene_of_run(const std::string& path, const std::string& scene_path,
                          std::vector<std::string>& remarks) {
  cases::Observed observed;
  const auto facts = facts_of(path, observed.gas_density);
  const auto scene = scene_beside(path, scene_path, remarks);
  for (const auto& s : facts.species) {
    cases::Species species;
    species.name = s.type;
    species.diameter = s.diameter;
    species.spread = (s.largest - s.smallest) / 2;
    species.density = s.density;
    observed.species.push_back(species);
    observed.numbers.push_back(s.number);
  }
  observed.extent = facts.extent;
  observed.impact_velocity = facts.impact_velocity;
  remarks.insert(remarks.end(), facts.remarks.begin(), facts.remarks.end());
  return cases::observed_scene(scene, observed, remarks);
}

}  // namespace bedscope::app
