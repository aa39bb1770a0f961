// SPDX-License-Identifier: BSD-3-Clause
// What can be said of a scene before CPU is spent: its numbers, the limits of its methods with the
// margin to each, and which models it needs. What a scene does not tell (a zero) is left out.
#pragma once

#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace bedscope::cases {

struct SceneNumber {
  std::string name;
  double value;      ///< NaN where the number is a letter
  std::string unit;  ///< or the letter
};

struct Limit {
  std::string name;
  double value, limit;
  double margin;  ///< how many times inside: 1 at the limit, above 1 inside
  bool ok;
  bool must;         ///< beyond it the scene cannot run: `case make` refuses
  std::string unit;  ///< of value and limit
  std::string rule;  ///< and its source
};

struct Advice {
  std::string model;
  bool needed;
  std::string reason;  ///< the rule with its numbers, and its source
};

struct CheckReport {
  std::vector<SceneNumber> numbers;
  std::vector<Limit> limits;
  std::vector<Advice> advice;
};

CheckReport check_scene(const Scene& scene);

std::vector<SceneNumber> scene_numbers(const Scene& scene);
std::vector<Limit> scene_limits(const Scene& scene);
std::vector<Advice> scene_advice(const Scene& scene);

/// One line for each limit that a scene must keep and does not, with the number and the limit.
std::vector<std::string> what_cannot_run(const std::vector<Limit>& limits);

}  // namespace bedscope::cases
