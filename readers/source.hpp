// SPDX-License-Identifier: BSD-3-Clause
// The bytes of one file, plain or gzip, read forward in large pieces.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace bedscope::readers {

class Checkpoint;

/// How much is read in one go: what is usual, or so little that the fuzz targets meet the edges of
/// every window.
#ifdef BEDSCOPE_FUZZING
constexpr std::size_t window_bytes(std::size_t) { return 256; }
#else
constexpr std::size_t window_bytes(std::size_t usual) { return usual; }
#endif

/// A regular file opened for reading. A gzip file (by its magic bytes, whatever its name) is
/// decompressed on the way, concatenated members included; offsets are of the decompressed bytes.
/// Throws FileError for anything that is not a readable regular file, naming the reason.
class Source {
 public:
  explicit Source(const std::string& path);
  ~Source();
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// Fills `into` unless the file ends before; returns how many bytes were read.
  /// A gzip stream that ends early gives what it holds; `cut()` then says where.
  std::size_t read(std::span<char> into);

  /// Moves to an offset. Inside gzip this decompresses what lies between (from the start for a step
  /// back), unless a checkpoint is nearer.
  void seek(std::uint64_t offset);

  /// Reads nothing behind `offset`, as if the file ended there.
  void stop_at(std::uint64_t offset);

  /// The state of the decompression at position(), 40 kB, to jump back to later from any Source of
  /// the same file; null for plain files, which need none.
  std::shared_ptr<const Checkpoint> checkpoint() const;
  void resume(const std::shared_ptr<const Checkpoint>& checkpoint);

  std::uint64_t position() const;         ///< offset of the next byte
  bool compressed() const;                ///< gzip
  std::uint64_t bytes_from_disk() const;  ///< read so far
  const std::string& path() const;

  /// An upper bound of the decompressed size: exact for plain files; for gzip the 1032-fold that
  /// deflate can reach at most. Counts in headers are claims; this bounds them.
  std::uint64_t size_bound() const;

  /// The decompressed size: exact for plain files, what the trailer claims for gzip. For estimates.
  std::uint64_t likely_size() const;

  /// Where a gzip stream ends early ("gzip stream ends early at offset 402"), or is followed by
  /// other bytes; empty otherwise. Known once the end was read.
  const std::string& cut() const;
  const std::string& trailing() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The first bytes of a file, decompressed; fewer than `count` only where the file is shorter.
std::string read_head(const std::string& path, std::size_t count = 4096);

/// The number (from 1) of the line that holds the byte at `offset`. Reads the file: for errors
/// only.
std::uint64_t line_at(const std::string& path, std::uint64_t offset);

}  // namespace bedscope::readers
