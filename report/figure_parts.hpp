// SPDX-License-Identifier: BSD-3-Clause
// Inside report: one maker a figure, and what makers share.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/result.hpp"
#include "report/canvas.hpp"
#include "report/figures.hpp"

namespace bedscope::report {

using Runs = std::span<const analysis::RunResult>;

constexpr std::string_view interval_words = "95 % confidence interval of the mean";

constexpr double bar_cap = 0.4;                        ///< half width of an error bar's caps [mm]
constexpr double page_width = 170, page_height = 215;  ///< room for a figure [mm]

Figure fields_figure(Runs runs);
Figure axial_figure(Runs runs);
Figure axial_species_figure(Runs runs);
std::vector<Figure> lateral_figures(Runs runs);
std::vector<Figure> gas_figures(Runs runs);  ///< none where no run has gas
Figure inventory_figure(Runs runs);
Figure occurrence_figure(Runs runs);
Figure clusters_lateral_figure(Runs runs);
std::vector<Figure> snapshots_figures(Runs runs);
Figure temperature_figure(Runs runs);
Figure temperature_pdf_figure(Runs runs);
std::vector<Figure> bed_figures(Runs runs);  ///< of what the study asks for: none, or all

Figure bed_height_figure(Runs runs);
std::vector<Figure> bubble_strips(Runs runs);
Figure bubble_profile_figure(Runs runs);
Figure spectra_figure(Runs runs);

/// A figure whose script and data come from the canvas.
Figure drawn(const Canvas& canvas, std::string name, std::string title, std::string caption);
Figure left_out(std::string name, std::string title, std::string why);

/// "holdup φ [-]", with "domain assumed" where a run's domain was; `what` replaces "holdup φ".
std::string holdup_label(Runs runs, std::string_view what = "holdup φ");
/// "time t [s]" or "step [-]".
std::string time_label(Runs runs);
/// "Averaging window: 10 to 20 s (1001 snapshots)", for each run where they differ.
std::string window_words(Runs runs);
/// "Mapping kernel and grid: exact, 28 × 600 cells of 2.5 × 2.5 mm", for each run where they
/// differ.
std::string mapping_words(Runs runs);
std::string threshold_words(Runs runs);

/// The types besides "all", of all runs in order of appearance; empty where there is only one.
std::vector<std::string> species_names(Runs runs);
/// "all types", "type 1", or the name of a rule.
std::string species_title(const std::string& type);
const analysis::SpeciesResult* find_species(const analysis::RunResult& run,
                                            const std::string& type);
/// Bounds of all runs' domains along an axis.
Range domain_range(Runs runs, int axis);

/// Rows and columns of equal panels for a domain of lx x lz in width x height [mm]; the scale is
/// the same along both axes unless panels would be thinner than is legible: then one is stretched.
struct PanelGrid {
  std::size_t columns = 1, rows = 1;
  double width = 0, height = 0;  ///< of a panel [mm]
  double stretch = 1;            ///< of lateral against up
};
PanelGrid panel_grid(std::size_t columns, std::size_t rows, double lx, double lz, double width,
                     double height, double gap_x, double gap_z);
/// The one in which `count` panels are largest.
PanelGrid arrange_panels(std::size_t count, double lx, double lz, double width, double height,
                         double gap_x, double gap_z);
/// "The lateral axis is stretched 2.1 times.", or nothing.
std::string stretch_words(double stretch);

/// An entry a run, with markers or lines only.
std::vector<LegendEntry> run_legend(Runs runs, bool markers);
bool same_windows(Runs runs);
/// The averaging windows of all runs as grey behind a panel whose x is time.
void shade_windows(Canvas& canvas, Runs runs);

/// Widens a range by values with their intervals.
void add_estimates(Range& range, std::span<const analysis::Estimate> estimates);
/// Times and values of a series, of long ones the least and greatest of each stretch, and their
/// rows.
using Samples = std::vector<std::pair<double, double>>;
Samples thinned(const Samples& samples);
std::string sample_rows(const Samples& samples);

/// Whether a profile has a value at all.
bool seen(const analysis::Profile& profile);

/// A row of a data file; NaN is written as nan, which gnuplot shows as a gap.
std::string data_row(std::initializer_list<double> values);
/// Closed outlines of a band around a curve, a new one after each gap: rows "across along".
std::string band_outline(std::span<const double> along, std::span<const double> low,
                         std::span<const double> high);
/// The 95 % band of a curve as such outlines, `along` being multiplied by `factor`.
std::string estimate_band(std::span<const double> along,
                          std::span<const analysis::Estimate> estimates, double factor);
/// Error bars as one polyline with gaps (rows "x value"), caps reaching `cap` to both sides. Not by
/// `with yerrorbars`: that blanks what lies beneath the middle, and makes the SVG five times
/// larger.
std::string bar_rows(std::span<const double> x, std::span<const analysis::Estimate> estimates,
                     double cap);
/// gnuplot's words to fill outlines.
std::string band_words(const std::string& colour);
/// The rows of an image, one a line of cells, lateral fastest.
std::string image_rows(std::span<const double> values, std::size_t columns, double factor = 1);
/// gnuplot's words to draw image_rows() at the cells' places, in units of `x_factor`, `z_factor`.
std::string image_words(const analysis::Grid& grid, double x_factor, double z_factor);

}  // namespace bedscope::report
