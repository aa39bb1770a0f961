// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum and continuity of the gas: a predictor and PISO corrections.
#include <chrono>

#include <constrainHbyA.H>
#include <constrainPressure.H>
#include "cases/coupled/gas_fields.hpp"

using namespace Foam;

namespace bedscope::coupled {
namespace {

// Cell values of the mean of a force over the faces, as the pressure gradient of a cell is one.
// Where the voidage jumps the one would else not balance the other: the velocity would swing from
// row to row, and the first row of a bed feel half of its drag.
class FaceMean {
 public:
  FaceMean(const volScalarField& K, const volVectorField& KUs)
      : K_(K),
        KUs_(KUs),
        drag_(IOobject("drag", K.time().timeName(), K.mesh(), IOobject::NO_READ, IOobject::NO_WRITE,
                       false),
              K.mesh(), dimensionedVector(KUs.dimensions(), Zero),
              extrapolatedCalculatedFvPatchVectorField::typeName) {}

  /// Mean over the faces less value in the cell, of the drag that the particles exert. On boxes it
  /// adds up to 0 over the cells, so that what they take is what K (U - Us) says.
  tmp<volVectorField> less_cell(const volVectorField& u) {
    drag_.primitiveFieldRef() = KUs_.primitiveField() - K_.primitiveField() * u.primitiveField();
    drag_.correctBoundaryConditions();
    return fvc::reconstruct(fvc::flux(drag_)) - drag_;
  }
  /// The same of eps grad p. At the patches by the values there: a gradient that a patch remembers
  /// is not in a checkpoint.
  static tmp<volVectorField> pressure(const surfaceScalarField& epsf, const volScalarField& p) {
    surfaceScalarField gradient(fvc::snGrad(p));
    forAll(gradient.boundaryField(), patch) {
      const fvPatchScalarField& there = p.boundaryField()[patch];
      if (!there.coupled())
        gradient.boundaryFieldRef()[patch] =
            there.patch().deltaCoeffs() * (there - there.patchInternalField());
    }
    return fvc::reconstruct(epsf * gradient * p.mesh().magSf());
  }

 private:
  const volScalarField& K_;
  const volVectorField& KUs_;
  volVectorField drag_;
};

}  // namespace

void Gas::solve_flow() {
  Fields& f = *f_;
  const dictionary& piso = f.mesh.solutionDict().subDict("PISO");
  const label corrections = piso.getOrDefault<label>("nCorrectors", 2);
  const label skew = piso.getOrDefault<label>("nNonOrthogonalCorrectors", 0);
  volScalarField& eps = f.voidfraction;
  const volScalarField epsNu("epsNu", eps * f.nu);
  const bool implicit = f.settings.implicit_drag;

  // The term with fvm::Sp is 0 where continuity holds; it keeps a uniform velocity uniform while
  // the fluxes are still those of the old voidage.
  fvVectorMatrix UEqn(
      fvm::ddt(eps, f.U) + fvm::div(f.alphaPhi, f.U) -
      fvm::Sp(fvc::ddt(eps) + fvc::div(f.alphaPhi), f.U) - fvm::laplacian(epsNu, f.U) -
      fvc::div(epsNu * dev2(T(fvc::grad(f.U))), "div((voidfraction*nu*dev2(T(grad(U)))))") - f.KUs);
  if (implicit)
    UEqn += fvm::Sp(f.K, f.U);
  else
    UEqn += f.K * f.U.oldTime();
  UEqn.relax();
  FaceMean faces(f.K, f.KUs);
  const surfaceScalarField epsf(fvc::interpolate(eps));
  if (piso.getOrDefault<bool>("momentumPredictor", true))
    solve(UEqn == faces.less_cell(f.U.oldTime()) - faces.pressure(epsf, f.p));

  const auto start = std::chrono::steady_clock::now();
  // A and H are brought to the faces each by itself: 1/A jumps with the drag, and the pressure drop
  // would depend on the time step.
  const volScalarField A(UEqn.A());
  const volScalarField rAU(1 / A);
  const surfaceScalarField rAUf(1 / fvc::interpolate(A));
  const volScalarField epsrAU("epsrAU", eps * rAU);
  for (label corrector = 1; corrector <= corrections; ++corrector) {
    volVectorField HbyA(constrainHbyA(rAU * UEqn.H(), f.U, f.p));
    surfaceScalarField phiHbyA("phiHbyA",
                               rAUf * (fvc::flux(A * HbyA) + epsf * fvc::ddtCorr(f.U, f.phi)));
    adjustPhi(phiHbyA, f.U, f.p);
    constrainPressure(f.p, f.U, phiHbyA, epsrAU);
    for (label again = 0; again <= skew; ++again) {
      fvScalarMatrix pEqn(fvm::laplacian(epsf * epsf * rAUf, f.p) ==
                          fvc::ddt(eps) + fvc::div(epsf * phiHbyA));
      pEqn.setReference(f.pressure_cell, f.pressure_value);
      const bool last = corrector == corrections && again == skew;
      pEqn.solve(f.mesh.solver(f.p.select(last)));
      if (again == skew) {
        f.alphaPhi = epsf * phiHbyA - pEqn.flux();
        f.phi = f.alphaPhi / epsf;
      }
    }
    f.U =
        HbyA + rAU * (faces.less_cell(implicit ? f.U : f.U.oldTime()) - faces.pressure(epsf, f.p));
    f.U.correctBoundaryConditions();
  }
  f.pressure_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

GasBalance Gas::balance() const {
  const Fields& f = *f_;
  GasBalance balance;
  const scalarField residual((fvc::ddt(f.voidfraction) + fvc::div(f.alphaPhi))().primitiveField());
  balance.worst_cell = gMax(mag(residual)()) * f.time.deltaTValue();
  balance.storage =
      gSum(scalarField(fvc::ddt(f.voidfraction)().primitiveField() * f.mesh.V().field()));
  const double capacity =
      f.settings.energy ? f.settings.gas_density * f.settings.energy->heat_capacity : 0;
  double hot = 0;
  forAll(f.mesh.boundary(), patch) {
    if (f.mesh.boundary()[patch].coupled()) continue;
    const scalarField& flux = f.alphaPhi.boundaryField()[patch];
    for (label n = 0; n < flux.size(); ++n) {
      (flux[n] < 0 ? balance.inflow : balance.outflow) += std::abs(flux[n]);
      if (!f.T) continue;
      const double carried = std::abs(flux[n]) * f.T->boundaryField()[patch][n];
      (flux[n] < 0 ? balance.heat_in : hot) += carried * (flux[n] < 0 ? capacity : 1);
    }
  }
  for (double* sum : {&balance.inflow, &balance.outflow, &balance.heat_in, &hot})
    reduce(*sum, sumOp<scalar>());
  balance.heat_out = capacity * hot;
  if (balance.outflow > 0) balance.outlet_temperature = hot / balance.outflow;
  if (f.T)
    balance.heat_content = capacity * gSum(scalarField(f.voidfraction.primitiveField() *
                                                       f.T->primitiveField() * f.mesh.V().field()));
  const auto mean = [&](const std::string& name) {
    const label patch = f.mesh.boundaryMesh().findPatchID(name);
    if (patch < 0) return 0.0;
    const scalarField& area = f.mesh.magSf().boundaryField()[patch];
    return gSum(scalarField(area * f.p.boundaryField()[patch])) / gSum(area);
  };
  balance.pressure_drop =
      f.settings.gas_density * (mean(f.settings.inlet) - mean(f.settings.outlet));
  const scalarField sums(fvc::surfaceSum(mag(f.phi))().primitiveField() / f.mesh.V().field());
  balance.courant = 0.5 * gMax(sums) * f.time.deltaTValue();
  return balance;
}

Vec3 Gas::drag_on_particles() const {
  const Fields& f = *f_;
  const vectorField& u =
      f.settings.implicit_drag ? f.U.primitiveField() : f.U.oldTime().primitiveField();
  const vector force =
      f.settings.gas_density *
      gSum(vectorField((f.K.primitiveField() * u - f.KUs.primitiveField()) * f.mesh.V().field()));
  return {force.x(), force.y(), force.z()};
}

}  // namespace bedscope::coupled
