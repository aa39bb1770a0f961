// SPDX-License-Identifier: GPL-3.0-or-later
// The OpenFOAM side of Gas, shared by gas.cpp, gas_flow.cpp and gas_energy.cpp.
#pragma once

#include <fvCFD.H>
#include "cases/coupled/gas.hpp"

namespace bedscope::coupled {

struct Gas::Fields {
  Fields(Foam::Time& time, Settings settings);

  Foam::Time& time;
  Settings settings;
  Foam::fvMesh mesh;
  Foam::dimensionedScalar nu;
  Foam::volScalarField voidfraction;
  Foam::volVectorField U;
  Foam::volScalarField p;
  Foam::volVectorField grad_p;        // of p as it is: drag, predictor and corrector share it
  Foam::surfaceScalarField phi;       // u . S
  Foam::surfaceScalarField alphaPhi;  // eps u . S
  Foam::volScalarField K;             // drag coefficient over rho, in a volume of bed [1/s]
  Foam::volVectorField KUs;           // ... times the particles' velocity [m/s2]
  Foam::volVectorField Us;
  std::unique_ptr<Foam::volScalarField> T;
  std::unique_ptr<Foam::volScalarField> H, HTs;  // sum h A / (rho c V) [1/s], times T [K/s]
  std::vector<double> voidage;
  double pressure_seconds = 0;
  Foam::label floor_hits = 0;
  Foam::label pressure_cell = 0;  // reference in a domain closed to gas
  Foam::scalar pressure_value = 0;

  // Calls f(data, count) on every array that is state; the list of a checkpoint.
  template <class F>
  void each_state(F f) {
    auto volume = [&](auto& field) {
      f(field.primitiveFieldRef());
      for (auto& patch : field.boundaryFieldRef()) f(patch);
    };
    volume(voidfraction);
    volume(U);
    volume(p);
    volume(phi);
    volume(alphaPhi);
    if (T) volume(*T);
  }
};

}  // namespace bedscope::coupled
