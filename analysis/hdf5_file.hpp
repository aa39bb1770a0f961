// SPDX-License-Identifier: BSD-3-Clause
// Writing HDF5: groups, attributes with their unit, arrays. All that bedscope needs of the library.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bedscope::analysis {

/// An identifier of the library, closed with its owner.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor)

 private:
  hid_t id_;
  Close close_;
};

using Shape = std::vector<hsize_t>;

/// A group to write into. Arrays of 64 kB and more are stored in chunks, shuffled and deflated.
/// Names are those of HDF5 links: see hdf5_name. Throws FileError with the library's reason.
class Hdf5Group {
 public:
  Hdf5Group(Hdf5Handle id, const std::filesystem::path& path) : id_(std::move(id)), path_(&path) {}

  Hdf5Group group(const std::string& name);

  void attribute(const std::string& name, std::string_view text);
  void attribute(const std::string& name, double value);
  void attribute(const std::string& name, std::int64_t value);
  void attribute(const std::string& name, std::span<const double> values);
  void attribute(const std::string& name, std::span<const std::int64_t> values);
  /// Text without a final zero, in ASCII, as VTKHDF wants its `Type`.
  void ascii_attribute(const std::string& name, std::string_view text);

  /// Arrays carry their unit in the attribute `unit` where they have one; the last index of `shape`
  /// varies fastest, an empty one stands for a list.
  void write(const std::string& name, std::span<const double> values, std::string_view unit,
             Shape shape = {});
  void write(const std::string& name, std::span<const std::int64_t> values,
             std::string_view unit = {});
  /// Texts in UTF-8, padded with zeros to the longest.
  void write(const std::string& name, std::span<const std::string> texts);

 private:
  Hdf5Handle check(hid_t id, Hdf5Handle::Close close) const;
  void check(herr_t status) const;
  void attribute(const std::string& name, hid_t type, hid_t space, const void* data);
  void write(const std::string& name, hid_t type, std::size_t type_size, const void* data,
             const Shape& shape, std::string_view unit);

  Hdf5Handle id_;
  const std::filesystem::path* path_;  // for messages
};

/// A file made in memory and put on disk, whole, at commit(): the library does not survive a full
/// disk (1.10 crashes when it closes the file), and what is written is small beside its RunResult.
/// While one exists the library prints nothing to stderr in this thread.
class Hdf5File {
 public:
  explicit Hdf5File(const std::filesystem::path& path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  Hdf5Group root() const;
  /// Throws FileError naming path and reason; nothing half-written stays.
  void commit();

 private:
  std::filesystem::path path_;
  H5E_auto2_t report_ = nullptr;
  void* report_to_ = nullptr;
  hid_t id_ = H5I_INVALID_HID;
};

/// `name` as the name of a link: `/` (which would be a path) becomes `_`, as do a lone `.` and
/// nothing at all.
std::string hdf5_name(std::string_view name);

}  // namespace bedscope::analysis
