// SPDX-License-Identifier: BSD-3-Clause
// Holdup and velocity of clusters across the riser.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"
#include "report/figure_parts.hpp"

namespace bedscope::report {

using analysis::Cluster;
using analysis::Estimate;
using analysis::RunResult;

namespace {

constexpr std::size_t lateral_bins = 10, fewest_in_bin = 5;

struct BinnedMean {
  double x = 0;
  Estimate mean;
};

/// Mean over the clusters of each lateral bin; NaN in bins of too few. Clusters of one snapshot and
/// of neighbouring ones are not independent: the interval is that of a ratio of the snapshots'
/// sums.
std::vector<BinnedMean> binned_means(const RunResult& run, double Cluster::*value) {
  const double lo = run.grid.min[analysis::lateral];
  const double width = run.grid.length(analysis::lateral) / static_cast<double>(lateral_bins);
  const std::size_t snapshots = run.window.snapshots;
  std::vector<std::vector<double>> sums(lateral_bins, std::vector<double>(snapshots)),
      counts = sums;
  std::vector<std::size_t> total(lateral_bins);
  for (const Cluster& cluster : run.clusters) {
    const double place = (cluster.centre.x - lo) / width;
    if (!(place >= 0) || place > static_cast<double>(lateral_bins)) continue;
    if (!std::isfinite(cluster.*value) || cluster.snapshot < run.window.first) continue;
    const std::size_t bin = std::min(static_cast<std::size_t>(place), lateral_bins - 1);
    const std::size_t snapshot = cluster.snapshot - run.window.first;
    if (snapshot >= snapshots) continue;
    sums[bin][snapshot] += cluster.*value;
    counts[bin][snapshot] += 1;
    ++total[bin];
  }
  const std::vector<double> weights(snapshots, 1.0);
  std::vector<BinnedMean> means;
  for (std::size_t b = 0; b < lateral_bins; ++b) {
    BinnedMean bin{lo + (static_cast<double>(b) + 0.5) * width, {}};
    if (total[b] >= fewest_in_bin) {
      bin.mean = analysis::estimate_ratio(sums[b], counts[b], weights);
    }
    means.push_back(bin);
  }
  return means;
}

/// Points of single clusters, thinned evenly where there are more than can be told apart.
std::string cluster_rows(const RunResult& run, double Cluster::*value, double factor) {
  constexpr std::size_t most = 1500;
  const std::size_t every = run.clusters.size() / most + 1;
  std::string rows;
  for (std::size_t i = 0; i < run.clusters.size(); i += every) {
    const Cluster& cluster = run.clusters[i];
    if (std::isfinite(cluster.*value)) {
      rows += data_row({factor * cluster.centre.x, cluster.*value});
    }
  }
  return rows;
}

/// A quantity of the clusters of all runs.
struct Row {
  std::string label;
  double Cluster::*value;
  std::vector<std::vector<BinnedMean>> means;  ///< of each run
  Range range;
};

Row make_row(Runs runs, std::string label, double Cluster::*value) {
  Row row{std::move(label), value, {}, {}};
  for (const RunResult& run : runs) {
    row.means.push_back(binned_means(run, value));
    for (const Cluster& cluster : run.clusters) row.range.add(cluster.*value);
  }
  // Room for the intervals, but a bin of few clusters shall not flatten all others: cut at the
  // frame.
  const Range points = row.range;
  for (const auto& means : row.means) {
    for (const BinnedMean& bin : means) {
      row.range.add(std::max(bin.mean.value - bin.mean.ci95, 1.5 * points.lo - 0.5 * points.hi));
      row.range.add(std::min(bin.mean.value + bin.mean.ci95, 1.5 * points.hi - 0.5 * points.lo));
    }
  }
  return row;
}

/// The points of a run, and its means.
void add_points(Canvas& canvas, const RunResult& run, const Row& row, double x_factor,
                std::vector<std::string>& layers) {
  const std::string dots = cluster_rows(run, row.value, x_factor);
  if (dots.empty()) return;
  layers.push_back(Canvas::layer(canvas.block(run.label + ": x, " + row.label, dots),
                                 "using 1:2 with points pt 7 ps 0.18 lc rgb '#A0A0A0'"));
}

void add_means(Canvas& canvas, const RunResult& run, std::size_t r, const Row& row, double x_factor,
               double cap, std::vector<std::string>& layers) {
  const CurveStyle style = curve_style(r);
  std::string rows;
  std::vector<double> places;
  std::vector<Estimate> means;
  for (const BinnedMean& bin : row.means[r]) {
    places.push_back(x_factor * bin.x);
    means.push_back(bin.mean);
    rows += data_row({places.back(), bin.mean.value, bin.mean.ci95});
  }
  if (const std::string bars = bar_rows(places, means, cap); !bars.empty()) {
    layers.push_back(
        Canvas::layer(canvas.block("bars of " + run.label + ": x, " + row.label, bars),
                      fmt::format("using 1:2 with lines lw 1.0 lc rgb '{}'", style.colour)));
  }
  const std::size_t block = canvas.block(run.label + ": x, mean of " + row.label + ", ci95", rows);
  layers.push_back(Canvas::layer(block, fmt::format("using 1:2 with lines {} lw 1.3", style.line)));
  layers.push_back(Canvas::layer(
      block, fmt::format("using 1:2 with points {} lc rgb '{}'", style.marker, style.colour)));
}

}  // namespace

Figure clusters_lateral_figure(Runs runs) {
  const std::string name = "clusters_lateral", title = "Clusters against lateral position";
  if (std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.clusters.empty(); })) {
    return left_out(name, title, "no clusters found in the window");
  }
  const Row rows[] = {make_row(runs, holdup_label(runs, "cluster holdup"), &Cluster::holdup),
                      make_row(runs, "cluster velocity v_z [m/s]", &Cluster::velocity_z)};
  // A panel a run with its points, and one more where the means of all are compared.
  const bool several = runs.size() > 1, points = runs.size() <= 5;
  const std::size_t own = points ? runs.size() : 0, columns = own + (several ? 1 : 0);
  constexpr double left = 19, bottom = 11, gap = 4, row_height = 54, top = 5.5;
  const double width =
      std::min((page_width - left - 4 + gap) / static_cast<double>(columns) - gap, 80.0);
  const double total = left + static_cast<double>(columns) * (width + gap) - gap + 4;
  const std::vector<LegendEntry> entries = run_legend(runs, true);
  const double legend = several ? Canvas::legend_height(entries, total - left) + 1 : 0;
  Canvas canvas(total, bottom + 2 * row_height + gap + top + legend);
  if (several) canvas.legend(entries, left, canvas.height() - 0.5, total - left);
  const Range x = domain_range(runs, analysis::lateral);
  const Unit unit = length_unit(x.hi - x.lo);

  for (const Row& row : rows) {
    const bool upper = &row == rows;
    for (std::size_t c = 0; c < columns; ++c) {
      Panel panel;
      panel.left = left + static_cast<double>(c) * (width + gap);
      panel.bottom = bottom + (upper ? row_height + gap : 0);
      panel.width = width;
      panel.height = row_height;
      panel.x = exact_axis(x.lo * unit.factor, x.hi * unit.factor,
                           width < 20   ? 2
                           : width < 30 ? 4
                                        : 5);
      panel.y = rounded_axis(row.range.lo, row.range.hi, 6);
      panel.x_numbers = !upper;
      panel.y_numbers = c == 0;
      if (!upper) panel.x_label = literal(fmt::format("x [{}]", unit.name));
      if (c == 0) panel.y_label = literal(row.label);
      panel.y_label_gap = 13;
      panel.zero_line = true;
      panel.neighbour = c + 1 < columns;
      canvas.open(panel);
      if (upper && several) {
        const std::string words = c < own ? runs[c].label : "means of all runs";
        canvas.user_label(shortened(words, width + gap), panel.left + width / 2,
                          panel.bottom + row_height + 2.6);
      }
      const double cap = bar_cap * (panel.x.hi - panel.x.lo) / width;
      std::vector<std::string> layers;
      for (std::size_t r = 0; r < runs.size(); ++r) {
        if (c < own && c != r) continue;
        if (c < own) add_points(canvas, runs[r], row, unit.factor, layers);
        add_means(canvas, runs[r], r, row, unit.factor, cap, layers);
      }
      canvas.draw(layers);
    }
  }
  return drawn(
      canvas, name, title,
      fmt::format(
          "Holdup and vertical velocity of clusters against the lateral position of their "
          "centre. {}Lines: mean over the clusters in each of {} bins, where it holds {} or "
          "more; bars: 95 % confidence interval of the mean. {}. {}. {}.",
          points ? "Grey points: single clusters (about 1500 a run at most). " : "", lateral_bins,
          fewest_in_bin, threshold_words(runs), window_words(runs), mapping_words(runs)));
}

}  // namespace bedscope::report
