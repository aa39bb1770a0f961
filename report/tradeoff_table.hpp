// SPDX-License-Identifier: BSD-3-Clause
// Inside report: the parts of the tradeoff's page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/tradeoff_page.hpp"

namespace bedscope::report {

std::string product_sentence(const TradeoffReport& report, std::size_t product);
std::vector<std::string> recommendation_sentences(const TradeoffReport& report);
void write_tradeoff_table(const TradeoffReport& report, const std::filesystem::path& path);

}  // namespace bedscope::report
