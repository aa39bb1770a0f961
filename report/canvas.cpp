// SPDX-License-Identifier: BSD-3-Clause
#include "report/canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bedscope::report {
namespace {

constexpr double px_per_mm = 96 / 25.4;        // an SVG's px is a CSS px
constexpr double png_scale = 300.0 / 96;       // PNG at 300 dpi
constexpr double line_height = 4.2;            // of a legend's row [mm]
constexpr double sample_width = 8, gap = 1.5;  // of a legend's entry [mm]

double sample_room(const LegendEntry& entry) {
  return entry.line.empty() && entry.marker.empty() ? 0 : sample_width + gap;
}

double entry_width(const LegendEntry& entry) {
  return sample_room(entry) + text_width(entry.label) + 4;
}

/// Entries of equal width, as many as fit side by side.
std::size_t legend_columns(std::span<const LegendEntry> entries, double width) {
  double widest = 1;
  for (const LegendEntry& entry : entries) widest = std::max(widest, entry_width(entry));
  const auto fit = static_cast<std::size_t>(std::max(1.0, std::floor(width / widest)));
  return std::min(fit, std::max<std::size_t>(entries.size(), 1));
}

std::string palette(std::span<const std::string> stops) {
  std::string text = "set palette defined (";
  for (std::size_t i = 0; i < stops.size(); ++i) {
    text += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, stops[i]);
  }
  return text + ")";
}

/// In single quotes nothing but the quote itself means anything to gnuplot. It writes a '>' into an
/// SVG as it is, where "]]>" must not stand: an invisible space breaks it.
std::string constant(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    if (c == '>' && result.ends_with("]]")) result += "\u200B";
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return result + "'";
}

/// A word as it is written: what gnuplot's enhanced text takes for markup is escaped.
std::string plain(std::string_view word) {
  std::string text;
  for (const char c : word) {
    if (std::string_view("\\{}^_@&~").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

/// Braces where there is more than one letter behind the `_`.
std::string subscript(std::string_view part) {
  return part.size() > 2 ? fmt::format("_{{{}}}", part.substr(1)) : std::string(part);
}

}  // namespace

std::string literal(std::string_view text) {
  static constexpr std::array<std::string_view, 11> symbols{"x", "z",   "t", "φ",     "v_z", "G_z",
                                                            "ε", "u_z", "p", "p_top", "T"};
  std::string result;
  for (bool first = true; !text.empty(); first = false) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    const bool symbol = std::find(symbols.begin(), symbols.end(), word) != symbols.end();
    const std::size_t letter = std::min(word.find('_'), word.size());
    if (!first) result += ' ';
    result += symbol ? fmt::format("{{/:Italic {}}}{}", word.substr(0, letter),
                                   subscript(word.substr(letter)))
                     : plain(word);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return constant(result);
}

std::size_t Canvas::block(std::string_view comment, std::string_view rows) {
  if (blocks_ > 0) data_ += "\n\n";
  std::string one_line(comment);
  std::replace_if(
      one_line.begin(), one_line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  while (rows.ends_with("\n\n")) rows.remove_suffix(1);  // more would begin a block of their own
  data_ += fmt::format("# {}: {}\n{}", blocks_, one_line, rows);
  return blocks_++;
}

std::string Canvas::text(std::string_view user_text) {
  const std::string value = constant(user_text);
  auto found = std::find(texts_.begin(), texts_.end(), value);
  if (found == texts_.end()) found = texts_.insert(texts_.end(), value);
  return fmt::format("text{}", found - texts_.begin() + 1);
}

std::string Canvas::screen(double x, double y) const {
  return fmt::format("screen {:.5f}, screen {:.5f}", x / width_, y / height_);
}

void Canvas::command(std::string_view line) { pending_.emplace_back(line); }

void Canvas::label(const std::string& expression, double x, double y, std::string_view words) {
  command(fmt::format("set label {} at {} {}", expression, screen(x, y), words));
}

void Canvas::axis(char name, const Axis& range, bool numbers, bool map) {
  if (range.logarithmic) body_ += fmt::format("  set logscale {0}; set m{0}tics 10\n", name);
  const std::string format = !numbers            ? ""
                             : range.logarithmic ? "10^{%T}"
                                                 : fmt::format("%.{}f", range.decimals);
  body_ += fmt::format("  set {0}range [{1:.10g}:{2:.10g}]; set format {0} '{3}'\n", name, range.lo,
                       range.hi, format);
  body_ += fmt::format("  set {0}tics {1:.10g},{2:.10g},{3:.10g} {4} scale 0.5,0.25 offset {5}\n",
                       name, range.first, range.step, range.last,
                       map ? "out nomirror" : "in mirror", name == 'x' ? "0,0.3" : "0.4,0");
}

void Canvas::user_label(std::string_view user_text, double x, double y, std::string_view words) {
  label(text(user_text), x, y, fmt::format("{} noenhanced", words));
}

void Canvas::open(const Panel& panel) {
  const double right = panel.left + panel.width, top = panel.bottom + panel.height;
  body_ += fmt::format(
      "\n  unset label; unset arrow; unset object\n"
      "  set lmargin at screen {:.5f}; set rmargin at screen {:.5f}\n"
      "  set bmargin at screen {:.5f}; set tmargin at screen {:.5f}\n",
      panel.left / width_, right / width_, panel.bottom / height_, top / height_);
  Axis x = panel.x;
  if (panel.neighbour) x.last -= 0.05 * x.step;
  axis('x', x, panel.x_numbers, panel.map);
  axis('y', panel.y, panel.y_numbers, panel.map);
  if (panel.map) {
    command(
        "set object rectangle from graph 0,0 to graph 1,1 behind fc rgb '#D9D9D9' fs solid "
        "noborder");
  }
  if (panel.zero_line && panel.y.lo < 0 && panel.y.hi > 0) {
    command("set arrow from graph 0, first 0 to graph 1, first 0 nohead lw 0.5 lc rgb '#808080'");
  }
  if (!panel.x_label.empty()) {
    label(panel.x_label, panel.left + panel.width / 2, panel.bottom - 8);
  }
  if (!panel.y_label.empty()) {
    label(panel.y_label, panel.left - panel.y_label_gap, panel.bottom + panel.height / 2,
          "center rotate by 90");
  }
}

void Canvas::draw(std::span<const std::string> layers) {
  for (const std::string& line : pending_) body_ += "  " + line + "\n";
  pending_.clear();
  body_ += "  plot ";
  for (std::size_t i = 0; i < layers.size(); ++i) {
    body_ += (i == 0 ? "" : ", \\\n    ") + layers[i];
  }
  body_ += layers.empty() ? "NaN notitle\n" : "\n";
}

std::string Canvas::layer(std::size_t index, std::string_view words) {
  return fmt::format("data index {} {} notitle", index, words);
}

double Canvas::legend_height(std::span<const LegendEntry> entries, double width) {
  const std::size_t columns = legend_columns(entries, width);
  const std::size_t rows = (entries.size() + columns - 1) / columns;
  return line_height * static_cast<double>(rows);
}

void Canvas::legend(std::span<const LegendEntry> entries, double left, double top, double width) {
  const std::size_t columns = legend_columns(entries, width);
  double column_width = 0;
  for (const LegendEntry& entry : entries)
    column_width = std::max(column_width, entry_width(entry));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const LegendEntry& entry = entries[i];
    const std::size_t row = i / columns;
    const double x = left + column_width * static_cast<double>(i % columns);
    const double y = top - line_height * (static_cast<double>(row) + 0.5);
    if (!entry.line.empty()) {
      command(fmt::format("set arrow from {} rto screen {:.5f}, screen 0 nohead {}", screen(x, y),
                          sample_width / width_, entry.line));
    }
    if (!entry.marker.empty()) {
      label("''", x + sample_width / 2, y, "center point " + entry.marker);
    }
    const double room = std::min(column_width, width) - sample_room(entry);
    user_label(shortened(entry.label, room), x + sample_room(entry), y, "left");
  }
}

void Canvas::colour_bar(double left, double bottom, double width, const Axis& range,
                        const std::string& title) {
  constexpr double thickness = 2.2;
  command(
      fmt::format("set colorbox horizontal user origin screen {:.5f}, screen {:.5f} size screen "
                  "{:.5f}, screen {:.5f} front",
                  left / width_, bottom / height_, width / width_, thickness / height_));
  // The numbers are labels of ours: gnuplot has them below the bar only.
  command("unset cbtics");
  const auto ticks = static_cast<int>(std::floor((range.last - range.first) / range.step + 1e-6));
  for (int i = 0; i <= ticks; ++i) {
    const double value = range.first + i * range.step;
    const double x = left + width * (value - range.lo) / (range.hi - range.lo);
    label(literal(fmt::format("{:.{}f}", std::abs(value) < 1e-9 * range.step ? 0.0 : value,
                              range.decimals)),
          x, bottom + thickness + 2.2);
    command(fmt::format("set arrow from {} rto screen 0, screen {:.5f} nohead lw 0.7 front",
                        screen(x, bottom + thickness), 0.7 / height_));
  }
  label(title, left + width / 2, bottom + thickness + 6.2);
}

std::string Canvas::script(const std::string& name, const std::string& title) const {
  std::string text = fmt::format(
      "# {0}. Drawn by bedscope from {1}.dat; draw it again with: gnuplot {1}.gp\n"
      "reset\nset encoding utf8\ndata = '{1}.dat'\n"
      "if (!exists('forms')) forms = 'svg png'\n",
      title, name);
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    text += fmt::format("text{} = {}\n", i + 1, texts_[i]);
  }
  const double width = width_ * px_per_mm, height = height_ * px_per_mm;
  text += fmt::format(
      "\ndo for [form in forms] {{\n"
      "  reset\n"
      "  # {0:.0f} x {1:.0f} mm, text of 8.25 pt; the PNG has 300 dpi.\n"
      "  if (form eq 'svg') {{\n"
      "    set terminal svg enhanced size {2:.0f},{3:.0f} font 'DejaVu Sans,11' background "
      "'white'\n"
      "  }} else {{\n"
      "    set terminal pngcairo enhanced size {4:.0f},{5:.0f} font 'DejaVu Sans,11' \\\n"
      "      fontscale {6:.4f} linewidth {7:.4f} pointscale {8:.4f} dashlength 2 background "
      "'white'\n"
      "  }}\n"
      "  set output '{9}.'.form\n"
      "  unset key; unset colorbox; set border lw 0.7\n"
      "  set multiplot\n",
      width_, height_, width, height, width * png_scale, height * png_scale, 0.75 * png_scale,
      png_scale, 1.3 * png_scale, name);
  return text + body_ + "  unset multiplot\n  unset output\n}\n";
}

std::string viridis() {
  static const std::array<std::string, 10> stops{"#440154", "#482878", "#3E4A89", "#31688E",
                                                 "#26828E", "#1F9E89", "#35B779", "#6DCD59",
                                                 "#B4DE2C", "#FDE725"};
  return palette(stops);
}

std::string light_greys() {
  static const std::array<std::string, 2> stops{"#FFFFFF", "#6E6E6E"};
  return palette(stops);
}

std::string diverging(double lo, double hi) {
  // ColorBrewer's RdBu (Brewer, Harrower 2003), blue first.
  static constexpr std::array<std::array<int, 3>, 9> colours{{{0x21, 0x66, 0xAC},
                                                              {0x43, 0x93, 0xC3},
                                                              {0x92, 0xC5, 0xDE},
                                                              {0xD1, 0xE5, 0xF0},
                                                              {0xFF, 0xFF, 0xFF},
                                                              {0xFD, 0xDB, 0xC7},
                                                              {0xF4, 0xA5, 0x82},
                                                              {0xD6, 0x60, 0x4D},
                                                              {0xB2, 0x18, 0x2B}}};
  const double most = std::max(std::abs(lo), std::abs(hi));
  // Stops at the colours' own values, cut at the ends of the range: white is exactly at 0.
  std::vector<double> places{4 + 4 * lo / most};
  for (int i = 0; i <= 8; ++i) {
    if (i > places.front() + 1e-6 && i < 4 + 4 * hi / most - 1e-6) places.push_back(i);
  }
  places.push_back(4 + 4 * hi / most);
  std::string text;
  for (const double place : places) {
    const auto below = std::min(static_cast<std::size_t>(std::max(place, 0.0)), std::size_t{7});
    const double part = std::clamp(place - static_cast<double>(below), 0.0, 1.0);
    std::array<long, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      rgb[c] = std::lround((1 - part) * colours[below][c] + part * colours[below + 1][c]);
    }
    text += fmt::format("{}{:.6g} '#{:02X}{:02X}{:02X}'", text.empty() ? "" : ", ",
                        most * (place - 4) / 4, rgb[0], rgb[1], rgb[2]);
  }
  return "set palette defined (" + text + ")";
}

}  // namespace bedscope::report
