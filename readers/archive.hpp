// SPDX-License-Identifier: BSD-3-Clause
// Plain data to bytes and back: what one start of the program keeps on disk for the next.
//
// A type says once what it consists of, for both ways, beside its definition:
//
//   template <class Archive>
//   void archive(Archive& ar, SolidsSum& sum) {
//     auto& [particles, volume, moment, mass, mass_moment] = sum;  // one more would not compile
//     ar(particles, volume, moment, mass, mass_moment);
//   }
//
// or, where members are private, by a member function `void archive(Archive& ar)`. Numbers, texts
// and the standard containers need nothing. Bytes are those of the machine: what is kept serves
// the program that wrote it, and a file that does not fit is made anew.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace bedscope::readers {

/// The part that both ways share: what a value consists of.
template <class Self>
class Archive {
 public:
  template <class... T>
  void operator()(T&... values) {
    (item(values), ...);
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }

  template <class T>
  static constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

  template <class T>
  void item(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      auto byte = static_cast<unsigned char>(value);
      self().raw(&byte, 1);
      value = byte != 0;
    } else if constexpr (is_number<T>) {
      self().raw(&value, sizeof value);
    } else if constexpr (requires { value.archive(self()); }) {
      value.archive(self());
    } else {
      archive(self(), value);
    }
  }

  void item(std::string& text) {
    text.resize(self().count(text.size(), 1));
    self().raw(text.data(), text.size());
  }

  template <class T>
  void item(std::vector<T>& values) {
    if constexpr (is_number<T>) {
      values.resize(self().count(values.size(), sizeof(T)));
      self().raw(values.data(), values.size() * sizeof(T));
    } else {
      const auto count = self().count(values.size(), 0);
      if (Self::loading) values.clear();  // grows with what is really there
      for (std::size_t i = 0; i < count; ++i) {
        if (Self::loading) values.emplace_back();
        item(values[i]);
      }
    }
  }

  template <class T, std::size_t N>
  void item(std::array<T, N>& values) {
    for (auto& value : values) item(value);
  }

  template <class A, class B>
  void item(std::pair<A, B>& pair) {
    item(pair.first);
    item(pair.second);
  }

  template <class T>
  void item(std::optional<T>& value) {
    bool there = value.has_value();
    item(there);
    if (Self::loading) there ? void(value.emplace()) : value.reset();
    if (there) item(*value);
  }

  template <class Key, class T>
  void item(std::map<Key, T>& map) {
    const auto count = self().count(map.size(), 0);
    if (Self::loading) {
      map.clear();
      for (std::size_t i = 0; i < count; ++i) {
        std::pair<Key, T> entry;
        item(entry);
        map.insert(std::move(entry));
      }
    } else {
      for (auto& [key, value] : map) {
        auto copy = key;
        item(copy);
        item(value);
      }
    }
  }
};

/// A file closed with its owner.
struct CloseArchive {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using ArchiveFile = std::unique_ptr<std::FILE, CloseArchive>;

/// Writes `kind` (a line that names content and version), the values and a checksum.
class ArchiveWriter : public Archive<ArchiveWriter> {
 public:
  static constexpr bool loading = false;

  /// Into memory, without kind and checksum: see bytes().
  ArchiveWriter() = default;
  /// Into a file; makes its folder. Throws FileError, as every write does.
  ArchiveWriter(const std::filesystem::path& path, std::string_view kind);

  /// The values so far, of a writer into memory.
  const std::string& bytes() const { return buffer_; }
  std::uint64_t size() const { return size_; }
  /// The checksum; the file is whole after it.
  void finish();

  void raw(const void* data, std::size_t size);
  std::size_t count(std::size_t size, std::size_t) {
    const std::uint64_t written = size;
    raw(&written, sizeof written);
    return size;
  }

 private:
  void flush();

  std::filesystem::path path_;
  ArchiveFile file_;
  std::string buffer_;
  std::uint32_t checksum_ = 0;
  std::uint64_t size_ = 0;
};

/// Reads what ArchiveWriter wrote. Room is made only for what the file really holds.
class ArchiveReader : public Archive<ArchiveReader> {
 public:
  static constexpr bool loading = true;

  /// Throws FileError, or FormatError where the file is of another kind.
  ArchiveReader(const std::filesystem::path& path, std::string_view kind);

  /// Throws FormatError where the checksum differs or bytes are left: nothing read is then valid.
  void finish();

  /// Throws FormatError where the file ends before.
  void raw(void* data, std::size_t size);
  /// A number of items of at least `bytes_each`.
  std::size_t count(std::size_t, std::size_t bytes_each);

 private:
  std::filesystem::path path_;
  ArchiveFile file_;
  std::uint64_t left_ = 0;  // bytes before the checksum
  std::uint32_t checksum_ = 0;
};

}  // namespace bedscope::readers
