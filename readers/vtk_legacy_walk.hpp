// SPDX-License-Identifier: BSD-3-Clause
// The sections of a legacy VTK file. Internal to this room.
// Reference: VTK file formats (vtk.org), sections "Simple Legacy Formats" and, for 5.1, the OFFSETS
// and CONNECTIVITY arrays of cells.
#pragma once

#include <array>

#include "readers/columns.hpp"
#include "readers/snapshot.hpp"
#include "readers/vtk_common.hpp"
#include "readers/vtk_legacy_data.hpp"

namespace bedscope::readers::vtk_legacy_file {

inline constexpr std::string_view magic = "# vtk DataFile Version ";

struct CellArray {
  std::string name;
  std::size_t components = 1;
};

/// The cells of an UNSTRUCTURED_GRID as they are on disk, and what is known of them.
struct LegacyCells {
  bool offsets_form = false;           ///< since 5.0: `offsets` of each cell and the end
  std::vector<double> stream;          ///< points; in the old form each cell's number before them
  std::vector<double> offsets, types;  ///< of each cell
  std::vector<CellArray> arrays;       ///< of CELL_DATA, in the order of the file
  std::vector<std::vector<double>> values;  ///< components of the array that was wanted
  std::vector<double> ghosts;               ///< vtkGhostType of each cell, where it is there
};

/// One way through a file from front to back: learns what it holds, and decodes the columns that
/// are wanted on the way. Flat columns are numbered as they come: the points (x y z), then the
/// point arrays, component by component.
class LegacyWalk : private LegacyData {
 public:
  /// `path` and `buffer` must outlive it.
  LegacyWalk(const std::string& path, std::vector<char>& buffer,
             std::size_t piece = ByteWindow::piece)
      : LegacyData(path, buffer, piece) {}

  using LegacyData::bytes_from_disk;
  using LegacyData::trailing;

  /// Where flat column `column` goes; before run().
  void want(int column, std::vector<double>& values) {
    if (targets_.size() <= static_cast<std::size_t>(column)) targets_.resize(column + 1, nullptr);
    targets_[static_cast<std::size_t>(column)] = &values;
  }

  /// Reads the header down to the number of points, which is all that a glance needs.
  void run_to_points() {
    only_points_ = true;
    run();
  }

  void run() {
    prologue();
    while (!done_) {
      const auto line = keyword_line();
      if (!line) break;
      section(*line);
    }
    if (points_ < 0 && !other_dataset_) fail("no POINTS in this {} file", dataset_);
  }

  std::int64_t points() const { return std::max<std::int64_t>(points_, 0); }
  const std::vector<std::string>& names() const { return flat_names_; }
  const std::vector<std::string>& arrays() const { return arrays_; }
  double time() const { return time_; }
  bool binary() const { return binary_; }
  bool single_points() const { return single_points_; }  ///< float, not double

  /// Which points are copies of another file's; empty where no array tells. Known after run().
  std::vector<bool> ghosts() const {
    if (ghost_values_ == nullptr) return {};
    std::vector<bool> marked(ghost_values_->size());
    mark_ghosts(ghost_array_, *ghost_values_, 0, marked);
    return marked;
  }

  /// Has the cells and, of the arrays of CELL_DATA, `array` decoded by run().
  void want(LegacyCells& cells, std::string array = {}) {
    cells_ = &cells;
    cell_array_ = std::move(array);
  }

  /// What the file is, where it is not particles; empty for particles.
  std::string not_particles() const {
    if (dataset_ == "RECTILINEAR_GRID")
      return fmt::format("a RECTILINEAR_GRID{}, not particles",
                         dimensions_ == " 2 2 2" ? " bounding box companion" : "");
    if (other_dataset_) return fmt::format("a {}, not particles", dataset_);
    const auto has = [&](std::string_view name) {
      return std::find(arrays_.begin(), arrays_.end(), name) != arrays_.end();
    };
    if (polygons_ > 0)
      return fmt::format("a triangle mesh ({} polygons{}{}), not particles", polygons_,
                         vertices_ > 0 ? "" : ", no vertices", cell_data_ ? ", cell data" : "");
    if (lines_ > 0) return fmt::format("{} lines (contacts?), not particles", lines_);
    if (other_cells_ > 0) return fmt::format("a mesh of {} cells, not particles", other_cells_);
    if (has("volumefraction") && has("v_avg"))
      return "averages on an Eulerian grid (dump euler/vtk), not particles";
    if (points_ > 0 && vertices_ == 0 && !has_column(flat_names_, "radius"))
      return "points without vertices and without a radius, not particles";
    return {};
  }

 private:
  void prologue() {
    auto line = need_line("\"# vtk DataFile Version\"");
    if (!line.starts_with(magic)) fail("expected \"{}\", found \"{}\"", magic, line.substr(0, 40));
    std::string_view rest = line.substr(magic.size());
    auto word = next_word(rest);
    if (word.ends_with('.')) word.remove_suffix(1);  // "Version 3.0." of Yade's export
    double version = 0;
    if (!parse_number(word.data(), word.data() + word.size(), version) || version < 1 ||
        version > 5.1)
      fail("legacy VTK version {} not known (1.0 to 5.1 are)", word);
    offsets_form_ = version >= 5;
    need_line("a title");
    line = need_line("ASCII or BINARY");
    rest = line;
    const auto encoding = lower_case(next_word(rest));
    if (encoding != "ascii" && encoding != "binary")
      fail("expected ASCII or BINARY, found \"{}\"", line.substr(0, 40));
    binary_ = encoding == "binary";
    const auto dataset = keyword_line();
    rest = dataset ? *dataset : std::string_view{};
    if (upper_case(next_word(rest)) != "DATASET")
      fail("expected DATASET, found {}",
           dataset ? fmt::format("\"{}\"", dataset->substr(0, 40)) : "end of file");
    dataset_ = upper_case(next_word(rest));
    if (dataset_ == "RECTILINEAR_GRID" || dataset_ == "STRUCTURED_POINTS" ||
        dataset_ == "STRUCTURED_GRID" || dataset_ == "FIELD") {
      other_dataset_ = true;
      if (const auto line_of_size = keyword_line();
          line_of_size && line_of_size->starts_with("DIMENSIONS"))
        dimensions_ = line_of_size->substr(10);
      while (dimensions_.ends_with(' ')) dimensions_.pop_back();
      done_ = true;
    } else if (dataset_ != "POLYDATA" && dataset_ != "UNSTRUCTURED_GRID") {
      fail("dataset \"{}\" not known", dataset_);
    }
  }

  void section(std::string_view line) {
    std::string_view rest = line;
    const auto keyword = upper_case(next_word(rest));  // VTK takes any case
    if (keyword == "POINTS") {
      if (points_ >= 0) fail("POINTS twice");
      points_ = count(next_word(rest), "POINTS");
      const auto& type = find_type(next_word(rest));
      single_points_ = type.kind == Kind::real && type.size == 4;
      if (only_points_) {
        done_ = true;
        return;
      }
      check_room(points_, 3, type.size, "POINTS");
      flat_names_.insert(flat_names_.end(), {"x", "y", "z"});
      data(type, points_, 3, "POINTS");
    } else if (keyword == "VERTICES" || keyword == "LINES" || keyword == "POLYGONS" ||
               keyword == "TRIANGLE_STRIPS" || keyword == "CELLS") {
      cells(keyword, rest);
    } else if (keyword == "CELL_TYPES") {
      cell_types(count(next_word(rest), "CELL_TYPES"));
    } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      in_point_data_ = keyword == "POINT_DATA";
      in_data_ = true;
      tuples_ = count(next_word(rest), keyword == "POINT_DATA" ? "POINT_DATA" : "CELL_DATA");
      if (!in_point_data_) cell_data_ = cell_data_ || tuples_ > 0;
      if (in_point_data_ && tuples_ != points_)
        fail("POINT_DATA of {} tuples, {} points", tuples_, points_);
    } else if (keyword == "FIELD") {
      next_word(rest);
      field(count(next_word(rest), "FIELD"));
    } else if (keyword == "SCALARS") {
      const std::string name = decode_name(next_word(rest));
      const Type& type = find_type(next_word(rest));
      const auto components = next_word(rest);
      const auto number = components.empty() ? 1 : count(components, "SCALARS");
      const auto table = keyword_line();
      if (!table || !upper_case(*table).starts_with("LOOKUP_TABLE"))
        fail("expected LOOKUP_TABLE after SCALARS {}", name);
      array(name, type, tuples_, number);
    } else if (keyword == "VECTORS" || keyword == "NORMALS" || keyword == "TENSORS" ||
               keyword == "TENSORS6" || keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS") {
      const std::string name = decode_name(next_word(rest));
      const std::int64_t components = keyword == "TENSORS"       ? 9
                                      : keyword == "TENSORS6"    ? 6
                                      : keyword.ends_with("IDS") ? 1
                                                                 : 3;
      array(name, find_type(next_word(rest)), tuples_, components);
    } else if (keyword == "TEXTURE_COORDINATES") {
      const std::string name = decode_name(next_word(rest));
      const auto components = count(next_word(rest), "TEXTURE_COORDINATES");
      array(name, find_type(next_word(rest)), tuples_, components);
    } else if (keyword == "COLOR_SCALARS") {
      const std::string name = decode_name(next_word(rest));
      const auto components = count(next_word(rest), "COLOR_SCALARS");
      array(name, find_type(binary_ ? "unsigned_char" : "float"), tuples_, components);
    } else if (keyword == "LOOKUP_TABLE") {
      next_word(rest);
      const auto size = count(next_word(rest), "LOOKUP_TABLE");
      const auto& type = find_type(binary_ ? "unsigned_char" : "float");
      check_room(size, 4, type.size, "LOOKUP_TABLE");
      skip_data(type, size, 4, "LOOKUP_TABLE");
    } else if (keyword == "METADATA") {
      metadata();
    } else {
      fail("keyword expected, found \"{}\"", printable(line));
    }
  }

  void cells(const std::string& what, std::string_view rest) {
    const auto first = count(next_word(rest), what.c_str());
    const auto second = count(next_word(rest), what.c_str());
    std::int64_t cells = first;
    if (offsets_form_) {
      cells = std::max<std::int64_t>(first - 1, 0);
      for (const auto& [name, values] :
           {std::pair{"OFFSETS", first}, std::pair{"CONNECTIVITY", second}}) {
        if (first == 0) break;
        const auto line = keyword_line();
        std::string_view words = line ? *line : std::string_view{};
        if (next_word(words) != name)
          fail("{}: expected {}, found \"{}\"", what, name,
               line ? printable(*line) : "end of file");
        cell_numbers(
            find_type(next_word(words)), values, what,
            name == std::string_view("OFFSETS") ? &LegacyCells::offsets : &LegacyCells::stream);
      }
    } else {
      cell_numbers(find_type("int"), second, what, &LegacyCells::stream);
    }
    if (cells_ != nullptr) cells_->offsets_form = offsets_form_;
    if (what == "VERTICES")
      vertices_ += cells;
    else if (what == "LINES")
      lines_ += cells;
    else if (what != "CELLS")
      polygons_ += cells;
  }

  void cell_numbers(const Type& type, std::int64_t count, const std::string& what,
                    std::vector<double> LegacyCells::*into) {
    check_room(count, 1, type.size, what);
    if (cells_ == nullptr || what != "CELLS") return skip_data(type, count, 1, what);
    decode_into(cells_->*into, type, count, what);
  }

  void decode_into(std::vector<double>& column, const Type& type, std::int64_t count,
                   const std::string& what) {
    column.resize(static_cast<std::size_t>(count));
    std::array<double*, 1> target{column.data()};
    values(type, count, target, what);
  }

  void cell_types(std::int64_t cells) {
    constexpr double vertex = 1, poly_vertex = 2;
    std::vector<double> kinds;
    check_room(cells, 1, 4, "CELL_TYPES");
    decode_into(kinds, find_type("int"), cells, "CELL_TYPES");
    const auto good = std::count_if(kinds.begin(), kinds.end(), [](double kind) {
      return kind == vertex || kind == poly_vertex;
    });
    vertices_ += good;
    other_cells_ += cells - good;
    if (cells_ != nullptr) cells_->types = std::move(kinds);
  }

  void field(std::int64_t arrays) {
    for (std::int64_t i = 0; i < arrays; ++i) {
      auto line = keyword_line();
      if (line && line->starts_with("METADATA")) {
        metadata();
        line = keyword_line();
      }
      if (!line) fail_cut("FIELD of {} arrays: end of file after {}", arrays, i);
      std::string_view rest = *line;
      const std::string name = decode_name(next_word(rest));
      const auto components = count(next_word(rest), name.c_str());
      const auto tuples = count(next_word(rest), name.c_str());
      const std::string type_name(next_word(rest));
      if (type_name == "string") {  // LIGGGHTS writes `element 1 0 string`: no tuples, a blank line
        check_room(tuples, components, 1, "array " + name);
        skip_strings(name, tuples * components);
        if (in_data_ && in_point_data_) {
          arrays_.push_back(name);
          flat_names_.push_back(name + " (text)");
        }
        continue;
      }
      const auto& type = find_type(type_name);
      if (in_data_) {
        if (tuples != tuples_)
          fail("array {}: {} tuples, {} {}", name, tuples, tuples_,
               in_point_data_ ? "points" : "cells");
        array(name, type, tuples, components);
      } else if (name == "TimeValue" && tuples == 1 && components == 1) {
        std::array<double*, 1> target{&time_};
        values(type, 1, target, name);
      } else {
        check_room(tuples, components, type.size, name);
        skip_data(type, tuples, components, name);
      }
    }
  }

  /// A point array: noted, and decoded where it is wanted; cell arrays are passed over.
  void array(const std::string& name, const Type& type, std::int64_t tuples,
             std::int64_t components) {
    if (!in_data_) fail("array {} outside POINT_DATA and CELL_DATA", name);
    check_room(tuples, components, type.size, "array " + name);
    if (!in_point_data_) return cell_array(name, type, tuples, components);
    if (components > 10000) fail("array {}: {} components", name, components);
    arrays_.push_back(name);
    for (auto& flat :
         component_names(name, static_cast<int>(components)))  // POINTS are the positions
      flat_names_.push_back(flat == "x" || flat == "y" || flat == "z" ? flat + " (array)" : flat);
    if (components == 1 && is_ghost_array(name) && ghost_array_ != "vtkGhostType") {
      ghost_array_ = name;
      const auto column = flat_names_.size() - 1;
      if (column >= targets_.size() || targets_[column] == nullptr)
        want(static_cast<int>(column), own_ghosts_);
      ghost_values_ = targets_[column];
    }
    data(type, tuples, components, name);
  }

  void cell_array(const std::string& name, const Type& type, std::int64_t tuples,
                  std::int64_t components) {
    if (cells_ == nullptr) return skip_data(type, tuples, components, name);
    if (tuples != static_cast<std::int64_t>(cells_->types.size()))
      fail("array {}: {} tuples, {} cells", name, tuples, cells_->types.size());
    if (components == 1 && name == "vtkGhostType")
      return decode_into(cells_->ghosts, type, tuples, name);
    cells_->arrays.push_back({name, static_cast<std::size_t>(components)});
    if (name != cell_array_ || components > 9) return skip_data(type, tuples, components, name);
    cells_->values.assign(static_cast<std::size_t>(components),
                          std::vector<double>(static_cast<std::size_t>(tuples)));
    std::vector<double*> into;
    for (auto& column : cells_->values) into.push_back(column.data());
    values(type, tuples, into, name);
  }

  /// Decodes the flat columns that were just named, or passes over them.
  void data(const Type& type, std::int64_t tuples, std::int64_t components,
            const std::string& what) {
    const auto first = flat_names_.size() - static_cast<std::size_t>(components);
    std::vector<double*> into(static_cast<std::size_t>(components), nullptr);
    bool wanted = false;
    for (std::size_t k = 0; k < into.size(); ++k) {
      auto* column = first + k < targets_.size() ? targets_[first + k] : nullptr;
      if (column == nullptr) continue;
      column->resize(static_cast<std::size_t>(tuples));
      into[k] = column->data();
      wanted = true;
    }
    if (wanted) return values(type, tuples, into, what);
    skip_data(type, tuples, components, what);
  }

  bool offsets_form_ = false, other_dataset_ = false, done_ = false, only_points_ = false;
  bool single_points_ = false;
  bool in_data_ = false, in_point_data_ = false, cell_data_ = false;
  std::string dataset_, dimensions_;
  std::int64_t points_ = -1, tuples_ = 0;
  std::int64_t vertices_ = 0, polygons_ = 0, lines_ = 0, other_cells_ = 0;
  double time_ = unknown;
  std::vector<std::string> arrays_;      // point arrays as on disk
  std::vector<std::string> flat_names_;  // their components, the points first
  std::vector<std::vector<double>*> targets_;
  std::string ghost_array_;
  const std::vector<double>* ghost_values_ = nullptr;
  std::vector<double> own_ghosts_;  // where nobody wanted the column
  LegacyCells* cells_ = nullptr;
  std::string cell_array_;
};

}  // namespace bedscope::readers::vtk_legacy_file
