// SPDX-License-Identifier: BSD-3-Clause
#include "readers/file_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "readers/error.hpp"
#include "readers/source.hpp"
#include "readers/text_file.hpp"

namespace bedscope::readers {

extern const IndexForm file_series, vtk_collection, vtk_multiblock, vtk_parallel;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_index = std::size_t{64} << 20;  // 10^5 snapshots take 10 MB
constexpr std::size_t deepest = 4;                            // collection, blocks, pieces, file
constexpr std::size_t most_names = 1'000'000;  // blocks of blocks of blocks ask for any number

/// Follows the names from index to index.
class Resolver {
 public:
  explicit Resolver(FileIndex& index) : named_(index.named), cut_(index.cut) {}

  std::vector<IndexedSnapshot> snapshots(const std::string& path, const IndexForm& form) {
    chain_.push_back(path);
    std::vector<IndexedSnapshot> found;
    std::string missing;  // told at the end: what else is named has to be known
    const IndexEntry* before = nullptr;
    const auto entries = form.read(path, read_text(path, largest_index), cut_);
    if (entries.empty() && !form.one_snapshot) throw FormatError("{}: names no files", path);
    if (entries.empty()) found.push_back({path, unknown, {}});  // no process had particles
    for (const auto& entry : entries) {
      IndexedFile file{(fs::path(path).parent_path() / entry.name).lexically_normal().string(),
                       path, fmt::format("{} {}", form.name, entry.name), entry.offset};
      named_.push_back(file.path);
      if (named_.size() > most_names)
        throw FormatError("{} and more are not accepted", file.place());
      if (form.one_snapshot) require_below(entry.name, file);
      std::error_code ignored;
      if (!fs::exists(file.path, ignored)) {
        if (missing.empty()) missing = file.place() + " not found";
        continue;
      }
      const bool joins =
          form.one_snapshot ? !found.empty() : before != nullptr && before->time == entry.time;
      if (!form.one_snapshot && joins && before->part == entry.part)
        throw FormatError("{}: time {} twice (part=\"{}\" both)", file.place(), entry.time,
                          entry.part);
      if (!joins) found.push_back({form.one_snapshot ? path : file.path, entry.time, {}});
      add_file(std::move(file), found.back());
      before = &entry;
    }
    if (!missing.empty()) throw FormatError("{}", missing);
    chain_.pop_back();
    return found;
  }

 private:
  static void require_below(const std::string& name, const IndexedFile& file) {
    const auto normal = fs::path(name).lexically_normal();
    if (normal.is_absolute() || (!normal.empty() && *normal.begin() == ".."))
      throw FormatError("{} lies outside the folder of the index", file.place());
  }

  static std::string head_of(const IndexedFile& file) {
    try {
      return read_head(file.path);
    } catch (const Error& what) {
      throw FormatError("{}: {}", file.place(), what.what());
    }
  }

  /// The file, or what it names where it is an index itself.
  void add_file(IndexedFile file, IndexedSnapshot& to) {
    const auto* form = index_form(head_of(file));
    if (form == nullptr) {
      to.files.push_back(std::move(file));
      return;
    }
    for (const auto& index : chain_) {
      std::error_code ignored;
      if (fs::equivalent(index, file.path, ignored))
        throw FormatError("{} is the index itself", file.place());
    }
    if (chain_.size() == deepest)
      throw FormatError("{} is an index, nested deeper than {}", file.place(), deepest);
    auto inner = snapshots(file.path, *form);
    if (inner.size() != 1)
      throw FormatError("{} names {} snapshots, expected one", file.place(), inner.size());
    std::move(inner[0].files.begin(), inner[0].files.end(), std::back_inserter(to.files));
    if (std::isnan(to.time)) to.time = inner[0].time;
  }

  std::vector<std::string>& named_;
  std::string& cut_;
  std::vector<std::string> chain_;
};

/// LIGGGHTS' write_pvd_file (and others) number the snapshots 0, 1, 2 ... instead of their times.
void drop_running_number(const std::string& path, FileIndex& index) {
  for (std::size_t i = 0; i < index.snapshots.size(); ++i)
    if (index.snapshots[i].time != static_cast<double>(i)) return;
  for (auto& snapshot : index.snapshots) snapshot.time = unknown;
  index.notes.push_back(fmt::format(
      "{}: its times 0, 1, 2 ... are a running number: the numbers of the file names are the steps",
      path));
}

}  // namespace

std::string IndexedFile::place() const {
  return fmt::format("{}: line {}: {}", index, line_at(index, offset), label);
}

const IndexForm* index_form(std::string_view head) {
  static constexpr std::array<const IndexForm*, 4> all{&file_series, &vtk_collection,
                                                       &vtk_multiblock, &vtk_parallel};
  for (const auto* form : all)
    if (form->matches(head)) return form;
  return nullptr;
}

FileIndex read_index(const std::string& path, const IndexForm& form) {
  FileIndex index;
  try {
    index.snapshots = Resolver(index).snapshots(path, form);
    if (form.may_count) drop_running_number(path, index);
  } catch (const Error& error) {
    index.error = error.what();
  }
  return index;
}

}  // namespace bedscope::readers
