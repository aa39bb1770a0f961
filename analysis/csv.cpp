// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/csv.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "readers/error.hpp"
#include "readers/text_file.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::size_t flush_at = 1 << 18;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// For a message of one line, from a field that may hold anything.
std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  return text.size() > longest ? result + "..." : result;
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& path, std::string_view header)
    : path_(path), output_(path), file_(std::fopen(output_.part().c_str(), "wb")) {
  if (file_ == nullptr) fail(errno);
  buffer_.reserve(flush_at + 4096);
  buffer_ = header;
  buffer_ += '\n';
}

CsvWriter::~CsvWriter() {
  if (file_ != nullptr) std::fclose(file_);
}

void CsvWriter::put(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    buffer_ += text;
  } else {
    buffer_ += '"';
    for (const char c : text) buffer_.append(c == '"' ? 2 : 1, c);
    buffer_ += '"';
  }
  buffer_ += ',';
}

void CsvWriter::put(double value) {
  if (std::isnan(value)) {
    buffer_ += "nan,";  // to_chars would write its sign, which means nothing
    return;
  }
  std::array<char, 32> digits{};
  buffer_.append(digits.data(),
                 std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  buffer_ += ',';
}

void CsvWriter::put(std::int64_t value) {
  std::array<char, 24> digits{};
  buffer_.append(digits.data(),
                 std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  buffer_ += ',';
}

void CsvWriter::end_row() {
  buffer_.back() = '\n';
  if (buffer_.size() >= flush_at) flush();
}

void CsvWriter::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size()) fail(errno);
  buffer_.clear();
}

void CsvWriter::commit() {
  flush();
  if (std::fclose(std::exchange(file_, nullptr)) != 0)
    fail(errno);  // a full disk may show only here
  output_.commit();
}

void CsvWriter::fail(int reason) const {
  throw FileError("{}: {}", path_.string(), std::strerror(reason));
}

CsvReader::CsvReader(const std::filesystem::path& path)
    : path_(path), text_(readers::read_text(path.string())) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  if (!read_record()) fail("a line of column names", "none");
  for (const std::string_view name : fields_) header_.emplace_back(trimmed(name));
}

std::optional<std::size_t> CsvReader::column(std::string_view name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) return std::nullopt;
  if (std::find(found + 1, header_.end(), name) != header_.end())
    throw FormatError("{}: line 1: expected one column '{}', found two", path_.string(), name);
  return static_cast<std::size_t>(found - header_.begin());
}

std::size_t CsvReader::needed(std::string_view name) const {
  if (const auto found = column(name)) return *found;
  throw FormatError("{}: line 1: expected a column '{}'{}, found '{}'", path_.string(), name,
                    header_.size() > 1 ? "" : " and others, with commas between them",
                    shown(fmt::format("{}", fmt::join(header_, ","))));
}

bool CsvReader::next() {
  if (!read_record()) return false;
  if (fields_.size() != header_.size())
    fail(fmt::format("{} fields", header_.size()), std::to_string(fields_.size()));
  return true;
}

double CsvReader::number(std::size_t column) const {
  std::string_view field = trimmed(fields_[column]);
  if (field.empty()) return not_a_number;
  if (field.front() == '+') field.remove_prefix(1);
  double value = not_a_number;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || std::isinf(value))
    fail(fmt::format("a number for '{}'", header_[column]),
         fmt::format("'{}'", shown(fields_[column])));
  return value;
}

double CsvReader::number(std::optional<std::size_t> column) const {
  return column ? number(*column) : not_a_number;
}

std::int64_t CsvReader::whole(std::size_t column, std::int64_t least) const {
  constexpr double most = 9007199254740992.0;  // 2^53: beyond it a double skips whole numbers
  const double value = number(column);
  if (!(value >= static_cast<double>(least) && value <= most && value == std::floor(value)))
    fail(fmt::format("a whole number for '{}'", header_[column]),
         fmt::format("'{}'", shown(fields_[column])));
  return static_cast<std::int64_t>(value);
}

void CsvReader::fail(std::string_view expected, std::string_view found) const {
  throw FormatError("{}: line {}: expected {}, found {}", path_.string(), line_, expected, found);
}

// One record into fields_, lines without any content skipped.
bool CsvReader::read_record() {
  while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r'))
    if (text_[at_++] == '\n') ++next_line_;
  line_ = next_line_;
  fields_.clear();
  if (at_ == text_.size()) return false;
  while (true) {
    fields_.push_back(read_field());
    if (at_ == text_.size()) return true;
    if (text_[at_++] == ',') continue;
    ++next_line_;
    return true;
  }
}

// One field; at_ then stands on the comma or line feed after it, or at the end.
std::string_view CsvReader::read_field() {
  if (at_ < text_.size() && text_[at_] == '"') return read_quoted();
  const std::size_t begin = at_;
  at_ = std::min(text_.find_first_of(",\n", at_), text_.size());
  std::string_view field = std::string_view(text_).substr(begin, at_ - begin);
  if ((at_ == text_.size() || text_[at_] == '\n') && field.ends_with('\r')) field.remove_suffix(1);
  return field;
}

std::string_view CsvReader::read_quoted() {
  const std::size_t begin = ++at_;
  std::size_t end = begin;  // of what is unescaped so far
  while (true) {
    if (at_ == text_.size()) fail("a closing quote", "the end of the file");
    const char c = text_[at_++];
    if (c == '"') {
      if (at_ == text_.size() || text_[at_] != '"') break;
      ++at_;
    }
    if (c == '\n') ++next_line_;
    text_[end++] = c;
  }
  if (at_ < text_.size() && text_[at_] == '\r') ++at_;
  if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n')
    fail("a comma or the line's end after a closing quote",
         fmt::format("'{}'", shown(std::string_view(text_).substr(at_, 1))));
  return std::string_view(text_).substr(begin, end - begin);
}

}  // namespace bedscope::analysis
