// SPDX-License-Identifier: BSD-3-Clause
// Every rule of the check-up: a small run that breaks none, and for each rule a change of it that
// breaks this one and no other.
#include "readers/checkup.hpp"

#include <functional>
#include <numbers>
#include <set>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

/// A run of 27 particles of 2 mm on a lattice in a box of 0.1 m, dumped at six steps.
struct MadeRun {
  std::vector<std::int64_t> steps{0, 100, 200, 300, 400, 500};
  std::vector<std::size_t> counts{27, 27, 27, 27, 27, 27};
  double radius = 1e-3, density = 2500, mass_factor = 1, spacing = 0.0025, speed = 0.5;
  double temperature = 350, origin = 0.01;
  std::string box = "ff ff ff\n0 0.1\n0 0.1\n0 0.1\n";
  std::string more_columns, more_values;  // of each row
  std::string log =
      "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled)\nunits si\ntimestep 1e-5\n"
      "fix p all particletemplate/sphere 1 atom_type 1 density constant 2500 radius constant 1e-3\n"
      "    Step    Atoms   KinEng\n       0   27  0\n     500  27  1\nLoop time of 1 on 1 procs\n";

  std::string dump(std::size_t k) const {
    const auto step = steps[k];
    auto text =
        dump_header(step, counts[k],
                    "id type x y z vx vy vz radius density mass f_Temp[0]" + more_columns, box);
    const double mass = mass_factor * density * 4 * std::numbers::pi / 3 * std::pow(radius, 3);
    for (std::size_t i = 0; i < counts[k]; ++i) {
      const auto at = [&](std::size_t n) { return origin + spacing * static_cast<double>(n); };
      text += fmt::format("{} 1 {:g} {:g} {:g} 0 0 {:g} {:g} {:g} {:g} {:g}{} \n", i + 1, at(i % 3),
                          at(i / 3 % 3), at(i / 9), speed, radius, density, mass, temperature,
                          more_values);
    }
    return text;
  }
};

struct Outcome {
  std::set<std::string> problems, notes;
  std::string text;
};

Outcome check(const MadeRun& run) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("post"));
  for (std::size_t k = 0; k < run.steps.size(); ++k)
    folder.write(fmt::format("post/dump{}", run.steps[k]), run.dump(k));
  if (!run.log.empty()) folder.write("log.liggghts", run.log);
  const auto series = Series::open(folder.path("post"));
  const auto surveyed = survey(series, true);
  EXPECT_TRUE(surveyed.problems.empty());
  const auto found = check_up(surveyed, find_log(series.path(0)));
  Outcome outcome;
  for (const auto& problem : found.problems) {
    outcome.problems.emplace(problem.rule);
    outcome.text += problem.text + "\n";
  }
  for (const auto& note : found.notes) {
    outcome.notes.emplace(note.rule);
    outcome.text += note.text + "\n";
  }
  return outcome;
}

struct Case {
  std::string rule;
  std::function<void(MadeRun&)> change;
  std::string says;
  bool alone = true;  ///< breaks no other rule
};

void replace_in_log(MadeRun& run, const std::string& from, const std::string& to) {
  ASSERT_NE(run.log.find(from), std::string::npos);
  run.log = replaced(run.log, from, to);
}

/// Radii and all lengths times a factor.
void scale(MadeRun& run, double factor) {
  run.radius *= factor;
  run.spacing *= factor;
  run.origin *= factor;
  const double side = 0.1 * factor;
  run.box = fmt::format("ff ff ff\n0 {0:g}\n0 {0:g}\n0 {0:g}\n", side);
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"missing steps", [](MadeRun& r) { r.steps = {0, 50, 100, 150, 300, 350}; },
       "steps 200 to 250 are missing between 150 and 300"},
      {"changed spacing",
       [](MadeRun& r) {
         r.steps = {0, 20, 40, 60, 160, 260}, r.steps.push_back(360), r.counts.push_back(27);
       },
       "changes from 20 to 100 steps at step 60"},
      {"irregular steps", [](MadeRun& r) { r.steps = {0, 100, 200, 300, 430, 500}; },
       "2 of 5 intervals between steps are irregular (the most common one is 100)"},
      {"particles lost", [](MadeRun& r) { r.counts = {270, 270, 270, 270, 270, 90}; },
       "270 at step 400, 90 at step 500", false},
      {"particles added", [](MadeRun& r) { r.counts = {90, 90, 90, 270, 270, 270}; },
       "90 at step 200, 270 at step 300", false},
      {"drift", [](MadeRun& r) { r.counts = {100, 96, 92, 88, 84, 80}; },
       "the number of particles drifts by -22.2 +-", true},
      {"units of the log", [](MadeRun& r) { replace_in_log(r, "units si", "units cgs"); },
       "says units cgs (cm, g, s; densities in g/cm3)"},
      {"errors in the log", [](MadeRun& r) { r.log += "ERROR: Lost atoms (../thermo.cpp:400)\n"; },
       "line 9: error: Lost atoms"},
      {"warnings in the log", [](MadeRun& r) { r.log += "WARNING: a\nWARNING: b\n"; },
       "2 warnings, first in line 9: a"},
      {"several time steps", [](MadeRun& r) { r.log += "timestep 2e-5\n"; }, "2e-05 s, the last"},
      {"log of another run", [](MadeRun& r) { replace_in_log(r, "     500  27", "     400  27"); },
       "ends at step 400, the dumps at 500"},
      {"run not ended", [](MadeRun& r) { replace_in_log(r, "Loop time of 1 on 1 procs\n", ""); },
       "breaks off at step 500"},
      {"impossible size", [](MadeRun& r) { scale(r, 1e4); }, "radii up to 10 m"},
      {"unusual size", [](MadeRun& r) { scale(r, 100); }, "radii up to 0.1 m"},
      {"density out of range",
       [](MadeRun& r) {
         r.density = 2.5;
         replace_in_log(r, "2500", "2.5");
       },
       "densities of 2.5 to 2.5 kg/m3 (column density): g/cm3"},
      {"larger than the box", [](MadeRun& r) { r.box = "pp pp pp\n0 0.0015\n0 0.0015\n0 0.1\n"; },
       "particles of 0.002 m in diameter do not fit", false},
      {"outside the box", [](MadeRun& r) { r.box = "ff ff ff\n0 0.1\n0.011 0.1\n0 0.1\n"; },
       "54 centres lie beyond"},  // 9 of 27, six times
      {"mass against density", [](MadeRun& r) { r.mass_factor = 1000; },
       "mass is 1000 to 1000 times"},
      {"density against the log", [](MadeRun& r) { r.density = 2400; },
       "type 1 has 2400 to 2400 kg/m3 in the dumps, 2500 in"},
      {"bodies",
       [](MadeRun& r) {
         r.more_columns = " id_multisphere";
         r.more_values = " 1";
       },
       "multi-sphere bodies"},
      {"shapes",
       [](MadeRun& r) {
         r.more_columns = " shapex";
         r.more_values = " 1";
       },
       "superquadrics"},
      {"speed",
       [](MadeRun& r) {
         r.speed = 2000;
         replace_in_log(r, "1e-5", "1e-7");
       },
       "a particle at 2000 m/s ("},
      {"speed against the time step", [](MadeRun& r) { r.speed = 150; },
       "moves 0.0015 m in a time step of 1e-05 s"},
      {"below 0 K", [](MadeRun& r) { r.temperature = -5; }, "f_Temp[0] goes down to -5"},
      {"degrees Celsius", [](MadeRun& r) { r.temperature = 80; },
       "f_Temp[0] lies between 80 and 80"},
      {"overlaps", [](MadeRun& r) { r.spacing = 0.0019; }, "overlaps reach 10 % of the smaller"},
      {"denser than any packing",
       [](MadeRun& r) { r.box = "pp pp pp\n0 0.0055\n0 0.005\n0 0.005\n"; },  // 0.82
       "holds 0.823 of its volume"},
      {"denser than a random packing",
       [](MadeRun& r) { r.box = "pp pp pp\n0 0.0055\n0 0.0055\n0 0.0055\n"; },  // 0.68
       "holds 0.68 of its volume"},
  };
  return all;
}

TEST(CheckUp, ARunWithNothingWrongBreaksNoRule) {
  const auto outcome = check({});
  EXPECT_TRUE(outcome.problems.empty() && outcome.notes.empty()) << outcome.text;
  MadeRun without_log;
  without_log.log.clear();
  const auto quiet = check(without_log);
  EXPECT_TRUE(quiet.problems.empty() && quiet.notes.empty()) << quiet.text;
}

TEST(CheckUp, EveryRuleIsBrokenByAChangeThatBreaksNoOther) {
  for (const auto& [rule, change, says, alone] : cases()) {
    SCOPED_TRACE(rule);
    MadeRun run;
    change(run);
    const auto outcome = check(run);
    EXPECT_TRUE(outcome.problems.count(rule) + outcome.notes.count(rule) == 1) << outcome.text;
    if (alone) {
      EXPECT_EQ(outcome.problems.size() + outcome.notes.size(), 1U) << outcome.text;
    }
    EXPECT_NE(outcome.text.find(says), std::string::npos) << outcome.text;
  }
}

TEST(CheckUp, EveryRuleHasItsCaseAndItsLineInTheManual) {
  std::set<std::string> tested;
  for (const auto& item : cases()) tested.insert(item.rule);
  const auto manual = bytes_of(fs::path(BEDSCOPE_SOURCE) / "docs/check-up.md");
  for (const auto rules : {run_rules(), value_rules()})
    for (const auto& rule : rules) {
      EXPECT_TRUE(tested.count(std::string(rule.name))) << rule.name;
      const auto* weight = rule.weight == Rule::Weight::problem ? "problem" : "note";
      EXPECT_NE(manual.find(fmt::format("| {} | {} |", rule.name, weight)), std::string::npos)
          << rule.name;
    }
}

TEST(CheckUp, WhatIsMeantSoIsNoProblem) {
  MadeRun two_sizes;  // a thin box, as two-dimensional beds have it; fast, but not in a step
  two_sizes.box = "ff pp ff\n0 0.1\n0 0.0018\n0 0.1\n";
  two_sizes.speed = 90;
  EXPECT_TRUE(check(two_sizes).problems.empty()) << check(two_sizes).text;
  MadeRun filling;  // a bed that is filled: jumps upwards are notes
  filling.counts = {0, 27, 54, 81, 108, 135};
  EXPECT_TRUE(check(filling).problems.empty()) << check(filling).text;
  MadeRun noisy;  // chance
  noisy.counts = {27, 22, 29, 24, 31, 20};
  EXPECT_TRUE(check(noisy).problems.empty()) << check(noisy).text;
  MadeRun bodies;  // the mass of the body on each row, spheres that overlap
  bodies.more_columns = " mol";
  bodies.more_values = " 1";
  bodies.mass_factor = 4;
  bodies.spacing = 0.0012;
  const auto outcome = check(bodies);
  EXPECT_TRUE(outcome.problems.empty()) << outcome.text;
  EXPECT_EQ(outcome.notes, std::set<std::string>{"bodies"}) << outcome.text;
}

}  // namespace
}  // namespace bedscope::readers
