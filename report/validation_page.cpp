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
using validation::in_digits;
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
    text += fmt::format(", {} {}{}", key, value, unit_of_place(key));
  if (verdict.check.place.species != "all") text += ", " + verdict.check.place.species;
  return text;
}

/// A figure and the verdicts that it shows, by number.
struct Shown {
  std::vector<std::size_t> verdicts;
  Figure figure;
};

std::vector<Shown> panels_of(std::span<const Verdict> verdicts) {
  std::vector<Shown> panels;
  const auto same = [](const Verdict& a, const Verdict& b) {
    return same_comparison(a, b) && a.comparison.points.empty() == b.comparison.points.empty();
  };
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    const auto panel = std::find_if(panels.begin(), panels.end(), [&](const Shown& shown) {
      return same(verdicts[shown.verdicts.front()], verdicts[k]);
    });
    if (panel != panels.end()) {
      panel->verdicts.push_back(k);
      continue;
    }
    panels.push_back(
        {{k}, check_figure(verdicts[k], fmt::format("check_{:02}", panels.size() + 1))});
  }
  return panels;
}

std::string history_of(const Verdict& verdict, const std::string& key,
                       const ValidationReport& report) {
  const auto before = std::find_if(report.earlier.begin(), report.earlier.end(),
                                   [&](const EarlierVerdict& e) { return e.key == key; });
  if (before == report.earlier.end()) return "new";
  auto text = escaped(before->outcome);
  if (before->outcome != name_of(verdict.outcome)) text = "<b>" + text + "</b>";
  if (!std::isfinite(before->value)) return text;
  return fmt::format("{} ({})", text, number(before->value, 3));
}

/// What the style sheet of all pages leaves to this one: a table of words that fits on paper.
constexpr std::string_view own_style = R"(<style>
  h1, h2, p, li, pre { overflow-wrap: anywhere; }
  .checks td, .checks th { text-align: left; white-space: normal; overflow-wrap: anywhere; min-width: 0; }
  .checks thead th { overflow-wrap: normal; }
  .checks .run { min-width: 4.5rem; }
  .checks tbody th { min-width: 5.5rem; overflow-wrap: break-word; }
  .checks .against { min-width: 6rem; }
  .checks .number, .checks th:first-child { white-space: nowrap; }
  .checks .metric, .checks .before { overflow-wrap: normal; }
  section p { margin: .2rem 0; }
  section .note { font-size: .82rem; }
  @media print {
    .wide { overflow: visible; }
    .checks { font-size: 8pt; }
    h2 { font-size: 11pt; margin: 1rem 0 .2rem; }
    section, figcaption { font-size: 9pt; }
    section .note, figcaption { font-size: 7.5pt; line-height: 1.3; margin: 0; }
    figure img { max-height: 74mm; width: auto !important; }
    #origins { break-inside: auto; }
    pre { columns: 2; }
  }
</style>
)";

/// The name of a curve, which may be broken between its parts and not within them.
std::string breakable(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == '?' || c == '_') text += "<wbr>";
    text += c;
    if (c == '/') text += "<wbr>";
  }
  return text;
}

std::string table_of(const ValidationReport& report) {
  std::string table =
      "<div class=\"wide\"><table class=\"checks\">\n<thead><tr><th scope=\"col\">Verdict</th><th>"
      "Check</th><th>Run</th><th>Against</th><th>Metric</th><th>Value</th><th>95 % "
      "interval</th><th>"
      "Limit</th>";
  if (!report.earlier_name.empty()) table += "<th>Before</th>";
  table += "</tr></thead>\n<tbody>\n";
  const auto keys = check_keys(report.verdicts);
  for (std::size_t k = 0; k < report.verdicts.size(); ++k) {
    const auto& v = report.verdicts[k];
    const bool has_value = v.outcome != Outcome::skipped && std::isfinite(v.metric.value);
    const int digits = digits_of(v);
    table += fmt::format(
        "<tr><td>{}</td><th scope=\"row\"><a href=\"#check{}\">{}</a></th><td "
        "class=\"run\">{}</td><td class=\"against\">{}</td>"
        "<td class=\"metric\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td class=\"number\">{} {}{}</td>",
        badge(v.outcome), k + 1, escaped(where(v)), escaped(v.run),
        breakable(escaped(reference_name(v).empty() ? "–" : reference_name(v))),
        escaped(v.check.metric), has_value ? in_digits(v.metric.value, digits) : "–",
        has_value ? fmt::format("{} to {}", in_digits(v.metric.lo, digits),
                                in_digits(v.metric.hi, digits))
                  : "–",
        v.small_is_good ? "≤" : "≥", in_digits(v.limit, digits), escaped(unit_text(v.metric)));
    if (!report.earlier_name.empty())
      table += "<td class=\"before\">" + history_of(v, keys[k], report) + "</td>";
    table += "</tr>\n";
  }
  return table + "</tbody></table></div>\n";
}

/// What the analysis has to say of the runs themselves: drift, too few samples, what was left out.
std::string problems_of(std::span<const analysis::RunResult> runs) {
  std::string list;
  for (const auto& run : runs)
    for (const auto& problem : run.problems)
      list += fmt::format("<li>{}: {}</li>\n", escaped(run.label), escaped(problem));
  if (list.empty()) return list;
  return "<div class=\"problems\"><p>The runs</p><ul>\n" + list + "</ul></div>\n";
}

std::string counts_of(std::span<const Verdict> verdicts) {
  std::string text =
      fmt::format("<p>{} check{}:", verdicts.size(), verdicts.size() == 1 ? "" : "s");
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
  add(about.kind.empty() || about.method.empty() ? about.kind + about.method
                                                 : about.kind + ", " + about.method);
  add(about.source);
  add(about.processing);
  return text;
}

/// A value and the half-width of its 95 % interval.
std::string with_interval(double value, double u, const std::string& unit) {
  const auto text = u > 0 ? fmt::format("{} ± {}", in_digits(value, 4), in_digits(1.96 * u, 2))
                          : in_digits(value, 4);
  return unit == "-" ? text : text + " " + unit;
}

std::string picture_of(const Figure& figure, const fs::path& folder) {
  return fmt::format(
      "<figure><img alt=\"{}\" style=\"width:{:.0f}mm\" src=\"{}\">\n<figcaption>{}</figcaption>"
      "</figure>\n",
      escaped(figure.title), figure.width, picture(figure, folder, false), escaped(figure.caption));
}

/// One comparison, drawn once, with all the checks made on it.
std::string section_of(const ValidationReport& report, const Shown& panel, const fs::path& folder) {
  const auto reference = reference_name(report.verdicts[panel.verdicts.front()]);
  std::string text = "<section>\n<h2>" + escaped(panel.figure.title) +
                     (reference.empty() ? "" : " against " + escaped(reference)) + "</h2>\n";
  std::set<std::string> notes, assumptions;
  for (const std::size_t k : panel.verdicts) {
    const auto& verdict = report.verdicts[k];
    text += fmt::format("<p id=\"check{}\">{}: {}.</p>\n", k + 1, badge(verdict.outcome),
                        escaped(verdict.reason));
    notes.insert(verdict.notes.begin(), verdict.notes.end());
    assumptions.insert(verdict.assumptions.begin(), verdict.assumptions.end());
  }
  const auto& first = report.verdicts[panel.verdicts.front()];
  if (first.result.is_scalar && !first.comparison.points.empty()) {
    const auto& point = first.comparison.points.front();
    text += fmt::format(
        "<p>Result {}, reference {}.</p>\n",
        escaped(with_interval(point.result, point.u_result, first.result.y.unit)),
        escaped(with_interval(point.reference, point.u_reference, first.result.y.unit)));
  }
  if (panel.figure.missing.empty()) text += picture_of(panel.figure, folder);
  for (const auto& note : notes) text += "<p class=\"note\">Note: " + escaped(note) + ".</p>\n";
  for (const auto& assumption : assumptions)
    text += "<p class=\"note\">Assumed: " + escaped(assumption) + ".</p>\n";
  return text + "</section>\n";
}

/// Each reference once: where it comes from and what its source warns of.
std::string references_of(const ValidationReport& report) {
  std::string text;
  std::set<std::string> seen;
  for (const auto& verdict : report.verdicts) {
    const auto& curve = verdict.reference;
    const auto source = provenance_of(curve);
    if (source.empty() || !seen.insert(curve.name).second) continue;
    text +=
        fmt::format("<p class=\"note\"><b>{}</b>: {}.</p>\n", escaped(curve.name), escaped(source));
    for (const auto& caveat : curve.about.caveats)
      text += "<p class=\"note\">Caveat: " + escaped(caveat) + ".</p>\n";
  }
  return text.empty() ? text : "<section>\n<h2>References</h2>\n" + text + "</section>\n";
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

/// "varas_2017/axial_holdup.csv": as people know it, wherever the folder lies.
std::string set_name(const fs::path& path) {
  return (path.parent_path().filename() / path.filename()).string();
}

std::string origins(const ValidationReport& report) {
  std::string text = fmt::format(
      "<section id=\"origins\">\n<h2>Where this comes from</h2>\n<p class=\"note\">bedscope "
      "{}, {}.</p>\n",
      BEDSCOPE_VERSION, escaped(machine()));
  std::set<std::string> curves;
  for (const auto& run : report.runs)
    text += fmt::format("<p class=\"note\">{}: {} file{}, hash {}.</p>\n", escaped(run.label),
                        run.inputs.size(), run.inputs.size() == 1 ? "" : "s",
                        analysis::fingerprint(run.inputs));
  for (const auto& verdict : report.verdicts)
    if (!verdict.reference.path.empty()) curves.insert(verdict.reference.path);
  for (const auto& path : curves)
    text += fmt::format("<p class=\"note\">{}: hash {}.</p>\n", escaped(set_name(path)),
                        analysis::fingerprint({path}));
  text += fmt::format("<p class=\"note\">{}: hash {}.</p>\n",
                      escaped(fs::path(report.study).filename().string()),
                      analysis::fingerprint({report.study}));
  return text + "<pre style=\"font-size:.75rem;white-space:pre-wrap\">" +
         escaped(text_of(report.study)) + "</pre>\n</section>\n";
}

}  // namespace

void write_validation_page(const ValidationReport& report, const fs::path& folder) {
  const auto panels = panels_of(report.verdicts);
  const auto groups = validation::families(report.verdicts);
  std::vector<Figure> all, drawn;
  for (std::size_t k = 0; k < groups.size(); ++k)
    all.push_back(family_figure(groups[k], fmt::format("quantity_{:02}", k + 1)));
  for (const auto& panel : panels) drawn.push_back(panel.figure);
  drawn.insert(drawn.end(), all.begin(), all.end());
  const auto pictures = folder / "checks";
  draw_figures(drawn, pictures, false);

  auto page = page_head(report.title);
  page += own_style;
  page += counts_of(report.verdicts) + table_of(report) + problems_of(report.runs);
  if (!report.earlier_name.empty())
    page += "<p class=\"note\">Before: " + escaped(report.earlier_name) + ".</p>\n";
  for (const auto& panel : panels) page += section_of(report, panel, pictures);
  for (const auto& figure : all) {
    if (!figure.missing.empty()) continue;
    page += "<section>\n<h2>" + escaped(figure.title) + "</h2>\n" + picture_of(figure, pictures) +
            "</section>\n";
  }
  page += references_of(report) + origins(report) + "</body>\n</html>\n";
  analysis::write_file(folder / "report.html", page);
}

}  // namespace bedscope::report
