// SPDX-License-Identifier: BSD-3-Clause
#include "app/recommended.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>

#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace bedscope::app {
namespace {

namespace fs = std::filesystem;
using readers::toml_number;
using readers::toml_text;

/// A text that is changed at places found before the first change.
class Edits {
 public:
  explicit Edits(std::string text) : text_(std::move(text)), lines_{0} {
    for (std::size_t i = 0; i < text_.size(); ++i)
      if (text_[i] == '\n') lines_.push_back(i + 1);
  }

  void replace(const toml::source_position& from, const toml::source_position& to,
               std::string with) {
    edits_.push_back({offset(from), offset(to) - offset(from), std::move(with)});
  }
  void insert(const toml::source_position& at, std::size_t behind, std::string what) {
    edits_.push_back({offset(at) + behind, 0, std::move(what)});
  }
  void insert_line_after(const toml::source_position& at, const std::string& line) {
    const std::size_t next = at.line < lines_.size() ? lines_[at.line] : text_.size();
    const bool ended = next > 0 && text_[next - 1] == '\n';
    edits_.push_back({next, 0, (ended ? "" : "\n") + line + "\n"});
  }
  void insert_before_line(const toml::source_position& at, const std::string& lines) {
    edits_.push_back({lines_[at.line - 1], 0, lines});
  }
  void append(const std::string& lines) {
    edits_.push_back({text_.size(), 0, (text_.ends_with('\n') ? "" : "\n") + lines});
  }

  std::string result() {
    std::stable_sort(edits_.begin(), edits_.end(),
                     [](const Edit& a, const Edit& b) { return a.at < b.at; });
    std::string out;
    std::size_t from = 0;
    for (const auto& edit : edits_) {
      out.append(text_, from, edit.at - from);
      out += edit.with;
      from = edit.at + edit.length;
    }
    return out + text_.substr(from);
  }

 private:
  struct Edit {
    std::size_t at, length;
    std::string with;
  };
  /// Columns count characters, not bytes.
  std::size_t offset(const toml::source_position& at) const {
    std::size_t i = lines_.at(at.line - 1);
    for (auto left = at.column - 1; left > 0 && i < text_.size(); --left)
      for (++i; i < text_.size() && (static_cast<unsigned char>(text_[i]) & 0xC0) == 0x80;) ++i;
    return i;
  }

  std::string text_;
  std::vector<std::size_t> lines_;  // offset of each
  std::vector<Edit> edits_;
};

bool is_block(const toml::table* table) { return table != nullptr && !table->is_inline(); }

/// Sets keys of [scene] and of the [[run]]s.
class StudyEditor {
 public:
  StudyEditor(const toml::table& root, Edits& edits) : edits_(edits) {
    scene_ = root["scene"].as_table();
    if (const auto* runs = root["run"].as_array())
      for (const auto& run : *runs) runs_.push_back(run.as_table());
  }

  /// `line` gives "key = value" for a run; `names` are the keys that it replaces.
  void set(std::initializer_list<std::string_view> names,
           const std::function<std::string(std::size_t)>& line) {
    std::vector<std::size_t> others;
    for (std::size_t r = 0; r < runs_.size(); ++r)
      if (!replace(*runs_[r], names, line(r))) others.push_back(r);
    if (others.empty()) return;
    const auto first = line(others.front());
    const bool same =
        std::all_of(others.begin(), others.end(), [&](std::size_t r) { return line(r) == first; });
    if (same && scene_ != nullptr && replace(*scene_, names, first)) return;
    if (same && is_block(scene_)) {
      edits_.insert_line_after(scene_->source().begin, first);
    } else if (same && scene_ == nullptr && is_block(runs_.front())) {
      new_scene_ += first + "\n";
    } else {
      for (const auto r : others) add(*runs_[r], line(r));
    }
  }

  void finish() {
    if (!new_scene_.empty())
      edits_.insert_before_line(runs_.front()->source().begin, "[scene]\n" + new_scene_ + "\n");
  }

 private:
  bool replace(const toml::table& table, std::initializer_list<std::string_view> names,
               const std::string& line) {
    for (const auto& [key, node] : table)
      if (std::find(names.begin(), names.end(), key.str()) != names.end()) {
        edits_.replace(key.source().begin, node.source().end, line);
        return true;
      }
    return false;
  }
  void add(const toml::table& table, const std::string& line) {
    if (table.is_inline())
      edits_.insert(table.source().begin, 1, fmt::format(" {},", line));
    else
      edits_.insert_line_after(table.source().begin, line);
  }

  Edits& edits_;
  const toml::table* scene_ = nullptr;
  std::vector<const toml::table*> runs_;
  std::string new_scene_;
};

/// Relative paths of the study, as they are called from another folder.
class Paths {
 public:
  Paths(fs::path from, fs::path to, Edits& edits)
      : from_(std::move(from)), to_(std::move(to)), edits_(edits) {}

  void move(const toml::node* node) {
    const auto path = node == nullptr ? std::string() : node->value_or(std::string{});
    if (!path.empty() && !fs::path(path).is_absolute()) put(*node, moved(path));
  }
  /// What a check is held against: a name of the registry, or a file.
  void move_reference(const toml::node* node) {
    const auto text = node == nullptr ? std::string() : node->value_or(std::string{});
    constexpr std::string_view baseline = "baseline:";
    std::error_code none;
    if (text.starts_with(baseline) && !fs::path(text.substr(baseline.size())).is_absolute())
      put(*node, std::string(baseline) + moved(text.substr(baseline.size())));
    else if (!text.empty() && !fs::path(text).is_absolute() &&
             fs::is_regular_file(from_ / text.substr(0, text.find('?')), none))
      put(*node, moved(text));
  }

 private:
  std::string moved(const std::string& path) const {
    return (from_ / path).lexically_normal().lexically_relative(to_).string();
  }
  void put(const toml::node& node, const std::string& text) {
    edits_.replace(node.source().begin, node.source().end, toml_text(text));
  }

  fs::path from_, to_;
  Edits& edits_;
};

void move_paths(const toml::table& root, Paths& paths) {
  if (const auto* runs = root["run"].as_array())
    for (const auto& run : *runs)
      for (const auto* key : {"particles", "tables", "probes", "gas"})
        paths.move(run.as_table()->get(key));
  if (const auto* curves = root["curves"].as_array())
    for (const auto& one : *curves) paths.move(&one);
  if (const auto* checks = root["check"].as_array())
    for (const auto& check : *checks) paths.move_reference(check.as_table()->get("against"));
}

void set_band(const toml::table& root, double band, Edits& edits) {
  const auto* profiles = root["profiles"].as_table();
  if (profiles != nullptr && profiles->contains("band")) return;
  const auto line = fmt::format("band = {}", band);
  if (is_block(profiles))
    edits.insert_line_after(profiles->source().begin, line);
  else if (profiles != nullptr)
    edits.insert(profiles->source().begin, 1, fmt::format(" {},", line));
  else
    edits.append(fmt::format("\n[profiles]\n{}\n", line));
}

}  // namespace

std::string changed_study(const std::string& path, const StudyChanges& changes,
                          const fs::path& folder) {
  const auto root = readers::parse_toml(path);
  std::ifstream file(path, std::ios::binary);
  Edits edits({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
  Paths paths(fs::weakly_canonical(fs::absolute(path).parent_path()),
              fs::weakly_canonical(fs::absolute(folder)), edits);
  move_paths(root, paths);
  StudyEditor study(root, edits);
  if (changes.mapping)
    study.set({"mapping"}, [&](std::size_t) {
      return fmt::format("mapping = {}", toml_text(*changes.mapping));
    });
  if (changes.every)
    study.set({"every"}, [&](std::size_t) { return fmt::format("every = {}", *changes.every); });
  const auto& runs = changes.runs;
  if (!runs.empty() && !runs.front().cells.empty()) {
    study.set({"cell", "cells"}, [&](std::size_t r) {
      return fmt::format("cells = [{}]", fmt::join(runs[r].cells, ", "));
    });
    set_band(root, runs.front().band, edits);
  }
  if (!runs.empty() && runs.front().average)
    study.set({"average"}, [&](std::size_t r) {
      const auto [from, to] = *runs[r].average;
      return fmt::format("average = {{ from = {}, to = {} }}", toml_number(from), toml_number(to));
    });
  study.finish();
  return edits.result();
}

}  // namespace bedscope::app
