// SPDX-License-Identifier: BSD-3-Clause
// The tradeoff in words, as JSON and as a table.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/csv.hpp"
#include "analysis/summary.hpp"
#include "report/style.hpp"
#include "report/tradeoff_figures.hpp"
#include "report/tradeoff_table.hpp"

namespace bedscope::report {

using validation::Setting;

namespace {

using Json = nlohmann::ordered_json;

std::string cheaper(const TradeoffReport& report, std::size_t setting) {
  const auto& settings = report.tradeoff.settings;
  const double times = settings[report.tradeoff.present()].seconds / settings[setting].seconds;
  return times >= 1 ? fmt::format("{} times cheaper than the present choice", number(times, 2))
                    : fmt::format("{} times dearer than the present choice", number(1 / times, 2));
}

Json error_json(const validation::ProductError& error) {
  return {{"whole", error.whole.value},   {"whole_ci95", error.whole.ci95},
          {"first", error.first.value},   {"first_ci95", error.first.ci95},
          {"second", error.second.value}, {"second_ci95", error.second.ci95}};
}

Json setting_json(const Setting& setting) {
  return {{"setting", setting.name},
          {"every", setting.every},
          {"window", 1. / setting.part},
          {"seconds", setting.seconds},
          {"bytes", setting.bytes}};
}

}  // namespace

std::string product_sentence(const TradeoffReport& report, std::size_t p) {
  const auto& tradeoff = report.tradeoff;
  const std::size_t only[] = {p};
  const auto& product = tradeoff.products[p];
  if (std::isnan(tradeoff.settings.front().errors[p].whole.value))
    return fmt::format("the {} is nowhere defined in this window", product);
  const auto best = validation::cheapest(tradeoff, only);
  const auto& setting = tradeoff.settings[best];
  const auto& present = tradeoff.settings[tradeoff.present()];
  if (setting.seconds >= present.seconds)
    return fmt::format(
        "nothing cheaper than the present choice stays within {} of the {}{}",
        percent(tradeoff.tolerance), product,
        setting.present ? "" : fmt::format("; the nearest that does is {}", setting.name));
  const bool kept = validation::kept_promise(tradeoff, best, only);
  return fmt::format("{} is {} within {} of the {} ({} on the first half; {} on the second: {})",
                     setting.name, cheaper(report, best), percent(tradeoff.tolerance), product,
                     percent(setting.errors[p].first), percent(setting.errors[p].second.value),
                     kept ? "kept" : "not kept");
}

std::vector<std::string> recommendation_sentences(const TradeoffReport& report) {
  const auto& tradeoff = report.tradeoff;
  const auto& found = report.recommendation;
  const auto& settings = tradeoff.settings;
  std::vector<std::string> names;
  for (const auto p : tradeoff.required) names.push_back(tradeoff.products[p]);
  std::vector<std::string> all;
  const auto worst = [&](std::size_t setting, analysis::Estimate validation::ProductError::*half) {
    std::size_t most = tradeoff.required.front();
    for (const auto p : tradeoff.required)
      if (!((settings[setting].errors[most].*half).value >=
            (settings[setting].errors[p].*half).value))
        most = p;
    return fmt::format("{} {}", tradeoff.products[most],
                       percent((settings[setting].errors[most].*half).value));
  };
  all.push_back(fmt::format("within {} of {} on the first half, the cheapest is {}, {}",
                            percent(tradeoff.tolerance), fmt::join(names, ", "),
                            settings[found.chosen].name, cheaper(report, found.chosen)));
  all.push_back(fmt::format("the second half says: {} (largest error there: {})",
                            found.kept ? "the promise was kept" : "the promise was not kept",
                            worst(found.chosen, &validation::ProductError::second)));
  if (!found.kept)
    all.push_back(fmt::format(
        "recommended instead, by both halves so that nothing is left to check it: {}, {}",
        settings[found.setting].name, cheaper(report, found.setting)));
  all.push_back(
      fmt::format("recommended.toml has it; over the whole window its largest error is {}",
                  worst(found.setting, &validation::ProductError::whole)));
  return all;
}

std::vector<std::string> sentences(const TradeoffReport& report) {
  std::vector<std::string> all;
  for (std::size_t p = 0; p < report.tradeoff.products.size(); ++p)
    all.push_back(product_sentence(report, p));
  for (auto& sentence : recommendation_sentences(report)) all.push_back(std::move(sentence));
  return all;
}

std::string tradeoff_summary(const TradeoffReport& report) {
  const auto& tradeoff = report.tradeoff;
  const auto& found = report.recommendation;
  auto summary = Json::parse(analysis::summary_text(report.runs));
  Json weighed = {{"tolerance", tradeoff.tolerance},
                  {"promise_kept", found.kept},
                  {"finest", setting_json(tradeoff.settings.front())},
                  {"present", setting_json(tradeoff.settings[tradeoff.present()])},
                  {"chosen", setting_json(tradeoff.settings[found.chosen])},
                  {"recommended", setting_json(tradeoff.settings[found.setting])},
                  {"times_cheaper", tradeoff.settings[tradeoff.present()].seconds /
                                        tradeoff.settings[found.setting].seconds},
                  {"products", Json::array()},
                  {"problems", report.problems}};
  for (std::size_t p = 0; p < tradeoff.products.size(); ++p) {
    const std::size_t only[] = {p};
    const auto best = validation::cheapest(tradeoff, only);
    const bool required =
        std::find(tradeoff.required.begin(), tradeoff.required.end(), p) != tradeoff.required.end();
    weighed["products"].push_back(
        {{"product", tradeoff.products[p]},
         {"required", required},
         {"window_ci95", tradeoff.noise[p]},
         {"chosen", error_json(tradeoff.settings[found.chosen].errors[p])},
         {"recommended", error_json(tradeoff.settings[found.setting].errors[p])},
         {"present", error_json(tradeoff.settings[tradeoff.present()].errors[p])},
         {"cheapest", tradeoff.settings[best].name},
         {"cheapest_kept", validation::kept_promise(tradeoff, best, only)},
         {"sentence", product_sentence(report, p)}});
  }
  summary["tradeoff"] = std::move(weighed);
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_tradeoff_table(const TradeoffReport& report, const std::filesystem::path& path) {
  const auto& tradeoff = report.tradeoff;
  analysis::CsvWriter table(path,
                            "product,setting,error [-],error_ci95 [-],seconds,bytes,on_front");
  for (std::size_t p = 0; p < tradeoff.products.size(); ++p) {
    const auto front = tradeoff.front(p);
    for (std::size_t s = 0; s < tradeoff.settings.size(); ++s) {
      const auto& setting = tradeoff.settings[s];
      const auto& error = setting.errors[p].whole;
      table.row(std::string_view(tradeoff.products[p]), std::string_view(setting.name), error.value,
                error.ci95, setting.seconds, static_cast<std::int64_t>(std::llround(setting.bytes)),
                static_cast<std::int64_t>(front[s]));
    }
  }
  table.commit();
}

}  // namespace bedscope::report
