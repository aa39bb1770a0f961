// SPDX-License-Identifier: BSD-3-Clause
// Inside report: the charts of error against cost.
#pragma once

#include <string>

#include "report/figures.hpp"
#include "report/tradeoff_page.hpp"

namespace bedscope::report {

/// Of product `p`, both axes logarithmic.
Figure tradeoff_figure(const TradeoffReport& report, std::size_t p);

/// "0.41 ± 0.12 %", "0 %".
std::string percent(const analysis::Estimate& error);
std::string percent(double share);

}  // namespace bedscope::report
