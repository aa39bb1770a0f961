// SPDX-License-Identifier: BSD-3-Clause
// What `bedscope info` says of particle dumps, for people and for programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/info_plan.hpp"
#include "readers/checkup.hpp"

namespace bedscope::app {

struct InfoReport {
  const readers::Series& series;
  const readers::Survey& survey;
  const readers::LiggghtsLog& log;
  const readers::Checkup& checkup;
  const Plan& plan;
};

/// Files of the folder that are no dumps, by what they are.
struct Companions {
  std::string what;
  std::size_t files = 0;
  std::string first;  ///< name of the first one
};
std::vector<Companions> companions_of(const std::vector<std::string>& left_out);

/// Times of the snapshots [s], from the form or by the log's time step; empty where unknown.
std::vector<double> times_of(const InfoReport& report);

std::string info_text(const InfoReport& report);
std::string info_json(const InfoReport& report);

}  // namespace bedscope::app
