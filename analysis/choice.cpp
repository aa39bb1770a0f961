// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/choice_sums.hpp"

namespace bedscope::analysis {
namespace {

/// The study's settings with all that it leaves open said, so that a variant changes one thing.
RunSettings explicit_settings(const RunSetup& study) {
  auto settings = study.settings;
  settings.every = 1;
  settings.heights = study.heights;
  settings.band = study.band;
  settings.bubbles.reset();
  settings.spectra = false;
  return settings;
}

void set_cells(RunSettings& settings, const Grid& grid, int coarser, int in_depth) {
  settings.cell.clear();
  settings.cells = {grid.cells[lateral] / coarser, grid.cells[up] / coarser};
  if (in_depth > 1)
    settings.cells = {grid.cells[lateral] / coarser, in_depth, grid.cells[up] / coarser};
}

}  // namespace

std::vector<int> fitting_multiples(const Grid& grid) {
  std::vector<int> fitting;
  for (int k = 1; k <= 8; ++k) {
    const int across = grid.cells[lateral], upwards = grid.cells[up];
    const bool fits = across % k == 0 && upwards % k == 0 && across / k >= 3 && upwards / k >= 4;
    if (k == 1 || fits) fitting.push_back(k);
  }
  return fitting;
}

std::vector<Variant> variants_of(const RunSetup& study, std::span<const int> multiples) {
  const auto& grid = study.grid;
  const auto base = explicit_settings(study);
  const int depth_cells = grid.cells[depth];
  std::vector<Variant> variants;
  const auto add = [&](const std::string& mapping, int coarser, int in_depth) -> Variant& {
    auto& variant = variants.emplace_back();
    variant.mapping = mapping;
    variant.coarser = coarser;
    variant.name = fmt::format("{}, cells x {}", mapping, coarser);
    variant.settings = base;
    variant.settings.mapping = mapping;
    set_cells(variant.settings, grid, coarser, in_depth);
    variant.present = mapping == base.mapping && coarser == 1 && in_depth == depth_cells;
    return variant;
  };
  // Cells in depth are widened with the others where they can be.
  const auto in_depth = [&](int coarser) {
    return depth_cells % coarser == 0 ? std::max(1, depth_cells / coarser) : depth_cells;
  };
  std::vector<std::string> mappings{"exact", "centre"};
  if (base.mapping != "exact" && base.mapping != "centre") mappings.push_back(base.mapping);
  for (const auto& mapping : mappings)
    for (const int coarser : multiples) add(mapping, coarser, in_depth(coarser));
  for (const auto* mapping : {"divided", "gaussian"})
    if (mapping != base.mapping) add(mapping, 1, depth_cells);
  if (depth_cells > 1) {
    add(base.mapping, 1, 1).name += ", depth-averaged";
  } else {
    const int cells =
        std::max(2, static_cast<int>(std::lround(grid.length(depth) / grid.width(lateral))));
    auto& other = add(base.mapping, 1, cells);
    other.name += fmt::format(", {} cells in depth", cells);
    other.candidate = false;
  }
  const auto shown = [&](const std::string& what) -> Variant& {
    auto& variant = add(base.mapping, 1, depth_cells);
    variant.name = what;
    variant.candidate = variant.present = false;
    return variant;
  };
  using readers::DumpForm;
  for (const auto form : {DumpForm::text, DumpForm::binary, DumpForm::vtk})
    shown(readers::name_of(form)).form = form;
  if (base.wanted.clusters) {
    for (const double factor : {0.9, 1.1}) {
      shown(fmt::format("cluster threshold x {}", factor)).settings.clusters.threshold *= factor;
      shown(fmt::format("cluster core x {}", factor)).settings.clusters.core *= factor;
    }
    for (const double factor : {0.5, 2.0})
      shown(fmt::format("cluster min_area x {}", factor)).settings.clusters.min_area *= factor;
  }
  return variants;
}

std::vector<int> thinnings(std::size_t snapshots) {
  static constexpr std::array all{1, 2, 3, 4, 6, 8, 12, 16};
  std::vector<int> fitting;
  for (const int n : all)
    if (snapshots / window_blocks >= static_cast<std::size_t>(n)) fitting.push_back(n);
  return fitting;
}

}  // namespace bedscope::analysis
