// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_row.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "readers/numbers.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

bool separates(char c) { return is_blank(c) || c == ','; }

}  // namespace

std::string FoamRow::parse(std::string_view text) {
  leaves.clear();
  std::array<std::size_t, deepest> place{}, first_leaf{};
  std::size_t depth = 0, item = 0;
  const auto next = [&] { ++(depth == 0 ? item : place[depth - 1]); };
  for (std::size_t at = 0; at < text.size();) {
    if (separates(text[at])) {
      ++at;
    } else if (text[at] == '(') {
      if (depth == deepest) return fmt::format("expected at most {} levels of '('", deepest);
      place[depth] = 0;
      first_leaf[depth++] = leaves.size();
      ++at;
    } else if (text[at] == ')') {
      if (depth == 0) return "expected a value, found ')'";
      --depth;
      for (std::size_t l = first_leaf[depth]; l < leaves.size(); ++l)
        leaves[l].count[depth] = place[depth];
      next();
      ++at;
    } else {
      // A word may have parentheses of its own: mag(U).
      std::size_t end = at, open = 0;
      for (; end < text.size() && !separates(text[end]); ++end) {
        open += text[end] == '(';
        if (text[end] == ')' && open-- == 0) break;
      }
      Leaf leaf;
      leaf.text = text.substr(at, end - at);
      leaf.is_number = parse_number(text.data() + at, text.data() + end, leaf.number);
      leaf.item = item;
      leaf.depth = depth;
      leaf.place = place;
      leaves.push_back(leaf);
      next();
      at = end;
    }
  }
  if (depth > 0) return "expected ')', found the end of the line";
  return leaves.empty() ? "expected values, found none" : "";
}

std::string leaf_title(const std::string& item, const FoamRow::Leaf& leaf) {
  std::string title = item;
  const auto open = item.find('(');
  for (std::size_t level = 0; level < leaf.depth; ++level) {
    if (level == 0 && leaf.depth > 1 && open != item.npos && item.back() == ')') {
      FoamRow names;
      const auto inside = std::string_view(item).substr(open + 1, item.size() - open - 2);
      if (names.parse(inside).empty() && names.leaves.size() == leaf.count[0]) {
        title = item.substr(0, open) + " " + std::string(names.leaves[leaf.place[0]].text);
        continue;
      }
    }
    const bool vector = leaf.count[level] == 3 && level + 1 == leaf.depth;
    title += vector ? std::string(" ") + "xyz"[leaf.place[level]]
                    : fmt::format(" {}", leaf.place[level]);
  }
  return title;
}

std::vector<std::string> split_titles(std::string_view line) {
  std::vector<std::string> titles;
  std::string title;
  int open = 0;
  for (const char c : line) {
    open += (c == '(') - (c == ')');
    if (is_blank(c) && (open <= 0 || c == '\t')) {
      if (!title.empty()) titles.push_back(std::move(title));
      title.clear();
    } else {
      title += c;
    }
  }
  if (!title.empty()) titles.push_back(std::move(title));
  return titles;
}

std::string field_name(const std::string& path) {
  auto name = std::filesystem::path(path).filename().string();
  for (const std::string_view ending : {".gz", ".dat"})
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return name;
}

}  // namespace bedscope::readers
