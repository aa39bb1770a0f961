// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of one sphere in a gas and of one contact, as references: what a run given as tables
// or a solver's own output can be held against.
#include "physics/contact.hpp"
#include "physics/drag.hpp"
#include "physics/heat_transfer.hpp"
#include "validation/theory_parts.hpp"

namespace bedscope::validation {
namespace {

using analysis::RunResult;

template <double (*law)(double voidage, double reynolds)>
double drag(const Parameters& with, const RunResult&, double) {
  return law(with("voidage"), with("reynolds"));
}

double nusselt(const Parameters& with, const RunResult&, double) {
  return physics::gunn_nusselt(with("voidage"), with("reynolds"), with("prandtl"));
}

double contact_time(const Parameters& with, const RunResult&, double) {
  return physics::contact_time(with("stiffness"), with("effective_mass"),
                               with.or_else("restitution", 1));
}

double contact_time_hertz(const Parameters& with, const RunResult&, double) {
  return physics::hertz_contact_time(with("effective_modulus"), with("effective_radius"),
                                     with("effective_mass"), with("impact_velocity"));
}

double largest_overlap(const Parameters& with, const RunResult&, double) {
  return physics::largest_overlap(with("stiffness"), with("effective_mass"),
                                  with("impact_velocity"), with.or_else("restitution", 1));
}

double largest_overlap_hertz(const Parameters& with, const RunResult&, double) {
  return physics::hertz_largest_overlap(with("effective_modulus"), with("effective_radius"),
                                        with("effective_mass"), with("impact_velocity"));
}

double damping(const Parameters& with, const RunResult&, double) {
  return physics::damping_coefficient(with("stiffness"), with("effective_mass"),
                                      with("restitution"));
}

double stiffness_ratio(const Parameters& with, const RunResult&, double) {
  return physics::tangential_stiffness_ratio(with("restitution"), with("tangential_restitution"));
}

constexpr std::string_view of_drag =
    "drag over 3 pi mu d eps (u - v), without the mean pressure gradient's; reynolds: of the "
    "superficial slip velocity; ";

}  // namespace

std::vector<Theory> theories_of_closures() {
  static const std::string ergun = std::string(of_drag) + "packed beds, voidage below 0.8",
                           wen_yu = std::string(of_drag) + "suspensions, voidage above 0.8",
                           gidaspow = std::string(of_drag) + "jumps at a voidage of 0.8",
                           di_felice = std::string(of_drag) + "a lone sphere's is 11 to 37 % high",
                           beetstra = std::string(of_drag) + "voidage 0.4 to 0.9, Re up to 1000";
  const std::vector<std::string_view> hertz{"effective_modulus", "effective_radius",
                                            "effective_mass", "impact_velocity"};
  return {
      {{"contact time",
        "s",
        {"stiffness", "effective_mass"},
        {"restitution"},
        "damped linear oscillator",
        "linear spring and dashpot, contact ends at zero overlap; elastic where restitution is "
        "left out"},
       contact_time},
      {{"contact time Hertz", "s", hertz, {}, "Hertz (1882), Johnson (1985)", "elastic, head-on"},
       contact_time_hertz},
      {{"damping coefficient",
        "kg/s",
        {"stiffness", "effective_mass", "restitution"},
        {},
        "damped linear oscillator",
        "linear spring and dashpot, contact ends at zero overlap"},
       damping},
      {{"drag Beetstra",
        "-",
        {"voidage", "reynolds"},
        {},
        "Beetstra, van der Hoef and Kuipers (2007)",
        beetstra},
       drag<physics::beetstra>},
      {{"drag Di Felice", "-", {"voidage", "reynolds"}, {}, "Di Felice (1994)", di_felice},
       drag<physics::di_felice>},
      {{"drag Ergun", "-", {"voidage", "reynolds"}, {}, "Ergun (1952)", ergun},
       drag<physics::ergun>},
      {{"drag Gidaspow", "-", {"voidage", "reynolds"}, {}, "Gidaspow (1994)", gidaspow},
       drag<physics::gidaspow>},
      {{"drag Wen-Yu", "-", {"voidage", "reynolds"}, {}, "Wen and Yu (1966)", wen_yu},
       drag<physics::wen_yu>},
      {{"largest overlap",
        "m",
        {"stiffness", "effective_mass", "impact_velocity"},
        {"restitution"},
        "damped linear oscillator",
        "head-on, linear spring and dashpot; elastic where restitution is left out"},
       largest_overlap},
      {{"largest overlap Hertz",
        "m",
        hertz,
        {},
        "Hertz (1882), Johnson (1985)",
        "elastic, head-on"},
       largest_overlap_hertz},
      {{"Nusselt Gunn",
        "-",
        {"voidage", "reynolds", "prandtl"},
        {},
        "Gunn (1978)",
        "voidage from 0.35, Re of the superficial slip velocity up to 1e5"},
       nusselt},
      {{"stiffness ratio",
        "-",
        {"restitution", "tangential_restitution"},
        {},
        "van der Hoef et al. (2006)",
        "k_t / k_n of solid spheres for equal periods"},
       stiffness_ratio},
  };
}

}  // namespace bedscope::validation
