// SPDX-License-Identifier: BSD-3-Clause
// What a theory is made of, shared by the lists of theories.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/result.hpp"
#include "validation/theory.hpp"

namespace bedscope::validation {

/// Parameters of a check, by name; all of a theory's are there when it is asked.
class Parameters {
 public:
  explicit Parameters(const std::map<std::string, double>& values) : values_(&values) {}
  double operator()(const char* name) const { return values_->at(name); }
  bool has(const char* name) const { return values_->contains(name); }
  double or_else(const char* name, double otherwise) const {
    const auto found = values_->find(name);
    return found != values_->end() ? found->second : otherwise;
  }

 private:
  const std::map<std::string, double>* values_;
};

struct Theory : NamedTheory {
  double (*value)(const Parameters& with, const analysis::RunResult& run, double x);
};

std::vector<Theory> theories_of_beds();      // theory_beds.cpp: a quantity of a whole run
std::vector<Theory> theories_of_closures();  // theory_closures.cpp: one sphere, one contact

}  // namespace bedscope::validation
