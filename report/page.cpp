// SPDX-License-Identifier: BSD-3-Clause
#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/output_file.hpp"
#include "readers/error.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/style.hpp"

namespace bedscope::report {

namespace fs = std::filesystem;
using analysis::RunResult;

namespace {

std::string run_row(const RunResult& run, const Unit& mass) {
  const std::string unit = run.time_known ? " s" : "";
  const std::string cells[] = {
      std::to_string(run.window.snapshots),
      fmt::format("{}{} – {}{}", run.time_known ? "" : "step ", number(run.window.from, 10),
                  number(run.window.to, 10), unit),
      plus_minus(run.mean_holdup),
      run.density_known ? plus_minus(run.inventory_mass, mass.factor) : "no density",
      plus_minus(run.mean_occurrence),
      number(run.independent_samples, 3),
      std::isnan(run.outside_fraction) ? "–" : number(100 * run.outside_fraction, 2) + " %"};
  std::string row = "<tr><th scope=\"row\">" + escaped(run.label) + "</th>";
  for (const std::string& cell : cells) row += "<td>" + escaped(cell) + "</td>";
  return row + "</tr>\n";
}

std::string run_table(std::span<const RunResult> runs) {
  double most = 0;
  bool assumed = false;
  for (const RunResult& run : runs) {
    if (std::isfinite(run.inventory_mass.value)) most = std::max(most, run.inventory_mass.value);
    assumed |= run.domain_assumed;
  }
  const Unit mass = mass_unit(most);
  std::string table = fmt::format(
      "<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Run</th><th "
      "scope=\"col\">Snapshots "
      "averaged</th><th scope=\"col\">Window</th><th scope=\"col\">Mean holdup{} <span "
      "class=\"unit\">[-]</span></th><th scope=\"col\">Inventory <span "
      "class=\"unit\">[{}]</span></th>"
      "<th scope=\"col\">Clusters <span class=\"unit\">[per snapshot]</span></th><th scope=\"col\">"
      "Independent samples</th><th scope=\"col\">Outside the domain</th></tr></thead>\n<tbody>\n",
      assumed ? ", domain assumed" : "", mass.name);
  for (const RunResult& run : runs) table += run_row(run, mass);
  return table +
         "</tbody></table></div>\n<p class=\"note\">± is the half-width of the 95 % confidence "
         "interval "
         "of the mean. Independent samples are those of the mean holdup; outside the domain: share "
         "of the "
         "solids volume.</p>\n";
}

std::string problem_list(std::span<const RunResult> runs) {
  std::string list;
  for (const RunResult& run : runs) {
    std::vector<std::string> problems = run.problems;
    const auto add = [&](bool wrong, std::string_view word, const char* text) {
      const auto said = [&](const std::string& one) { return one.find(word) != std::string::npos; };
      if (wrong && std::none_of(problems.begin(), problems.end(), said))
        problems.emplace_back(text);
    };
    add(run.domain_assumed, "domain", "domain assumed: every holdup depends on the dump’s box");
    add(!run.window.steady, "steady", "no steady part was found");
    add(!run.time_known, "time", "no time step is known: times are steps");
    for (const std::string& problem : problems) {
      list += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(run.label), escaped(problem));
    }
  }
  if (list.empty()) return "";
  return "<div class=\"problems\"><p>Problems</p><ul>\n" + list + "</ul></div>\n";
}

std::string link_list(const fs::path& folder) {
  std::set<std::string> tables;
  std::error_code missing;
  for (fs::directory_iterator item(folder / "tables", missing), end; !missing && item != end;
       item.increment(missing))
    if (item->path().extension() == ".csv")
      tables.insert("tables/" + item->path().filename().string());
  std::vector<std::string> files{"results.h5", "summary.json"};
  files.insert(files.end(), tables.begin(), tables.end());
  std::string links = "<p class=\"note\">Data: ";
  for (const std::string& file : files) {
    if (!fs::exists(folder / file, missing)) continue;
    links += fmt::format("<a href=\"{}\">{}</a>, ", escaped(file),
                         escaped(fs::path(file).filename().string()));
  }
  return links +
         "folders <a href=\"tables/\">tables/</a> and <a href=\"figures/\">figures/</a></p>\n";
}

std::string figure_section(const Figure& figure, const fs::path& folder, bool png) {
  std::string text =
      fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", figure.name, escaped(figure.title));
  if (!figure.missing.empty()) {
    return text + "<p class=\"note\">No figure: " + escaped(figure.missing) + ".</p>\n</section>\n";
  }
  std::string links;
  for (const std::string ending : {"svg", "png", "gp", "dat"}) {
    if (ending == "png" && !png) continue;
    links += fmt::format(" <a href=\"figures/{}.{}\">{}</a>", figure.name, ending, ending);
  }
  return text + fmt::format(
                    "<figure><img alt=\"{}\" style=\"width:{:.0f}mm\" src=\"{}\">\n<figcaption>{} "
                    "<span class=\"files\">[{} ]</span></figcaption></figure>\n</section>\n",
                    escaped(figure.title), figure.width, picture(figure, folder / "figures", png),
                    escaped(figure.caption), links);
}

}  // namespace

void write_report(std::span<const RunResult> runs, const std::string& title, const fs::path& folder,
                  const ReportOptions& options) {
  if (runs.empty()) throw InputError("report: expected one run or more, found none");
  const std::vector<Figure> figures = make_figures(runs);
  draw_figures(figures, folder / "figures", options.png);

  std::string page = page_head(title, options.refresh_seconds);
  page += link_list(folder) + run_table(runs) + problem_list(runs);
  for (const Figure& figure : figures) page += figure_section(figure, folder, options.png);
  page += "</body>\n</html>\n";
  analysis::write_file(folder / "index.html", page);
}

}  // namespace bedscope::report
