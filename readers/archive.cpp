// SPDX-License-Identifier: BSD-3-Clause
#include "readers/archive.hpp"

#include <zlib.h>

#include <cerrno>
#include <cstring>

#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

constexpr std::size_t piece = 1U << 18;

std::uint32_t add_to(std::uint32_t checksum, const void* data, std::size_t size) {
  return static_cast<std::uint32_t>(
      crc32_z(checksum, static_cast<const unsigned char*>(data), size));
}

}  // namespace

ArchiveWriter::ArchiveWriter(const std::filesystem::path& path, std::string_view kind)
    : path_(path) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw FileError("{}: {}", path.parent_path().string(), error.message());
  file_.reset(std::fopen(path.c_str(), "wb"));
  if (!file_) throw FileError("{}: {}", path.string(), std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // pieces are large
  raw(kind.data(), kind.size());
}

void ArchiveWriter::raw(const void* data, std::size_t size) {
  buffer_.append(static_cast<const char*>(data), size);
  size_ += size;
  if (file_ && buffer_.size() >= piece) flush();
}

void ArchiveWriter::flush() {
  checksum_ = add_to(checksum_, buffer_.data(), buffer_.size());
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size())
    throw FileError("{}: {}", path_.string(), std::strerror(errno));
  buffer_.clear();
}

void ArchiveWriter::finish() {
  flush();
  const auto checksum = checksum_;
  if (std::fwrite(&checksum, sizeof checksum, 1, file_.get()) != 1 ||
      std::fclose(file_.release()) != 0)  // a full disk may show only here
    throw FileError("{}: {}", path_.string(), std::strerror(errno));
}

ArchiveReader::ArchiveReader(const std::filesystem::path& path, std::string_view kind)
    : path_(path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!error) file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) throw FileError("{}: {}", path.string(), error ? error.message() : strerror(errno));
  if (size < sizeof checksum_) throw FormatError("{}: file is cut", path.string());
  left_ = size - sizeof checksum_;
  std::string found(kind.size(), '\0');
  raw(found.data(), found.size());
  if (found != kind)
    throw FormatError("{}: line 1: expected \"{}\"", path.string(),
                      kind.substr(0, kind.find('\n')));
}

void ArchiveReader::raw(void* data, std::size_t size) {
  if (size == 0) return;  // zlib takes an empty vector's null for a new start
  if (size > left_ || std::fread(data, 1, size, file_.get()) != size)
    throw FormatError("{}: {} bytes from the end: {} expected", path_.string(), left_, size);
  left_ -= size;
  checksum_ = add_to(checksum_, data, size);
}

std::size_t ArchiveReader::count(std::size_t, std::size_t bytes_each) {
  std::uint64_t found = 0;
  raw(&found, sizeof found);
  if (bytes_each > 0 && found > left_ / bytes_each)
    throw FormatError("{}: {} values declared, {} bytes left", path_.string(), found, left_);
  return found;
}

void ArchiveReader::finish() {
  std::uint32_t expected = 0;
  if (left_ != 0 || std::fread(&expected, sizeof expected, 1, file_.get()) != 1 ||
      expected != checksum_)
    throw FormatError("{}: checksum differs: file is damaged", path_.string());
}

}  // namespace bedscope::readers
