// SPDX-License-Identifier: BSD-3-Clause
#include "report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "readers/error.hpp"

namespace bedscope::report {

namespace fs = std::filesystem;

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

std::string page_head(const std::string& title, int refresh_seconds) {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  if (refresh_seconds > 0)
    page += fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", refresh_seconds);
  return page +
         fmt::format("<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
                     escaped(title), style_sheet);
}

std::string picture(const Figure& figure, const fs::path& folder, bool png) {
  constexpr std::size_t large = 500'000;
  const std::string svg = content(folder / (figure.name + ".svg"));
  if (svg.size() > large && png) {
    const std::string dots = content(folder / (figure.name + ".png"));
    if (dots.size() < svg.size()) return "data:image/png;base64," + base64(dots);
  }
  return "data:image/svg+xml;base64," + base64(svg);
}

}  // namespace bedscope::report
