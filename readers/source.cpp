// SPDX-License-Identifier: BSD-3-Clause
#include "readers/source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::readers {
namespace {

constexpr std::size_t gzip_input = window_bytes(1U << 16);
constexpr int gzip_window = 15 + 16;           // the largest window, gzip framing
constexpr std::uint64_t deflate_limit = 1032;  // deflate cannot expand a byte to more than this

bool is_gzip(const unsigned char* bytes, std::size_t count) {
  return count >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

}  // namespace

/// A copy of zlib's state, and where in the compressed file it stood.
class Checkpoint {
 public:
  Checkpoint(z_stream& stream, std::uint64_t offset_on_disk, std::uint64_t offset)
      : input_offset(offset_on_disk), position(offset) {
    good = inflateCopy(&state, &stream) == Z_OK;
  }
  ~Checkpoint() {
    if (good) inflateEnd(&state);
  }
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  mutable z_stream state{};  // inflateCopy takes its source by non-const pointer
  bool good = false;
  std::uint64_t input_offset, position;
};

struct Source::Impl {
  std::string path;
  int file = -1;
  std::uint64_t size = 0;  // on disk
  std::uint64_t position = 0;
  std::uint64_t bytes_read = 0;
  std::uint64_t stop = ~std::uint64_t{0};
  bool compressed = false;
  std::string cut, trailing;

  z_stream stream{};
  bool stream_open = false;
  bool stream_ended = false;
  std::uint64_t input_offset = 0;  // of the byte after what `input` holds
  std::vector<unsigned char> input;

  ~Impl() {
    if (stream_open) inflateEnd(&stream);
    if (file >= 0) ::close(file);
  }

  std::size_t read_disk(char* into, std::size_t count) {
    std::size_t done = 0;
    while (done < count) {
      const auto got = ::read(file, into + done, count - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw FileError("{}: {}", path, std::strerror(errno));
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    bytes_read += done;
    return done;
  }

  void move_disk(std::uint64_t offset) {
    if (::lseek(file, static_cast<off_t>(offset), SEEK_SET) < 0)
      throw FileError("{}: {}", path, std::strerror(errno));
  }

  void restart() {
    if (stream_open) inflateEnd(&stream);
    stream = z_stream{};
    if (inflateInit2(&stream, gzip_window) != Z_OK) throw FileError("{}: no memory for zlib", path);
    stream_open = true;
    stream_ended = false;
    move_disk(0);
    input_offset = 0;
    position = 0;
  }

  bool refill() {
    const auto got = read_disk(reinterpret_cast<char*>(input.data()), input.size());
    input_offset += got;
    stream.next_in = input.data();
    stream.avail_in = static_cast<uInt>(got);
    return got > 0;
  }

  /// At the end of a member: another one, trailing bytes, or the end of the file.
  void next_member() {
    if (stream.avail_in < 2) {  // keep what there is and look further
      const std::size_t kept = stream.avail_in;
      std::memmove(input.data(), stream.next_in, kept);
      const auto got = read_disk(reinterpret_cast<char*>(input.data()) + kept, input.size() - kept);
      input_offset += got;
      stream.next_in = input.data();
      stream.avail_in = static_cast<uInt>(kept + got);
    }
    if (stream.avail_in == 0) {
      stream_ended = true;
    } else if (is_gzip(stream.next_in, stream.avail_in)) {
      inflateReset(&stream);
    } else {
      stream_ended = true;
      trailing = fmt::format("bytes after the gzip stream ignored, from offset {}",
                             input_offset - stream.avail_in);
    }
  }

  std::size_t inflate_into(char* into, std::size_t count) {
    std::size_t done = 0;
    while (done < count && !stream_ended) {
      if (stream.avail_in == 0 && !refill()) {
        cut = fmt::format("gzip stream ends early at offset {}", size);
        stream_ended = true;
        break;
      }
      const std::size_t ask = std::min<std::size_t>(count - done, 1U << 30);
      stream.next_out = reinterpret_cast<unsigned char*>(into + done);
      stream.avail_out = static_cast<uInt>(ask);
      const int code = inflate(&stream, Z_NO_FLUSH);
      done += ask - stream.avail_out;
      if (code == Z_STREAM_END) {
        next_member();
      } else if (code != Z_OK && code != Z_BUF_ERROR) {
        throw FormatError("{}: offset {}: gzip stream damaged ({})", path,
                          input_offset - stream.avail_in,
                          stream.msg != nullptr ? stream.msg : "zlib error");
      }
    }
    return done;
  }
};

Source::Source(const std::string& path) : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  // Non-blocking: opening a named pipe must not wait for somebody to write into it.
  impl_->file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (impl_->file < 0) {
    const int reason = errno;
    throw FileError("{}: {}", path,
                    reason == ENOENT   ? "no such file"
                    : reason == EACCES ? "permission denied"
                    : reason == ELOOP  ? "too many levels of symbolic links"
                                       : std::strerror(reason));
  }
  struct stat status {};
  if (::fstat(impl_->file, &status) != 0) throw FileError("{}: {}", path, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw FileError("{}: is a directory, expected a file", path);
  if (!S_ISREG(status.st_mode)) throw FileError("{}: not a regular file", path);
  impl_->size = static_cast<std::uint64_t>(status.st_size);

  std::array<unsigned char, 2> magic{};
  const auto got = ::pread(impl_->file, magic.data(), magic.size(), 0);
  if (got > 0 && is_gzip(magic.data(), static_cast<std::size_t>(got))) {
    impl_->compressed = true;
    impl_->input.resize(gzip_input);
    impl_->restart();
  }
}

Source::~Source() = default;

std::size_t Source::read(std::span<char> into) {
  if (impl_->position >= impl_->stop) return 0;
  into = into.first(std::min<std::uint64_t>(into.size(), impl_->stop - impl_->position));
  const auto got = impl_->compressed ? impl_->inflate_into(into.data(), into.size())
                                     : impl_->read_disk(into.data(), into.size());
  impl_->position += got;
  return got;
}

void Source::seek(std::uint64_t offset) {
  if (!impl_->compressed) {
    impl_->move_disk(offset);
    impl_->position = offset;
    return;
  }
  if (offset < impl_->position) impl_->restart();
  std::vector<char> skipped(
      std::min<std::uint64_t>(offset - impl_->position, window_bytes(1U << 18)));
  while (impl_->position < offset) {
    const auto ask = std::min<std::uint64_t>(offset - impl_->position, skipped.size());
    if (read({skipped.data(), static_cast<std::size_t>(ask)}) < ask) return;
  }
}

void Source::stop_at(std::uint64_t offset) { impl_->stop = offset; }

std::shared_ptr<const Checkpoint> Source::checkpoint() const {
  if (!impl_->compressed || impl_->stream_ended) return nullptr;
  auto made = std::make_shared<const Checkpoint>(
      impl_->stream, impl_->input_offset - impl_->stream.avail_in, impl_->position);
  return made->good ? made : nullptr;
}

void Source::resume(const std::shared_ptr<const Checkpoint>& checkpoint) {
  if (!impl_->compressed || checkpoint == nullptr) return;
  inflateEnd(&impl_->stream);
  if (inflateCopy(&impl_->stream, &checkpoint->state) != Z_OK) {
    impl_->stream_open = false;
    throw FileError("{}: no memory for zlib", impl_->path);
  }
  impl_->stream_ended = false;
  impl_->move_disk(checkpoint->input_offset);
  impl_->input_offset = checkpoint->input_offset;
  impl_->position = checkpoint->position;
  impl_->stream.next_in = impl_->input.data();
  impl_->stream.avail_in = 0;
}

std::uint64_t Source::position() const { return impl_->position; }
bool Source::compressed() const { return impl_->compressed; }
std::uint64_t Source::bytes_from_disk() const { return impl_->bytes_read; }
const std::string& Source::path() const { return impl_->path; }

std::uint64_t Source::size_bound() const {
  return impl_->compressed ? impl_->size * deflate_limit : impl_->size;
}

std::uint64_t Source::likely_size() const {
  if (!impl_->compressed) return impl_->size;
  std::array<unsigned char, 4> trailer{};  // size modulo 2^32 of the last member, little-endian
  if (impl_->size < 18 ||
      ::pread(impl_->file, trailer.data(), 4, static_cast<off_t>(impl_->size - 4)) != 4)
    return 0;
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size |= std::uint64_t{trailer[i]} << (8 * i);
  return size;
}

const std::string& Source::cut() const { return impl_->cut; }
const std::string& Source::trailing() const { return impl_->trailing; }

std::string read_head(const std::string& path, std::size_t count) {
  Source source(path);
  std::string head(count, '\0');
  head.resize(source.read(head));
  return head;
}

std::uint64_t line_at(const std::string& path, std::uint64_t offset) {
  Source source(path);
  std::vector<char> piece(window_bytes(1U << 18));
  std::uint64_t line = 1;
  while (offset > 0) {
    const auto ask = std::min<std::uint64_t>(offset, piece.size());
    const auto got = source.read({piece.data(), static_cast<std::size_t>(ask)});
    line += static_cast<std::uint64_t>(std::count(piece.begin(), piece.begin() + got, '\n'));
    if (got < ask) break;
    offset -= got;
  }
  return line;
}

}  // namespace bedscope::readers
