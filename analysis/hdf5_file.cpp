// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/hdf5_file.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>

#include "analysis/output_file.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

constexpr std::size_t compress_from = std::size_t{64} << 10;  // [bytes]
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;     // the library's own chunk cache
constexpr std::size_t memory_step = std::size_t{1} << 20;     // by which the file in memory grows

// What went wrong, in the words of the innermost function of the library.
std::string reason() {
  std::string text = "HDF5 gives no reason";
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* to) -> herr_t {
        if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(to) = error->desc;
        return 0;
      },
      &text);
  return text;
}

}  // namespace

Hdf5Handle Hdf5Group::check(hid_t id, Hdf5Handle::Close close) const {
  if (id < 0) throw FileError("{}: {}", path_->string(), reason());
  return {id, close};
}

void Hdf5Group::check(herr_t status) const {
  if (status < 0) throw FileError("{}: {}", path_->string(), reason());
}

Hdf5Group Hdf5Group::group(const std::string& name) {
  return {check(H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose),
          *path_};
}

void Hdf5Group::attribute(const std::string& name, hid_t type, hid_t space, const void* data) {
  const Hdf5Handle id =
      check(H5Acreate2(id_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(id, type, data));
}

void Hdf5Group::attribute(const std::string& name, std::string_view text) {
  const std::string zero_ended(text);
  const char* const start = zero_ended.c_str();
  const Hdf5Handle type = check(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  attribute(name, type, check(H5Screate(H5S_SCALAR), H5Sclose), static_cast<const void*>(&start));
}

void Hdf5Group::ascii_attribute(const std::string& name, std::string_view text) {
  const Hdf5Handle type = check(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, text.size()));
  check(H5Tset_strpad(type, H5T_STR_NULLPAD));
  attribute(name, type, check(H5Screate(H5S_SCALAR), H5Sclose), text.data());
}

void Hdf5Group::attribute(const std::string& name, double value) {
  attribute(name, H5T_NATIVE_DOUBLE, check(H5Screate(H5S_SCALAR), H5Sclose), &value);
}

void Hdf5Group::attribute(const std::string& name, std::int64_t value) {
  attribute(name, H5T_NATIVE_INT64, check(H5Screate(H5S_SCALAR), H5Sclose), &value);
}

void Hdf5Group::attribute(const std::string& name, std::span<const double> values) {
  const hsize_t size = values.size();
  attribute(name, H5T_NATIVE_DOUBLE, check(H5Screate_simple(1, &size, nullptr), H5Sclose),
            values.data());
}

void Hdf5Group::attribute(const std::string& name, std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  attribute(name, H5T_NATIVE_INT64, check(H5Screate_simple(1, &size, nullptr), H5Sclose),
            values.data());
}

void Hdf5Group::write(const std::string& name, std::span<const double> values,
                      std::string_view unit, Shape shape) {
  if (shape.empty()) shape = {values.size()};
  assert(std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>()) ==
         values.size());
  write(name, H5T_NATIVE_DOUBLE, sizeof(double), values.data(), shape, unit);
}

void Hdf5Group::write(const std::string& name, std::span<const std::int64_t> values,
                      std::string_view unit) {
  write(name, H5T_NATIVE_INT64, sizeof(std::int64_t), values.data(), {values.size()}, unit);
}

void Hdf5Group::write(const std::string& name, std::span<const std::string> texts) {
  std::size_t longest = 1;  // the library has no type of size 0
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string padded(longest * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i)
    std::copy(texts[i].begin(), texts[i].end(),
              padded.begin() + static_cast<std::ptrdiff_t>(i * longest));
  const Hdf5Handle type = check(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, longest));
  check(H5Tset_strpad(type, H5T_STR_NULLPAD));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  write(name, type, longest, padded.data(), {texts.size()}, {});
}

void Hdf5Group::write(const std::string& name, hid_t type, std::size_t type_size, const void* data,
                      const Shape& shape, std::string_view unit) {
  const int rank = static_cast<int>(shape.size());
  const Hdf5Handle space = check(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose);
  const Hdf5Handle layout = check(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(layout, false));  // the same results make the same file
  const std::size_t bytes =
      std::accumulate(shape.begin(), shape.end(), type_size, std::multiplies<>());
  if (bytes >= compress_from) {
    Shape chunk = shape;  // whole slices along the first index, as many as make up a chunk
    const std::size_t slice = bytes / shape[0];
    chunk[0] = std::clamp<hsize_t>(chunk_bytes / slice, 1, shape[0]);
    check(H5Pset_chunk(layout, rank, chunk.data()));
    check(H5Pset_shuffle(layout));
    check(H5Pset_deflate(layout, 1));
  }
  const Hdf5Handle id =
      check(H5Dcreate2(id_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
  if (bytes > 0) check(H5Dwrite(id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
  if (!unit.empty()) {
    Hdf5Group described({H5Dopen2(id_, name.c_str(), H5P_DEFAULT), H5Dclose}, *path_);
    described.attribute("unit", unit);
  }
}

Hdf5File::Hdf5File(const std::filesystem::path& path) : path_(path) {
  H5Eget_auto2(H5E_DEFAULT, &report_, &report_to_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_fapl_core(access, memory_step, false);
  id_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (id_ < 0) {
    const std::string why = reason();
    H5Eset_auto2(H5E_DEFAULT, report_, report_to_);
    throw FileError("{}: {}", path_.string(), why);
  }
}

Hdf5File::~Hdf5File() {
  H5Fclose(id_);
  H5Eset_auto2(H5E_DEFAULT, report_, report_to_);
}

Hdf5Group Hdf5File::root() const { return {{H5Gopen2(id_, "/", H5P_DEFAULT), H5Gclose}, path_}; }

void Hdf5File::commit() {
  void** memory = nullptr;  // the driver in memory gives the place of its pointer
  if (H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0 ||
      H5Fget_vfd_handle(id_, H5P_DEFAULT, reinterpret_cast<void**>(&memory)) < 0)
    throw FileError("{}: {}", path_.string(), reason());
  const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
  if (size < 0) throw FileError("{}: {}", path_.string(), reason());
  write_file(path_, {static_cast<const char*>(*memory), static_cast<std::size_t>(size)});
}

std::string hdf5_name(std::string_view name) {
  if (name.empty() || name == ".") return "_";
  std::string result(name);
  std::replace(result.begin(), result.end(), '/', '_');
  return result;
}

}  // namespace bedscope::analysis
