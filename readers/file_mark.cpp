// SPDX-License-Identifier: BSD-3-Clause
#include "readers/file_mark.hpp"

#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "readers/error.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {
namespace {

constexpr std::uint64_t look = 4096;  // bytes

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::uint32_t checksum(Source& source, std::uint64_t from, std::uint64_t to) {
  std::vector<char> bytes(to - from);
  source.seek(from);
  bytes.resize(source.read(bytes));
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace

FileMark mark_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw FileError("{}: {}", path, std::strerror(errno));
  FileMark mark;
  mark.path = std::filesystem::absolute(path).lexically_normal().string();
  mark.size = static_cast<std::uint64_t>(status.st_size);
  mark.modified = nanoseconds(status.st_mtim);
  mark.changed = nanoseconds(status.st_ctim);
  return mark;
}

void let_grow(FileMark& mark, std::uint64_t end) {
  Source source(mark.path);
  if (source.compressed()) return;
  mark.end = end;
  mark.head = checksum(source, 0, std::min(look, end));
  mark.before = checksum(source, end - std::min(look, end), end);
}

Change change_since(const FileMark& then, const FileMark& now) {
  if (then.path != now.path) return Change::other;
  if (then.size == now.size && then.modified == now.modified && then.changed == now.changed)
    return Change::none;
  if (then.end == 0 || now.size <= then.size || now.size < then.end) return Change::other;
  FileMark grown = then;
  let_grow(grown, then.end);
  return grown == then ? Change::grown : Change::other;
}

}  // namespace bedscope::readers
