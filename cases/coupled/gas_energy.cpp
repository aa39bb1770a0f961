// SPDX-License-Identifier: GPL-3.0-or-later
// Heat in the gas: eps dT/dt + eps u . grad T = div(eps k / (rho c) grad T) + (sum h A (T_i - T)) /
// (rho c V).
#include "cases/coupled/gas_fields.hpp"

using namespace Foam;

namespace bedscope::coupled {

void Gas::set_heat_exchange(const std::vector<double>& ha,
                            const std::vector<double>& ha_temperature) {
  Fields& f = *f_;
  const double capacity = f.settings.gas_density * f.settings.energy->heat_capacity;
  for (label c = 0; c < cells(); ++c) {
    (*f.H)[c] = ha[c] / (capacity * f.mesh.V()[c]);
    (*f.HTs)[c] = ha_temperature[c] / (capacity * f.mesh.V()[c]);
  }
}

void Gas::solve_energy() {
  Fields& f = *f_;
  const Energy& energy = *f.settings.energy;
  const volScalarField& eps = f.voidfraction;
  const dimensionedScalar diffusivity(
      "a", dimViscosity, energy.conductivity / (f.settings.gas_density * energy.heat_capacity));
  volScalarField& temperature = *f.T;
  // The flux of energy is that of mass, so what is left of continuity must not heat: fvm::Sp.
  fvScalarMatrix TEqn(fvm::ddt(eps, temperature) +
                      fvm::div(f.alphaPhi, temperature, "div(alphaPhi,T)") -
                      fvm::Sp(fvc::ddt(eps) + fvc::div(f.alphaPhi), temperature) +
                      fvm::Sp(*f.H, temperature) - *f.HTs);
  if (energy.axial_conduction == "molecular")
    TEqn -= fvm::laplacian(eps * diffusivity, temperature);
  else if (energy.axial_conduction == "effective")  // eps k_eff = k (1 - sqrt(1 - eps))
    TEqn -= fvm::laplacian((1 - sqrt(1 - eps)) * diffusivity, temperature);
  TEqn.solve();
}

double Gas::heat_to_particles() const {
  const Fields& f = *f_;
  const double capacity = f.settings.gas_density * f.settings.energy->heat_capacity;
  return capacity * gSum(scalarField(
                        (f.H->primitiveField() * f.T->primitiveField() - f.HTs->primitiveField()) *
                        f.mesh.V().field()));
}

}  // namespace bedscope::coupled
