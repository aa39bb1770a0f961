// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/dem.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "cases/coupled/bad_input.hpp"
// LIGGGHTS; never together with OpenFOAM's headers.
#include <liggghts/atom.h>
#include <liggghts/atom_vec.h>
#include <liggghts/comm.h>
#include <liggghts/domain.h>
#include <liggghts/fix.h>
#include <liggghts/group.h>
#include <liggghts/lammps.h>
#include <liggghts/library.h>
#include <liggghts/modify.h>
#include <liggghts/update.h>

namespace bedscope::coupled {
namespace {

constexpr const char* screen_file = "DEM/log.liggghts";

// LIGGGHTS enters its styles into static tables each time it is opened, and complains of the second
// time on stderr, 600 lines long; read_restart writes a version to stdout.
class Silence {
 public:
  Silence() {
    for (int n : {0, 1}) kept[n] = ::dup(n + 1);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    for (int fd : {1, 2}) ::dup2(nowhere, fd);
    ::close(nowhere);
  }
  ~Silence() {
    std::fflush(stdout);
    restore();
    for (int fd : kept) ::close(fd);
  }
  Silence(const Silence&) = delete;
  static void restore() {
    for (int n : {0, 1}) ::dup2(kept[n], n + 1);
  }

 private:
  static inline int kept[2] = {1, 2};
};

// LIGGGHTS ends the process by itself, MPI_Abort() or exit(), and says why in its log only.
bool inside = false;  // whether it is LIGGGHTS that runs
void tell_error() {
  if (!inside) return;
  Silence::restore();
  std::ifstream log(screen_file);
  std::string line, error = "stopped without an error message";
  while (std::getline(log, line))
    if (line.rfind("ERROR", 0) == 0) error = line;
  std::fprintf(stderr, "bedscope-coupled: LIGGGHTS: %s (%s)\n", error.c_str(), screen_file);
}
struct Inside {
  bool before = inside;
  Inside() { inside = true; }
  ~Inside() { inside = before; }
};

}  // namespace

struct Dem::Handle {
  void* opaque = nullptr;
  LAMMPS_NS::LAMMPS& lmp() const { return *static_cast<LAMMPS_NS::LAMMPS*>(opaque); }
  LAMMPS_NS::Atom& atom() const { return *lmp().atom; }
  void command(const std::string& line) const { lammps_command(opaque, line.c_str()); }
  ~Handle() {
    if (opaque) lammps_close(opaque);
  }
};

Dem::Dem(MPI_Comm comm, std::string deck, std::vector<int> wall_types, bool heat)
    : comm_(comm), deck_(std::move(deck)), wall_types_(std::move(wall_types)), heat_(heat) {
  if (!std::ifstream(deck_))
    throw BadInput(deck_ + ": cannot be read; start the program in the case's folder");
}
Dem::~Dem() = default;

void Dem::open(const std::string& restart) {
  handle_.reset();
  handle_ = std::make_unique<Handle>();
  // -screen none crashes 3.8.0 when a deck reads an STL file; the log is what is written to the
  // screen.
  std::vector<std::string> words{"liggghts",
                                 "-screen",
                                 screen_file,
                                 "-log",
                                 "none",
                                 "-echo",
                                 "screen",
                                 "-var",
                                 "coupled",
                                 "1",
                                 "-var",
                                 "steps",
                                 "0",
                                 "-var",
                                 "resumed",
                                 restart.empty() ? "0" : "1",
                                 "-var",
                                 "restart",
                                 restart.empty() ? "none" : restart};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  static const bool once = std::atexit([] {
                             if (inside) tell_error(), _exit(2);
                           }) == 0;
  (void)once;
  const Inside guard;
  std::fflush(stdout);
  auto silence = std::make_unique<Silence>();
  lammps_open(int(argv.size()), argv.data(), comm_, &handle_->opaque);
  if (FILE* screen = handle_->lmp().screen) setvbuf(screen, nullptr, _IOLBF, 0);
  lammps_file(handle_->opaque, deck_.c_str());
  silence.reset();
  changed_ = true;
  run(0);  // fixes create what they need when they are first initialised
  if (FILE* screen = handle_->lmp().screen) log_start_ = std::ftell(screen);
  next_id_ = std::max(next_id_, handle_->atom().tag_max() + 1);
  learn_groups();
  if (!lammps_extract_fix(handle_->opaque, "dragforce", 1, 2, 0, 0))
    throw BadInput(deck_ + ": no 'fix couple/cfd/force', needed to hand over the gas' force");
  if (heat_ && (!lammps_extract_fix(handle_->opaque, "convectiveHeatFlux", 1, 1, 0, 0) ||
                !lammps_extract_fix(handle_->opaque, "Temp", 1, 1, 0, 0)))
    throw BadInput(deck_ +
                   ": no 'fix heat/gran' with 'fix couple/cfd/convection', needed by energy");
}

void Dem::write_restart(const std::string& file) {
  const Inside guard;
  handle_->command("write_restart " + file);
}

void Dem::run(int steps) {
  const Inside guard;
  handle_->command("run " + std::to_string(steps) + (changed_ ? " pre yes" : " pre no") +
                   " post no");
  changed_ = false;
  // LIGGGHTS writes a table a run: of these the log keeps the last megabyte.
  FILE* screen = handle_->lmp().screen;
  if (screen && std::ftell(screen) > log_start_ + (1 << 20)) {
    std::fseek(screen, log_start_, SEEK_SET);
    if (::ftruncate(::fileno(screen), log_start_) != 0) return;  // longer, that is all
  }
}

bool Dem::is_wall(int type) const {
  return std::find(wall_types_.begin(), wall_types_.end(), type) != wall_types_.end();
}

void Dem::read(Particles& to) {
  const LAMMPS_NS::Atom& atom = handle_->atom();
  to.local.clear();
  for (int i = 0; i < atom.nlocal; ++i)
    if (wall_types_.empty() || !is_wall(atom.type[i])) to.local.push_back(i);
  const std::size_t n = to.local.size();
  to.type.resize(n);
  to.position.resize(3 * n);
  to.velocity.resize(3 * n);
  to.radius.resize(n);
  to.mass.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int l = to.local[i];
    to.type[i] = atom.type[l];
    to.radius[i] = atom.radius[l];
    to.mass[i] = atom.rmass[l];
    for (int a = 0; a < 3; ++a) {
      to.position[3 * i + a] = atom.x[l][a];
      to.velocity[3 * i + a] = atom.v[l][a];
    }
  }
  if (!heat_) return;
  const auto* temperature =
      static_cast<double*>(lammps_extract_fix(handle_->opaque, "Temp", 1, 1, 0, 0));
  to.temperature.resize(n);
  for (std::size_t i = 0; i < n; ++i) to.temperature[i] = temperature[to.local[i]];
}

void Dem::set_force(const Particles& particles, const std::vector<double>& force) {
  auto** to = static_cast<double**>(lammps_extract_fix(handle_->opaque, "dragforce", 1, 2, 0, 0));
  for (int i = 0; i < particles.count(); ++i)
    for (int a = 0; a < 3; ++a) to[particles.local[i]][a] = force[3 * i + a];
}

void Dem::set_heat(const Particles& particles, const std::vector<double>& heat) {
  auto* to =
      static_cast<double*>(lammps_extract_fix(handle_->opaque, "convectiveHeatFlux", 1, 1, 0, 0));
  for (int i = 0; i < particles.count(); ++i) to[particles.local[i]] = heat[i];
}

void Dem::remove(std::vector<int> local) {
  LAMMPS_NS::Atom& atom = handle_->atom();
  std::sort(local.rbegin(), local.rend());  // from behind: the last one fills the gap
  for (const int i : local) {
    atom.avec->copy(atom.nlocal - 1, i, 1);
    --atom.nlocal;
  }
  renumber();
}

void Dem::place(const std::vector<NewParticle>& particles) {
  LAMMPS_NS::LAMMPS& lmp = handle_->lmp();
  LAMMPS_NS::Atom& atom = *lmp.atom;
  for (const NewParticle& particle : particles) {
    const int id = next_id_++;  // never one that was used before
    const int groups = groups_[std::size_t(particle.type)];
    if (groups == 0 && lmp.group->ngroup > 1)
      throw BadInput(
          deck_ + ": groups besides 'all', and no particle of type " +
          std::to_string(particle.type) +
          " at the start: expected one, to tell to which of them those that enter belong");
    const double* low = lmp.domain->sublo;
    const double* high = lmp.domain->subhi;
    bool here = true;
    for (int a = 0; a < 3; ++a)
      here = here && particle.position[a] >= low[a] && particle.position[a] < high[a];
    if (!here) continue;
    Vec3 position = particle.position;
    atom.avec->create_atom(particle.type, position.data());
    const int i = atom.nlocal - 1;
    atom.tag[i] = id;
    if (groups != 0) atom.mask[i] = groups;
    atom.radius[i] = particle.diameter / 2;
    atom.density[i] = particle.density;
    atom.rmass[i] = particle.density * M_PI / 6 * std::pow(particle.diameter, 3);
    for (int a = 0; a < 3; ++a) {
      atom.v[i][a] = particle.velocity[a];
      atom.omega[i][a] = 0;
    }
    for (int f = 0; f < lmp.modify->nfix; ++f)
      if (lmp.modify->fix[f]->create_attribute) {
        lmp.modify->fix[f]->pre_set_arrays();
        lmp.modify->fix[f]->set_arrays(i);
      }
  }
  renumber();
}

// A group holds those that were there when the deck named it: who enters later has to be told, or
// feels neither gravity nor what moves the others, and is in no dump.
void Dem::learn_groups() {
  const LAMMPS_NS::Atom& atom = handle_->atom();
  std::vector<int> common(std::size_t(atom.ntypes) + 1, ~0), all(common.size());
  for (int i = 0; i < atom.nlocal; ++i) common[std::size_t(atom.type[i])] &= atom.mask[i];
  MPI_Allreduce(common.data(), all.data(), int(all.size()), MPI_INT, MPI_BAND, comm_);
  groups_.resize(all.size(), 0);
  for (std::size_t type = 1; type < all.size(); ++type)
    if (all[type] != ~0) groups_[type] = all[type];
}

void Dem::renumber() {
  LAMMPS_NS::Atom& atom = handle_->atom();
  LAMMPS_NS::bigint local = atom.nlocal;
  MPI_Allreduce(&local, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, comm_);
  if (atom.map_style) {
    atom.nghost = 0;
    atom.map_init();
    atom.map_set();
  }
  changed_ = true;
}

long Dem::count() const {
  long local = handle_->atom().nlocal, all = 0;
  MPI_Allreduce(&local, &all, 1, MPI_LONG, MPI_SUM, comm_);
  return all;
}
double Dem::time_step() const { return handle_->lmp().update->dt; }
long Dem::step() const { return handle_->lmp().update->ntimestep; }

}  // namespace bedscope::coupled

// MPI lets a program stand in for its functions.
extern "C" int MPI_Abort(MPI_Comm comm, int code) {
  bedscope::coupled::tell_error();
  return PMPI_Abort(comm, code == 1 ? 2 : code);
}
