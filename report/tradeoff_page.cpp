// SPDX-License-Identifier: BSD-3-Clause
#include "report/tradeoff_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "analysis/output_file.hpp"
#include "report/html.hpp"
#include "report/style.hpp"
#include "report/tradeoff_figures.hpp"
#include "report/tradeoff_table.hpp"

namespace bedscope::report {

namespace fs = std::filesystem;

namespace {

std::string paragraph(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return "<p>" + escaped(text) + ".</p>\n";
}

/// What the choice made on the first half promised, and what it kept.
std::string promise_table(const TradeoffReport& report) {
  const auto& tradeoff = report.tradeoff;
  const auto& chosen = tradeoff.settings[report.recommendation.chosen];
  std::string table =
      "<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Product</th><th>Error, first "
      "half</th><th>Error, second half</th><th>Promise</th><th>Error, whole window</th><th>The "
      "window’s own interval</th></tr></thead>\n<tbody>\n";
  for (std::size_t p = 0; p < tradeoff.products.size(); ++p) {
    const auto& error = chosen.errors[p];
    const bool required =
        std::find(tradeoff.required.begin(), tradeoff.required.end(), p) != tradeoff.required.end();
    const std::size_t only[] = {p};
    const bool kept = validation::kept_promise(tradeoff, report.recommendation.chosen, only);
    table += fmt::format(
        "<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        tradeoff_figure(report, p).name, escaped(tradeoff.products[p]), percent(error.first),
        percent(error.second),
        !required ? "none given"
        : kept    ? "kept"
                  : "<b>not kept</b>",
        percent(error.whole),
        std::isfinite(tradeoff.noise[p]) ? "± " + percent(tradeoff.noise[p]) : "–");
  }
  return table +
         fmt::format(
             "</tbody></table></div>\n<p class=\"note\">Of the choice made on the first half, "
             "{}. ± is the half-width of the 95 % interval.</p>\n",
             escaped(chosen.name));
}

std::string front_table(const TradeoffReport& report, std::size_t p) {
  const auto& tradeoff = report.tradeoff;
  const auto front = tradeoff.front(p);
  std::vector<const validation::Setting*> on_front;
  for (std::size_t s = 0; s < front.size(); ++s)
    if (front[s]) on_front.push_back(&tradeoff.settings[s]);
  std::sort(on_front.begin(), on_front.end(),
            [](const auto* a, const auto* b) { return a->seconds < b->seconds; });
  std::string table =
      "<details><summary>The Pareto front</summary>\n<div class=\"wide\"><table>\n<thead><tr><th "
      "scope=\"col\">Setting</th><th>Error</th><th>CPU time <span class=\"unit\">[s]</span></th>"
      "<th>Read <span class=\"unit\">[MB]</span></th></tr></thead>\n<tbody>\n";
  for (const auto* setting : on_front)
    table += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                         escaped(setting->name), percent(setting->errors[p].whole),
                         number(setting->seconds, 3), number(1e-6 * setting->bytes, 3));
  return table + "</tbody></table></div></details>\n";
}

std::string problems_of(const TradeoffReport& report) {
  std::string list;
  for (const auto& problem : report.problems) list += "<li>" + escaped(problem) + "</li>\n";
  for (const auto& run : report.runs)
    for (const auto& problem : run.problems)
      list += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(run.label), escaped(problem));
  if (list.empty()) return "";
  return "<div class=\"problems\"><p>Problems</p><ul>\n" + list + "</ul></div>\n";
}

}  // namespace

void write_tradeoff(const TradeoffReport& report, const fs::path& folder) {
  write_tradeoff_table(report, folder / "tables" / "tradeoff.csv");
  analysis::write_file(folder / "summary.json", tradeoff_summary(report));
  std::vector<Figure> figures;
  for (std::size_t p = 0; p < report.tradeoff.products.size(); ++p)
    figures.push_back(tradeoff_figure(report, p));
  draw_figures(figures, folder / "figures", true);

  auto page = page_head(report.title + ": accuracy against cost");
  page +=
      "<p class=\"note\">Data: <a href=\"recommended.toml\">recommended.toml</a>, <a "
      "href=\"tables/tradeoff.csv\">tradeoff.csv</a>, <a href=\"summary.json\">summary.json</a>, "
      "<a href=\"figures/\">figures/</a></p>\n";
  for (const auto& sentence : recommendation_sentences(report)) page += paragraph(sentence);
  page += promise_table(report) + problems_of(report);
  for (std::size_t p = 0; p < figures.size(); ++p)
    page += fmt::format(
                "<section id=\"{0}\">\n<h2>{1}</h2>\n{2}<figure><img alt=\"{1}\" "
                "style=\"width:{3:.0f}mm\" src=\"{4}\">\n<figcaption>{5}</figcaption></figure>\n",
                figures[p].name, escaped(figures[p].title), paragraph(product_sentence(report, p)),
                figures[p].width, picture(figures[p], folder / "figures", true),
                escaped(figures[p].caption)) +
            front_table(report, p) + "</section>\n";
  analysis::write_file(folder / "index.html", page + "</body>\n</html>\n");
}

}  // namespace bedscope::report
