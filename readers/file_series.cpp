// SPDX-License-Identifier: BSD-3-Clause
// ParaView's .series files (JSON), as foamToVTK writes them: names and times of many snapshots.
//
//   { "file-series-version" : "1.0", "files" : [ { "name" : "cloud_10.vtp", "time" : 0.001 }, ... ]
//   }
#include <filesystem>
#include <nlohmann/json.hpp>

#include "readers/error.hpp"
#include "readers/file_index.hpp"
#include "readers/xml_text.hpp"

namespace bedscope::readers {
namespace {

bool matches(std::string_view head) {
  return trimmed(head).starts_with('{') && head.find("\"file-series-version\"") != head.npos;
}

nlohmann::json parse(const std::string& path, std::string_view text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto line = line_of(text, std::min(error.byte, text.size()));
    if (error.byte >= text.size()) throw CutError("{}: line {}: JSON ends early", path, line);
    throw FormatError("{}: line {}: JSON cannot be read at byte {}", path, line, error.byte);
  }
}

/// foamToVTK -legacy of v1912 writes "_10" into bed.vtk.series for bed_10.vtk.
std::string whole_name(const std::string& path, std::string name) {
  const std::filesystem::path stem = std::filesystem::path(path).stem();  // bed.vtk
  if (!name.starts_with('_') || name.find('.') != name.npos || !stem.has_extension()) return name;
  return stem.stem().string() + name + stem.extension().string();
}

std::vector<IndexEntry> read(const std::string& path, std::string_view text, std::string&) {
  const auto json = parse(path, text);
  const auto files = json.find("files");
  if (files == json.end() || !files->is_array())
    throw FormatError("{}: expected a list \"files\" of {{ \"name\", \"time\" }}", path);
  std::vector<IndexEntry> entries;
  std::size_t at = text.find("\"files\"");
  for (const auto& file : *files) {
    const auto name = file.is_object() ? file.value("name", nlohmann::json()) : nlohmann::json();
    const auto time = file.is_object() ? file.value("time", nlohmann::json()) : nlohmann::json();
    if (!name.is_string() || !time.is_number())
      throw FormatError("{}: file {} of the list: expected a \"name\" and a \"time\"", path,
                        entries.size() + 1);
    IndexEntry entry{name.get<std::string>(), time.get<double>(), "0", at};
    // The parser tells no places; a name with escapes keeps that of the one before.
    if (const auto next = text.find('"' + entry.name + '"', at); next != text.npos) at = next + 1;
    entry.offset = at;
    entry.name = whole_name(path, std::move(entry.name));
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace

extern const IndexForm file_series;
constinit const IndexForm file_series{.name = "file", .matches = matches, .read = read};

}  // namespace bedscope::readers
