// SPDX-License-Identifier: BSD-3-Clause
// The numbers of one array of a VTK XML file: ascii, base64 or raw, in compressed blocks or not.
//
// Uncompressed: [bytes] data. Compressed: [blocks] [size of a block] [size of the last one, 0: as
// the others] [compressed size of each block] blocks. The numbers in brackets have header_type.
#include <fast_float/fast_float.h>
#include <libdeflate.h>
#include <lz4.h>
#include <lzma.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include "readers/base64.hpp"
#include "readers/numbers.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers::vtk_xml_file {
namespace {

bool blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

// The most that a compressor can pack into one byte; counts in headers are claims, this bounds
// them.
std::uint64_t packing_bound(Compressor compressor) {
  switch (compressor) {
    case Compressor::zlib:
      return 1032;  // zlib.net/zlib_tech.html, "Maximum Compression Factor"
    case Compressor::lz4:
      return 255;  // a run grows by at most 255 a byte
    case Compressor::lzma:
      return 8192;  // 273 bytes a match of 14 bits that cost 0.022 bit each
    case Compressor::none:
      break;
  }
  return 1;
}

// Two to three times as fast as zlib on blocks that are there as a whole (docs/performance.md).
libdeflate_decompressor* inflater() {
  thread_local const std::unique_ptr<libdeflate_decompressor,
                                     decltype(&libdeflate_free_decompressor)>
      own(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (own == nullptr) throw std::bad_alloc();
  return own.get();
}

template <class T>
T swapped(T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  std::reverse(bytes, bytes + sizeof(T));
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class F>
void with_type(Number type, F&& use) {
  switch (type) {
    case Number::int8:
      return use(std::int8_t{});
    case Number::uint8:
      return use(std::uint8_t{});
    case Number::int16:
      return use(std::int16_t{});
    case Number::uint16:
      return use(std::uint16_t{});
    case Number::int32:
      return use(std::int32_t{});
    case Number::uint32:
      return use(std::uint32_t{});
    case Number::int64:
      return use(std::int64_t{});
    case Number::uint64:
      return use(std::uint64_t{});
    case Number::float32:
      return use(float{});
    case Number::float64:
      return use(double{});
    case Number::other:
      return;
  }
}

// Raw bytes to the columns that are wanted, from `row` on, one component after the other.
template <class T, bool swap>
void scatter(std::string_view bytes, std::size_t components, std::uint64_t row,
             std::span<double* const> columns) {
  const std::size_t tuples = bytes.size() / (components * sizeof(T));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c] == nullptr) continue;
    double* const to = columns[c] + row;
    const char* from = bytes.data() + c * sizeof(T);
    for (std::size_t i = 0; i < tuples; ++i, from += components * sizeof(T)) {
      T value;
      std::memcpy(&value, from, sizeof(T));
      if constexpr (swap) value = swapped(value);
      to[i] = static_cast<double>(value);
    }
  }
}

// A token that ends at a blank; whole, a number of type T. VTK reads Float32 as float: a double
// rounded to float may differ in the last bit.
template <class T>
bool parse_word(const char*& at, const char* end, double& value) {
  using Parsed = std::conditional_t<std::is_same_v<T, float>, float, double>;
  const char* begin = at;
  if (*begin == '+' && end - begin > 1 && begin[1] != '-') ++begin;
  Parsed parsed{};
  const auto [stop, error] = fast_float::from_chars(begin, end, parsed);
  if (error == std::errc::invalid_argument) return false;
  value = static_cast<double>(parsed);
  if (stop != end && !blank(*stop)) {  // a number that goes on: 1.#QNAN of older Windows
    const char* const behind = std::find_if(stop, end, blank);
    if (!parse_number(begin, behind, value) || std::isfinite(value)) return false;
    at = behind;
    return !std::is_integral_v<T>;
  }
  if constexpr (std::is_integral_v<T>) {
    const bool inside = value >= static_cast<double>(std::numeric_limits<T>::min()) &&
                        value <= static_cast<double>(std::numeric_limits<T>::max());
    if (!inside || value != std::trunc(value)) return false;
  }
  at = stop;
  return true;
}

}  // namespace

// Raw bytes are handed out as they lie in the file, base64 is decoded into a buffer.
class Decoder::Stored {
 public:
  Stored(std::string_view bytes, bool base64)
      : all_(bytes), raw_(bytes), text_(bytes), base64_(base64) {}

  // The next bytes; fewer where they end before.
  std::string_view take(std::uint64_t count, Buffer& buffer) {
    count = std::min(count, left());
    if (!base64_) {
      const std::string_view taken = raw_.substr(0, count);
      raw_.remove_prefix(count);
      return taken;
    }
    char* const decoded = buffer.reserve(count);
    return {decoded, text_.read(decoded, count)};
  }

  // Reads straight to where the bytes are wanted.
  std::size_t read(char* into, std::size_t count) {
    if (base64_) return text_.read(into, count);
    count = std::min(count, raw_.size());
    if (count > 0) std::memcpy(into, raw_.data(), count);
    raw_.remove_prefix(count);
    return count;
  }

  std::uint64_t left() const { return base64_ ? text_.left() : raw_.size(); }

  // Why bytes are missing.
  std::string reason() const {
    if (!base64_ || !text_.damaged()) return "the data end before";
    return fmt::format("byte 0x{:02x} not in the base64 alphabet (or a \"=\" out of place)",
                       static_cast<unsigned char>(all_[text_.position()]));
  }

 private:
  std::string_view all_;  // from the first byte on
  std::string_view raw_;  // what is left of it
  Base64Reader text_;
  bool base64_;
};

Decoder::Stored Decoder::stored(const DataArray& array) const {
  if (array.storage == Storage::inline_base64) return {array.text, true};
  if (!document_.has_appended) fail(array, "appended, but the file has no <AppendedData>");
  if (array.offset >= document_.appended.size()) {
    fail(array, "offset {} beyond the appended data of {} bytes", array.offset,
         document_.appended.size());
  }
  return {document_.appended.substr(array.offset), document_.appended_base64};
}

// Bytes of so many tuples once decoded.
std::uint64_t Decoder::checked_size(const DataArray& array, std::uint64_t tuples) const {
  if (array.type == Number::other)
    fail(array, "type '{}' is not a type of numbers", array.type_name);
  const std::uint64_t one = array.components * size_of(array.type);
  if (array.components > 1'000'000 || tuples > std::numeric_limits<std::int64_t>::max() / one) {
    fail(array, "{} tuples of {} components are more than any file holds", tuples,
         array.components);
  }
  return one * tuples;
}

void Decoder::bound(const DataArray& array, std::uint64_t tuples) {
  const std::uint64_t expected = checked_size(array, tuples);
  if (array.storage == Storage::ascii) {
    const std::uint64_t numbers = tuples * array.components;
    const std::uint64_t most = (array.text.size() + 1) / 2;  // a digit and a blank each
    if (numbers > most) fail(array, "{} numbers expected, at most {} found", numbers, most);
  } else if (expected > 0) {
    Stored from = stored(array);
    read_header(array, from, expected);
  }
}

void Decoder::decode(const DataArray& array, std::uint64_t tuples,
                     std::span<double* const> columns) {
  if (array.storage == Storage::ascii) {
    decode_ascii(array, tuples, columns);
  } else {
    binary(array, tuples,
           [&](std::string_view bytes, std::uint64_t row) { spread(array, bytes, row, columns); });
  }
}

void Decoder::spread(const DataArray& array, std::string_view bytes, std::uint64_t row,
                     std::span<double* const> columns) const {
  with_type(array.type, [&](auto type) {
    using T = decltype(type);
    document_.swap ? scatter<T, true>(bytes, array.components, row, columns)
                   : scatter<T, false>(bytes, array.components, row, columns);
  });
}

void Decoder::decode_ascii(const DataArray& array, std::uint64_t tuples,
                           std::span<double* const> columns) {
  bound(array, tuples);
  const std::uint64_t numbers = tuples * array.components;
  const char* at = array.text.data();
  const char* const end = at + array.text.size();
  with_type(array.type, [&](auto type) {
    std::size_t component = 0;
    std::uint64_t row = 0;
    for (std::uint64_t i = 0;; ++i) {
      while (at != end && blank(*at)) ++at;
      if (at == end) {
        if (i < numbers) fail(array, "{} numbers expected, {} found", numbers, i);
        return;
      }
      if (i == numbers) fail(array, "{} numbers expected, more found", numbers);
      double value = 0;
      if (!parse_word<decltype(type)>(at, end, value)) {
        const char* const stop =
            std::find_if(at, at + std::min<std::ptrdiff_t>(end - at, 40), blank);
        fail(array, "number {}: expected {}, found '{}'", i + 1, array.type_name,
             std::string_view(at, static_cast<std::size_t>(stop - at)));
      }
      if (component < columns.size() && columns[component] != nullptr) {
        columns[component][row] = value;
      }
      if (++component == array.components) {
        component = 0;
        ++row;
      }
    }
  });
}

void Decoder::decode(const DataArray& array, std::uint64_t tuples, std::vector<double>& into) {
  if (array.components != 1) fail(array, "expected 1 component, found {}", array.components);
  bound(array, tuples);
  into.clear();
  if (array.storage == Storage::ascii) {
    into.resize(tuples);
    double* const column = into.data();
    decode_ascii(array, tuples, {&column, 1});
    return;
  }
  // Grows with what is really there: the bound of compressed blocks is a generous one.
  binary(array, tuples, [&](std::string_view bytes, std::uint64_t row) {
    into.resize(row + bytes.size() / size_of(array.type));
    double* const column = into.data();
    spread(array, bytes, row, {&column, 1});
  });
}

std::uint64_t Decoder::word(const DataArray& array, Stored& from) {
  char bytes[8];
  if (from.read(bytes, document_.word) < document_.word) {
    fail(array, "{}: header of {} bytes expected", from.reason(), document_.word);
  }
  if (document_.word == 4) {
    std::uint32_t value;
    std::memcpy(&value, bytes, 4);
    return document_.swap ? swapped(value) : value;
  }
  std::uint64_t value;
  std::memcpy(&value, bytes, 8);
  return document_.swap ? swapped(value) : value;
}

// What stands before the data of an array. All of it is a claim; on return it is bounded by the
// bytes that are there.
Decoder::Header Decoder::read_header(const DataArray& array, Stored& from, std::uint64_t expected) {
  const std::uint64_t numbers = expected / size_of(array.type);
  if (document_.compressor == Compressor::none) {
    const std::uint64_t size = word(array, from);
    if (size != expected) {
      fail(array, "{} bytes expected ({} x {}), header says {}: header size not plausible ({})",
           expected, numbers, array.type_name, size, "header_type, byte_order or data wrong");
    }
    if (size > from.left()) {
      fail(array, "header says {} bytes, fewer decoded: at most {} there", size, from.left());
    }
    return {};
  }
  const std::uint64_t blocks = word(array, from);
  const std::uint64_t size = word(array, from);
  const std::uint64_t last = word(array, from);
  const bool plausible = blocks > 0 && blocks <= from.left() / document_.word && size > 0 &&
                         blocks - 1 <= expected / size && last <= size &&
                         (blocks - 1) * size + (last > 0 ? last : size) == expected;
  if (!plausible) {
    fail(array,
         "{} bytes expected ({} x {}), header says {} blocks of {} bytes, the last of {}: {}",
         expected, numbers, array.type_name, blocks, size, last, "header size not plausible");
  }
  block_sizes_.resize(blocks);
  std::uint64_t packed = 0;
  for (std::uint64_t& block_size : block_sizes_) {
    block_size = word(array, from);
    if (block_size > from.left()) {
      fail(array, "header says a block of {} bytes, fewer decoded: at most {} there", block_size,
           from.left());
    }
    packed += block_size;
  }
  if (packed > from.left() || expected / packing_bound(document_.compressor) > packed) {
    fail(array, "{} bytes expected, {} in compressed blocks, {} there", expected, packed,
         from.left());
  }
  return {size};
}

// Hands the bytes of an array over, whole tuples and the row of the first, in the order of the
// file: a block or a piece at a time, which is still in the cache then.
template <class Use>
void Decoder::binary(const DataArray& array, std::uint64_t tuples, Use&& use) {
  const std::uint64_t expected = checked_size(array, tuples);
  if (expected == 0) return;
  const std::uint64_t tuple = expected / tuples;
  Stored from = stored(array);
  const Header header = read_header(array, from, expected);
  if (document_.compressor == Compressor::none) {
    const std::uint64_t piece = std::max<std::uint64_t>(1, (1U << 15) / tuple) * tuple;
    for (std::uint64_t done = 0; done < expected;) {
      const std::uint64_t size = std::min(piece, expected - done);
      const std::string_view bytes = from.take(size, bytes_);
      if (bytes.size() < size) {
        fail(array, "{}: header says {} bytes, {} decoded", from.reason(), expected,
             done + bytes.size());
      }
      use(bytes, done / tuple);
      done += size;
    }
    return;
  }
  const std::uint64_t size = std::min(header.block_size, expected);
  char* const decoded = bytes_.reserve(size + tuple);
  std::uint64_t begun = 0;  // bytes of a tuple that the block before ends in
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < block_sizes_.size(); ++i) {
    const std::uint64_t length = std::min(size, expected - done);
    block(array, i, from, {decoded + begun, length});
    const std::uint64_t there = begun + length;
    const std::uint64_t row = (done - begun) / tuple;
    begun = there % tuple;
    use(std::string_view(decoded, there - begun), row);
    std::memmove(decoded, decoded + there - begun, begun);
    done += length;
  }
}

void Decoder::block(const DataArray& array, std::uint64_t index, Stored& stored,
                    std::span<char> into) {
  const std::string_view from = stored.take(block_sizes_[index], block_);
  if (from.size() < block_sizes_[index]) {
    fail(array, "block {} of {}: {}: header says {} bytes, {} decoded", index + 1,
         block_sizes_.size(), stored.reason(), block_sizes_[index], from.size());
  }
  constexpr std::uint64_t most = std::numeric_limits<int>::max();  // LZ4 counts in int
  std::uint64_t got = 0;
  bool good = from.size() <= most && into.size() <= most;
  std::string_view kind = "block";
  if (good && document_.compressor == Compressor::zlib) {
    kind = "zlib";
    std::size_t length = 0;
    good = libdeflate_zlib_decompress(inflater(), from.data(), from.size(), into.data(),
                                      into.size(), &length) == LIBDEFLATE_SUCCESS;
    got = length;
  } else if (good && document_.compressor == Compressor::lz4) {
    kind = "lz4";
    const int length = LZ4_decompress_safe(from.data(), into.data(), static_cast<int>(from.size()),
                                           static_cast<int>(into.size()));
    good = length >= 0;
    got = good ? static_cast<std::uint64_t>(length) : 0;
  } else if (good) {
    kind = "lzma";
    std::uint64_t memory = std::uint64_t{1} << 28;  // the largest dictionary of xz takes 64 MB
    std::size_t used = 0, length = 0;
    good = lzma_stream_buffer_decode(&memory, 0, nullptr,
                                     reinterpret_cast<const std::uint8_t*>(from.data()), &used,
                                     from.size(), reinterpret_cast<std::uint8_t*>(into.data()),
                                     &length, into.size()) == LZMA_OK;
    got = length;
  }
  if (good && got == into.size()) return;
  fail(array, "block {} of {}: {} stream damaged ({} bytes expected, {} decoded)", index + 1,
       block_sizes_.size(), kind, into.size(), got);
}

}  // namespace bedscope::readers::vtk_xml_file
