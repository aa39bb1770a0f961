// SPDX-License-Identifier: BSD-3-Clause
#include "report/validation_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
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
  const auto reference = reference_name(verdict);
  if (!reference.empty()) text += " against " + reference;
  return text;
}

/// Escaped, and without the control characters that no XML may hold.
std::string in_xml(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') c = '?';
  return escaped(text);
}

std::size_t count(std::span<const Verdict> verdicts, Outcome outcome) {
  return static_cast<std::size_t>(
      std::count_if(verdicts.begin(), verdicts.end(),
                    [&](const Verdict& verdict) { return verdict.outcome == outcome; }));
}

/// The whole story of a check: GitLab shows the text of an element and not its message.
std::string story_of(const Verdict& verdict) {
  std::string text = verdict.reason + "\n";
  for (const auto& note : verdict.notes) text += "note: " + note + "\n";
  for (const auto& assumption : verdict.assumptions) text += "assumed: " + assumption + "\n";
  return text;
}

/// A cell of a Markdown table: no line break, no bar, and nothing that is taken for a tag.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
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
      {"unit", verdict.metric.unit},
      {"verdict", name_of(verdict.outcome)},
      {"reason", verdict.reason},
      {"points", verdict.comparison.points.size()},
      {"points_outside", verdict.comparison.outside.size()},
      {"notes", verdict.notes},
      {"assumptions", verdict.assumptions}};
}

}  // namespace

std::vector<std::string> check_keys(std::span<const Verdict> verdicts) {
  std::map<std::string, int> seen;
  std::vector<std::string> keys;
  for (const auto& verdict : verdicts) {
    auto key = fmt::format("{}: {}", verdict.run, title_of(verdict));
    const int times = ++seen[key];
    keys.push_back(times > 1 ? fmt::format("{} ({})", key, times) : key);
  }
  return keys;
}

std::string junit_text(std::span<const Verdict> verdicts, const std::string& title) {
  const auto counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\"", verdicts.size(),
                  count(verdicts, Outcome::does_not_hold),
                  count(verdicts, Outcome::undecided) + count(verdicts, Outcome::skipped));
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{0}\" {1}>\n<testsuite "
      "name=\"{0}\" {1}>\n",
      in_xml(title), counts);
  const auto keys = check_keys(verdicts);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    const auto& verdict = verdicts[k];
    const auto name = keys[k].substr(verdict.run.size() + 2);  // the run is the class
    text +=
        fmt::format("<testcase classname=\"{}\" name=\"{}\">", in_xml(verdict.run), in_xml(name));
    const auto reason = in_xml(one_line(verdict.reason)), story = in_xml(story_of(verdict));
    if (verdict.outcome == Outcome::does_not_hold)
      text +=
          fmt::format("<failure message=\"{}\" type=\"does not hold\">{}</failure>", reason, story);
    if (verdict.outcome == Outcome::undecided || verdict.outcome == Outcome::skipped)
      text += fmt::format("<skipped message=\"{0}: {1}\">{0}: {2}</skipped>",
                          name_of(verdict.outcome), reason, story);
    if (verdict.outcome == Outcome::holds)
      text += fmt::format("<system-out>{}</system-out>", story);
    text += "</testcase>\n";
  }
  return text + "</testsuite>\n</testsuites>\n";
}

std::string markdown_text(std::span<const analysis::RunResult> runs,
                          std::span<const Verdict> verdicts, const std::string& title) {
  std::string text = fmt::format(
      "## {}\n\nChecks: {}, of which {} hold, {} do not hold, {} undecided, {} skipped\n\n"
      "| verdict | run | check | why |\n|---|---|---|---|\n",
      cell(title), verdicts.size(), count(verdicts, Outcome::holds),
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
  text += "\n";
  for (const auto& run : runs)
    for (const auto& problem : run.problems)
      text += fmt::format("- {}: {}\n", cell(run.label), cell(problem));
  return text;
}

std::string summary_with_checks(std::span<const analysis::RunResult> runs,
                                std::span<const Verdict> verdicts) {
  auto summary = Json::parse(analysis::summary_text(runs));
  const auto keys = check_keys(verdicts);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    summary["checks"].push_back(check_json(verdicts[k]));
    summary["checks"].back()["key"] = keys[k];
  }
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<EarlierVerdict> read_earlier(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown))  // a pipe would be waited for
    throw FileError("{}: no such file, expected a summary.json", path.string());
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
