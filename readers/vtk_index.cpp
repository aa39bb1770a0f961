// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files that name others: the pieces of processors (.pvtp, .pvtu), the blocks of one
// instant (.vtm), the files of many instants (.pvd).
#include <fast_float/fast_float.h>

#include <cmath>

#include "readers/file_index.hpp"
#include "readers/vtk_common.hpp"
#include "readers/vtk_xml.hpp"
#include "readers/xml_text.hpp"

namespace bedscope::readers {
namespace {

using Event = XmlReader::Event;

double number(const XmlReader& xml, std::string_view text, std::string_view what) {
  double value = 0;
  const auto* const end = text.data() + text.size();
  const auto [stop, error] = fast_float::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value))
    throw FormatError("{}: expected {}, found '{}'", xml.place(xml.position()), what,
                      text.substr(0, 40));
  return value;
}

/// Collects the elements `element` of a file with the name that `attribute` holds. A list that ends
/// early is one of what it holds where `cut` takes the reason.
std::vector<IndexEntry> entries_of(const std::string& path, std::string_view text,
                                   std::string_view element, std::string_view attribute,
                                   std::string* cut = nullptr) {
  XmlReader xml(text, path);
  std::vector<IndexEntry> entries;
  const auto next = [&] {
    try {
      return xml.next();
    } catch (const CutError& error) {
      if (cut == nullptr || entries.empty()) throw;
      *cut = error.what();
      return Event::end;
    }
  };
  double time = unknown;
  bool in_time = false, single = false;
  for (auto event = next(); event != Event::end; event = next()) {
    if (event == Event::close) in_time = false;
    if (event == Event::text && in_time) time = number(xml, trimmed(xml.text()), "a time");
    if (event == Event::text && in_time && single) time = as_written(static_cast<float>(time));
    if (event != Event::open) continue;
    in_time = xml.attribute("Name") == "TimeValue" && xml.attribute("format") != "binary" &&
              xml.attribute("format") != "appended";
    single = xml.attribute("type") == "Float32";
    if (xml.name() != element) continue;
    const auto name = xml.attribute(attribute);
    if (!name && element == "DataSet") continue;  // a block without a file: it is empty
    IndexEntry entry;
    entry.offset = xml.position();
    entry.name = xml.unescape(name.value_or(""));
    if (entry.name.empty())
      throw FormatError("{}: <{}> without {}", xml.place(xml.position()), element, attribute);
    if (const auto stamp = xml.attribute("timestep"); stamp && !stamp->empty())
      entry.time = number(xml, *stamp, "a time");
    entry.part = xml.attribute("part").value_or("0");
    entries.push_back(std::move(entry));
  }
  if (!std::isnan(time))
    for (auto& entry : entries) entry.time = time;
  return entries;
}

}  // namespace

extern const IndexForm vtk_parallel, vtk_multiblock, vtk_collection;

constinit const IndexForm vtk_parallel{
    .name = "piece",
    .one_snapshot = true,
    .matches =
        [](std::string_view head) {
          const auto type = xml_root_type(head);
          return type == "PPolyData" || type == "PUnstructuredGrid";
        },
    .read = [](const std::string& path, std::string_view text,
               std::string&) { return entries_of(path, text, "Piece", "Source"); },
};

constinit const IndexForm vtk_multiblock{
    .name = "block",
    .one_snapshot = true,
    .matches = [](std::string_view head) { return xml_root_type(head) == "vtkMultiBlockDataSet"; },
    .read = [](const std::string& path, std::string_view text,
               std::string&) { return entries_of(path, text, "DataSet", "file"); },
};

constinit const IndexForm vtk_collection{
    .name = "file",
    .may_count = true,
    .matches = [](std::string_view head) { return xml_root_type(head) == "Collection"; },
    .read = [](const std::string& path, std::string_view text,
               std::string& cut) { return entries_of(path, text, "DataSet", "file", &cut); },
};

}  // namespace bedscope::readers
