// SPDX-License-Identifier: BSD-3-Clause
#include "report/tradeoff_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "report/figure_parts.hpp"

namespace bedscope::report {

using validation::Setting;

namespace {

constexpr double resolution = 1e-6;  // of the charts: what is below lies in a strip
constexpr double zero_line = 10;     // in the strip, from 1 to 100
constexpr double width = 150, left = 21, right = 4, bottom = 11, strip = 6,
                 main_height = 78;  // [mm]

/// A family of settings that differ in one thing, drawn together.
struct Family {
  std::string label;
  std::string colour, marker;  ///< gnuplot point words without colour
  bool joined = false;
  std::function<bool(const Setting&)> has;
};

std::vector<Family> families_of(const TradeoffReport& report) {
  const auto& variants = report.variants;
  const auto variant = [&variants](const Setting& s) -> const analysis::Variant& {
    return variants[s.variant];
  };
  const auto whole = [](const Setting& s) { return s.every == 1 && s.part == 1; };
  const auto same_depth = [&variants, variant](const Setting& s) {
    return variant(s).settings.cells.size() == variants.front().settings.cells.size();
  };
  const auto cells = [=](const char* mapping) {
    return [=](const Setting& s) {
      return s.candidate && whole(s) && same_depth(s) && variant(s).mapping == mapping;
    };
  };
  return {
      {"every n-th snapshot", "#0072B2", "pt 7 ps 0.5", true,
       [](const Setting& s) { return s.variant == 0 && s.part == 1; }},
      {"shorter window", "#D55E00", "pt 9 ps 0.6", true,
       [](const Setting& s) { return s.variant == 0 && s.every == 1; }},
      {"wider cells, exact", "#009E73", "pt 5 ps 0.45", true, cells("exact")},
      {"wider cells, centre", "#CC79A7", "pt 13 ps 0.65", true, cells("centre")},
      {"divided, gaussian", "#000000", "pt 3 ps 0.5", false,
       [=](const Setting& s) {
         return s.candidate && whole(s) && same_depth(s) && variant(s).mapping != "exact" &&
                variant(s).mapping != "centre";
       }},
      {"other depth", "#E69F00", "pt 11 ps 0.65", false,
       [=](const Setting& s) { return whole(s) && !same_depth(s); }},
      {"other form of dumps", "#56B4E9", "pt 2 ps 0.5", false,
       [=](const Setting& s) { return variant(s).form != readers::DumpForm::as_it_is; }},
      {"other thresholds", "#808080", "pt 1 ps 0.5", false,
       [=](const Setting& s) {
         return !s.candidate && same_depth(s) && variant(s).form == readers::DumpForm::as_it_is;
       }},
  };
}

struct Point {
  double seconds, error, ci95;
};

class Chart {
 public:
  Chart(const TradeoffReport& report, std::size_t product) : report_(report), p_(product) {
    const auto& tradeoff = report.tradeoff;
    Range x, y;
    for (const auto& setting : tradeoff.settings) {
      const auto& error = setting.errors[p_].whole;
      x.add(setting.seconds);
      if (error.value > 0) {
        y.add(error.value);
        y.add(error.value + error.ci95);
      }
    }
    y.add(tradeoff.tolerance);
    if (tradeoff.noise[p_] > 0) y.add(tradeoff.noise[p_]);
    x_ = log_axis(0.9 * x.lo, 1.1 * x.hi);
    y_ = log_axis(std::max(y.lo, resolution), y.hi);
  }

  Figure draw(const std::string& name, const std::string& title, const std::string& caption) {
    const auto entries = legend();
    const double rows = Canvas::legend_height(entries, width - left) + 1;
    Canvas canvas(width, bottom + strip + main_height + 2 + rows);
    canvas.legend(entries, left, canvas.height() - 0.5, width - left);
    Panel main{.left = left,
               .bottom = bottom + strip,
               .width = width - left - right,
               .height = main_height};
    main.x = x_;
    main.y = y_;
    main.x_numbers = false;
    main.y_label = literal("error against the finest choice [-]");
    main.y_label_gap = 15;
    canvas.open(main);
    canvas.draw(layers(canvas, false));
    Panel zero = main;
    zero.bottom = bottom;
    zero.height = strip;
    zero.x_numbers = true;
    zero.y_numbers = false;
    // Logarithmic as the panel above, whose scale gnuplot would keep; one line of marks, no ticks.
    zero.y = {.lo = 1, .hi = 100, .first = 1e9, .step = 10, .last = 1e9, .logarithmic = true};
    zero.y_label = "";
    zero.x_label = literal("CPU time of the analysis [s]");
    canvas.open(zero);
    canvas.user_label("< 10⁻⁶", left - 1.5, bottom + strip / 2, "right");
    canvas.draw(layers(canvas, true));
    return drawn(canvas, name, title, caption);
  }

 private:
  const validation::ProductError& error(const Setting& s) const { return s.errors[p_]; }
  static bool is_zero(const Setting& s, std::size_t p) {
    return !(s.errors[p].whole.value >= resolution);
  }

  std::vector<Point> points(const std::function<bool(const Setting&)>& has, bool zeros) const {
    std::vector<Point> found;
    for (const auto& setting : report_.tradeoff.settings) {
      const auto& e = error(setting).whole;
      if (!has(setting) || std::isnan(e.value) || is_zero(setting, p_) != zeros) continue;
      found.push_back({setting.seconds, zeros ? zero_line : e.value, zeros ? 0 : e.ci95});
    }
    std::sort(found.begin(), found.end(),
              [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
    return found;
  }

  static std::string rows_of(const std::vector<Point>& points) {
    std::string rows;
    for (const auto& [seconds, value, ci95] : points) rows += data_row({seconds, value, ci95});
    return rows;
  }

  std::vector<std::string> layers(Canvas& canvas, bool zeros) const {
    std::vector<std::string> all;
    const auto add = [&](const std::string& what, const std::string& rows,
                         const std::string& words) {
      if (!rows.empty()) all.push_back(Canvas::layer(canvas.block(what, rows), words));
    };
    if (!zeros) lines(add);
    add("all candidates: seconds, error, ci95",
        rows_of(points([](const Setting& s) { return s.candidate; }, zeros)),
        "using 1:2 with points pt 7 ps 0.22 lc rgb '#B0B0B0'");
    if (!zeros) add("front", front_rows(), "using 1:2 with lines lc rgb '#000000' lw 1.6");
    for (const auto& family : families_of(report_)) {
      const auto found = points(family.has, zeros);
      if (family.joined && !zeros)
        add(family.label, rows_of(found),
            fmt::format("using 1:2 with lines lc rgb '{}' lw 0.7", family.colour));
      if (!zeros)
        add(family.label + ": bars", bars(found),
            fmt::format("using 1:2 with lines lc rgb '{}' lw 0.6", family.colour));
      add(family.label, rows_of(found),
          fmt::format("using 1:2 with points {} lc rgb '{}'", family.marker, family.colour));
    }
    const auto one = [&](std::size_t setting, const char* what, const char* words) {
      add(what,
          rows_of(points(
              [&](const Setting& s) { return &s == &report_.tradeoff.settings[setting]; }, zeros)),
          words);
    };
    one(report_.tradeoff.present(), "present choice",
        "using 1:2 with points pt 6 ps 1.5 lw 1.6 lc rgb '#000000'");
    one(report_.recommendation.setting, "recommended",
        "using 1:2 with points pt 4 ps 1.5 lw 1.6 lc rgb '#D55E00'");
    return all;
  }

  template <class Add>
  void lines(const Add& add) const {
    const auto across = [&](double value) {
      return data_row({x_.lo, value}) + data_row({x_.hi, value});
    };
    add("tolerance", across(report_.tradeoff.tolerance),
        "using 1:2 with lines lc rgb '#D55E00' lw 0.9 dt (8,4)");
    if (const double noise = report_.tradeoff.noise[p_]; noise >= resolution)
      add("the window's own interval", across(noise),
          "using 1:2 with lines lc rgb '#0072B2' lw 0.9 dt (2,3)");
  }

  /// From the cheapest on, a step down at each setting that is nearer.
  std::string front_rows() const {
    const auto on_front = report_.tradeoff.front(p_);
    std::vector<Point> points;
    for (std::size_t s = 0; s < on_front.size(); ++s) {
      const auto& setting = report_.tradeoff.settings[s];
      if (on_front[s])
        points.push_back({setting.seconds, std::max(error(setting).whole.value, y_.lo), 0});
    }
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
    std::string rows;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k == 0) rows += data_row({points[0].seconds, y_.hi});
      if (k > 0) rows += data_row({points[k].seconds, points[k - 1].error});
      rows += data_row({points[k].seconds, points[k].error});
    }
    if (!points.empty()) rows += data_row({x_.hi, points.back().error});
    return rows;
  }

  std::string bars(const std::vector<Point>& points) const {
    std::string rows;
    for (const auto& [seconds, value, ci95] : points) {
      if (!(ci95 > 0)) continue;
      // A bar that reaches zero would reach the floor, whatever its length.
      rows += data_row({seconds, std::max({value - ci95, value / 3, y_.lo})}) +
              data_row({seconds, std::min(value + ci95, y_.hi)}) + "\n";
    }
    return rows;
  }

  std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    for (const auto& family : families_of(report_)) {
      const auto& settings = report_.tradeoff.settings;
      if (std::none_of(settings.begin(), settings.end(), family.has)) continue;
      entries.push_back({family.joined ? fmt::format("lc rgb '{}' lw 0.7", family.colour) : "",
                         fmt::format("{} lc rgb '{}'", family.marker, family.colour),
                         family.label});
    }
    entries.push_back({"", "pt 7 ps 0.22 lc rgb '#B0B0B0'", "combinations"});
    entries.push_back({"lc rgb '#000000' lw 1.6", "", "Pareto front"});
    entries.push_back({"", "pt 6 ps 1.3 lw 1.6 lc rgb '#000000'", "present choice"});
    entries.push_back({"", "pt 4 ps 1.3 lw 1.6 lc rgb '#D55E00'", "recommended"});
    entries.push_back({"lc rgb '#D55E00' lw 0.9 dt (8,4)", "", "tolerance"});
    entries.push_back({"lc rgb '#0072B2' lw 0.9 dt (2,3)", "", "window's own interval"});
    return entries;
  }

  const TradeoffReport& report_;
  std::size_t p_;
  Axis x_, y_;
};

}  // namespace

std::string percent(double share) { return number(100 * share, 2) + " %"; }

std::string percent(const analysis::Estimate& error) {
  if (std::isnan(error.value)) return "–";
  if (error.value == 0) return "0";
  return std::isfinite(error.ci95) ? plus_minus({100 * error.value, 100 * error.ci95}) + " %"
                                   : percent(error.value);
}

Figure tradeoff_figure(const TradeoffReport& report, std::size_t p) {
  const auto& product = report.tradeoff.products[p];
  auto name = "tradeoff_" + product;
  std::replace(name.begin(), name.end(), ' ', '_');
  std::string title = product;
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return Chart(report, p).draw(
      name, title,
      fmt::format(
          "Error of the {} against the finest choice (exact mapping, the study’s cells, every "
          "snapshot, the whole window), with its 95 % interval, against the CPU time of the "
          "analysis; a bar is cut at a third of its error. Strip below: errors of zero, or below "
          "10⁻⁶. Dotted: how well the "
          "finest choice itself knows the {} (95 %); a smaller error is no gain.",
          product, product));
}

}  // namespace bedscope::report
