// SPDX-License-Identifier: BSD-3-Clause
// The order of a series, what occurs twice in it, and what changes along it.
#include <algorithm>
#include <cmath>
#include <set>

#include "readers/error.hpp"
#include "readers/series.hpp"

namespace bedscope::readers {

/// By the step inside; where files store none by the time; else by the number of the name.
void Series::order() {
  if (unused_names_)
    problems_.push_back("columns = [...] is not used: the dumps name their columns themselves");
  const bool by_time = order_by_time();
  if (!by_time) {
    for (auto& entry : entries_)
      if (entry.step == no_step) entry.step = 0;
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.step < b.step; });
  }
  take_one_of_repeated(by_time);
  if (!has_steps_)
    for (std::size_t i = 0; i < entries_.size(); ++i)
      entries_[i].step = static_cast<std::int64_t>(i);
}

bool Series::order_by_time() {
  const auto any = [&](auto&& what) { return std::any_of(entries_.begin(), entries_.end(), what); };
  if (any([](const Entry& e) { return e.step_inside || std::isnan(e.time); })) return false;
  const bool numbered = !any([](const Entry& e) { return e.step == no_step; });
  const double first = entries_.front().time;
  if (numbered && entries_.size() > 1 && !any([&](const Entry& e) { return e.time != first; })) {
    problems_.push_back(fmt::format(
        "time {} in all files: not used, the numbers of the file names are the steps", first));
    for (auto& entry : entries_) entry.time = unknown;
    return false;
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.time < b.time; });
  has_steps_ = numbered;
  for (std::size_t i = 1; numbered && has_steps_ && i < entries_.size(); ++i)
    has_steps_ =
        entries_[i - 1].step < entries_[i].step || entries_[i - 1].time == entries_[i].time;
  if (numbered && !has_steps_)
    problems_.emplace_back(
        "the numbers of the file names are not in the order of the times: "
        "sorted by time, steps unknown");
  return true;
}

void Series::take_one_of_repeated(bool by_time) {
  const auto same = [by_time](const Entry& a, const Entry& b) {
    return by_time ? a.time == b.time : a.step == b.step;
  };
  std::vector<Entry> kept;
  std::size_t dropped = 0;
  for (auto& entry : entries_) {
    if (kept.empty() || !same(kept.back(), entry)) {
      kept.push_back(std::move(entry));
      continue;
    }
    if (options_.repeated == Repeated::refuse)
      throw FormatError(
          "{}: {} occurs twice, also in {}: say repeated = \"first\" or \"last\", or name one "
          "dump with a pattern",
          origin(entry),
          by_time ? fmt::format("time {}", entry.time) : fmt::format("step {}", entry.step),
          origin(kept.back()));
    ++dropped;
    if (options_.repeated == Repeated::last) kept.back() = std::move(entry);
  }
  entries_ = std::move(kept);
  if (dropped > 0)
    problems_.push_back(fmt::format("{} repeated {}: the {} of each was taken", dropped,
                                    by_time ? "times" : "steps",
                                    options_.repeated == Repeated::first ? "first" : "last"));
}

/// File and place where an entry begins, if other snapshots may be in the file.
std::string Series::origin(const Entry& entry) const {
  const auto& [file, where] = entry.parts.front();
  if (where.bytes == 0) return files_[file];
  return where.line > 0 ? fmt::format("{} (line {})", files_[file], where.line)
                        : fmt::format("{} (offset {})", files_[file], where.offset);
}

/// Two runs in one folder show by a box or columns that change; said once.
void Series::compare_snapshots() {
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    const auto& a = located(i - 1);
    const auto& b = located(i);
    std::string changes;
    const bool other_columns = a.columns != nullptr && b.columns != nullptr &&
                               *a.columns != *b.columns &&
                               std::set(a.columns->begin(), a.columns->end()) !=
                                   std::set(b.columns->begin(), b.columns->end());
    if (a.box.known && b.box.known && (!b.box.shrink_wrapped || other_columns)) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (a.box.min[axis] != b.box.min[axis] || a.box.max[axis] != b.box.max[axis])
          changes += fmt::format("{}box changes in {} ({}..{} to {}..{})",
                                 changes.empty() ? "" : ", ", "xyz"[axis], a.box.min[axis],
                                 a.box.max[axis], b.box.min[axis], b.box.max[axis]);
    }
    if (other_columns) {
      const auto missing = [](const auto& from, const auto& in) {
        std::string names;
        for (const auto& name : from)
          if (std::find(in.begin(), in.end(), name) == in.end()) names += " " + name;
        return names;
      };
      const auto gone = missing(*a.columns, *b.columns);
      const auto come = missing(*b.columns, *a.columns);
      changes +=
          fmt::format("{}columns change{}{}{}{}", changes.empty() ? "" : ", ",
                      gone.empty() ? "" : ", gone:", gone, come.empty() ? "" : ", new:", come);
    }
    if (changes.empty()) continue;
    problems_.push_back(
        fmt::format("{}: step {}: {}: two runs in one folder?", path(i), step(i), changes));
    return;
  }
}

}  // namespace bedscope::readers
