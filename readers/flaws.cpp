// SPDX-License-Identifier: BSD-3-Clause
#include "readers/flaws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bedscope::readers {
namespace {

constexpr std::size_t named_rows = 4;
/// No fluidised bed is larger; positions beyond come from bytes in the wrong order or a blown-up
/// run.
constexpr double implausible_position = 1e4;  // m

}  // namespace

void Flaws::Kind::add(std::size_t in_snapshot, std::size_t row, double id) {
  if (particles == 0) {
    snapshot = in_snapshot;
    snapshots = 1;
  }
  ++particles;
  if (rows.size() < named_rows) {
    rows.push_back(row);
    ids.push_back(id);
  }
}

void Flaws::Kind::merge(const Kind& later) {
  if (later.particles == 0) return;
  if (particles == 0) {
    *this = later;
    return;
  }
  particles += later.particles;
  snapshots += later.snapshots;
}

void Flaws::merge(const Flaws& later) {
  not_finite.merge(later.not_finite);
  no_size.merge(later.no_size);
  doubled_id.merge(later.doubled_id);
  no_type.merge(later.no_type);
  farthest = std::max(farthest, later.farthest);
}

std::vector<std::string> Flaws::describe(const Series& series) const {
  std::vector<std::string> lines;
  const auto tell = [&](const Kind& kind, const char* what, const char* done) {
    if (kind.particles == 0) return;
    std::string places;
    for (std::size_t k = 0; k < kind.rows.size(); ++k) {
      const auto place = series.place(kind.snapshot, kind.rows[k]);
      places += k == 0 ? place : ", " + place.substr(series.path(kind.snapshot).size() + 2);
      if (std::isfinite(kind.ids[k])) places += fmt::format(" (id {:.0f})", kind.ids[k]);
    }
    const auto in_first =
        kind.snapshots == 1 ? kind.particles : static_cast<std::int64_t>(kind.rows.size());
    lines.push_back(fmt::format(
        "{} particles in {} snapshots {}, {}; first: {}{}", kind.particles, kind.snapshots, what,
        done, places, in_first > static_cast<std::int64_t>(kind.rows.size()) ? ", ..." : ""));
  };
  tell(not_finite, "are not finite (nan or inf in position, velocity or radius)",
       "excluded and counted");
  tell(no_size, "have a radius of zero or less", "excluded from all that needs a size, counted");
  tell(doubled_id, "carry an id that occurs before in the snapshot", "counted as they stand");
  tell(no_type, "have a type that is no whole number", "counted as type 0");
  if (farthest > implausible_position)
    lines.push_back(fmt::format(
        "positions up to {:.3g} m are implausible: is the byte order right (legacy VTK is "
        "big-endian), or did the run blow up?",
        farthest));
  return lines;
}

void find_doubled_ids(std::span<const double> ids, std::size_t snapshot,
                      std::vector<std::uint64_t>& scratch, Flaws& flaws) {
  double largest = 0;
  for (const double id : ids) {
    if (!(id >= 0 && id < 1e15)) return;  // not ids that one can compare
    largest = std::max(largest, id);
  }
  const auto words = static_cast<std::size_t>(largest) / 64 + 1;
  if (words > 64 * ids.size() + 1024) {  // sparse ids: sort rather than mark
    std::vector<std::pair<double, std::size_t>> sorted;
    for (std::size_t row = 0; row < ids.size(); ++row) sorted.emplace_back(ids[row], row);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 1; k < sorted.size(); ++k)
      if (sorted[k].first == sorted[k - 1].first)
        flaws.doubled_id.add(snapshot, sorted[k].second, sorted[k].first);
    return;
  }
  scratch.assign(words, 0);
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const auto id = static_cast<std::uint64_t>(ids[row]);
    const std::uint64_t bit = std::uint64_t{1} << (id % 64);
    if ((scratch[id / 64] & bit) != 0) flaws.doubled_id.add(snapshot, row, ids[row]);
    scratch[id / 64] |= bit;
  }
}

void find_no_types(std::span<const double> types, std::span<const double> ids, std::size_t snapshot,
                   Flaws& flaws) {
  for (std::size_t row = 0; row < types.size(); ++row)
    if (whole_type(types[row]) != types[row])  // nan differs from all
      flaws.no_type.add(snapshot, row, ids.empty() ? unknown : ids[row]);
}

}  // namespace bedscope::readers
