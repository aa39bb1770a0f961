// SPDX-License-Identifier: BSD-3-Clause
// What a VTK XML file says about itself, and the numbers of its arrays. Internal to this room, but
// for xml_root_type(), which forms.cpp calls to name the files that are no particle dumps.
//
// Layout: the VTK User's Guide, "VTK XML formats"; block headers: vtkXMLDataParser of VTK 9.1.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "readers/error.hpp"
#include "readers/xml_text.hpp"

namespace bedscope::readers {

class Source;

/// The `type` of <VTKFile> ("PolyData", "PPolyData", "Collection" ...) where a file that begins
/// with `head` is VTK XML, "?" where that element names none; empty where it is something else.
std::string xml_root_type(std::string_view head);

namespace vtk_xml_file {

/// Types of numbers that an array can have; `other` for strings and what is not known.
enum class Number {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  other
};
std::size_t size_of(Number type);  ///< [bytes], 0 for other

enum class Storage { ascii, inline_base64, appended };
enum class Compressor { none, zlib, lz4, lzma };

/// One <DataArray>, not decoded.
struct DataArray {
  std::string
      name;  ///< "(unnamed)" where the file has Name="" (LIGGGHTS 3.8 writes it for xu yu zu)
  std::string type_name;
  Number type = Number::other;
  std::size_t components = 1;
  std::optional<std::uint64_t> tuples;  ///< as claimed; only field data need it
  Storage storage = Storage::ascii;
  std::string_view text;     ///< between the tags; empty if appended
  std::uint64_t offset = 0;  ///< into the appended data
  std::size_t position = 0;  ///< of the tag in the file
};
using Arrays = std::vector<DataArray>;
const DataArray* find(const Arrays& arrays, std::string_view name);  ///< the first; null if none

/// Cells of one kind: Verts, Lines, Strips, Polys of PolyData, Cells of an UnstructuredGrid.
struct CellGroup {
  std::uint64_t count = 0;
  Arrays arrays;  ///< connectivity, offsets, types
};

struct Piece {
  std::uint64_t points = 0;
  std::size_t position = 0;
  Arrays coordinates;  ///< one array, or none in a piece without points
  Arrays point_data;
  Arrays cell_data;  ///< only where asked for
  CellGroup verts, lines, strips, polys, cells;
};

struct Document {
  std::string path;
  std::string_view bytes;  ///< the whole file
  std::string type;        ///< "PolyData", "UnstructuredGrid", or another grid that is not parsed
  std::string extent;      ///< WholeExtent of such a grid
  bool swap = false;       ///< byte order differs from this machine's
  std::size_t word = 4;    ///< bytes of a number in a block header
  Compressor compressor = Compressor::none;
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s], TimeValue
  std::vector<Piece> pieces;
  std::string_view appended;  ///< after the "_"
  bool has_appended = false, appended_base64 = false;
  std::size_t end = 0;  ///< offset behind </VTKFile>

  bool is_particle_grid() const { return type == "PolyData" || type == "UnstructuredGrid"; }
  std::uint64_t points() const;
};

/// Finds every array of a file without decoding them (TimeValue excepted). `bytes` must outlive the
/// document. Throws FormatError where the text is damaged or cut, and where more points are claimed
/// than the bytes of the file can hold.
struct ParseOptions {
  bool cell_data = false;  ///< arrays of cells too
  bool condensed = false;  ///< of condensed(): nothing can be said of bytes that are not there
};
Document parse_document(std::string_view bytes, const std::string& path,
                        const ParseOptions& options = {});

/// The text of a large file without the bodies of its large binary arrays (their elements are
/// empty) and without appended data, most of which is never read. Nothing for a file that is not
/// worth it, or not as expected: it is to be read as a whole.
std::optional<std::string> condensed(const std::string& path);

/// The whole file, decompressed, in a buffer that only grows. Throws FileError, CutError.
std::string_view read_all(Source& source, std::vector<char>& buffer);

/// Memory that is not cleared before it is written to, and that only grows.
class Buffer {
 public:
  char* reserve(std::size_t size) {
    if (size > size_) {
      bytes_.reset(new char[size]);  // left uninitialised
      size_ = size;
    }
    return bytes_.get();
  }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Decodes arrays of one document. Not thread-safe: it owns buffers.
class Decoder {
 public:
  explicit Decoder(const Document& document) : document_(document) {}

  /// Writes component c of `tuples` tuples to columns[c], unless that is null. Checks the whole
  /// array in any case. Throws FormatError for every difference between what the array says, what
  /// it holds and what is expected.
  void decode(const DataArray& array, std::uint64_t tuples, std::span<double* const> columns);

  /// Throws FormatError unless the array can hold that many tuples, by its length and its block
  /// header alone: before any memory is reserved for them.
  void bound(const DataArray& array, std::uint64_t tuples);

  /// All values of an array of one component; `into` is cleared first.
  void decode(const DataArray& array, std::uint64_t tuples, std::vector<double>& into);

  template <class... T>
  [[noreturn]] void fail(const DataArray& array, fmt::format_string<T...> text,
                         T&&... values) const {
    throw FormatError("{}: line {}: array {}: {}", document_.path,
                      line_of(document_.bytes, array.position), array.name,
                      fmt::format(text, std::forward<T>(values)...));
  }

 private:
  class Stored;  // the bytes of one array as they lie in the file
  Stored stored(const DataArray& array) const;
  std::uint64_t checked_size(const DataArray& array, std::uint64_t tuples) const;
  struct Header {
    std::uint64_t block_size = 0;  // decoded [bytes]; the sizes of the compressed: block_sizes_
  };
  Header read_header(const DataArray& array, Stored& from, std::uint64_t expected);
  template <class Use>
  void binary(const DataArray& array, std::uint64_t tuples, Use&& use);
  void decode_ascii(const DataArray& array, std::uint64_t tuples, std::span<double* const> columns);
  void spread(const DataArray& array, std::string_view bytes, std::uint64_t row,
              std::span<double* const> columns) const;
  void block(const DataArray& array, std::uint64_t index, Stored& stored, std::span<char> into);
  std::uint64_t word(const DataArray& array, Stored& from);

  const Document& document_;
  Buffer bytes_;  // of the block that was decoded last
  Buffer block_;  // out of base64, still compressed
  std::vector<std::uint64_t> block_sizes_;
};

/// What the file holds instead of particles ("a triangle mesh (64 triangles)"), by the types and
/// lengths of its cells; empty for particles: points without cells, or with vertices only.
std::string what_instead_of_particles(const Document& document, Decoder& decoder);

/// The array that tells ghosts; null where none does.
const DataArray* ghost_array(const Arrays& arrays);

/// True for points that are copies of another piece's; empty where no array tells of such.
std::vector<bool> ghost_points(const Document& document, Decoder& decoder);

/// Throws FormatError where cells name points that are not there; points that no cell names are
/// worth a line in `problems`.
void check_cells(const Document& document, const Piece& piece, const CellGroup& group,
                 Decoder& decoder, std::vector<std::string>& problems);

}  // namespace vtk_xml_file
}  // namespace bedscope::readers
