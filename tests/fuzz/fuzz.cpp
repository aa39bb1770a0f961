// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/fuzz.hpp"

#include <fcntl.h>
#include <sanitizer/allocator_interface.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "readers/error.hpp"

namespace bedscope::fuzz {
namespace {

namespace fs = std::filesystem;

// What a reader may hold at once, as docs/reliability.md promises it: a double and its copies for
// every two characters ("1 "), and the buffers that do not depend on the input.
constexpr std::size_t memory_factor = 64, memory_base = 16U << 20;
constexpr std::size_t longest_line = 4 * 1800 + 10;  // see one_line(): \x1b for a character
constexpr std::size_t most_parts = 40;
constexpr std::size_t checksum_bytes = 4;  // at the end of what ArchiveWriter writes

std::size_t held = 0, most_held = 0, input_bytes = 0;  // of the input at hand

void allocated(const volatile void*, std::size_t size) {
  held += size;
  most_held = std::max(most_held, held);
}
void freed(const volatile void* pointer) {
  const auto size = __sanitizer_get_allocated_size(const_cast<const void*>(pointer));
  held -= std::min(held, size);  // older memory than this input may go, too
}

bool is_name(std::string_view path) {
  const auto odd =
      path.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-+/");
  return !path.empty() && path.size() < 100 && odd == path.npos && path.front() != '/' &&
         path.find("..") == path.npos;
}

}  // namespace

void require(bool holds, std::string_view promise) {
  if (holds) return;
  std::fprintf(stderr, "PROMISE BROKEN: %.*s\n", static_cast<int>(promise.size()), promise.data());
  std::abort();
}

void require_line(std::string_view text) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  if (!text.empty() && text.size() <= longest_line &&
      std::none_of(text.begin(), text.end(), control))
    return;
  std::fprintf(stderr, "%.*s\n", static_cast<int>(std::min<std::size_t>(text.size(), 4000)),
               text.data());
  require(false, "one short line of printable text for the user");
}

void add_input(std::size_t bytes) { input_bytes += bytes; }

MemoryFile::MemoryFile() : file_(::memfd_create("input", MFD_CLOEXEC)) {
  require(file_ >= 0, "memfd_create works");
  path_ = fmt::format("/proc/self/fd/{}", file_);
}

MemoryFile::~MemoryFile() { ::close(file_); }

const std::string& MemoryFile::write(std::string_view bytes) {
  const auto size = static_cast<ssize_t>(bytes.size());
  require(::ftruncate(file_, 0) == 0 && ::pwrite(file_, bytes.data(), bytes.size(), 0) == size,
          "the memory file can be written");
  return path_;
}

std::map<std::string, std::string_view> parts_of(std::string_view input) {
  constexpr std::string_view mark = "=== ";
  const auto find_mark = [&](std::size_t from) {
    if (from == 0 && input.starts_with(mark)) return from;
    const auto at = input.find("\n=== ", from == 0 ? 0 : from - 1);
    return at == input.npos ? at : at + 1;
  };
  std::map<std::string, std::string_view> parts;
  for (auto at = find_mark(0); at != input.npos && parts.size() < most_parts;) {
    const auto name_end = std::min(input.find('\n', at), input.size());
    const auto begin = std::min(name_end + 1, input.size());
    const auto next = find_mark(begin);
    const std::string name(input.substr(at + mark.size(), name_end - at - mark.size()));
    if (is_name(name)) parts[name] = input.substr(begin, next == input.npos ? next : next - begin);
    at = next;
  }
  return parts;
}

MemoryFolder::MemoryFolder(const std::map<std::string, std::string_view>& parts) {
  std::error_code error;
  const fs::path memory = "/dev/shm";
  real_ = ((fs::is_directory(memory, error) ? memory : fs::temp_directory_path()) /
           "bedscope_fuzz_XXXXXX")
              .string();
  require(::mkdtemp(real_.data()) != nullptr, "a folder can be made");
  folder_ = ::open(real_.c_str(), O_DIRECTORY | O_CLOEXEC);
  require(folder_ >= 0, "a folder can be opened");
  path_ = fmt::format("/proc/self/fd/{}", folder_);
  for (const auto& [name, bytes] : parts) {
    const auto file = fs::path(path_) / name;
    fs::create_directories(file.parent_path(), error);  // fails where a part is a file: left out
    if (!error) std::ofstream(file, std::ios::binary) << bytes;
  }
}

MemoryFolder::~MemoryFolder() {
  std::error_code ignored;
  fs::remove_all(real_, ignored);
  ::close(folder_);
}

KeptFile::KeptFile(const fs::path& folder, const std::function<void()>& make) {
  make();
  for (const auto& item : fs::directory_iterator(folder)) path_ = item.path();
  std::ifstream file(path_, std::ios::binary);
  whole_.assign(std::istreambuf_iterator<char>(file), {});
  require(whole_.size() > checksum_bytes, "the program keeps a file");
}

void KeptFile::change(std::string_view input, bool valid) const {
  auto bytes = whole_.substr(0, whole_.size() - checksum_bytes);
  auto checksum = whole_.substr(bytes.size());
  for (; input.size() >= 4 && !bytes.empty(); input.remove_prefix(4)) {
    const auto low = static_cast<unsigned char>(input[0]),
               high = static_cast<unsigned char>(input[1]);
    const auto at = (low + 256U * high) % bytes.size();
    if (input[2] == 'c')
      bytes.resize(at);
    else if (input[2] == 'd')
      bytes.erase(at, 1);
    else if (input[2] == 'i')
      bytes.insert(at, 1, input[3]);
    else
      bytes[at] = input[3];
  }
  if (valid) {
    const auto sum = static_cast<std::uint32_t>(
        ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
    std::memcpy(checksum.data(), &sum, checksum_bytes);
  }
  std::ofstream(path_, std::ios::binary) << bytes << checksum;
  add_input(bytes.size());
}

namespace {

void check(std::string_view input) {
  input_bytes = input.size();
  held = most_held = 0;
  try {
    use(input);
  } catch (const Error& error) {
    require_line(error.what());
    if (std::getenv("FUZZ_SAY") != nullptr) std::fprintf(stderr, "SAID %s\n", error.what());
  }
  const auto bound = memory_factor * input_bytes + memory_base;
  if (most_held > bound)
    std::fprintf(stderr, "%zu bytes held for %zu of input\n", most_held, input_bytes);
  require(most_held <= bound, "memory stays below a small multiple of the input");
}

}  // namespace
}  // namespace bedscope::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  __sanitizer_install_malloc_and_free_hooks(bedscope::fuzz::allocated, bedscope::fuzz::freed);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  bedscope::fuzz::check({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
