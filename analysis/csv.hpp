// SPDX-License-Identifier: BSD-3-Clause
// CSV as RFC 4180 has it, with `nan` for what is undefined: a row at a time, in and out.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/output_file.hpp"

namespace bedscope::analysis {

/// Writes a table row by row; the file appears under its name at commit(), else not at all.
/// Throws FileError naming path and reason.
class CsvWriter {
 public:
  CsvWriter(const std::filesystem::path& path, std::string_view header);
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  /// Fields are strings (quoted where needed), integers, or doubles (the shortest digits that read
  /// back to the same bits; `nan`, `inf`).
  template <class... T>
  void row(const T&... fields) {
    (put(fields), ...);
    end_row();
  }
  void commit();

 private:
  void put(std::string_view text);
  void put(double value);
  void put(std::int64_t value);
  void put(int value) { put(std::int64_t{value}); }
  void end_row();
  void flush();
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path path_;
  OutputFile output_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
};

/// Reads a table row by row, its columns found by name. LF and CRLF, a byte order mark, quoted
/// fields with line breaks in them and empty lines are all accepted.
/// Throws FileError, or FormatError with path and line.
class CsvReader {
 public:
  explicit CsvReader(const std::filesystem::path& path);

  /// The titles of the columns, in order.
  const std::vector<std::string>& header() const { return header_; }
  /// The place of a column in the rows; nothing where the table has none of that name. Two of it
  /// are an error.
  std::optional<std::size_t> column(std::string_view name) const;
  /// The same, but FormatError where there is none.
  std::size_t needed(std::string_view name) const;

  /// Goes to the next row, which has as many fields as the header; false at the end.
  bool next();

  std::size_t line() const { return line_; }  ///< on which the present row begins, from 1
  std::string_view text(std::size_t column) const { return fields_[column]; }
  /// A number; NaN for `nan` and for an empty field; an infinite one is none.
  double number(std::size_t column) const;
  /// The same; NaN where there is no such column.
  double number(std::optional<std::size_t> column) const;
  /// A whole number from `least` up; "3.0" counts as one.
  std::int64_t whole(std::size_t column, std::int64_t least) const;
  /// FormatError "path: line N: expected ..., found ...".
  [[noreturn]] void fail(std::string_view expected, std::string_view found) const;

 private:
  bool read_record();
  std::string_view read_field();
  std::string_view read_quoted();

  std::filesystem::path path_;
  std::string text_;  // quoted fields are unescaped in place, so that fields are views into it
  std::size_t at_ = 0, line_ = 1, next_line_ = 1;
  std::vector<std::string> header_;
  std::vector<std::string_view> fields_;
};

}  // namespace bedscope::analysis
