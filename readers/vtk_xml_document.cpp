// SPDX-License-Identifier: BSD-3-Clause
// From the tags of a VTK XML file to the list of its arrays.
#include <algorithm>
#include <bit>
#include <charconv>

#include "readers/source.hpp"
#include "readers/vtk_common.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers {

std::string xml_root_type(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  constexpr std::string_view root = "<VTKFile";
  while (true) {
    head = head.substr(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
    if (head.starts_with(root)) break;
    std::size_t next = std::string_view::npos;
    if (head.starts_with("<!--")) {
      next = head.find("-->");
    } else if (head.starts_with("<?")) {
      next = head.find("?>");
    } else if (head.starts_with("<!")) {
      next = head.find(root);  // a DOCTYPE: the reader names it as what is wrong
    }
    if (next == std::string_view::npos) return {};
    head.remove_prefix(next + (head.substr(next).starts_with(root) ? 0 : 2));
    if (head.starts_with('>')) head.remove_prefix(1);
  }
  try {
    XmlReader xml(head, "");
    xml.next();
    const std::string type(xml.attribute("type").value_or("?"));
    return type.empty() ? "?" : type;
  } catch (const FormatError&) {
    return "?";
  }
}

namespace vtk_xml_file {
namespace {

struct NumberName {
  std::string_view name;
  Number type;
  std::size_t size;
};
constexpr NumberName number_names[] = {
    {"Int8", Number::int8, 1},       {"UInt8", Number::uint8, 1},   {"Int16", Number::int16, 2},
    {"UInt16", Number::uint16, 2},   {"Int32", Number::int32, 4},   {"UInt32", Number::uint32, 4},
    {"Int64", Number::int64, 8},     {"UInt64", Number::uint64, 8}, {"Float32", Number::float32, 4},
    {"Float64", Number::float64, 8},
};

// One function for each element of the file; each begins after its open tag and ends with its
// close tag. Elements that are not known are passed over.
class DocumentReader {
 public:
  DocumentReader(std::string_view bytes, const std::string& path, bool cell_data)
      : xml_(bytes, path), cell_data_(cell_data) {
    document_.path = path;
    document_.bytes = bytes;
  }

  Document read() {
    if (xml_.next() != XmlReader::Event::open || xml_.name() != "VTKFile") {
      fail("expected <VTKFile>, found <{}>", xml_.name());
    }
    document_.type = attribute("type").value_or("");
    if (document_.type.empty()) fail("<VTKFile> names no type");
    if (!document_.is_particle_grid()) {
      if (xml_.next() == XmlReader::Event::open)
        document_.extent = attribute("WholeExtent").value_or("");
      return std::move(document_);
    }
    read_root_attributes();
    bool found = false;
    each_child([&] {
      if (xml_.name() == document_.type) {
        found = true;
        read_grid();
      } else if (xml_.name() == "AppendedData") {
        read_appended();
      } else {
        xml_.skip_element();
      }
    });
    document_.end = xml_.next_position();
    if (!found) fail("expected <{0}> inside of <VTKFile type=\"{0}\">", document_.type);
    return std::move(document_);
  }

  std::optional<DataArray> time_array() const { return time_; }

 private:
  template <class... T>
  [[noreturn]] void fail(fmt::format_string<T...> text, T&&... values) const {
    throw FormatError("{}: {}", xml_.place(xml_.position()),
                      fmt::format(text, std::forward<T>(values)...));
  }

  std::optional<std::string_view> attribute(std::string_view name) const {
    return xml_.attribute(name);
  }

  template <class F>
  void each_child(F&& child) {
    for (auto event = xml_.next(); event != XmlReader::Event::close; event = xml_.next()) {
      if (event == XmlReader::Event::open) child();
    }
  }

  std::uint64_t count(std::string_view name, std::uint64_t otherwise = 0) const {
    const auto text = attribute(name);
    if (!text) return otherwise;
    if (text->starts_with('-')) fail("{} is negative: {}", name, text->substr(0, 40));
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (error != std::errc{} || end != text->data() + text->size()) {
      fail("{}: expected a whole number, found '{}'", name, text->substr(0, 40));
    }
    return value;
  }

  void read_root_attributes() {
    const std::string_view order = attribute("byte_order").value_or("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian") {
      fail("byte_order: expected LittleEndian or BigEndian, found '{}'", order);
    }
    document_.swap = (order == "BigEndian") != (std::endian::native == std::endian::big);
    const std::string_view header = attribute("header_type").value_or("UInt32");
    if (header != "UInt32" && header != "UInt64") {
      fail("header_type: expected UInt32 or UInt64, found '{}'", header);
    }
    document_.word = header == "UInt32" ? 4 : 8;
    const std::string_view compressor = attribute("compressor").value_or("");
    if (compressor == "vtkZLibDataCompressor") {
      document_.compressor = Compressor::zlib;
    } else if (compressor == "vtkLZ4DataCompressor") {
      document_.compressor = Compressor::lz4;
    } else if (compressor == "vtkLZMADataCompressor") {
      document_.compressor = Compressor::lzma;
    } else if (!compressor.empty()) {
      fail(
          "compressor {} not known (vtkZLibDataCompressor, vtkLZ4DataCompressor and "
          "vtkLZMADataCompressor are)",
          compressor);
    }
  }

  void read_grid() {
    if (trimmed(attribute("TimeValues").value_or("")).find(' ') != std::string_view::npos) {
      fail("several time steps in one file are not supported (TimeValues=\"{}\")",
           attribute("TimeValues")->substr(0, 40));
    }
    each_child([&] {
      if (xml_.name() == "Piece") {
        read_piece();
      } else if (xml_.name() == "FieldData") {
        Arrays arrays = read_arrays();
        const DataArray* time = find(arrays, "TimeValue");
        if (time != nullptr) time_ = *time;
      } else {
        xml_.skip_element();
      }
    });
  }

  void read_piece() {
    Piece piece;
    piece.position = xml_.position();
    const bool poly_data = document_.type == "PolyData";
    if (!attribute("NumberOfPoints")) fail("<Piece> without NumberOfPoints");
    piece.points = count("NumberOfPoints");
    if (poly_data) {
      piece.verts.count = count("NumberOfVerts");
      piece.lines.count = count("NumberOfLines");
      piece.strips.count = count("NumberOfStrips");
      piece.polys.count = count("NumberOfPolys");
    } else {
      piece.cells.count = count("NumberOfCells");
    }
    each_child([&] {
      const std::string_view name = xml_.name();
      if (name == "PointData") {
        piece.point_data = read_arrays();
      } else if (name == "CellData" && cell_data_) {
        piece.cell_data = read_arrays();
      } else if (name == "Points") {
        piece.coordinates = read_arrays();
      } else if (CellGroup* group = cell_group(piece, name, poly_data)) {
        group->arrays = read_arrays();
      } else {
        xml_.skip_element();
      }
    });
    document_.pieces.push_back(std::move(piece));
  }

  static CellGroup* cell_group(Piece& piece, std::string_view name, bool poly_data) {
    if (!poly_data) return name == "Cells" ? &piece.cells : nullptr;
    if (name == "Verts") return &piece.verts;
    if (name == "Lines") return &piece.lines;
    if (name == "Strips") return &piece.strips;
    return name == "Polys" ? &piece.polys : nullptr;
  }

  Arrays read_arrays() {
    Arrays arrays;
    each_child([&] {
      if (xml_.name() == "DataArray" || xml_.name() == "Array") {
        arrays.push_back(read_array());
      } else {
        xml_.skip_element();
      }
    });
    return arrays;
  }

  DataArray read_array() {
    DataArray array;
    array.position = xml_.position();
    array.name = xml_.unescape(attribute("Name").value_or(""));
    if (array.name.empty()) array.name = "(unnamed)";
    array.type_name = attribute("type").value_or("");
    for (const NumberName& known : number_names) {
      if (known.name == array.type_name) array.type = known.type;
    }
    array.components = count("NumberOfComponents", 1);
    if (array.components == 0) array.components = 1;
    if (attribute("NumberOfTuples")) array.tuples = count("NumberOfTuples");
    const std::string_view format = attribute("format").value_or("ascii");
    if (format == "appended") {
      if (!attribute("offset")) fail("array {}: appended, but without an offset", array.name);
      array.storage = Storage::appended;
      array.offset = count("offset");
    } else if (format == "binary") {
      array.storage = Storage::inline_base64;
    } else if (format != "ascii") {
      fail("array {}: format: expected ascii, binary or appended, found '{}'", array.name, format);
    }
    read_array_text(array);
    return array;
  }

  // The numbers come first; VTK adds <InformationKey> elements behind them.
  void read_array_text(DataArray& array) {
    bool past = false;
    for (auto event = xml_.next(); event != XmlReader::Event::close; event = xml_.next()) {
      if (event == XmlReader::Event::open) {
        xml_.skip_element();
        past = true;
      } else if (past || !array.text.empty()) {
        fail("array {}: data in several parts are not accepted", array.name);
      } else {
        array.text = xml_.text();
      }
    }
  }

  void read_appended() {
    const std::string_view encoding = attribute("encoding").value_or("base64");
    if (encoding != "raw" && encoding != "base64") {
      fail("<AppendedData>: encoding: expected raw or base64, found '{}'", encoding);
    }
    document_.has_appended = true;
    document_.appended_base64 = encoding == "base64";
    const std::string_view all = document_.bytes;
    const std::size_t begin = all.find_first_not_of(" \t\r\n", xml_.next_position());
    if (begin == std::string_view::npos || all[begin] != '_') {
      fail("<AppendedData>: expected \"_\" before the data, found {}",
           begin == std::string_view::npos
               ? "the end of the file"
               : fmt::format("byte 0x{:02x}", static_cast<unsigned char>(all[begin])));
    }
    // Raw bytes may hold anything, "<" too: the close tag is the last one of the file.
    const std::size_t end = all.rfind("</AppendedData");
    if (end == std::string_view::npos || end < begin) {
      throw CutError("{}: XML ends inside <AppendedData> of line {}: file is cut after {} bytes",
                     document_.path, line_of(all, xml_.position()), all.size());
    }
    document_.appended = all.substr(begin + 1, end - begin - 1);
    xml_.jump(end);
    xml_.skip_element();
  }

  XmlReader xml_;
  bool cell_data_;
  Document document_;
  std::optional<DataArray> time_;
};

// MercuryDPM writes "<!-- time 0.5-->" before <VTKFile>, and no TimeValue.
double time_of_comment(std::string_view bytes) {
  constexpr std::string_view begin = "<!-- time ";
  const auto head = bytes.substr(0, std::min(bytes.find("<VTKFile"), bytes.size()));
  const auto at = head.find(begin);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double time = unknown;
  if (at == head.npos) return time;
  const auto rest = head.substr(at + begin.size());
  const auto text = trimmed(rest.substr(0, rest.find("-->")));
  return parse_number(text.data(), text.data() + text.size(), time) ? time : unknown;
}

// A count is a claim: nothing is reserved for more points than the bytes of the file can hold.
void bound_points(const Document& document) {
  Decoder decoder(document);
  double claimed = 0;
  for (const Piece& piece : document.pieces) {
    if (piece.points == 0) continue;
    if (piece.coordinates.empty()) {
      throw FormatError("{}: line {}: <Piece> of {} points has no <Points>", document.path,
                        line_of(document.bytes, piece.position), piece.points);
    }
    const DataArray& points = piece.coordinates.front();
    if (points.components != 3) {
      decoder.fail(points, "expected 3 components, found {}", points.components);
    }
    std::vector<const DataArray*> arrays{&points};
    for (const DataArray& array : piece.point_data) {
      if (array.type != Number::other) arrays.push_back(&array);
    }
    std::sort(arrays.begin(), arrays.end(),  // the first that is wrong in the file is reported
              [](const auto* a, const auto* b) { return a->position < b->position; });
    for (const DataArray* array : arrays) decoder.bound(*array, piece.points);
    claimed += static_cast<double>(piece.points);
  }
  // Pieces may share appended bytes, so that each is within its bound but not their sum. A point
  // takes 3 bytes; no compressor in use packs better than 8192 to 1.
  const double most = static_cast<double>(document.bytes.size()) *
                      (document.compressor == Compressor::none ? 1 : 8192) / 3;
  if (claimed > most) {
    throw FormatError("{}: {} points claimed, more than its {} bytes can hold", document.path,
                      claimed, document.bytes.size());
  }
}

}  // namespace

std::string_view read_all(Source& source, std::vector<char>& buffer) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::size_t length = 0;
  const std::size_t first = source.compressed() ? piece : source.size_bound() + 1;
  if (buffer.size() < first) buffer.resize(first);
  while (true) {
    length += source.read(std::span(buffer).subspan(length));
    if (length < buffer.size()) break;
    buffer.resize(2 * buffer.size());
  }
  if (!source.cut().empty()) throw CutError("{}: {}", source.path(), source.cut());
  return {buffer.data(), length};
}

std::size_t size_of(Number type) {
  for (const NumberName& known : number_names) {
    if (known.type == type) return known.size;
  }
  return 0;
}

const DataArray* find(const Arrays& arrays, std::string_view name) {
  for (const DataArray& array : arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

std::uint64_t Document::points() const {
  std::uint64_t sum = 0;
  for (const Piece& piece : pieces) sum += piece.points;
  return sum;
}

Document parse_document(std::string_view bytes, const std::string& path,
                        const ParseOptions& options) {
  DocumentReader reader(bytes, path, options.cell_data);
  Document document = reader.read();
  if (!options.condensed) bound_points(document);
  document.time = time_of_comment(bytes);
  if (const auto time = reader.time_array()) {
    std::vector<double> values;
    Decoder decoder(document);
    const std::uint64_t tuples = time->tuples.value_or(1);
    if (time->components == 1 && tuples > 0) {
      decoder.decode(*time, tuples, values);
      document.time = values.front();
    }
  }
  return document;
}

}  // namespace vtk_xml_file
}  // namespace bedscope::readers
