// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/gas.hpp"

#include <argList.H>
#include <sigFpe.H>
#include "cases/coupled/bad_input.hpp"
#include "cases/coupled/gas_fields.hpp"
#include "cases/coupled/settings_reader.hpp"

using namespace Foam;

namespace bedscope::coupled {
namespace {

IOobject must_read(const word& name, const Time& time, const fvMesh& mesh) {
  return IOobject(name, time.timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
}
IOobject silent(const word& name, const Time& time, const fvMesh& mesh) {
  return IOobject(name, time.timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE);
}

Time& open_case(bool parallel) {
  std::vector<std::string> words{"bedscope-coupled", "-case", "CFD"};
  if (parallel) words.push_back("-parallel");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int argc = int(pointers.size());
  char** argv = pointers.data();
  Info.level = 0;  // its banner and its solvers' lines; errors are thrown
  messageStream::level = 0;
  FatalError.throwExceptions();
  FatalIOError.throwExceptions();
  argList::noBanner();
  argList::noFunctionObjects();
  // Never destroyed: argList's destructor ends the process, with exit code 0.
  const argList& arguments = *new argList(argc, argv, false, false);
  sigFpe::unset(false);  // what blows up is told by its numbers, not by a crash
  Time& time = *new Time(Time::controlDictName, arguments);
  time.setTime(0.0, 0);
  return time;
}

}  // namespace

Gas::Fields::Fields(Time& t, Settings s)
    : time(t),
      settings(std::move(s)),
      mesh(IOobject(fvMesh::defaultRegion, time.constant(), time, IOobject::MUST_READ)),
      nu("nu", dimViscosity, settings.gas_viscosity / settings.gas_density),
      voidfraction(must_read("voidfraction", time, mesh), mesh),
      U(must_read("U", time, mesh), mesh),
      p(must_read("p", time, mesh), mesh),
      grad_p(fvc::grad(p)),
      phi(silent("phi", time, mesh), fvc::flux(U)),
      alphaPhi(silent("alphaPhi", time, mesh), fvc::interpolate(voidfraction) * phi),
      K(silent("K", time, mesh), mesh, dimensionedScalar(inv(dimTime), Zero)),
      KUs(silent("KUs", time, mesh), mesh, dimensionedVector(dimAcceleration, Zero)),
      Us(silent("Us", time, mesh), mesh, dimensionedVector(dimVelocity, Zero)),
      voidage(mesh.nCells(), 1.0) {
  Us.writeOpt() = IOobject::AUTO_WRITE;
  mesh.setFluxRequired(p.name());
  setRefCell(p, mesh.solutionDict().subOrEmptyDict("PISO"), pressure_cell, pressure_value);
  for (const std::string& name : {settings.inlet, settings.outlet})
    if (p.needReference() == false && mesh.boundaryMesh().findPatchID(name) < 0)
      throw BadInput("CFD/constant/coupledProperties: output: no patch '" + name + "' in the mesh");
  if (!settings.energy) return;
  T = std::make_unique<volScalarField>(must_read("T", time, mesh), mesh);
  H = std::make_unique<volScalarField>(silent("H", time, mesh), mesh,
                                       dimensionedScalar(inv(dimTime), Zero));
  HTs = std::make_unique<volScalarField>(silent("HTs", time, mesh), mesh,
                                         dimensionedScalar(dimTemperature / dimTime, Zero));
}

Gas::Gas(bool parallel) {
  try {
    Time& time = open_case(parallel);
    f_ = std::make_unique<Fields>(time, read_settings(time));
  } catch (const Foam::IOerror& error) {
    throw BadInput(error.ioFileName() + ": line " + std::to_string(error.ioStartLineNumber()) +
                   ": " + error.message());
  } catch (const Foam::error& error) {
    throw BadInput(error.message());
  }
}

Gas::~Gas() = default;

const Settings& Gas::settings() const { return f_->settings; }
double Gas::time() const { return f_->time.value(); }
long Gas::step() const { return f_->time.timeIndex(); }
int Gas::cells() const { return f_->mesh.nCells(); }
double Gas::pressure_seconds() const { return f_->pressure_seconds; }
long Gas::floor_hits() const { return returnReduce(f_->floor_hits, sumOp<label>()); }

MeshGeometry Gas::geometry() const {
  MeshGeometry geometry;
  const fvMesh& mesh = f_->mesh;
  const auto vec = [](const vector& v) { return Vec3{v.x(), v.y(), v.z()}; };
  geometry.first_plane.push_back(0);
  for (label c = 0; c < mesh.nCells(); ++c) {
    const boundBox box(mesh.points(), mesh.cellPoints(c), false);
    geometry.low.push_back(vec(box.min()));
    geometry.high.push_back(vec(box.max()));
    geometry.volume.push_back(mesh.V()[c]);
    for (const label face : mesh.cells()[c]) {
      vector normal = mesh.faceAreas()[face] / mag(mesh.faceAreas()[face]);
      if (mesh.faceOwner()[face] != c) normal = -normal;
      geometry.planes.push_back({vec(normal), normal & mesh.faceCentres()[face]});
    }
    geometry.first_plane.push_back(int(geometry.planes.size()));
  }
  return geometry;
}

void Gas::set_solids(const std::vector<double>& solids_volume) {
  const scalarField& volume = f_->mesh.V();
  for (label c = 0; c < cells(); ++c) {
    double voidage = 1 - solids_volume[c] / volume[c];
    if (voidage < f_->settings.voidage_floor) {
      voidage = f_->settings.voidage_floor;
      ++f_->floor_hits;
    }
    f_->voidfraction[c] = f_->voidage[c] = voidage;
  }
  f_->voidfraction.correctBoundaryConditions();
}

void Gas::forget_old_voidage() { f_->alphaPhi = fvc::interpolate(f_->voidfraction) * f_->phi; }

const std::vector<double>& Gas::voidage() const { return f_->voidage; }

namespace {
void copy(const vectorField& from, std::vector<double>& to) {
  to.resize(3 * from.size());
  for (label c = 0; c < from.size(); ++c)
    for (direction a = 0; a < 3; ++a) to[3 * c + a] = from[c][a];
}
}  // namespace

void Gas::get_velocity(std::vector<double>& to) const { copy(f_->U.primitiveField(), to); }
void Gas::get_pressure_gradient(std::vector<double>& to) const {
  copy(f_->grad_p.primitiveField(), to);
}
void Gas::get_temperature(std::vector<double>& to) const {
  to.assign(f_->T->primitiveField().begin(), f_->T->primitiveField().end());
}

void Gas::set_exchange(const std::vector<double>& k, const std::vector<double>& k_velocity) {
  for (label c = 0; c < cells(); ++c) {
    const double over = 1 / (f_->mesh.V()[c] * f_->settings.gas_density);
    f_->K[c] = k[c] * over;
    for (direction a = 0; a < 3; ++a) f_->KUs[c][a] = k_velocity[3 * c + a] * over;
  }
  // Processor patches take their neighbours' values; physical ones stay 0.
  f_->K.correctBoundaryConditions();
  f_->KUs.correctBoundaryConditions();
}

void Gas::set_solids_velocity(const std::vector<double>& velocity) {
  for (label c = 0; c < cells(); ++c)
    for (direction a = 0; a < 3; ++a) f_->Us[c][a] = velocity[3 * c + a];
}

void Gas::begin_step() {
  ++f_->time;
  // Before they change. The first call makes the old field, the second notes that it is of this
  // step.
  const auto keep = [](auto& field) { field.oldTime(), field.storeOldTimes(); };
  keep(f_->voidfraction);
  keep(f_->U);
  keep(f_->phi);
  if (f_->T) keep(*f_->T);
}

void Gas::write() const { f_->time.writeNow(); }

void Gas::save(std::FILE* file) const {
  const double time = this->time();
  const std::int64_t step = this->step();
  std::fwrite(&time, sizeof time, 1, file);
  std::fwrite(&step, sizeof step, 1, file);
  f_->each_state([&](const auto& values) {
    const std::int64_t bytes = values.byteSize();
    std::fwrite(&bytes, sizeof bytes, 1, file);
    std::fwrite(values.cdata(), 1, bytes, file);
  });
}

void Gas::load(std::FILE* file) {
  const auto expect = [&](void* to, std::size_t bytes) {
    if (std::fread(to, 1, bytes, file) != bytes) throw BadInput("checkpoint: the gas' file is cut");
  };
  double time;
  std::int64_t step;
  expect(&time, sizeof time);
  expect(&step, sizeof step);
  f_->time.setTime(time, label(step));
  f_->each_state([&](auto& values) {
    std::int64_t bytes;
    expect(&bytes, sizeof bytes);
    if (bytes != std::int64_t(values.byteSize()))
      throw BadInput("checkpoint: written with another mesh, other ranks or other equations");
    expect(values.data(), bytes);
  });
  f_->grad_p = fvc::grad(f_->p);
}

}  // namespace bedscope::coupled
