// SPDX-License-Identifier: BSD-3-Clause
#include "readers/liggghts_log.hpp"

#include <filesystem>
#include <string_view>
#include <vector>

#include "readers/byte_window.hpp"
#include "readers/numbers.hpp"
#include "readers/tokens.hpp"

namespace bedscope::readers {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto word = next_word(line); !word.empty(); word = next_word(line)) words.push_back(word);
  return words;
}

std::optional<double> number(std::string_view word) {
  double value = 0;
  if (!parse_number(word.data(), word.data() + word.size(), value)) return std::nullopt;
  return value;
}

}  // namespace

LiggghtsLog read_log(const std::string& path) {
  LiggghtsLog log;
  log.path = path;
  Source source(path);
  std::vector<char> buffer;
  ByteWindow window(source, buffer);
  while (const auto line = window.line()) {
    if (line->size() > 2000) continue;
    const auto words = words_of(*line);
    // The echo of `timestep ${dt}` is followed by the line with the value in its place.
    if (words.size() == 2 && words[0] == "timestep") {
      if (const auto step = number(words[1])) {
        log.several_time_steps |= log.time_step && *log.time_step != *step;
        log.time_step = step;
      }
    }
    // fix pts all particletemplate/sphere 1 atom_type 1 density constant 2500 radius constant 1e-3
    if (words.size() < 5 || words[0] != "fix" || !words[3].starts_with("particletemplate/"))
      continue;
    std::optional<double> type, density;
    for (std::size_t i = 4; i + 1 < words.size(); ++i) {
      if (words[i] == "atom_type") type = number(words[i + 1]);
      if (words[i] == "density" && words[i + 1] == "constant" && i + 2 < words.size())
        density = number(words[i + 2]);
    }
    if (type && *type >= 1 && *type < 1e9 && density)
      log.density[static_cast<int>(*type)] = *density;
  }
  return log;
}

LiggghtsLog find_log(const std::string& dump) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto folder = fs::absolute(dump, error).parent_path();
  for (const auto& place : {folder, folder.parent_path()}) {
    const auto path = place / "log.liggghts";
    if (fs::is_regular_file(path, error)) return read_log(path.string());
  }
  return {};
}

}  // namespace bedscope::readers
