// SPDX-License-Identifier: BSD-3-Clause
#include "readers/dump_index.hpp"

#include <zlib.h>

#include <utility>

#include "readers/archive.hpp"
#include "readers/error.hpp"

namespace bedscope::readers {

template <class Archive>
void archive(Archive& ar, Box& box) {
  auto& [min, max, tilt, periodic, shrink_wrapped, known] = box;
  ar(min, max, tilt, periodic, shrink_wrapped, known);
}

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kind = "bedscope index of a dump, version 1\n";

/// Columns rarely change within a file, so each list is stored once.
using ColumnLists = std::vector<std::shared_ptr<const std::vector<std::string>>>;

template <class Archive>
void archive_columns(Archive& ar, ColumnLists& lists, std::vector<Located>& snapshots) {
  std::vector<std::vector<std::string>> texts;
  for (const auto& list : lists) texts.push_back(*list);
  ar(texts);
  if (Archive::loading)
    for (auto& names : texts)
      lists.push_back(std::make_shared<const std::vector<std::string>>(std::move(names)));
  std::size_t in_use = 0;
  for (auto& located : snapshots) {
    while (!Archive::loading && lists[in_use] != located.columns) ++in_use;
    ar(in_use);
    if (in_use >= lists.size()) throw FormatError("columns {} of {}", in_use, lists.size());
    located.columns = located.parts = lists[in_use];
  }
}

template <class Archive>
void archive_scan(Archive& ar, FileScan& scan) {
  auto& [snapshots, cut, problems, not_particles, unnamed] = scan;
  ar(cut, problems, unnamed);
  std::size_t count = snapshots.size();
  ar(count);
  ColumnLists lists;
  for (std::size_t i = 0; i < count; ++i) {
    if (Archive::loading) snapshots.emplace_back();
    auto& [step, time, particles, ghosts, without_ghosts, offset, bytes, line, checkpoint, context,
           box, columns, named, parts] = snapshots[i];
    ar(step, time, particles, ghosts, without_ghosts, offset, bytes, line, box, named);
    if (!Archive::loading && (lists.empty() || lists.back() != columns)) lists.push_back(columns);
  }
  archive_columns(ar, lists, snapshots);
}

/// "dump.all-5f3a9c21.index": the name for people, the checksum of the path for two of one name.
fs::path index_of(const fs::path& folder, const std::string& dump) {
  const auto checksum =
      crc32_z(0, reinterpret_cast<const unsigned char*>(dump.data()), dump.size());
  return folder / fmt::format("{}-{:08x}.index", fs::path(dump).filename().string(), checksum);
}

/// Worth an index: several snapshots in a file that can be entered anywhere.
bool worth_it(const FileScan& found, const FileMark& mark) {
  return mark.end > 0 && found.snapshots.size() > 1 && found.not_particles.empty();
}

}  // namespace

void DumpIndex::load(const Form& form, const FileMark& mark) {
  if (from_.empty() || known_.contains(mark.path)) return;
  const auto path = index_of(from_, mark.path);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  try {
    ArchiveReader reader(path, kind);
    Known known;
    reader(known.form, known.mark);
    archive_scan(reader, known.found);
    reader.finish();
    known.saved = true;
    if (known.form == form.name && known.found.snapshots.size() > 1)
      known_.insert_or_assign(mark.path, std::move(known));
  } catch (const Error&) {
    return;  // it will be written anew
  }
}

FileScan DumpIndex::scan(const Form& form, const std::string& path, bool thorough) {
  if (form.extend == nullptr) return form.scan(path, thorough);
  auto mark = mark_of(path);
  load(form, mark);
  FileScan found;
  if (const auto at = known_.find(mark.path); at != known_.end()) {
    const auto change = change_since(at->second.mark, mark);
    if (change == Change::none) return at->second.found;
    if (change == Change::grown) found = form.extend(path, std::move(at->second.found));
    known_.erase(at);
  }
  if (found.snapshots.empty()) found = form.scan(path, thorough);
  if (found.snapshots.size() < 2) return found;
  const auto& last = found.snapshots.back();
  let_grow(mark, last.offset + last.bytes);
  if (worth_it(found, mark)) known_[mark.path] = {std::string(form.name), mark, found, false};
  return found;
}

void DumpIndex::save() {
  if (to_.empty()) return;
  for (auto& [dump, known] : known_) {
    if (known.saved) continue;
    ArchiveWriter writer(index_of(to_, dump), kind);
    writer(known.form, known.mark);
    archive_scan(writer, known.found);
    writer.finish();
    known.saved = true;
  }
}

}  // namespace bedscope::readers
