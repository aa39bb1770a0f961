// SPDX-License-Identifier: GPL-3.0-or-later
// bedscope-coupled: runs the case of the current folder. See README.md.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "cases/coupled/bad_input.hpp"
#include "cases/coupled/checkpoint.hpp"
#include "cases/coupled/coupling.hpp"
#include "cases/coupled/record.hpp"

namespace bedscope::coupled {
namespace {

constexpr const char* usage =
    "usage: bedscope-coupled [--resume | --again]\n"
    "Runs the case of the current folder (DEM/in.liggghts, CFD/).\n"
    "  --resume  goes on from the last checkpoint\n"
    "  --again   starts anew although there is a checkpoint\n";

bool multiple(double time, double interval, double step) {  // of the interval, within half a step
  return interval > 0 && std::abs(time - std::round(time / interval) * interval) < 0.5 * step;
}

class Run {
 public:
  Run(MPI_Comm comm, bool parallel)
      : comm_(comm),
        gas_(parallel),
        settings_(gas_.settings()),
        finder_(gas_.geometry()),
        dem_(comm, "DEM/in.liggghts", settings_.wall_types, settings_.energy.has_value()),
        feed_(settings_.inventory, settings_.time_step, comm),
        record_(comm, gas_),
        coupling_(gas_, dem_, finder_, comm, timing_) {
    int rank;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) std::filesystem::create_directories("DEM/post");
    MPI_Barrier(comm);
  }

  void go(bool resume) {
    if (resume) {
      record_.restore(load_checkpoint(comm_, gas_, dem_, feed_));
    } else {
      dem_.open();
    }
    check_steps();
    record_.start(resume ? gas_.time() : -1);
    coupling_.map();
    if (!resume) gas_.forget_old_voidage();
    const auto is_over = [&] {
      return gas_.time() > settings_.end_time - 0.5 * settings_.time_step;
    };
    if (!resume || is_over()) update_forces();  // of a run that is over: for its record
    expected_ = dem_.count();
    while (!is_over()) step();
    finish();
  }

 private:
  void check_steps() const {
    const double dem = dem_.time_step() * settings_.dem_steps;
    if (std::abs(dem / settings_.time_step - 1) > 1e-9)
      throw BadInput("CFD/constant/coupledProperties: demSteps x the deck's timestep is " +
                     std::to_string(dem) + " s, deltaT " + std::to_string(settings_.time_step) +
                     " s");
  }

  void update_forces() {
    coupling_.exchange();
    coupling_.act();
  }

  void step() {
    change_inventory();
    {
      const Timing::Lap lap(timing_, Part::dem);
      dem_.run(settings_.dem_steps);
    }
    gas_.begin_step();
    coupling_.map();
    check_count();
    coupling_.exchange();
    {
      const double before = gas_.pressure_seconds();
      const auto start = Timing::Clock::now();
      solve_gas();
      const double pressure = gas_.pressure_seconds() - before;
      timing_.add(Part::pressure, pressure);
      timing_.add(Part::momentum,
                  std::chrono::duration<double>(Timing::Clock::now() - start).count() - pressure);
    }
    if (settings_.energy) {
      const Timing::Lap lap(timing_, Part::energy);
      gas_.solve_energy();
    }
    coupling_.act();
    tell();
  }

  // OpenFOAM's errors say what they are to its own headers alone.
  void solve_gas() {
    try {
      gas_.solve_flow();
    } catch (const std::exception&) {
      throw BadInput("OpenFOAM could not solve for the gas at t = " + std::to_string(gas_.time()) +
                     " s: it blew up (try a smaller deltaT or implicit drag), or CFD/system lacks "
                     "a scheme or a solver");
    }
  }

  void change_inventory() {
    const Timing::Lap lap(timing_, Part::inventory);
    if (!feed_.look(gas_.step(), coupling_.particles(), dem_)) return;
    coupling_.map();
    gas_.forget_old_voidage();
    update_forces();
    expected_ = dem_.count();
  }

  // LIGGGHTS drops what leaves its box, mostly after a time step that was too long.
  void check_count() const {
    const long count = dem_.count();
    if (count != expected_)
      throw BadInput("LIGGGHTS lost " + std::to_string(expected_ - count) +
                     " particles before t = " + std::to_string(gas_.time()) +
                     " s; the box of the deck must hold them all");
  }

  void tell() {
    const Timing::Lap lap(timing_, Part::output);
    const double t = gas_.time(), dt = settings_.time_step;
    const GasBalance balance = gas_.balance();
    if (!std::isfinite(balance.pressure_drop) || !std::isfinite(balance.worst_cell))
      throw BadInput("the gas blew up at t = " + std::to_string(t) + " s, Courant number " +
                     std::to_string(balance.courant) + "; try a smaller deltaT or implicit drag");
    record_.step(gas_, dem_, balance, double(expected_));
    if (settings_.history_interval == 0 || multiple(t, settings_.history_interval, dt))
      record_.row(gas_, coupling_.sums(), balance, feed_);
    if (multiple(t, settings_.write_interval, dt)) {
      coupling_.output_fields();
      gas_.write();
    }
    if (multiple(t, settings_.checkpoint_interval, dt)) checkpoint("running");
    record_.progress(gas_, expected_, timing_);
  }

  void checkpoint(const std::string& state) {
    save_checkpoint(comm_, gas_, dem_, feed_, record_.saved(timing_));
    record_.write_json(gas_, coupling_.sums(), feed_, timing_, state);
    reopen(dem_);
    coupling_.map();
  }

  void finish() {
    checkpoint("done");
    record_.print_costs(timing_);
  }

  MPI_Comm comm_;
  Timing timing_;
  Gas gas_;
  const Settings& settings_;
  CellFinder finder_;
  Dem dem_;
  Feed feed_;
  Record record_;
  Coupling coupling_;
  long expected_ = 0;
};

int run(int argc, char** argv) {
  int ranks, rank;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  bool resume = false, again = false;
  for (int n = 1; n < argc; ++n) {
    resume = resume || std::strcmp(argv[n], "--resume") == 0;
    again = again || std::strcmp(argv[n], "--again") == 0;
    if (std::strcmp(argv[n], "--help") == 0) {
      if (rank == 0) std::fputs(usage, stdout);
      return 0;
    }
  }
  if (argc > 2 || (argc == 2 && !resume && !again)) {
    if (rank == 0) std::fputs(usage, stderr);
    return 2;
  }
  if (!resume && !again && has_checkpoint())
    throw BadInput("there is a checkpoint; --resume goes on from it, --again starts anew");
  Run(MPI_COMM_WORLD, ranks > 1).go(resume);
  return 0;
}

}  // namespace
}  // namespace bedscope::coupled

int main(int argc, char** argv) {
  using namespace bedscope::coupled;
  MPI_Init(&argc, &argv);
  int code = 3;
  try {
    code = run(argc, argv);
  } catch (const BadInput& error) {
    std::fprintf(stderr, "bedscope-coupled: %s\n", error.what());
    code = 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bedscope-coupled: internal error: %s\n", error.what());
  }
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (code != 0 && ranks > 1) PMPI_Abort(MPI_COMM_WORLD, code);  // the others may wait for this one
  MPI_Finalize();
  return code;
}
