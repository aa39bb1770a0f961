// SPDX-License-Identifier: BSD-3-Clause
#include "report/validation_page.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "analysis/output_file.hpp"
#include "analysis/summary.hpp"
#include "readers/error.hpp"
#include "report/check_figures.hpp"
#include "report/html.hpp"
#include "report/style.hpp"

namespace bedscope::report {

namespace fs = std::filesystem;
using validation::Outcome;
using validation::Verdict;

namespace {

// Words carry the verdict; the colours (Okabe and Ito) only support them.
std::string badge(Outcome outcome) {
  const char* colour = outcome == Outcome::holds           ? "#007a5a"
                       : outcome == Outcome::does_not_hold ? "#b03a00"
                                                           : "#6b6b6b";
  return fmt::format("<b style=\"color:{};white-space:nowrap\">{}</b>", colour, name_of(outcome));
}

std::string where(const Verdict& verdict) {
  std::string text = verdict.check.place.quantity;
  for (const auto& [key, value] : verdict.check.place.at)
    text += fmt::format(", {} {}", key, value);
  if (verdict.check.place.species != "all") text += ", " + verdict.check.place.species;
  return text;
}

std::string history_of(const Verdict& verdict, const ValidationReport& report) {
  const auto key = check_key(verdict);
  const auto before = std::find_if(report.earlier.begin(), report.earlier.end(),
                                   [&](const EarlierVerdict& e) { return e.key == key; });
  if (before == report.earlier.end()) return "new";
  if (!std::isfinite(before->value)) return before->outcome;
  return fmt::format("{} ({})", before->outcome, number(before->value, 3));
}

std::string table_of(const ValidationReport& report) {
  std::string table =
      "<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Check</th><th>Run</th><th>Against"
      "</th><th>Metric</th><th>Value</th><th>95 % interval</th><th>Limit</th><th>Verdict</th>";
  if (!report.earlier_name.empty()) table += "<th>Before</th>";
  table += "</tr></thead>\n<tbody>\n";
  for (std::size_t k = 0; k < report.verdicts.size(); ++k) {
    const auto& v = report.verdicts[k];
    const bool skipped = v.outcome == Outcome::skipped;
    table += fmt::format(
        "<tr><th scope=\"row\"><a href=\"#check{}\">{}</a></th><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td><td>{} {}</td><td>{}</td>",
        k + 1, escaped(where(v)), escaped(v.run),
        escaped(v.reference.name.empty() ? "–" : v.reference.name), escaped(v.check.metric),
        skipped ? "–" : number(v.metric.value, 3),
        skipped ? "–" : fmt::format("{} – {}", number(v.metric.lo, 3), number(v.metric.hi, 3)),
        v.small_is_good ? "≤" : "≥", number(v.limit, 3), badge(v.outcome));
    if (!report.earlier_name.empty()) table += "<td>" + escaped(history_of(v, report)) + "</td>";
    table += "</tr>\n";
  }
  return table + "</tbody></table></div>\n";
}

std::string counts_of(std::span<const Verdict> verdicts) {
  std::string text = fmt::format("<p>{} checks:", verdicts.size());
  for (const auto outcome :
       {Outcome::holds, Outcome::does_not_hold, Outcome::undecided, Outcome::skipped}) {
    const auto n = std::count_if(verdicts.begin(), verdicts.end(),
                                 [&](const Verdict& v) { return v.outcome == outcome; });
    if (n > 0) text += fmt::format(" {} {},", n, badge(outcome));
  }
  text.pop_back();
  return text + ".</p>\n";
}

std::string provenance_of(const validation::Curve& curve) {
  const auto& about = curve.about;
  std::string text;
  const auto add = [&](const std::string& words) {
    if (!words.empty()) text += (text.empty() ? "" : ". ") + words;
  };
  add(about.citation);
  add(about.doi.empty() ? "" : "doi " + about.doi);
  add(about.method.empty() ? about.kind : about.kind + ", " + about.method);
  add(about.source);
  add(about.processing);
  return text;
}

std::string section_of(const Verdict& verdict, const Figure& figure, std::size_t k,
                       const fs::path& folder) {
  std::string text =
      fmt::format("<section id=\"check{}\">\n<h2>{}</h2>\n<p>{}: {}.</p>\n", k + 1,
                  escaped(figure.title), badge(verdict.outcome), escaped(verdict.reason));
  if (figure.missing.empty())
    text += fmt::format(
        "<figure><img alt=\"{}\" style=\"width:{:.0f}mm\" src=\"{}\">\n<figcaption>{}</figcaption>"
        "</figure>\n",
        escaped(figure.title), figure.width, picture(figure, folder, false),
        escaped(figure.caption));
  if (const auto source = provenance_of(verdict.reference); !source.empty())
    text += "<p class=\"note\">Reference: " + escaped(source) + ".</p>\n";
  for (const auto& assumption : verdict.assumptions)
    text += "<p class=\"note\">Assumed: " + escaped(assumption) + ".</p>\n";
  for (const auto& caveat : verdict.reference.about.caveats)
    text += "<p class=\"note\">Caveat of the source: " + escaped(caveat) + ".</p>\n";
  return text + "</section>\n";
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string machine() {
  utsname name{};
  if (::uname(&name) != 0) return "unknown";
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

std::string origins(const ValidationReport& report) {
  std::string text = fmt::format(
      "<section id=\"origins\">\n<h2>Where this comes from</h2>\n<p class=\"note\">bedscope "
      "{}, {}.</p>\n",
      BEDSCOPE_VERSION, escaped(machine()));
  std::set<std::string> curves;
  for (const auto& run : report.runs)
    text += fmt::format("<p class=\"note\">{}: {} files, hash {}.</p>\n", escaped(run.label),
                        run.inputs.size(), analysis::fingerprint(run.inputs));
  for (const auto& verdict : report.verdicts)
    if (!verdict.reference.path.empty()) curves.insert(verdict.reference.path);
  for (const auto& path : curves)
    text += fmt::format("<p class=\"note\">{}: hash {}.</p>\n",
                        escaped(fs::path(path).filename().string()), analysis::fingerprint({path}));
  return text + "<pre style=\"font-size:.75rem;white-space:pre-wrap\">" +
         escaped(text_of(report.study)) + "</pre>\n</section>\n";
}

}  // namespace

void write_validation_page(const ValidationReport& report, const fs::path& folder) {
  std::vector<Figure> checks, all;
  for (std::size_t k = 0; k < report.verdicts.size(); ++k)
    checks.push_back(check_figure(report.verdicts[k], fmt::format("check_{:02}", k + 1)));
  const auto groups = validation::families(report.verdicts);
  for (std::size_t k = 0; k < groups.size(); ++k)
    all.push_back(family_figure(groups[k], fmt::format("quantity_{:02}", k + 1)));
  std::vector<Figure> drawn = checks;
  drawn.insert(drawn.end(), all.begin(), all.end());
  const auto pictures = folder / "checks";
  draw_figures(drawn, pictures, false);

  auto page = page_head(report.title);
  page += counts_of(report.verdicts) + table_of(report);
  if (!report.earlier_name.empty())
    page += "<p class=\"note\">Before: " + escaped(report.earlier_name) + ".</p>\n";
  for (std::size_t k = 0; k < checks.size(); ++k)
    page += section_of(report.verdicts[k], checks[k], k, pictures);
  for (const auto& figure : all) {
    if (!figure.missing.empty()) continue;
    page += fmt::format(
        "<section>\n<h2>{0}</h2>\n<figure><img alt=\"{0}\" style=\"width:{1:.0f}mm\" src=\"{2}\">\n"
        "<figcaption>{3}</figcaption></figure>\n</section>\n",
        escaped(figure.title), figure.width, picture(figure, pictures, false),
        escaped(figure.caption));
  }
  page += origins(report) + "</body>\n</html>\n";
  analysis::write_file(folder / "report.html", page);
}

}  // namespace bedscope::report
