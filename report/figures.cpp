// SPDX-License-Identifier: BSD-3-Clause
#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "analysis/output_file.hpp"
#include "readers/error.hpp"
#include "report/figure_parts.hpp"
#include "report/gnuplot.hpp"

namespace bedscope::report {

namespace fs = std::filesystem;

namespace {

constexpr std::array figure_names{
    "fields",     "axial_holdup", "axial_holdup_species", "lateral",     "inventory",
    "occurrence", "snapshots",    "clusters_lateral",     "temperature", "temperature_pdf",
    "bed_height", "bubbles",      "bubble_profile",       "spectra",     "gas_axial",
    "gas_lateral"};

/// Whether a file in figures/ comes from a report: name or name_2 with one of our endings.
bool is_ours(const fs::path& file) {
  static const std::set<std::string> endings{".svg", ".png", ".gp", ".dat"};
  if (!endings.contains(file.extension().string())) return false;
  std::string stem = file.stem().string();
  const std::size_t digits = stem.find_last_not_of("0123456789");
  if (digits != std::string::npos && digits + 1 < stem.size() && stem[digits] == '_') {
    stem.resize(digits);
  }
  return std::find(figure_names.begin(), figure_names.end(), stem) != figure_names.end();
}

/// A folder for half-made files, removed at the end of its life.
class WorkFolder {
 public:
  explicit WorkFolder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    fs::remove_all(path_, error);
    fs::create_directories(path_, error);
    if (error) throw FileError("{}: {}", path_.string(), error.message());
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

/// What gnuplot has no words for. Cells stay cells: viewers would smooth the maps that it embeds.
/// And the spaces around symbols stay: some viewers drop them where the font changes.
void finish_svg(const fs::path& svg) {
  std::ifstream file(svg, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  replace_all(text, "<image ", "<image style='image-rendering:pixelated' ");
  replace_all(text, "<text>", "<text xml:space='preserve'>");
  analysis::write_file(svg, text);
}

/// SVG and PNG of all figures are so many tasks, dealt out to a process a core.
std::vector<std::string> drivers(std::span<const Figure* const> figures, bool png) {
  std::vector<std::string> tasks;
  for (const Figure* figure : figures) {
    tasks.push_back(fmt::format("forms = 'svg'\nload '{}.gp'\n", figure->name));
    if (png) tasks.push_back(fmt::format("forms = 'png'\nload '{}.gp'\n", figure->name));
  }
  const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 4);
  std::vector<std::string> dealt(std::min(cores, tasks.size()));
  // In pairs with the order turned each time, as a PNG takes longer than an SVG.
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::size_t round = i / dealt.size(), place = i % dealt.size();
    dealt[round % 2 == 0 ? place : dealt.size() - 1 - place] += tasks[i];
  }
  return dealt;
}

}  // namespace

std::vector<Figure> make_figures(Runs runs) {
  std::vector<Figure> figures{fields_figure(runs), axial_figure(runs), axial_species_figure(runs)};
  const auto add = [&](std::vector<Figure> more) {
    std::move(more.begin(), more.end(), std::back_inserter(figures));
  };
  add(lateral_figures(runs));
  add(gas_figures(runs));
  figures.push_back(inventory_figure(runs));
  figures.push_back(occurrence_figure(runs));
  figures.push_back(clusters_lateral_figure(runs));
  add(snapshots_figures(runs));
  add(bed_figures(runs));
  figures.push_back(temperature_figure(runs));
  figures.push_back(temperature_pdf_figure(runs));
  return figures;
}

void draw_figures(std::span<const Figure> figures, const fs::path& folder, bool png) {
  std::vector<const Figure*> drawn;
  for (const Figure& figure : figures) {
    if (figure.missing.empty()) drawn.push_back(&figure);
  }
  const WorkFolder work(folder / ".part");
  for (const Figure* figure : drawn) {
    analysis::write_file(work.path() / (figure->name + ".gp"), figure->script);
    analysis::write_file(work.path() / (figure->name + ".dat"), figure->data);
  }
  run_gnuplot(drivers(drawn, png), work.path());

  std::set<std::string> kept;
  for (const Figure* figure : drawn) {
    finish_svg(work.path() / (figure->name + ".svg"));
    for (const std::string ending : {".gp", ".dat", ".svg", ".png"}) {
      if (ending == ".png" && !png) continue;
      const std::string name = figure->name + ending;
      std::error_code error;
      fs::rename(work.path() / name, folder / name, error);
      if (error) throw FileError("{}: {}", (folder / name).string(), error.message());
      kept.insert(name);
    }
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_ours(entry.path()) && !kept.contains(entry.path().filename().string())) {
      std::error_code ignored;  // an old figure that stays does not spoil the new ones
      fs::remove(entry.path(), ignored);
    }
  }
}

}  // namespace bedscope::report
