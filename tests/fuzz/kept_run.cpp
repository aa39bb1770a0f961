// SPDX-License-Identifier: BSD-3-Clause
// The state that an analysis keeps for the next one: with changes that its checksum does not show
// it is read without harm; with any that shows the analysis begins anew.
#include "analysis/kept_run.hpp"

#include "analysis/analyse_run.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace analysis;

std::string dump(int step) {
  std::string rows;
  for (int i = 0; i < 12; ++i)
    rows += fmt::format("{} {} 0.0{} 0.005 0.0{} 0 1 0.004 3{}0\n", i + 1, 1 + i % 2, i % 4 + 1,
                        i / 4 + 1 + step % 2, i);
  return fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n12\nITEM: BOX BOUNDS ff ff ff\n0 0.05\n0 0.01\n"
      "0 0.05\nITEM: ATOMS id type x y z vx vz radius temperature \n{}",
      step, rows);
}

MemoryFolder dumps() {
  const std::string one = dump(1), two = dump(2), three = dump(3);
  return MemoryFolder({{"dump1", one}, {"dump2", two}, {"dump3", three}});
}

struct Bed {
  MemoryFolder folder = dumps();
  std::string state = folder.path() + "/kept/run.state";
  RunSettings settings;
  AnalysisOptions options{
      .threads = 1, .keep = {.earlier_state = state, .state = state}, .note = require_line};
  double holdup = 0;  // what any analysis must find
  KeptFile kept{folder.path() + "/kept", [this] {
                  settings.label = "run";
                  settings.particles = folder.path();
                  settings.time_step = 1e-4;
                  settings.density.all = 2500;
                  settings.average = {0, 1};
                  settings.cell = {0.01, 0.01};
                  settings.temperature = {300, 400};
                  settings.clusters = {0.1, 0.2, 1e-6};
                  settings.bubbles = ClusterThresholds{0.6, 0.8, 0};
                  holdup = analyse_run(settings, options).mean_holdup.value;
                }};
};

}  // namespace

void use(std::string_view input) {
  static Bed bed;
  static const auto series = readers::Series::open(bed.settings.particles);
  static const auto setup = set_up(bed.settings, series);
  bed.kept.change(input);
  try {
    KeptRun(setup, false, true).load(bed.state);
  } catch (const Error& error) {
    require_line(error.what());
  }
  bed.kept.change(input, false);
  bed.options.keep.state.clear();
  require(analyse_run(bed.settings, bed.options).mean_holdup.value == bed.holdup,
          "results do not depend on what was kept");
}

}  // namespace bedscope::fuzz
