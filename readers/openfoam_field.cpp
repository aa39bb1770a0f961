// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_field.hpp"

#include <algorithm>

#include "readers/numbers.hpp"

namespace bedscope::readers {
namespace {

// Passes over `{ ... }` by its brackets; lists of binary numbers inside by their counts.
void skip_braces(FoamStream& stream, const FoamLayout& layout, std::string_view name) {
  stream.expect('{', name);
  const auto start = stream.offset();
  for (std::uint64_t depth = 1; depth > 0;) {
    const auto token = stream.next();
    if (token.at_end())
      stream.fail_cut("expected \"}}\" for the \"{{\" of {} at offset {}, found end of file", name,
                      start - 1);
    if (token.is('{')) ++depth;
    if (token.is('}')) --depth;
    if (token.text.starts_with("List<") && token.text.ends_with('>'))
      skip_list(stream, layout, token.text);
  }
}

void read_dimensions(FoamStream& stream, FieldValues& out) {
  stream.expect('[', "dimensions");
  out.dimensions.fill(0);
  std::size_t count = 0;
  out.dimensions_known = true;
  for (;;) {
    const auto token = stream.next();
    if (token.is(']')) break;
    if (token.at_end()) stream.fail_cut("expected \"]\" after dimensions, found end of file");
    double power = 0;
    if (token.is(';')) stream.fail(token.offset, "expected \"]\" after dimensions, found \";\"");
    if (!parse_number(token.text.data(), token.text.data() + token.text.size(), power))
      out.dimensions_known = false;  // [m s^-1]: names of units
    else if (count < out.dimensions.size())
      out.dimensions[count++] = power;
  }
  // The last two, current and luminous intensity, may be left out.
  if (count != 5 && count != 7) out.dimensions_known = false;
  stream.expect(';', "dimensions");
}

// The type in the class against the one of the list: they differ where a file was put together.
const FoamType& agreed_type(const FoamStream& stream, std::uint64_t offset, std::string_view list,
                            const FoamHeader& header) {
  const auto* said = mesh_field_type(header.class_name);
  const auto* type = said;
  if (list.starts_with("List<") && list.ends_with('>'))
    type = foam_type(list.substr(5, list.size() - 6));
  if (type == nullptr)
    stream.fail(offset, "expected List<scalar>, List<vector> ... after nonuniform, found {}", list);
  if (said != nullptr && said != type)
    stream.fail(offset, "class {} but {}", header.class_name, list);
  return *type;
}

void read_nonuniform(FoamStream& stream, const FoamLayout& layout, const FoamHeader& header,
                     std::optional<FoamCount> cells, FieldValues& out, const FoamPlaces* places) {
  const char next = stream.peek();
  std::string list;
  const auto offset = stream.offset();
  if (next < '0' || next > '9') list = stream.next().text;  // old files leave the type out
  const auto& type = agreed_type(stream, offset, list, header);
  out.components = type.components;
  out.uniform = false;
  out.non_finite = read_values(stream, layout, type, cells, out.values, places);
}

void refuse_code(const FoamStream& stream, const FoamToken& token, std::string_view expected) {
  if (token.kind == FoamToken::Kind::directive)
    throw CodeError("{}: expected {}, found \"{}\", which is never run", stream.path(), expected,
                    token.text);
}

// One value for all cells: `0`, `(0 0 1)`.
void read_uniform(FoamStream& stream, const FoamHeader& header, std::optional<FoamCount> cells,
                  FieldValues& out, const FoamPlaces* places) {
  std::vector<double> value;
  const bool bracketed = stream.take('(');
  for (;;) {
    const auto token = stream.next();
    if (bracketed && token.is(')')) break;
    double number = 0;
    if (token.at_end()) stream.fail_cut("expected the value of a uniform field, found end of file");
    refuse_code(stream, token, "a number after uniform");
    if (!parse_number(token.text.data(), token.text.data() + token.text.size(), number) ||
        value.size() == 9)
      stream.fail(token.offset, "expected a number after uniform, found \"{}\"", token.text);
    value.push_back(number);
    if (!bracketed) break;
  }
  const auto* type = mesh_field_type(header.class_name);
  const auto components = type != nullptr ? type->components : value.size();
  if (components != value.size() && !(type != nullptr && value.size() == 1 && value[0] == 0))
    stream.fail(stream.offset(), "expected {} numbers for {}, found {}", components,
                header.class_name, value.size());
  value.resize(components);
  out.components = static_cast<unsigned>(components);
  out.uniform = true;
  const auto count = places != nullptr ? places->count
                     : cells           ? static_cast<std::size_t>(cells->count)
                                       : 1;
  out.values.resize((places != nullptr ? places->size : count) * components);
  const auto fill = [&](std::size_t from, std::size_t cells_of_run) {
    auto into = out.values.begin() + static_cast<std::ptrdiff_t>(from * components);
    for (std::size_t k = 0; k < cells_of_run; ++k)
      into = std::copy(value.begin(), value.end(), into);
  };
  if (places == nullptr) fill(0, count);
  for (const auto& run : places != nullptr ? places->runs : std::span<const FoamRun>())
    fill(static_cast<std::size_t>(run.place), static_cast<std::size_t>(run.count));
  const bool finite = std::all_of(value.begin(), value.end(), [](double x) { return x - x == 0; });
  out.non_finite = {finite ? 0 : count, 0};
}

// What follows internalField: from the file, or (`text`) an entry that macros were put into.
void read_internal(FoamStream& stream, const FoamLayout& layout, const FoamHeader& header,
                   std::optional<FoamCount> cells, FieldValues& out, const FoamPlaces* places) {
  const auto word = stream.next();
  refuse_code(stream, word, "uniform or nonuniform");
  if (word.text == "nonuniform")
    read_nonuniform(stream, layout, header, cells, out, places);
  else if (word.text == "uniform")
    read_uniform(stream, header, cells, out, places);
  else if (word.at_end())
    stream.fail_cut("expected uniform or nonuniform, found end of file");
  else
    stream.fail(word.offset, "expected uniform or nonuniform, found \"{}\"", word.text);
}

// A value with a macro in it: the text with all macros put in, read as if it stood there.
void read_with_macros(const FoamStream& stream, const FoamHeader& header,
                      std::optional<FoamCount> cells, std::string_view value,
                      const FoamDictionary& entries, FieldValues& out, const FoamPlaces* places) {
  FoamStream expanded(expand_macros(value, entries, stream.path()), stream.path());
  read_internal(expanded, FoamLayout{}, header, cells, out, places);
}

bool has_macro(FoamStream& stream) {
  if (stream.peek() == '$' || stream.peek() == '#') return true;
  // "uniform $U;" and "uniform ($u 0 0);": what is at hand of the line tells.
  const char* p = stream.at();
  if (std::string_view(p, static_cast<std::size_t>(stream.end() - p)).substr(0, 7) != "uniform")
    return false;
  const auto* stop = std::find(p, stream.end(), ';');
  return std::find(p, stop, '$') != stop;
}

}  // namespace

const FoamType* mesh_field_type(std::string_view name) {
  const auto colons = name.find("::");
  const auto inner = colons == std::string_view::npos ? "" : name.substr(colons);
  if (!inner.empty() && inner != "::Internal" && inner != "::DimensionedInternalField")
    return nullptr;
  name = name.substr(0, colons);
  for (const std::string_view place : {"vol", "surface", "point"}) {
    if (!name.starts_with(place) || !name.ends_with("Field")) continue;
    std::string type(name.substr(place.size()));
    if (type.size() < 6) return nullptr;
    type.resize(type.size() - 5);
    type[0] = static_cast<char>(type[0] | 0x20);
    return foam_type(type);
  }
  return nullptr;
}

const FoamType* vol_field_type(std::string_view name) {
  return name.starts_with("vol") ? mesh_field_type(name) : nullptr;
}

void read_field(FoamBlocks& file, std::optional<FoamCount> cells, FieldValues& out,
                const FoamPlaces* places) {
  auto& stream = file.stream();
  const auto& header = file.header();
  if (header.present && mesh_field_type(header.class_name) == nullptr)
    throw FormatError("{}: expected a field (volScalarField ...), found class {}", stream.path(),
                      header.class_name);
  const auto layout = layout_of(header, stream.path());
  // ::Internal calls it value, and has no boundary.
  const bool is_internal = header.class_name.find("::") != std::string::npos;
  const std::string_view key = is_internal ? "value" : "internalField";
  out.class_name = header.class_name;
  out.no_header = !header.present;
  out.binary = layout.binary;
  out.compressed = stream.compressed();
  out.dimensions_known = false;
  out.dimensions.fill(0);
  FoamEntries reader(stream);
  FoamDictionary entries;
  bool seen = false, boundary = false;
  for (auto token = reader.keyword(entries); !token.at_end(); token = reader.keyword(entries)) {
    if (token.text == key && !has_macro(stream)) {
      read_internal(stream, layout, header, cells, out, places);
      stream.expect(';', token.text);
      seen = true;
    } else if (token.text == "dimensions" && stream.peek() == '[') {
      read_dimensions(stream, out);
    } else if (token.text == "boundaryField") {
      skip_braces(stream, layout, token.text);
      boundary = true;
    } else {
      reader.entry(token, entries);
    }
  }
  if (!seen) {
    const auto* entry = entries.find(key);
    if (entry == nullptr || !entry->nested.empty())
      stream.fail_cut(
          "expected {}, found end of file{}", key,
          entries.not_followed.empty() ? "" : "; not followed: " + entries.not_followed.front());
    read_with_macros(stream, header, cells, entry->value, entries, out, places);
  }
  if (!boundary && !is_internal && header.present)
    stream.fail_cut("expected boundaryField, found end of file");
}

}  // namespace bedscope::readers
