// SPDX-License-Identifier: BSD-3-Clause
// A reference curve: points with their uncertainties, and where they come from.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bedscope::validation {

/// "holdup [-]" as a header of a table names it.
struct Title {
  std::string name, unit;  ///< unit empty: none was said
  bool is_time() const { return unit == "s"; }
  std::string text() const { return unit.empty() ? name : name + " [" + unit + "]"; }
};
Title parse_title(std::string_view text);

struct CurvePoint {
  double x = 0, y = 0;
  double u_x = 0, u_y = 0;  ///< standard uncertainties, in the units of x and y
  double u_y_down = -1;     ///< of y downwards, where its bar has unequal arms; below 0: as u_y

  double up() const { return u_y; }
  double down() const { return u_y_down < 0 ? u_y : u_y_down; }
};

/// What the sidecar tells; texts as written there, empty where it says nothing.
struct Provenance {
  std::string title, quantity, citation, doi;
  std::string kind;    ///< experiment, simulation, correlation ...
  std::string method;  ///< digitised, original
  std::string by, measurement, source, licence, processing, uncertainty_note;
  bool redistribute = true;
  bool orientation_known = true;  ///< false: which end of the abscissa is which wall is not said
  std::vector<std::string> caveats, checks;
  std::vector<std::pair<std::string, std::string>> conditions;
};

struct Curve {
  std::string name;  ///< as it was asked for: "varas_2017/lateral_holdup?U=5.55"
  std::string path;
  Title x, y;
  std::vector<CurvePoint> points;  ///< by ascending x
  Provenance about;
  std::vector<std::string> assumptions;  ///< uncertainties that the source does not state
  bool of_same_snapshots = false;        ///< an earlier result of what the run itself averages
};

}  // namespace bedscope::validation
