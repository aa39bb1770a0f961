// SPDX-License-Identifier: BSD-3-Clause
// The physical limit of reading legacy binary dumps: the time to read warm files as `cat` does
// (read() in 1 MB pieces into a re-used buffer) plus one byte swap of the columns that the analysis
// uses (x, z, vx, vz, radius) into doubles. Nothing is computed from them but a sum that keeps the
// compiler honest.
//
//   limits FILE...     prints: files, bytes, particles, seconds of reading, seconds of swapping,
//   checksum
//
// Knows only what LIGGGHTS 3.8 writes: POINTS float, FIELD arrays v and radius double.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& text) {
  std::fprintf(stderr, "limits: %s\n", text.c_str());
  std::exit(2);
}

std::size_t read_file(const char* path, std::vector<char>& buffer) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(std::string(path) + ": cannot open");
  std::size_t size = 0;
  for (;;) {
    if (buffer.size() < size + piece) buffer.resize(2 * (size + piece));
    const ::ssize_t got = ::read(file, buffer.data() + size, piece);
    if (got < 0) fail(std::string(path) + ": cannot read");
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  ::close(file);
  return size;
}

// Where the value of `word` starts: behind the first line that begins with `word`, at or after
// `from`.
std::size_t behind_line(std::string_view text, std::string_view word, std::size_t from) {
  std::string needle("\n");
  needle += word;
  const std::size_t at = text.find(needle, from);
  const std::size_t end = at == std::string_view::npos ? at : text.find('\n', at + 1);
  if (end == std::string_view::npos) fail("no line that begins with '" + needle.substr(1) + "'");
  return end + 1;
}

template <typename Real, typename Bits>
void swap_column(std::string_view text, std::size_t start, std::size_t stride,
                 std::vector<double>& column) {
  if (start + stride * (column.size() - 1) + sizeof(Bits) > text.size()) fail("file too short");
  const char* from = text.data() + start;
  for (double& value : column) {
    Bits bits;
    std::memcpy(&bits, from, sizeof bits);
    if constexpr (sizeof bits == 4) {
      bits = __builtin_bswap32(bits);
    } else {
      bits = __builtin_bswap64(bits);
    }
    value = static_cast<double>(std::bit_cast<Real>(bits));
    from += stride;
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) fail("usage: limits FILE...");
  std::vector<char> buffer;
  std::vector<double> x, z, vx, vz, radius;
  double reading = 0, swapping = 0, sum = 0;
  std::uint64_t bytes = 0, particles = 0;
  for (int i = 1; i < count; ++i) {
    const auto start = Clock::now();
    const std::size_t size = read_file(arguments[i], buffer);
    const std::string_view whole(buffer.data(), size);
    const auto between = Clock::now();

    const std::size_t points = behind_line(whole, "POINTS ", 0);
    const std::size_t line = whole.rfind("POINTS ", points);
    const std::size_t n = std::strtoull(whole.data() + line + 7, nullptr, 10);
    if (n == 0 || n > whole.size() / 92) fail("no points, or more than the file can hold");
    for (auto* column : {&x, &z, &vx, &vz, &radius}) column->resize(n);
    // Looked for behind what must lie between: vertices 16 bytes a particle, id and type 8.
    const std::size_t fields = behind_line(whole, "FIELD ", points + 28 * n) - 1;
    const std::size_t v = behind_line(whole, "v 3 ", fields + 8 * n);
    const std::size_t r = behind_line(whole, "radius 1 ", v + 24 * n);
    swap_column<float, std::uint32_t>(whole, points, 12, x);
    swap_column<float, std::uint32_t>(whole, points + 8, 12, z);
    swap_column<double, std::uint64_t>(whole, v, 24, vx);
    swap_column<double, std::uint64_t>(whole, v + 16, 24, vz);
    swap_column<double, std::uint64_t>(whole, r, 8, radius);
    const auto end = Clock::now();

    for (const auto* column : {&x, &z, &vx, &vz, &radius}) sum += column->front() + column->back();
    reading += std::chrono::duration<double>(between - start).count();
    swapping += std::chrono::duration<double>(end - between).count();
    bytes += whole.size();
    particles += n;
  }
  std::printf(
      "%d files, %.3f GB, %llu particles: read %.4f s, swap %.4f s, together %.4f s (checksum "
      "%.9g)\n",
      count - 1, static_cast<double>(bytes) * 1e-9, static_cast<unsigned long long>(particles),
      reading, swapping, reading + swapping, sum);
}
