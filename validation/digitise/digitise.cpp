// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "readers/error.hpp"
#include "validation/digitise/beside_line.hpp"
#include "validation/digitise/calibration.hpp"
#include "validation/digitise/clear.hpp"
#include "validation/digitise/colour.hpp"
#include "validation/digitise/doubt.hpp"
#include "validation/digitise/error_bars.hpp"
#include "validation/digitise/legend.hpp"
#include "validation/digitise/lines.hpp"
#include "validation/digitise/lines_among_markers.hpp"
#include "validation/digitise/markers.hpp"
#include "validation/digitise/overlay.hpp"
#include "validation/digitise/page.hpp"
#include "validation/digitise/rules.hpp"
#include "validation/digitise/stroke.hpp"
#include "validation/digitise/ticks.hpp"
#include "validation/digitise/uncertainty.hpp"

namespace bedscope::digitise {
namespace {

cv::Rect2d box_of_points(const Figure& figure, const Page& page) {
  std::vector<cv::Point2d> points;
  for (const auto* axis : {&figure.x, &figure.y})
    for (const auto& point : axis->points) points.push_back(page.to_page(point.pixel));
  cv::Point2d low = points[0], high = points[0];
  for (const auto& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, high};
}

/// What is neither the page's paper nor the plot's, which may be shaded.
cv::Mat ink_of_page(const Page& page, const cv::Rect2d& plot) {
  const auto& image = page.image();
  const cv::Rect whole({0, 0}, image.size());
  cv::Rect inside = cv::Rect(plot) & whole;
  if (inside.empty()) inside = whole;
  return cv::min(ink_of(image, paper_of(image, whole)), ink_of(image, paper_of(image, inside)));
}

bool is_grey(cv::Vec3f colour) {
  const auto [least, most] = std::minmax({colour[0], colour[1], colour[2]});
  return most - least < 40;
}

double shorter_side(const cv::Rect2d& box) {
  return std::max(8.0, std::min(box.width, box.height));
}

double thickest(const cv::Rect2d& box) { return std::max(5.0, 0.02 * shorter_side(box)); }

/// The angle by which the long straight lines lean; where there are none but those of the plot's
/// grid in the colour of the page, of these. Nothing where there are no such lines.
std::optional<double> lean_of(const Page& page, const cv::Rect2d& plot) {
  const double least = 0.5 * shorter_side(plot);
  const auto lines = angle_of(find_rules(ink_of_page(page, plot), least, thickest(plot)));
  const cv::Rect inside = cv::Rect(plot) & cv::Rect({0, 0}, page.image().size());
  if (lines || inside.empty()) return lines;
  const cv::Mat part = page.image()(inside);
  return angle_of(
      find_rules(ink_of(part, paper_of(part, {{0, 0}, part.size()})), least, thickest(plot)));
}

struct Upright {
  Page page;
  double u_angle = 0;  ///< of the angle by which it was turned [rad]
};

/// The picture made upright: by the angle that the file gives, or that the calibration points show
/// (the picture itself where they do not tell; none where it may be that of their pixels), made
/// finer by the straight lines in the picture. Lines that contradict the points are data: they may
/// differ by three uncertainties of the points and by what a pixel over 500 is.
Upright upright(const cv::Mat& picture, const Figure& figure) {
  const auto box = box_of_points(figure, Page(picture, 0));
  const double stroke =
      stroke_width(ink_of(picture, paper_of(picture, {0, 0, picture.cols, picture.rows})));
  const int reduction = reduction_for(std::max(box.width, box.height), stroke);
  if (figure.rotation) return {{picture, *figure.rotation, reduction}};
  const auto points = angle_of_points(figure);
  const bool told = !std::isnan(points.angle);
  const double radian = 180 / std::numbers::pi;
  const double shown = told ? points.angle : angle_of_ink(picture);
  const double allowed = told ? std::max(3 * points.u, radian / 500) : 0.5;
  const double angle = std::abs(shown) < 3 * points.u ? 0 : shown;
  Page page(picture, angle, reduction);
  const auto rest = lean_of(page, box_of_points(figure, page));
  if (!rest || std::abs(angle + *rest - shown) > allowed)
    return {page, angle != 0 ? points.u / radian : 0};
  if (std::abs(*rest) < 0.01) return {page};
  return {{picture, angle + *rest, reduction}};
}

/// `across`: the long lines across the axis; `ticks`: its ticks.
Calibration calibration_of(const AxisSpec& axis, const Page& page, const std::vector<Rule>& across,
                           const std::vector<double>& ticks, bool is_x, const std::string& where) {
  std::vector<double> along;
  for (const auto& point : axis.points) {
    const auto at = page.to_page(point.pixel);
    along.push_back(is_x ? at.x : at.y);
  }
  // The plot's edge cuts a grid line on it in half; the middle of what is left is not its place.
  std::vector<double> thickness, lines;
  for (const auto& rule : across) thickness.push_back(rule.thickness);
  std::sort(thickness.begin(), thickness.end());
  for (const auto& rule : across)
    if (rule.thickness > 0.75 * thickness[thickness.size() / 2]) lines.push_back(rule.at);
  const double pixel = 1.0 / page.reduction();
  // A tick at the end of a line is the line.
  const auto rules = lines;
  for (const double tick : ticks)
    if (std::none_of(rules.begin(), rules.end(),
                     [&](double line) { return std::abs(line - tick) < 2 * pixel; }))
      lines.push_back(tick);
  return calibrate(axis, places_of(axis, along, lines, pixel, page.angle() != 0),
                   fmt::format("{}: axes.{}", where, is_x ? "x" : "y"));
}

cv::Rect whole_pixels(const cv::Rect2d& box, cv::Size page) {
  const cv::Rect rect(cv::Point(cvFloor(box.x), cvFloor(box.y)),
                      cv::Point(cvCeil(box.br().x), cvCeil(box.br().y)));
  return rect & cv::Rect({0, 0}, page);
}

/// The state of one digitisation.
class Digitiser {
 public:
  Digitiser(const cv::Mat& picture, bool lossy, const Figure& figure, const std::string& where)
      : figure_(figure), where_(where), upright_(upright(picture, figure)) {
    found_.angle = page_.angle();
    const auto inside = box_of_points(figure_, page_);
    const auto rules =
        find_rules(ink_of_page(page_, inside), 0.4 * shorter_side(inside), thickest(inside));
    const auto framed = plot_area(rules, inside, page_.image().size());
    const auto ticks = find_ticks(page_.image(), framed.box);
    x_ = calibration_of(figure.x, page_, rules.columns, ticks.x, true, where);
    y_ = calibration_of(figure.y, page_, rules.rows, ticks.y, false, where);
    for (const auto& point : figure.x.points)
      row_of_x_ += page_.to_page(point.pixel).y / static_cast<double>(figure.x.points.size());
    for (const auto& point : figure.y.points)
      column_of_y_ += page_.to_page(point.pixel).x / static_cast<double>(figure.y.points.size());
    find_area(inside, framed);
    separate_inks(lossy);
    find_left_out();
  }

  Digitised run() {
    found_.series.resize(figure_.series.size());
    for (std::size_t i = 0; i < figure_.series.size(); ++i) {
      found_.series[i].name = figure_.series[i].name;
      found_.series[i].kind = figure_.series[i].kind;
    }
    for (const auto& [ink, members] : members_) digitise_ink(ink, members);
    if (!missing_.empty()) throw InputError("{}: {}", where_, missing_);
    for (auto& series : found_.series)
      std::stable_sort(series.points.begin(), series.points.end(),
                       [](const Point& a, const Point& b) { return a.x < b.x; });
    found_.overlay = draw_overlay(page_, found_, figure_);
    return std::move(found_);
  }

 private:
  void find_area(const cv::Rect2d& inside, const PlotArea& framed) {
    const auto size = page_.image().size();
    if (figure_.plot_area) {
      found_.plot_area = page_.to_page(*figure_.plot_area);
    } else {
      const auto shaded = shaded_area(page_.image(), inside);
      found_.plot_area = shaded ? framed.box & *shaded : framed.box;
      if (framed.guess && !shaded)
        found_.doubts.push_back(
            "no frame was found: labels of the ticks may be taken for data where they have a "
            "series' colour; plot_area tells where the plot ends");
    }
    area_ = whole_pixels(found_.plot_area, size);
    if (area_.width < 16 || area_.height < 16)
      throw InputError(
          "{}: plot_area: expected at least 16 x 16 pixels inside the picture of {} x {}, "
          "found {} x {}",
          where_, size.width, size.height, area_.width, area_.height);
  }

  void separate_inks(bool lossy) {
    std::vector<cv::Vec3f> asked;
    for (const auto& series : figure_.series) asked.push_back(series.colour);
    colours_ = separate(page_.image(), area_, lossy, asked);
    for (std::size_t i = 0; i < figure_.series.size(); ++i)
      if (const int ink = colours_.ink_of_asked[i]; ink >= 0)
        members_[ink].push_back(i);
      else
        miss(figure_.series[i], "pixels");
  }

  void find_left_out() {
    for (const auto& box : figure_.exclude)
      found_.left_out.push_back(whole_pixels(page_.to_page(box), page_.image().size()));
    const cv::Mat ink = ink_of_page(page_, area_);
    const auto rules = find_rules(ink, std::max(12.0, 0.03 * area_.height), thickest(area_));
    auto boxes = find_boxes(rules, ink, area_);
    cv::Mat text = cv::Mat::zeros(ink.size(), CV_32F);
    for (std::size_t k = 0; k < colours_.inks.size(); ++k) {
      const auto& c = colours_.inks[k];
      if (is_grey(c) && cv::norm(c - colours_.paper) > 150)
        text += coverage_of(colours_, static_cast<int>(k));
    }
    const auto rows = find_legend_rows(text, ink, area_);
    boxes.insert(boxes.end(), rows.begin(), rows.end());
    // Each once, and none that lies in another.
    std::vector<cv::Rect> outer;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const auto within = [&](std::size_t j) {
        return j != i && (boxes[i] | boxes[j]) == boxes[j] && (boxes[i] != boxes[j] || j < i);
      };
      bool inner = false;
      for (std::size_t j = 0; j < boxes.size(); ++j) inner = inner || within(j);
      if (!inner) outer.push_back(boxes[i]);
    }
    boxes = outer;
    for (const auto& box : boxes)
      found_.notes.push_back(
          fmt::format("taken for a legend or an inset and left out: [{}, {}, {}, {}]", box.x, box.y,
                      box.width, box.height));
    found_.left_out.insert(found_.left_out.end(), boxes.begin(), boxes.end());
  }

  InkMap map_of(int ink) const {
    InkMap map{coverage_of(colours_, ink)(area_).clone(),
               hidden_from(colours_, ink)(area_).clone()};
    // Markers with an edge of another ink: what surrounds them all is not what hides them.
    if (is_edged(map)) map.unknown.setTo(0);
    // Before a legend on the frame or on a grid line cuts it short.
    clear_rules(map, is_grey(colours_.inks[static_cast<std::size_t>(ink)]));
    for (const auto& box : found_.left_out) {
      const cv::Rect there = box & area_;
      if (there.empty()) continue;
      map.coverage(there - area_.tl()).setTo(0);
      map.unknown(there - area_.tl()).setTo(255);
    }
    hide_edges(map);
    return map;
  }

  /// Where no ink is seen along the plot's edges a frame may lie over it, in the paper's colour
  /// too: by half its thickness, of three points in a plot of three and a half inches.
  static void hide_edges(InkMap& map) {
    const int strip = std::max(2, cvRound(0.006 * std::min(map.unknown.cols, map.unknown.rows)));
    cv::Mat inner = cv::Mat::zeros(map.unknown.size(), CV_8U);
    inner(cv::Range(strip, inner.rows - strip), cv::Range(strip, inner.cols - strip)).setTo(255);
    map.unknown.setTo(255, (inner == 0) & (map.coverage < 0.06F));
  }

  /// Whether most of the ink's outline touches another ink.
  static bool is_edged(const InkMap& map) {
    const cv::Mat ink = map.coverage > 0.5F;
    cv::Mat core, near, rim;
    cv::erode(ink, core, cv::Mat::ones(3, 3, CV_8U));
    cv::dilate(map.unknown, near, cv::Mat::ones(3, 3, CV_8U));
    cv::subtract(ink, core, rim);
    return cv::countNonZero(rim & near) > 0.6 * cv::countNonZero(rim);
  }

  void digitise_ink(int ink, const std::vector<std::size_t>& members) {
    auto map = map_of(ink);
    std::vector<Template> templates;
    std::vector<std::size_t> with_markers;
    std::vector<MarkerQuery> queries;
    for (const auto i : members)
      if (figure_.series[i].kind == Kind::markers) {
        with_markers.push_back(i);
        queries.push_back(query_of(figure_.series[i], ink));
      }
    const auto learned = learn_all(map, queries);
    for (std::size_t t = 0; t < learned.size(); ++t) {
      const auto& series = figure_.series[with_markers[t]];
      if (learned[t])
        templates.push_back(*learned[t]);
      else
        miss(series, "markers");
    }
    if (templates.size() < learned.size()) return;
    auto markers = find_markers(map, templates);
    drop_stretches(map, line_width(map.coverage), templates, markers);
    const auto asked = lines_asked(members);
    const auto lines = lines_among(map, templates, markers, asked);
    const bool with_line = asked > 0 || !lines.empty();
    markers = beside_line(map, lines, templates, markers);
    std::vector<bool> with_bars;
    for (const auto i : with_markers)
      with_bars.push_back(figure_.series[i].error_bars.value_or(true));
    drop_on_bars(map, templates, with_bars, markers, with_line);
    for (std::size_t t = 0; t < templates.size(); ++t)
      if (markers[t].empty()) miss(figure_.series[with_markers[t]], "markers");
    if (std::any_of(markers.begin(), markers.end(), [](const auto& one) { return one.empty(); }))
      return;
    for (std::size_t t = 0; t < templates.size(); ++t)
      store_markers(map, templates[t], markers[t], figure_.series[with_markers[t]],
                    found_.series[with_markers[t]], with_line);
    if (with_line && templates.empty())
      if (const auto unasked = markers_on_line(map)) {
        templates.push_back(*unasked);
        markers = find_markers(map, templates);
        drop_stretches(map, line_width(map.coverage), templates, markers);
        complete(markers[0], page_.reduction(), page_.angle() != 0, colours_.lossy);
      }
    map = covered(map, templates, markers, with_line);
    if (!with_markers.empty())
      doubt_markers(ink, with_markers, missed_markers(map, templates),
                    incomplete_markers(map, templates), markers);
    for (const auto i : members)
      if (figure_.series[i].kind == Kind::line)
        store_line(map, all_points(markers), figure_.series[i], found_.series[i]);
    if (const int beside = ink_beside(colours_, ink); beside >= 0)
      found_.doubts.push_back(fmt::format(
          "series {}: the noise of the picture mixes its colour {} with another that is there, {}",
          names_of(members), hex_of(colours_.inks[ink]), hex_of(colours_.inks[beside])));
  }

  /// A series that is not there is an error; all of them are said at once, by run().
  void miss(const SeriesSpec& series, const char* what) {
    missing_ += fmt::format(
        "{}series \"{}\": expected {} of colour {}{} in the plot area, found none",
        missing_.empty() ? "" : "; ", series.name, what, hex_of(series.colour),
        series.shape && what == std::string_view("markers") ? " and shape " + name_of(*series.shape)
                                                            : "");
  }

  void doubt_markers(int ink, const std::vector<std::size_t>& series,
                     const std::vector<cv::Point2d>& missed,
                     const std::vector<cv::Point2d>& incomplete,
                     const std::vector<std::vector<Marker>>& markers) {
    if (series.size() > 1 && std::any_of(series.begin(), series.end(), [&](std::size_t i) {
          return !figure_.series[i].shape && !figure_.series[i].sample;
        }))
      found_.doubts.push_back(fmt::format(
          "series {}: all of colour {}: expected a shape or a template for each, found one without",
          names_of(series), hex_of(colours_.inks[ink])));
    if (!incomplete.empty())
      found_.doubts.push_back(
          fmt::format("series {}: {} places look like markers of which a part is hidden: {}",
                      names_of(series), incomplete.size(), listed(incomplete, area_.tl())));
    if (!missed.empty())
      found_.doubts.push_back(fmt::format("series {}: {} more places look like markers: {}",
                                          names_of(series), missed.size(),
                                          listed(missed, area_.tl())));
    std::vector<cv::Point2d> either;
    for (const auto& of_series : markers)
      for (const auto& one : of_series)
        if (one.doubted) either.push_back(one.at);
    if (!either.empty())
      found_.doubts.push_back(fmt::format("series {}: {} markers resemble those of two series: {}",
                                          names_of(series), either.size(),
                                          listed(either, area_.tl())));
    for (std::size_t t = 0; t < series.size(); ++t)
      if (const auto unlike = unlike_others(markers[t]); !unlike.empty())
        found_.doubts.push_back(fmt::format(
            "series {}: {} of {} markers resemble the others little: {}", names_of({series[t]}),
            unlike.size(), markers[t].size(), listed(unlike, area_.tl())));
  }

  std::string names_of(const std::vector<std::size_t>& series) const {
    std::string names;
    for (const auto i : series)
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", figure_.series[i].name);
    return names;
  }

  /// The first of `places`, which count from `corner` of the page, in pixels of the picture.
  std::string listed(const std::vector<cv::Point2d>& places, cv::Point corner) const {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, places.size()); ++i) {
      const auto at = page_.to_picture(places[i] + cv::Point2d(corner));
      text += fmt::format("{}[{:.0f}, {:.0f}]", i == 0 ? "" : ", ", at.x, at.y);
    }
    return places.size() > 3 ? text + " ..." : text;
  }

  std::size_t lines_asked(const std::vector<std::size_t>& members) const {
    return static_cast<std::size_t>(
        std::count_if(members.begin(), members.end(),
                      [&](std::size_t i) { return figure_.series[i].kind == Kind::line; }));
  }

  /// The shapes of an ink: those that are named where each of several series names its own.
  std::vector<Shape> shapes_among(const std::vector<std::size_t>& members) const {
    std::vector<Shape> named;
    int series = 0;
    for (const auto i : members) {
      if (figure_.series[i].kind != Kind::markers) continue;
      if (!figure_.series[i].shape) return candidates(std::nullopt);
      ++series;
      for (const auto& shape : candidates(figure_.series[i].shape)) named.push_back(shape);
    }
    return series > 1 ? named : candidates(std::nullopt);
  }

  MarkerQuery query_of(const SeriesSpec& series, int ink) const {
    MarkerQuery query;
    query.shape = series.shape;
    query.among = shapes_among(members_.at(ink));
    query.with_line = lines_asked(members_.at(ink)) > 0;
    for (const auto i : members_.at(ink)) {
      const auto& other = figure_.series[i];
      if (other.kind != Kind::markers || !other.shape || &other == &series) continue;
      for (const auto& shape : candidates(other.shape)) query.rivals.push_back(shape);
    }
    if (!series.sample) return query;
    const cv::Rect2d wanted = *series.sample;
    const cv::Rect box = whole_pixels(page_.to_page(wanted), page_.image().size());
    if (box.width < 4 || box.height < 4)
      throw InputError(
          "{}: series \"{}\": template: expected at least 4 x 4 pixels inside the picture", where_,
          series.name);
    query.sample = coverage_of(colours_, ink)(box).clone();
    if (cv::sum(query.sample)[0] < 4)
      throw InputError(
          "{}: series \"{}\": template: expected a marker of colour {} in it, found none", where_,
          series.name, hex_of(series.colour));
    if (series.reference)
      query.reference = page_.to_page(*series.reference) - cv::Point2d(box.tl());
    return query;
  }

  Point to_point(cv::Point2d at, double u_x, double u_y) const {
    Point point;
    point.pixel = at;
    point.u_pixel[0] = u_x;
    point.u_pixel[1] = u_y;
    point.x = x_.value(at.x);
    point.y = y_.value(at.y);
    // A page that leans moves what is far from an axis' points along it.
    const double lean_x = upright_.u_angle * (at.y - row_of_x_),
                 lean_y = upright_.u_angle * (at.x - column_of_y_);
    point.x_u = x_.uncertainty(at.x, std::hypot(u_x, lean_x));
    point.y_u = y_.uncertainty(at.y, std::hypot(u_y, lean_y));
    return point;
  }

  void store_markers(const InkMap& map, const Template& marker, std::vector<Marker>& markers,
                     const SeriesSpec& series, FoundSeries& found, bool with_line) {
    complete(markers, page_.reduction(), page_.angle() != 0, colours_.lossy);
    found.shape = name_of(marker.shape);
    const cv::Point2d corner = area_.tl();
    std::vector<ErrorBar> bars;
    const bool with_bars = series.error_bars.value_or(true);
    if (with_bars) {
      // Where their ink is seen, not where complete() takes the points to be.
      std::vector<cv::Point2d> seen;
      for (const auto& one : markers) seen.push_back(one.fit.origin + marker.reference);
      bars = find_error_bars(map, marker, seen, with_line);
    }
    for (std::size_t i = 0; i < markers.size(); ++i) {
      const auto& one = markers[i];
      auto point = to_point(one.at + corner, one.u[0], one.u[1]);
      if (with_bars) {
        const auto& bar = bars[i];
        point.bar_pixel[0] = bar.lower + corner.y;
        point.bar_pixel[1] = bar.upper + corner.y;
        for (const double end : point.bar_pixel)
          if (!std::isnan(end)) {
            const double value = y_.value(end);
            (value < point.y ? point.lo : point.hi) = value;
          }
      }
      found.points.push_back(point);
    }
    if (!series.error_bars)
      if (const auto stray = drop_stray_bars(found.points); !stray.empty())
        found_.doubts.push_back(fmt::format(
            "series \"{}\": {} of {} markers seem to have an error bar, too few to take these for "
            "bars (error_bars = true takes them): {}",
            series.name, stray.size(), found.points.size(), listed(stray, {0, 0})));
    if (const auto without = without_bar(found.points); !without.empty())
      found_.doubts.push_back(
          fmt::format("series \"{}\": an end of the error bar is not seen at {} of {} markers: {}",
                      series.name, without.size(), found.points.size(), listed(without, {0, 0})));
  }

  void store_line(const InkMap& map, const std::vector<LinePoint>& through,
                  const SeriesSpec& series, FoundSeries& found) {
    auto line = trace_beside(map, through, series.points);
    if (line.points.size() < 2) return miss(series, "a line");
    if (line.explained < 0.7)
      found_.doubts.push_back(
          fmt::format("series \"{}\": the line explains {:.0f} % of the ink of its colour: a "
                      "second line, or one with several places for one abscissa",
                      series.name, 100 * line.explained));
    if (const auto gaps = gaps_in(line, area_.size()); !gaps.empty())
      found_.doubts.push_back(
          fmt::format("series \"{}\": the line is not seen to within a twentieth of an axis "
                      "at {} places: {}",
                      series.name, gaps.size(), listed(gaps, area_.tl())));
    complete(line.points, colours_.lossy);
    for (const auto& one : line.points)
      found.points.push_back(to_point(one.at + cv::Point2d(area_.tl()), one.u, one.u));
  }

  const Figure& figure_;
  const std::string& where_;
  Upright upright_;
  const Page& page_ = upright_.page;
  Calibration x_, y_;
  double row_of_x_ = 0, column_of_y_ = 0;  ///< where the axes' points are
  cv::Rect area_;
  Colours colours_;
  std::map<int, std::vector<std::size_t>> members_;  ///< the series of an ink
  Digitised found_;
  std::string missing_;  ///< what was expected and not found
};

}  // namespace

Digitised digitise(const cv::Mat& picture, bool lossy, const Figure& figure,
                   const std::string& where) {
  check_inside(figure, picture.size(), where);
  return Digitiser(picture, lossy, figure, where).run();
}

}  // namespace bedscope::digitise
