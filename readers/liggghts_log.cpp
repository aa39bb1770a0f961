// SPDX-License-Identifier: BSD-3-Clause
#include "readers/liggghts_log.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "readers/byte_window.hpp"
#include "readers/numbers.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t longest_line = 2000;   // of a command; longer ones are no commands
constexpr std::size_t longest_quote = 120;   // of a warning
constexpr std::size_t most_properties = 64;  // numbers of one property/global

Words words_of(std::string_view line) {
  Words words;
  for (auto word = next_word(line); !word.empty(); word = next_word(line)) words.push_back(word);
  return words;
}

std::optional<double> number(std::string_view word) {
  double value = 0;
  if (!parse_number(word.data(), word.data() + word.size(), value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> integer(std::string_view word) {
  std::int64_t value = 0;
  bool overflow = false;
  if (!parse_integer(word, value, overflow)) return std::nullopt;
  return value;
}

/// The number behind a key such as `constant`, from word `i` on.
std::optional<double> constant_after(const Words& words, std::size_t i) {
  if (i + 2 >= words.size() || words[i + 1] != "constant") return std::nullopt;
  return number(words[i + 2]);
}

/// fix pts all particletemplate/sphere 1 atom_type 1 density constant 2500 radius constant 1e-3
void read_template(const Words& words, LiggghtsLog& log) {
  std::optional<double> type, density, radius;
  for (std::size_t i = 4; i + 1 < words.size(); ++i) {
    if (words[i] == "atom_type") type = number(words[i + 1]);
    if (words[i] == "density") density = constant_after(words, i);
    if (words[i] == "radius") radius = constant_after(words, i);
  }
  if (!type || !(*type >= 1 && *type < 1e9)) return;
  const int key = static_cast<int>(*type);
  if (density) log.density[key] = *density;
  if (!radius) return;
  auto& range = log.radius.try_emplace(key, std::array{*radius, *radius}).first->second;
  range = {std::min(range[0], *radius), std::max(range[1], *radius)};
}

/// fix g all gravity 9.81 vector 0.0 0.0 -1.0
void read_gravity(const Words& words, LiggghtsLog& log) {
  if (words.size() < 9 || words[5] != "vector") return;
  const auto size = number(words[4]), x = number(words[6]), y = number(words[7]),
             z = number(words[8]);
  if (!size || !x || !y || !z) return;
  const double length = std::hypot(*x, *y, *z);
  if (length > 0) log.gravity = {{*size * *x / length, *size * *y / length, *size * *z / length}};
}

/// fix m1 all property/global youngsModulus peratomtype 5e6 5e6
void read_property(const Words& words, LiggghtsLog& log) {
  if (words.size() < 7) return;
  const std::size_t first = words[5] == "peratomtypepair" ? 7 : 6;  // their number stands before
  std::vector<double> values;
  for (std::size_t i = first; i < std::min(words.size(), first + most_properties); ++i)
    if (const auto value = number(words[i])) values.push_back(*value);
  if (!values.empty()) log.properties[std::string(words[4])] = std::move(values);
}

/// One command, as the log echoes it; echoes with variables are followed by one with their values.
void read_command(const Words& words, LiggghtsLog& log) {
  if (words.size() == 2 && words[0] == "units" && !words[1].starts_with('$'))
    log.units = std::string(words[1]);
  if (words.size() == 2 && words[0] == "timestep") {
    if (const auto step = number(words[1])) {
      log.several_time_steps |= log.time_step && *log.time_step != *step;
      log.time_step = step;
    }
  }
  if (words.size() < 5 || words[0] != "fix") return;
  if (words[3].starts_with("particletemplate/")) read_template(words, log);
  if (words[3] == "gravity") read_gravity(words, log);
  if (words[3] == "property/global") read_property(words, log);
}

/// Follows the tables of thermo output: a line of names with Step, rows, then "Loop time of". A
/// line of names counts once a row follows it.
class Thermo {
 public:
  void take(const Words& words, LiggghtsLog& log) {
    if (words.size() < 2) return;
    if (words[0] == "Loop" && words[1] == "time") {
      columns_ = 0;
      log.ended = true;
    } else if (const auto step = std::find(words.begin(), words.end(), "Step");
               step != words.end()) {
      column_ = static_cast<std::size_t>(step - words.begin());
      columns_ = words.size();
    } else if (words.size() == columns_ && number(words[0]) && integer(words[column_])) {
      log.last_step = integer(words[column_]);
      log.ended = false;
    }
  }

 private:
  std::size_t column_ = 0, columns_ = 0;  // of the table; 0: outside of one
};

/// "WARNING: text"; where nothing follows on the line, the text is the next line that has some.
class Complaint {
 public:
  explicit Complaint(std::string_view word) : word_(word) {}

  void take(std::string_view line, std::int64_t at, LiggghtsLog::Complaints& found) {
    if (line.starts_with(word_)) {
      if (found.count++ > 0) return;
      found.line = at;
      line.remove_prefix(word_.size());
      wanted_ = true;
    }
    if (!wanted_) return;
    const auto begin = line.find_first_not_of(": \t");
    if (begin == line.npos) return;
    found.first = std::string(line.substr(begin, longest_quote));
    wanted_ = false;
  }

 private:
  std::string_view word_;
  bool wanted_ = false;
};

std::string version_of(std::string_view line) {
  constexpr std::string_view begin = "LIGGGHTS (Version ";
  if (!line.starts_with(begin)) return {};
  line.remove_prefix(begin.size());
  return std::string(line.substr(0, line.find_first_of(",)")));
}

}  // namespace

LiggghtsLog read_log(const std::string& path) {
  LiggghtsLog log;
  log.path = path;
  Source source(path);
  std::vector<char> buffer;
  ByteWindow window(source, buffer);
  Thermo thermo;
  Complaint warning("WARNING"), error("ERROR");
  std::int64_t number_of_line = 0;
  while (const auto line = window.line()) {
    ++number_of_line;
    if (line->size() > longest_line) continue;
    if (number_of_line == 1) log.version = version_of(*line);
    warning.take(*line, number_of_line, log.warnings);
    error.take(*line, number_of_line, log.errors);
    const auto words = words_of(*line);
    thermo.take(words, log);
    read_command(words, log);
  }
  return log;
}

LiggghtsLog find_log(const std::string& dump) {
  namespace fs = std::filesystem;
  const auto folder = fs::absolute(dump).parent_path();
  for (const auto& place : {folder, folder.parent_path()}) {
    const auto path = place / "log.liggghts";
    std::error_code error;
    if (fs::is_regular_file(path, error)) return read_log(path.string());
  }
  return {};
}

}  // namespace bedscope::readers
