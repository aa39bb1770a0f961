// SPDX-License-Identifier: BSD-3-Clause
#include "report/validation_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/summary.hpp"
#include "readers/error.hpp"
#include "report/html.hpp"

namespace bedscope::report {

using Json = nlohmann::ordered_json;
using validation::Outcome;
using validation::Verdict;

namespace {

std::string title_of(const Verdict& verdict) {
  std::string text = verdict.check.place.quantity;
  for (const auto& [key, value] : verdict.check.place.at) text += fmt::format(" {}={}", key, value);
  if (verdict.check.place.species != "all") text += " of " + verdict.check.place.species;
  text += ": " + verdict.check.metric;
  if (!verdict.reference.name.empty()) text += " against " + verdict.reference.name;
  return text;
}

std::size_t count(std::span<const Verdict> verdicts, Outcome outcome) {
  return static_cast<std::size_t>(
      std::count_if(verdicts.begin(), verdicts.end(),
                    [&](const Verdict& verdict) { return verdict.outcome == outcome; }));
}

std::string assumed(const Verdict& verdict) {
  std::string text;
  for (const auto& assumption : verdict.assumptions) text += "assumed: " + assumption + "\n";
  return text;
}

/// A cell of a Markdown table: no line break, no bar.
std::string cell(std::string text) {
  for (auto& c : text)
    if (c == '\n') c = ' ';
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

Json place_json(const Verdict& verdict) {
  Json at = Json::object();
  for (const auto& [key, value] : verdict.check.place.at) at[key] = value;
  return at;
}

Json check_json(const Verdict& verdict) {
  const bool skipped = verdict.outcome == Outcome::skipped;
  const auto number = [&](double value) {
    return skipped || !std::isfinite(value) ? Json(nullptr) : Json(value);
  };
  return {
      {"quantity", verdict.check.place.quantity},
      {"at", place_json(verdict)},
      {"species", verdict.check.place.species},
      {"run", verdict.run},
      {"against", verdict.check.number ? Json(*verdict.check.number) : Json(verdict.check.against)},
      {"metric", verdict.check.metric},
      {"value", number(verdict.metric.value)},
      {"lo", number(verdict.metric.lo)},
      {"hi", number(verdict.metric.hi)},
      {"limit", verdict.limit},
      {"verdict", name_of(verdict.outcome)},
      {"reason", verdict.reason},
      {"points", verdict.comparison.points.size()},
      {"points_outside", verdict.comparison.outside.size()},
      {"assumptions", verdict.assumptions}};
}

}  // namespace

std::string check_key(const Verdict& verdict) { return verdict.run + ": " + title_of(verdict); }

std::string junit_text(std::span<const Verdict> verdicts, const std::string& title) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{0}\">\n<testsuite "
      "name=\"{0}\" tests=\"{1}\" failures=\"{2}\" errors=\"0\" skipped=\"{3}\">\n",
      escaped(title), verdicts.size(), count(verdicts, Outcome::does_not_hold),
      count(verdicts, Outcome::undecided) + count(verdicts, Outcome::skipped));
  for (const auto& verdict : verdicts) {
    text += fmt::format("<testcase classname=\"{}\" name=\"{}\">", escaped(verdict.run),
                        escaped(title_of(verdict)));
    if (verdict.outcome == Outcome::does_not_hold)
      text += fmt::format("<failure message=\"{}\" type=\"does not hold\">{}</failure>",
                          escaped(verdict.reason), escaped(assumed(verdict)));
    if (verdict.outcome == Outcome::undecided || verdict.outcome == Outcome::skipped)
      text += fmt::format("<skipped message=\"{}: {}\"/>", name_of(verdict.outcome),
                          escaped(verdict.reason));
    if (verdict.outcome == Outcome::holds)
      text += fmt::format("<system-out>{}\n{}</system-out>", escaped(verdict.reason),
                          escaped(assumed(verdict)));
    text += "</testcase>\n";
  }
  return text + "</testsuite>\n</testsuites>\n";
}

std::string markdown_text(std::span<const Verdict> verdicts, const std::string& title) {
  std::string text = fmt::format(
      "## {}\n\n{} checks: {} hold, {} do not hold, {} undecided, {} skipped\n\n"
      "| verdict | run | check | why |\n|---|---|---|---|\n",
      title, verdicts.size(), count(verdicts, Outcome::holds),
      count(verdicts, Outcome::does_not_hold), count(verdicts, Outcome::undecided),
      count(verdicts, Outcome::skipped));
  for (const auto outcome :
       {Outcome::does_not_hold, Outcome::undecided, Outcome::skipped, Outcome::holds})
    for (const auto& verdict : verdicts)
      if (verdict.outcome == outcome)
        text += fmt::format("| {} | {} | {} | {} |\n",
                            outcome == Outcome::holds ? std::string("holds")
                                                      : fmt::format("**{}**", name_of(outcome)),
                            cell(verdict.run), cell(title_of(verdict)), cell(verdict.reason));
  return text;
}

std::string summary_with_checks(std::span<const analysis::RunResult> runs,
                                std::span<const Verdict> verdicts) {
  auto summary = Json::parse(analysis::summary_text(runs));
  for (const auto& verdict : verdicts) {
    summary["checks"].push_back(check_json(verdict));
    summary["checks"].back()["key"] = check_key(verdict);
  }
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<EarlierVerdict> read_earlier(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown))  // a pipe would be waited for
    throw FileError("{}: no such file", path.string());
  std::ifstream file(path);
  if (!file) throw FileError("{}: cannot be read", path.string());
  std::vector<EarlierVerdict> earlier;
  try {
    const auto summary = Json::parse(file);
    for (const auto& check : summary.at("checks"))
      earlier.push_back({check.at("key"), check.at("verdict"),
                         check.at("value").is_number() ? check.at("value").get<double>() : NAN});
  } catch (const Json::exception&) {
    throw FormatError("{}: expected a summary.json of bedscope validate", path.string());
  }
  return earlier;
}

}  // namespace bedscope::report
