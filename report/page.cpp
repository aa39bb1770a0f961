// SPDX-License-Identifier: BSD-3-Clause
#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "analysis/output_file.hpp"
#include "readers/error.hpp"
#include "report/figures.hpp"
#include "report/style.hpp"

namespace bedscope::report {

namespace fs = std::filesystem;
using analysis::RunResult;

namespace {

constexpr std::string_view style_sheet = R"(
  :root { color-scheme: light; }
  body { margin: 2.5rem auto 4rem; padding: 0 1.5rem; max-width: 54rem; background: #fff; color: #1a1a1a;
         font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
  h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .3rem; }
  h2 { font-size: 1.15rem; margin: 2.5rem 0 .6rem; }
  a { color: #005a9c; }
  .note { color: #555; margin: 0; }
  .wide { overflow-x: auto; }
  table { border-collapse: collapse; font-size: .8rem; margin-top: 1.5rem; font-variant-numeric: tabular-nums; }
  th, td { padding: .3rem .55rem .3rem 0; text-align: right; vertical-align: top; }
  th:first-child { text-align: left; min-width: 8rem; overflow-wrap: break-word; }
  thead th { border-bottom: 1.5px solid #1a1a1a; font-weight: 600; vertical-align: bottom; line-height: 1.25; }
  tbody td, tbody th { border-bottom: 1px solid #ddd; }
  tbody th { font-weight: 600; }
  td { white-space: nowrap; }
  .unit { font-weight: 400; color: #555; white-space: nowrap; }
  .problems { border-left: 4px solid #d55e00; background: #fdf3ea; padding: .6rem 1rem; margin: 1.2rem 0; }
  .problems p { margin: 0; font-weight: 600; }
  .problems ul { margin: .2rem 0 0; padding-left: 1.2rem; overflow-wrap: anywhere; }
  figure { margin: 0; }
  figure img { display: block; max-width: 100%; height: auto; object-fit: contain; object-position: left top; }
  figcaption { font-size: .88rem; color: #333; margin-top: .5rem; max-width: 46rem; overflow-wrap: anywhere; }
  .files { font-size: .8rem; color: #555; white-space: nowrap; }
  @media print {
    @page { size: A4; margin: 15mm 18mm; }
    body { margin: 0; padding: 0; max-width: none; font-size: 10.5pt; }
    h2 { break-after: avoid; margin-top: 1.2rem; }
    section, tr { break-inside: avoid; }
    figure img { max-height: 225mm; }
    .files { display: none; }
    a { color: inherit; text-decoration: none; }
  }
)";

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (j < left ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += j <= left ? digits[group >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw FileError("{}: expected the figure that gnuplot drew, found none", path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

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
  static constexpr std::array files{"results.h5",
                                    "summary.json",
                                    "tables/axial_profile.csv",
                                    "tables/lateral_profile.csv",
                                    "tables/inventory.csv",
                                    "tables/clusters.csv",
                                    "tables/cluster_occurrence.csv",
                                    "tables/bed_height.csv",
                                    "tables/bubbles.csv",
                                    "tables/bubble_profile.csv",
                                    "tables/fluctuation.csv",
                                    "tables/spectrum.csv",
                                    "tables/temperature.csv",
                                    "tables/temperature_pdf.csv",
                                    "tables/gas_axial.csv",
                                    "tables/gas_lateral.csv",
                                    "tables/voidage_check.csv",
                                    "tables/pressure_drop.csv"};
  std::string links = "<p class=\"note\">Data: ";
  for (const char* file : files) {
    std::error_code missing;
    if (!fs::exists(folder / file, missing)) continue;
    const std::string name = fs::path(file).filename().string();
    links += fmt::format("<a href=\"{}\">{}</a>, ", file, name);
  }
  return links +
         "folders <a href=\"tables/\">tables/</a> and <a href=\"figures/\">figures/</a></p>\n";
}

/// A figure as a data URI: a picture of its own rather than SVG in the page, as the names inside
/// would clash. A figure of very many marks is smaller as PNG.
std::string picture(const Figure& figure, const fs::path& folder, bool png) {
  constexpr std::size_t large = 500'000;
  const std::string svg = content(folder / "figures" / (figure.name + ".svg"));
  if (svg.size() > large && png) {
    const std::string dots = content(folder / "figures" / (figure.name + ".png"));
    if (dots.size() < svg.size()) return "data:image/png;base64," + base64(dots);
  }
  return "data:image/svg+xml;base64," + base64(svg);
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
                    escaped(figure.title), figure.width, picture(figure, folder, png),
                    escaped(figure.caption), links);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

void write_report(std::span<const RunResult> runs, const std::string& title, const fs::path& folder,
                  const ReportOptions& options) {
  if (runs.empty()) throw InputError("report: expected one run or more, found none");
  const std::vector<Figure> figures = make_figures(runs);
  draw_figures(figures, folder / "figures", options.png);

  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  if (options.refresh_seconds > 0) {
    page += fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", options.refresh_seconds);
  }
  page += fmt::format("<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
                      escaped(title), style_sheet);
  page += link_list(folder) + run_table(runs) + problem_list(runs);
  for (const Figure& figure : figures) page += figure_section(figure, folder, options.png);
  page += "</body>\n</html>\n";
  analysis::write_file(folder / "index.html", page);
}

}  // namespace bedscope::report
