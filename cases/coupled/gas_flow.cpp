// SPDX-License-Identifier: GPL-3.0-or-later
// Momentum and continuity of the gas: a predictor and PISO corrections.
#include <chrono>

#include <constrainHbyA.H>
#include <constrainPressure.H>
#include "cases/coupled/gas_fields.hpp"

using namespace Foam;

namespace bedscope::coupled {

void Gas::solve_flow() {
  Fields& f = *f_;
  const dictionary& piso = f.mesh.solutionDict().subDict("PISO");
  const label corrections = piso.getOrDefault<label>("nCorrectors", 2);
  const label skew = piso.getOrDefault<label>("nNonOrthogonalCorrectors", 0);
  volScalarField& eps = f.voidfraction;
  const volScalarField epsNu("epsNu", eps * f.nu);

  const volScalarField storage(fvc::ddt(eps));

  // The term with fvm::Sp is 0 where continuity holds; it keeps a uniform velocity uniform while
  // the fluxes are still those of the old voidage.
  fvVectorMatrix UEqn(
      fvm::ddt(eps, f.U) + fvm::div(f.alphaPhi, f.U) -
      fvm::Sp(storage + fvc::div(f.alphaPhi), f.U) - fvm::laplacian(epsNu, f.U) -
      fvc::div(epsNu * dev2(T(fvc::grad(f.U))), "div((voidfraction*nu*dev2(T(grad(U)))))") - f.KUs);
  if (f.settings.implicit_drag)
    UEqn += fvm::Sp(f.K, f.U);
  else
    UEqn += f.K * f.U.oldTime();
  UEqn.relax();
  if (piso.getOrDefault<bool>("momentumPredictor", true)) solve(UEqn == -eps * f.grad_p);

  const auto start = std::chrono::steady_clock::now();
  const surfaceScalarField epsf(fvc::interpolate(eps));
  const volScalarField rAU(1 / UEqn.A());
  const surfaceScalarField rAUf(fvc::interpolate(rAU));
  const volScalarField epsrAU("epsrAU", eps * rAU);
  const surfaceScalarField conductance(epsf * fvc::interpolate(epsrAU));
  const surfaceScalarField of_old_flux(epsf * rAUf * fvc::ddtCorr(f.U, f.phi));
  for (label corrector = 1; corrector <= corrections; ++corrector) {
    volVectorField HbyA(constrainHbyA(rAU * UEqn.H(), f.U, f.p));
    surfaceScalarField phiHbyA("phiHbyA", fvc::flux(HbyA) + of_old_flux);
    adjustPhi(phiHbyA, f.U, f.p);
    constrainPressure(f.p, f.U, phiHbyA, epsrAU);
    for (label again = 0; again <= skew; ++again) {
      fvScalarMatrix pEqn(fvm::laplacian(conductance, f.p) == storage + fvc::div(epsf * phiHbyA));
      pEqn.setReference(f.pressure_cell, f.pressure_value);
      const bool last = corrector == corrections && again == skew;
      pEqn.solve(f.mesh.solver(f.p.select(last)));
      if (again == skew) {
        f.alphaPhi = epsf * phiHbyA - pEqn.flux();
        f.phi = f.alphaPhi / epsf;
      }
    }
    f.grad_p = fvc::grad(f.p);
    f.U = HbyA - epsrAU * f.grad_p;
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
