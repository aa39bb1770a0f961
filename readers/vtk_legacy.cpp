// SPDX-License-Identifier: BSD-3-Clause
// Legacy VTK files of particles, ASCII or big-endian binary, versions 1.0 to 5.1, as LIGGGHTS
// (`dump custom/vtk`), LPP and ParaView write them. One snapshot a file; the step is in its name.
// Reference: VTK file formats (vtk.org), sections "Simple Legacy Formats" and, for 5.1, the OFFSETS
// and CONNECTIVITY arrays of cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>

#include "readers/byte_window.hpp"
#include "readers/columns.hpp"
#include "readers/error.hpp"
#include "readers/forms.hpp"
#include "readers/numbers.hpp"
#include "readers/source.hpp"
#include "readers/tokens.hpp"
#include "readers/vtk_legacy_types.hpp"

namespace bedscope::readers {
namespace {

using namespace vtk_legacy_file;

constexpr std::size_t header_bytes = 4096;  // more than the lines before an array take
constexpr std::string_view magic = "# vtk DataFile Version ";

/// One way through a file from front to back: learns what it holds, and decodes the columns that
/// are wanted on the way. Flat columns are numbered as they come: the points (x y z), then the
/// point arrays, component by component.
class Walk {
 public:
  Walk(const std::string& path, std::vector<char>& buffer, std::size_t piece = ByteWindow::piece)
      : path_(path), source_(path), window_(source_, buffer, piece) {}

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
  std::uint64_t bytes_from_disk() const { return source_.bytes_from_disk(); }
  const std::string& trailing() const { return source_.trailing(); }

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
  template <class... T>
  [[noreturn]] void fail(fmt::format_string<T...> text, T&&... values) {
    throw FormatError("{}: {}: {}", path_, here(), fmt::format(text, std::forward<T>(values)...));
  }

  template <class... T>
  [[noreturn]] void fail_cut(fmt::format_string<T...> text, T&&... values) {
    const auto end = binary_ ? fmt::format("offset {}", source_.likely_size()) : here();
    throw CutError("{}: {}: {}", path_, end, fmt::format(text, std::forward<T>(values)...));
  }

  /// A line number means nothing behind binary data.
  std::string here() const {
    if (binary_ && seen_data_) return fmt::format("offset {}", window_.offset());
    return fmt::format("line {}", line_at(path_, line_start_));
  }

  std::optional<std::string_view> next_line() {
    line_start_ = window_.offset();
    if (binary_ && window_.size() == 0) window_.more(header_bytes);
    return window_.line();
  }

  std::string_view need_line(const char* expected) {
    const auto line = next_line();
    if (!line) fail_cut("expected {}, found end of file", expected);
    return *line;
  }

  /// The next line that is not blank.
  std::optional<std::string_view> keyword_line() {
    while (auto line = next_line())
      if (line->find_first_not_of(" \t") != line->npos) return line;
    return std::nullopt;
  }

  void prologue() {
    auto line = need_line("\"# vtk DataFile Version\"");
    if (!line.starts_with(magic)) fail("expected \"{}\", found \"{}\"", magic, line.substr(0, 40));
    std::string_view rest = line.substr(magic.size());
    const auto word = next_word(rest);
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
    if (next_word(rest) != "DATASET")
      fail("expected DATASET, found {}",
           dataset ? fmt::format("\"{}\"", dataset->substr(0, 40)) : "end of file");
    dataset_ = next_word(rest);
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
    const auto keyword = next_word(rest);
    if (keyword == "POINTS") {
      if (points_ >= 0) fail("POINTS twice");
      points_ = count(next_word(rest), "POINTS");
      const auto& type = find_type(next_word(rest));
      if (only_points_) {
        done_ = true;
        return;
      }
      check_room(points_, 3, type.size, "POINTS");
      flat_names_.insert(flat_names_.end(), {"x", "y", "z"});
      data(type, points_, 3, "POINTS");
    } else if (keyword == "VERTICES" || keyword == "LINES" || keyword == "POLYGONS" ||
               keyword == "TRIANGLE_STRIPS" || keyword == "CELLS") {
      cells(std::string(keyword), rest);
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
      if (!table || !table->starts_with("LOOKUP_TABLE"))
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

  static std::string printable(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, 30))
      shown += static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~' ? '?' : c;
    return shown;
  }

  void metadata() {
    while (auto line = next_line())
      if (line->find_first_not_of(" \t") == line->npos) return;
  }

  std::int64_t count(std::string_view word, const char* what) {
    std::int64_t value = 0;
    bool overflow = false;
    if (!parse_integer(word, value, overflow))
      fail("{}: expected a count, found \"{}\"", what, printable(word));
    if (value < 0) fail("{}: negative count {}", what, value);
    return value;
  }

  const Type& find_type(std::string_view name) {
    const auto lower = lower_case(name);
    for (const auto& type : types)
      if (type.name == lower) return type;
    fail("unknown data type \"{}\"", printable(name));
  }

  /// Counts are claims: no more values than the rest of the file can hold.
  void check_room(std::int64_t tuples, std::int64_t components, int size, const std::string& what) {
    const std::uint64_t bound = source_.size_bound();
    const std::uint64_t bytes_each =
        binary_ || size == 1 ? static_cast<std::uint64_t>(size) : 2;  // a digit and a blank
    const auto most = bound / bytes_each + 1;
    if (components > 0 &&
        static_cast<std::uint64_t>(tuples) > most / static_cast<std::uint64_t>(components))
      fail("{}: {} x {} values declared, more than the file can hold", what, tuples, components);
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
        const auto& type = find_type(next_word(words));
        check_room(values, 1, type.size, what);
        skip_data(type, values, 1, what);
      }
    } else {
      const auto& type = find_type("int");
      check_room(second, 1, type.size, what);
      skip_data(type, second, 1, what);
    }
    if (what == "VERTICES")
      vertices_ += cells;
    else if (what == "LINES")
      lines_ += cells;
    else if (what != "CELLS")
      polygons_ += cells;
  }

  void cell_types(std::int64_t cells) {
    constexpr double vertex = 1, poly_vertex = 2;
    std::vector<double> kinds;
    check_room(cells, 1, 4, "CELL_TYPES");
    kinds.resize(static_cast<std::size_t>(cells));
    std::array<double*, 1> target{kinds.data()};
    values(find_type("int"), cells, target, "CELL_TYPES");
    const auto good = std::count_if(kinds.begin(), kinds.end(), [](double kind) {
      return kind == vertex || kind == poly_vertex;
    });
    vertices_ += good;
    other_cells_ += cells - good;
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

  void skip_strings(const std::string& name, std::int64_t strings) {
    for (std::int64_t i = 0; i < strings; ++i) {
      if (!binary_) {
        if (!next_line()) fail_cut("array {}: end of file inside it", name);
        continue;
      }
      // VTK's binary strings: the length in 1, 2, 4 or 8 bytes, told by the first two bits.
      if (!window_.ensure(1)) fail_cut("array {}: end of file inside it", name);
      const int form = static_cast<unsigned char>(*window_.begin()) >> 6;
      const std::size_t bytes = form == 3 ? 1 : form == 2 ? 2 : form == 1 ? 4 : 8;
      if (!window_.ensure(bytes)) fail_cut("array {}: end of file inside it", name);
      std::uint64_t length = static_cast<unsigned char>(*window_.begin()) & 0x3f;
      for (std::size_t k = 1; k < bytes; ++k)
        length = length << 8 | static_cast<unsigned char>(window_.begin()[k]);
      window_.drop_until(window_.begin() + bytes);
      skip_bytes(length, name);
    }
  }

  /// A point array: noted, and decoded where it is wanted; cell arrays are passed over.
  void array(const std::string& name, const Type& type, std::int64_t tuples,
             std::int64_t components) {
    if (!in_data_) fail("array {} outside POINT_DATA and CELL_DATA", name);
    check_room(tuples, components, type.size, "array " + name);
    if (!in_point_data_) return skip_data(type, tuples, components, name);
    if (components > 10000) fail("array {}: {} components", name, components);
    arrays_.push_back(name);
    for (auto& flat :
         component_names(name, static_cast<int>(components)))  // POINTS are the positions
      flat_names_.push_back(flat == "x" || flat == "y" || flat == "z" ? flat + " (array)" : flat);
    data(type, tuples, components, name);
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

  void skip_data(const Type& type, std::int64_t tuples, std::int64_t components,
                 const std::string& what) {
    seen_data_ = true;
    if (binary_)
      return skip_bytes(static_cast<std::uint64_t>(tuples) * components * type.size, what);
    std::int64_t left = tuples * components;
    while (left > 0) {
      const char* at = window_.begin();
      const char* const end = behind_last_blank();
      left -= skip_words(at, end, left);
      window_.drop_until(at);
      if (left > 0 && !next_words(what, tuples * components - left, tuples, components)) break;
    }
  }

  /// Up to where words are whole: at the end of the file everything is.
  const char* behind_last_blank() const {
    const char* end = window_.end();
    if (at_end_) return end;
    while (end > window_.begin() && !is_blank(end[-1])) --end;
    return end;
  }

  /// Brings more words into the window after all whole ones were used.
  bool next_words(const std::string& what, std::int64_t seen, std::int64_t tuples,
                  std::int64_t components) {
    if (window_.more()) return true;
    if (!at_end_) {
      at_end_ = true;
      return true;
    }
    line_start_ = window_.offset();
    if (what == "POINTS")
      fail_cut("POINTS {} declared, {} present (end of file)", tuples, seen / 3);
    fail_cut("end of file inside {}: {} values declared, {} present", what, tuples * components,
             seen);
  }

  void skip_bytes(std::uint64_t bytes, const std::string& what) {
    seen_data_ = true;
    if (bytes <= window_.size()) {
      window_.drop_until(window_.begin() + bytes);
      return;
    }
    const auto target = window_.offset() + bytes;
    if (target > source_.size_bound()) fail_cut("end of file inside {}", what);
    source_.seek(target);
    window_.restart();
    if (source_.position() < target) fail_cut("end of file inside {}", what);
  }

  void values(const Type& type, std::int64_t tuples, std::span<double* const> into,
              const std::string& what) {
    seen_data_ = true;
    if (binary_)
      binary_values(type, tuples, into, what);
    else
      text_values(type, tuples, into, what);
  }

  void binary_values(const Type& type, std::int64_t tuples, std::span<double* const> into,
                     const std::string& what) {
    const std::size_t tuple_bytes = into.size() * static_cast<std::size_t>(type.size);
    std::size_t done = 0;
    const auto all = static_cast<std::size_t>(tuples);
    while (done < all) {
      const std::size_t here = std::min(window_.size() / tuple_bytes, all - done);
      if (here == 0) {
        // Not beyond the array and the header behind it: the next array may not be wanted.
        if (!window_.more((all - done) * tuple_bytes - window_.size() + header_bytes))
          fail_cut("end of file inside {}: {} tuples declared, {} present", what, all, done);
        continue;
      }
      for (std::size_t k = 0; k < into.size(); ++k)
        if (into[k] != nullptr) decode(type, window_.begin(), here, into.size(), k, into[k] + done);
      window_.drop_until(window_.begin() + here * tuple_bytes);
      done += here;
    }
  }

  void text_values(const Type& type, std::int64_t tuples, std::span<double* const> into,
                   const std::string& what) {
    const auto components = static_cast<std::int64_t>(into.size());
    const std::int64_t all = tuples * components;
    const bool single = type.kind == Kind::real && type.size == 4;
    std::int64_t done = 0;
    while (done < all) {
      const char* at = window_.begin();
      const char* const end = behind_last_blank();
      std::size_t tuple = static_cast<std::size_t>(done / components);
      std::size_t component = static_cast<std::size_t>(done % components);
      const char* bad = nullptr;
      const std::int64_t left = all - done;
      std::int64_t taken = 0;
      for_each_word(at, end, [&](std::int64_t index, const char* from, const char* to) {
        if (index == left) return false;
        if (double* const target = into[component]; target != nullptr) {
          double value = 0;
          if (!parse_number(from, to, value)) {
            bad = from;
            return false;
          }
          target[tuple] = single ? static_cast<double>(static_cast<float>(value)) : value;
        }
        if (++component == into.size()) {
          component = 0;
          ++tuple;
        }
        taken = index + 1;
        at = to;
        return true;
      });
      done += taken;
      if (bad != nullptr) {
        line_start_ = window_.offset(bad);
        const char* stop = bad;
        while (stop < window_.end() && !is_blank(*stop)) ++stop;
        fail("{}: {} x {} numbers declared; number expected, found \"{}\"", what, tuples,
             components, printable({bad, static_cast<std::size_t>(stop - bad)}));
      }
      window_.drop_until(at);
      if (done < all && !next_words(what, done, tuples, components)) break;
    }
  }

  const std::string& path_;
  Source source_;
  ByteWindow window_;
  std::uint64_t line_start_ = 0;
  bool binary_ = false, offsets_form_ = false, other_dataset_ = false, done_ = false;
  bool only_points_ = false, seen_data_ = false, at_end_ = false;
  bool in_data_ = false, in_point_data_ = false, cell_data_ = false;
  std::string dataset_, dimensions_;
  std::int64_t points_ = -1, tuples_ = 0;
  std::int64_t vertices_ = 0, polygons_ = 0, lines_ = 0, other_cells_ = 0;
  double time_ = unknown;
  std::vector<std::string> arrays_;      // point arrays as on disk
  std::vector<std::string> flat_names_;  // their components, the points first
  std::vector<std::vector<double>*> targets_;
};

FileScan scan(const std::string& path, bool thorough) {
  constexpr std::size_t first_look = 4096;
  std::vector<char> buffer;
  Walk walk(path, buffer, thorough ? ByteWindow::piece : first_look);
  std::array<std::vector<double>, 3> positions;
  if (thorough) {
    for (int axis = 0; axis < 3; ++axis) walk.want(axis, positions[static_cast<std::size_t>(axis)]);
    walk.run();
  } else {
    walk.run_to_points();
  }
  FileScan found;
  if (thorough || walk.not_particles().starts_with("a "))
    found.not_particles = walk.not_particles();
  if (!found.not_particles.empty()) return found;
  Located located;
  located.particles = walk.points();
  located.time = walk.time();
  if (thorough) {
    located.columns = std::make_shared<const std::vector<std::string>>(walk.arrays());
    located.parts = std::make_shared<const std::vector<std::string>>(walk.names());
  }
  found.snapshots.push_back(std::move(located));
  if (!walk.trailing().empty()) found.problems.push_back(walk.trailing());
  return found;
}

void read(const std::string& path, const Located&, const Request& request, Snapshot& out,
          Scratch& scratch) {
  // The names are known only after the walk, so the first guess is the snapshot before; a wrong one
  // costs a second walk.
  ColumnPlan plan;
  out.step = no_step;
  out.box = {};
  out.bytes_read = 0;
  for (bool sure = false;;) {
    bool planned = true;
    try {
      plan = plan_columns(scratch.names, request, path);
    } catch (const FormatError&) {
      if (sure) throw;
      planned = false;
    }
    if (!planned) plan.parse = {0, 1, 2};  // positions: numbers that are parsed are counted best
    Walk walk(path, scratch.bytes);
    if (scratch.raw.size() < plan.parse.size()) scratch.raw.resize(plan.parse.size());
    for (std::size_t k = 0; k < plan.parse.size(); ++k) walk.want(plan.parse[k], scratch.raw[k]);
    walk.run();
    if (const auto what = walk.not_particles(); !what.empty())
      throw FormatError("{}: {}", path, what);
    out.bytes_read += walk.bytes_from_disk();
    if (walk.points() == 0) {  // LPP writes a file of 0 particles without any array
      out.particles = 0;
      out.columns.assign(request.size(), {});
      return;
    }
    if (planned && (sure || walk.names() == scratch.names)) {
      out.particles = static_cast<std::size_t>(walk.points());
      out.time = walk.time();
      break;
    }
    scratch.names = walk.names();
    sure = true;
  }
  finish_columns(plan, scratch.raw, out, path);
}

bool matches(std::string_view head) { return head.starts_with("# vtk DataFile Version"); }

}  // namespace

extern const Form vtk_legacy;
constinit const Form vtk_legacy{
    .name = "vtk-legacy",
    .description = "legacy VTK particles, ASCII or binary (dump custom/vtk, LPP, ParaView)",
    .reference = "https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html",
    .matches = matches,
    .scan = scan,
    .read = read,
};

}  // namespace bedscope::readers
