// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets share. A target is one file that defines use(): all that the program does
// with such an input. fuzz.cpp calls it and holds it to the promises of docs/reliability.md.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace bedscope::fuzz {

/// Everything that the program does with this input. May end in a bedscope::Error; any other
/// exception, and whatever the sanitizers mind, is a finding.
void use(std::string_view input);

/// A promise that must hold; prints and aborts where it does not.
void require(bool holds, std::string_view promise);

/// A line for the user (an error, an entry of `problems`): one line of printable text, and short.
void require_line(std::string_view text);

/// Bytes that count as input besides those given to use(): what a gzip stream expands to.
void add_input(std::size_t bytes);

/// A regular file in memory. Its path stays the same from input to input.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& write(std::string_view bytes);  ///< replaces the content

 private:
  int file_ = -1;
  std::string path_;
};

/// Several files in one input: each begins with a line "=== its/path". What stands before the first
/// such line is dropped, as are parts with odd paths.
std::map<std::string, std::string_view> parts_of(std::string_view input);

/// A folder in memory that holds the parts of one input; gone with the object. Its path stays the
/// same from input to input and from run to run, which libFuzzer needs to do the same again.
class MemoryFolder {
 public:
  explicit MemoryFolder(const std::map<std::string, std::string_view>& parts);
  ~MemoryFolder();
  MemoryFolder(const MemoryFolder&) = delete;
  MemoryFolder& operator=(const MemoryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string real_;
  int folder_ = -1;
  std::string path_;
};

/// A file that the program keeps for itself (readers/archive.hpp), whole when made.
class KeptFile {
 public:
  /// `make` leaves it as the only file in `folder`.
  KeptFile(const std::filesystem::path& folder, const std::function<void()>& make);

  /// Writes it with the changes that `input` asks for, in records of four bytes: a place (two),
  /// what (c: cut there, d: leave out, i: insert, else: replace), and a byte. `valid`: the checksum
  /// is that of the changed bytes. Without changes it is what was made.
  void change(std::string_view input, bool valid = true) const;

 private:
  std::filesystem::path path_;
  std::string whole_;
};

}  // namespace bedscope::fuzz
