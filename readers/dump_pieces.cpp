// SPDX-License-Identifier: BSD-3-Clause
// One file per processor: which files are pieces of one snapshot, and which pieces are missing.
#include <algorithm>
#include <map>
#include <set>

#include "readers/columns.hpp"
#include "readers/dump_folder.hpp"
#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

/// Where star `k` stands in a stem; a star of the name's own has a backslash before it.
std::size_t star_at(const std::string& stem, std::size_t k) {
  std::size_t at = stem.find('*');
  while (at != stem.npos && ((at > 0 && stem[at - 1] == '\\') || k-- > 0))
    at = stem.find('*', at + 1);
  return at;
}

/// `dump*.liggghts_*`, `split*_*.bin`, `dump.*.*`: the last number stands at the end or before the
/// suffix, behind "_" or "."; `dump*_*.vtp`, `p*.*.dump`: others may stand anywhere but there.
bool may_count_pieces(const std::string& stem, std::size_t k, std::size_t count) {
  const auto star = star_at(stem, k);
  if (star == stem.npos) return false;
  if (k + 1 < count) return true;
  if (star == 0 || (stem[star - 1] != '_' && stem[star - 1] != '.')) return false;
  return star + 1 == stem.size() || stem[star + 1] == '.';
}

using Numbers = std::vector<std::string>;                // of a name, without that of the piece
using Pieces = std::map<std::int64_t, const DumpUnit*>;  // by that

struct ByValue {
  bool operator()(const Numbers& a, const Numbers& b) const {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(), [](const std::string& x, const std::string& y) {
          return std::pair(to_step(x), x) < std::pair(to_step(y), y);
        });
  }
};
using Candidates = std::map<Numbers, Pieces, ByValue>;

/// By all numbers of the names but number `k`.
Candidates by_other_numbers(const std::vector<DumpUnit>& units, std::size_t k) {
  Candidates candidates;
  for (const auto& unit : units) {
    auto numbers = unit.name.numbers;
    const auto piece = to_step(numbers[k]);
    if (!piece || !unit.indexed.empty()) return {};
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(k));
    if (!candidates[numbers].emplace(*piece, &unit).second) return {};  // dump_01, dump_1
  }
  return candidates;
}

/// Whether an id occurs in two pieces of a snapshot; nothing where there are no ids. Two dumps of
/// one step (before and after a restart) hold the same particles, pieces never do.
std::optional<bool> share_ids(const Form& form, const std::vector<std::string>& files,
                              const std::vector<Located>& first) {
  std::vector<double> ids;
  Snapshot snapshot;
  Scratch scratch;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (first[k].particles == 0) continue;
    if (!first[k].named) return std::nullopt;
    form.read(files[k], first[k], {{"id", false}}, snapshot, scratch);
    if (snapshot.columns[0].empty()) return std::nullopt;
    auto& own = snapshot.columns[0];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    ids.insert(ids.end(), own.begin(), own.end());
  }
  std::sort(ids.begin(), ids.end());
  return std::adjacent_find(ids.begin(), ids.end()) != ids.end();
}

/// Looks into the pieces of one name: the same step, no particle twice.
bool are_pieces(const Form& form, const Pieces& pieces) {
  std::vector<std::string> files;
  std::vector<Located> first;
  try {
    for (const auto& [number, unit] : pieces) {
      files.push_back(unit->files[0]);
      const auto scan = form.scan(files.back(), false);
      if (!scan.not_particles.empty() || scan.snapshots.empty()) return false;
      first.push_back(scan.snapshots[0]);
      if (first.back().step != first.front().step) return false;
    }
    return !share_ids(form, files, first).value_or(first.front().step == no_step);
  } catch (const CutError&) {
    return first.size() > 1 && first.front().step != no_step;  // a run killed at its first dump
  }
}

std::string listed(const std::set<std::int64_t>& numbers) {
  const auto shown = std::vector<std::int64_t>(
      numbers.begin(),
      std::next(numbers.begin(),
                std::min<std::ptrdiff_t>(8, static_cast<std::ptrdiff_t>(numbers.size()))));
  return fmt::format("{}{}", fmt::join(shown, ", "), shown.size() < numbers.size() ? " ..." : "");
}

/// Numbers that others have and this one has not.
std::set<std::int64_t> missing(const std::set<std::int64_t>& all, const Pieces& pieces) {
  auto numbers = all;
  for (const auto& [number, unit] : pieces) numbers.erase(number);
  return numbers;
}

std::string told(const std::string& stem, const Numbers& numbers,
                 const std::set<std::int64_t>& gone) {
  return fmt::format("{}: one file per processor (dump %): step {} has no piece {}", stem,
                     numbers.empty() ? "0" : numbers.back(), listed(gone));
}

void tell_missing(const Candidates& candidates, const std::string& stem,
                  const std::set<std::int64_t>& all, DumpFolder& found) {
  std::size_t incomplete = 0;
  std::string first;
  for (const auto& [numbers, pieces] : candidates) {
    const auto gone = missing(all, pieces);
    if (gone.empty()) continue;
    if (++incomplete == 1) first = told(stem, numbers, gone);
  }
  if (incomplete > 0)
    found.problems.push_back(
        fmt::format("{} ({} of {} snapshots lack pieces; only the particles of those that are "
                    "there count)",
                    first, incomplete, candidates.size()));
}

/// The last snapshot may still be written, or a run was killed there: it lacks pieces that the one
/// before has.
void leave_out_unfinished(Candidates& candidates, const std::string& stem, DumpFolder& found) {
  if (candidates.size() < 2) return;
  const auto last = std::prev(candidates.end());
  std::set<std::int64_t> before;
  for (const auto& [number, unit] : std::prev(last)->second) before.insert(number);
  const auto gone = missing(before, last->second);
  if (gone.empty()) return;
  found.unfinished.push_back(told(stem, last->first, gone));
  candidates.erase(last);
}

/// Joins what differs in number `k` of the names only; false where these are no pieces.
bool join_by(std::size_t k, DumpGroup& group, DumpFolder& found) {
  auto& units = group.units;
  auto stem = units.front().name.stem;
  auto candidates = by_other_numbers(units, k);
  std::set<std::int64_t> all;
  const Pieces* some = nullptr;
  for (const auto& [numbers, pieces] : candidates) {
    for (const auto& [number, unit] : pieces) all.insert(number);
    if (some == nullptr && pieces.size() > 1) some = &pieces;
  }
  if (all.empty() || *all.begin() != 0 || some == nullptr || !are_pieces(*group.form, *some))
    return false;
  leave_out_unfinished(candidates, stem, found);
  tell_missing(candidates, stem, all, found);
  stem.erase(star_at(stem, k), 1);
  std::vector<DumpUnit> joined;
  for (const auto& [numbers, pieces] : candidates) {
    DumpUnit unit;
    unit.name = {stem, numbers};
    for (const auto& [number, piece] : pieces) {
      unit.files.push_back(piece->files[0]);
      unit.pieces.push_back(number);
    }
    joined.push_back(std::move(unit));
  }
  units = std::move(joined);
  return true;
}

}  // namespace

void join_pieces(DumpGroup& group, DumpFolder& found) {
  const auto name = group.units.front().name;
  if (group.units.size() < 2) return;
  for (auto k = name.numbers.size(); k-- > 0;)
    if (may_count_pieces(name.stem, k, name.numbers.size()) && join_by(k, group, found)) return;
}

}  // namespace bedscope::readers
