// SPDX-License-Identifier: BSD-3-Clause
// A VTK XML file without the bodies of its large binary arrays: enough to count particles, at a
// fraction of the reading. How long a body is, its header claims; what follows there must be a tag.
#include <algorithm>
#include <array>
#include <bit>

#include "readers/base64.hpp"
#include "readers/source.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers::vtk_xml_file {
namespace {

constexpr std::size_t window = window_bytes(std::size_t{1} << 13);
constexpr std::size_t least_body = std::size_t{1} << 14;  // shorter ones are read as cheaply
constexpr std::size_t most_text = std::size_t{1} << 20;   // ascii: no bodies to jump over

std::uint64_t encoded(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

class Condenser {
 public:
  explicit Condenser(Source& source) : source_(source) {}

  std::optional<std::string> run() {
    load(0);
    XmlReader root(text_, source_.path());
    if (root.next() != XmlReader::Event::open || root.attribute("byte_order") == "BigEndian" ||
        std::endian::native != std::endian::little)
      return std::nullopt;
    word_ = root.attribute("header_type") == "UInt64" ? 8 : 4;
    packed_ = root.attribute("compressor").has_value();
    while (!text_.empty()) {
      if (out_.size() > most_text) return std::nullopt;
      if (!step()) return std::nullopt;
    }
    return std::move(out_);
  }

 private:
  void load(std::uint64_t offset) {
    at_ = offset;
    source_.seek(offset);
    text_ = {buffer_.data(), source_.read(buffer_)};
  }

  // Copies what comes before `count` and goes on behind it.
  void pass(std::size_t count) {
    out_ += text_.substr(0, count);
    load(at_ + count);
  }

  // One window: up to the first tag that leads to a body to jump over, or wholly.
  bool step() {
    for (std::size_t tag = text_.find("<"); tag != text_.npos; tag = text_.find("<", tag + 1)) {
      const auto rest = text_.substr(tag);
      const auto close = rest.find('>');
      if (close == rest.npos || (tag > 0 && rest.size() < window / 2 && text_.size() == window)) {
        if (tag == 0) return false;  // a tag of a whole window, or one that never ends
        pass(tag);
        return true;
      }
      const auto head = rest.substr(0, close + 1);
      if (head.starts_with("<AppendedData")) return drop_appended(tag + head.size());
      if (!head.starts_with("<DataArray") || is_needed(head)) continue;
      const auto length = body_length(rest.substr(head.size()));
      if (!length) return false;
      if (*length < least_body) continue;
      out_ += text_.substr(0, tag + head.size());
      load(at_ + tag + head.size() + *length);
      const auto next = text_.find_first_not_of(" \t\r\n");
      return next != text_.npos && text_[next] == '<';
    }
    pass(text_.size());
    return true;
  }

  static bool is_needed(std::string_view head) {
    const auto says = [&](std::string_view text) { return head.find(text) != head.npos; };
    return (!says("format=\"binary\"") && !says("format='binary'")) || says("\"types\"") ||
           says("'types'") || says("vtkGhost") || says("TimeValue");
  }

  // From the first byte behind the tag to the last of the body.
  std::optional<std::uint64_t> body_length(std::string_view body) const {
    const auto blanks = std::min(body.find_first_not_of(" \t\r\n"), body.size());
    Base64Reader data(body.substr(blanks));
    const auto number = [&]() -> std::optional<std::uint64_t> {
      std::array<char, 8> bytes{};
      if (data.read(bytes.data(), word_) < word_) return std::nullopt;
      return std::bit_cast<std::uint64_t>(bytes);
    };
    const auto first = number();
    const auto most = source_.size_bound();
    if (!first || *first > most) return std::nullopt;
    if (!packed_) return blanks + encoded(word_ + *first);
    if (!number() || !number()) return std::nullopt;
    std::uint64_t sum = 0;
    for (std::uint64_t k = 0; k < *first; ++k) {
      const auto size = number();
      if (!size || *size > most || (sum += *size) > most) return std::nullopt;
    }
    return blanks + encoded(word_ * (3 + *first)) + encoded(sum);
  }

  // What is appended is not looked at, but for the end of the file.
  bool drop_appended(std::size_t count) {
    out_ += text_.substr(0, count);
    out_ += "_</AppendedData></VTKFile>";
    const auto size = source_.size_bound();
    load(size - std::min<std::uint64_t>(size, 64));
    const bool whole = text_.find("</VTKFile>") != text_.npos;
    text_ = {};
    return whole;
  }

  Source& source_;
  std::array<char, window> buffer_{};
  std::string_view text_;
  std::uint64_t at_ = 0;
  std::size_t word_ = 4;
  bool packed_ = false;
  std::string out_;
};

}  // namespace

std::optional<std::string> condensed(const std::string& path) {
  constexpr std::uint64_t worth_it = std::uint64_t{1} << 18;  // bytes
  Source source(path);
  if (source.compressed() || source.size_bound() < window_bytes(worth_it)) return std::nullopt;
  try {
    return Condenser(source).run();
  } catch (const FormatError&) {
    return std::nullopt;
  }
}

}  // namespace bedscope::readers::vtk_xml_file
