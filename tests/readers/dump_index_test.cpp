// SPDX-License-Identifier: BSD-3-Clause
#include "readers/dump_index.hpp"

#include <sys/stat.h>

#include "readers/archive.hpp"
#include "readers/series.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

std::string dumps(std::int64_t first, std::int64_t last, std::size_t particles = 60) {
  std::string text;
  for (auto step = first; step <= last; ++step) text += small_dump(step, particles);
  return text;
}

/// Everything that a scan says, as text.
std::string told(const FileScan& scan) {
  std::string text = scan.cut + "|" + scan.not_particles + "|";
  for (const auto& problem : scan.problems) text += problem + ";";
  for (const auto& s : scan.snapshots)
    text += fmt::format("\n{} {} {} {}+{} line {} {} {} {}", s.step, s.time, s.particles, s.offset,
                        s.bytes, s.line, s.box.known, s.box.max[2], fmt::join(*s.parts, ","));
  return text;
}

class Index : public testing::Test {
 protected:
  const Form& form() const { return identify(dump); }
  std::string fresh() const { return told(form().scan(dump, true)); }
  /// With what is on disk, which it then brings up to date.
  std::string indexed() const {
    DumpIndex index(folder.path("index"), folder.path("index"));
    const auto text = told(index.scan(form(), dump, true));
    index.save();
    return text;
  }
  void append(const std::string& text) const {
    std::ofstream(dump, std::ios::binary | std::ios::app) << text;
  }
  std::string index_file() const {
    for (const auto& item : fs::directory_iterator(folder.path("index")))
      return item.path().string();
    return {};
  }
  /// Another text of the same length in its place, which only a scan of that place can see: after
  /// it the time of the content is what it was, and the file system is asked for the rest.
  void deface(std::size_t at, const std::string& text) const {
    std::fstream file(dump, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at));
    file << text;
  }

  TemporaryFolder folder;
  std::string dump = folder.write("all.dump", dumps(1, 5));
};

/// What this process has read so far, from files and from the system's memory of them.
std::uint64_t bytes_read() {
  std::ifstream file("/proc/self/io");
  std::string name;
  std::uint64_t count = 0;
  file >> name >> count;
  EXPECT_EQ(name, "rchar:");
  return count;
}

TEST_F(Index, AnUnchangedDumpIsNotReadAgain) {
  folder.write("all.dump", dumps(1, 50, 1000));
  const auto text = fresh();
  const auto before = bytes_read();
  EXPECT_EQ(indexed(), text);
  const auto between = bytes_read();
  EXPECT_EQ(indexed(), text);
  EXPECT_GT(between - before, fs::file_size(dump));
  EXPECT_LT(bytes_read() - between, 40'000U);  // the index, and the head that tells the form
}

TEST_F(Index, AGrownDumpIsReadFromItsLastKnownSnapshotOn) {
  folder.write("all.dump", dumps(1, 50, 1000));
  indexed();
  // Damage far in front of what is new: a scan of the whole would stumble over the header.
  deface(form().scan(dump, true).snapshots[20].offset, "ITEM: TOMESTEP");
  append(dumps(51, 52, 1000));
  EXPECT_NE(error_of([&] { fresh(); }), "");
  const auto before = bytes_read();
  DumpIndex index(folder.path("index"), {});
  EXPECT_EQ(index.scan(form(), dump, true).snapshots.size(), 52U);
  EXPECT_LT(bytes_read() - before, fs::file_size(dump) / 10);
}

TEST_F(Index, GrowingInSteps) {
  const auto all = dumps(6, 9);
  for (std::size_t at = 0; at < all.size(); at += 333) {
    append(all.substr(at, 333));
    EXPECT_EQ(indexed(), fresh()) << at;
  }
  EXPECT_NE(fresh().find("\n9 "), std::string::npos);
}

TEST_F(Index, GrowingWithoutLineEndAndWithNulBytes) {
  indexed();
  append(small_dump(6, 20).substr(0, 300));
  EXPECT_EQ(indexed(), fresh());
  append(std::string(50, '\0'));
  EXPECT_EQ(indexed(), fresh());
}

TEST_F(Index, StepsOutOfOrderAreSaidOnce) {
  append(dumps(2, 3));
  EXPECT_EQ(indexed(), fresh());
  append(dumps(1, 1));
  EXPECT_EQ(indexed(), fresh());
  EXPECT_NE(fresh().find("5 then 2"), std::string::npos);
}

TEST_F(Index, ColumnsThatChange) {
  append(dump_header(6, 1, "id x y z") + "1 0 0 0 \n" + dumps(7, 8));
  EXPECT_EQ(indexed(), fresh());
  EXPECT_EQ(indexed(), fresh());
}

TEST_F(Index, AChangedDumpGetsANewOne) {
  indexed();
  folder.write("all.dump", dumps(11, 15));  // of the same length
  EXPECT_EQ(indexed(), fresh());
  folder.write("all.dump", dumps(1, 3));  // cut back
  EXPECT_EQ(indexed(), fresh());
  folder.write("all.dump", dumps(21, 29));  // longer, with another start
  EXPECT_EQ(indexed(), fresh());
  folder.write("all.dump", dumps(21, 28) + dumps(31, 33));  // longer, with the same start
  EXPECT_EQ(indexed(), fresh());
}

TEST_F(Index, AChangeWhoseTimeWasSetBackIsSeen) {
  indexed();
  const auto time = fs::last_write_time(dump);
  deface(form().scan(dump, true).snapshots[2].offset, "ITEM: TIMESTEP\n7\n");
  fs::last_write_time(dump, time);
  EXPECT_EQ(indexed(), fresh());
}

TEST_F(Index, AnotherFileOfTheSameName) {
  const auto other = folder.path("other/all.dump");
  fs::create_directories(folder.path("other"));
  std::ofstream(other) << dumps(31, 34);
  DumpIndex index(folder.path("index"), folder.path("index"));
  index.scan(form(), dump, true);
  index.scan(form(), other, true);
  index.save();
  DumpIndex again(folder.path("index"), {});
  EXPECT_EQ(told(again.scan(form(), dump, true)), fresh());
  EXPECT_EQ(told(again.scan(form(), other, true)), told(form().scan(other, true)));
}

TEST_F(Index, ADamagedIndexCountsAsNone) {
  const auto text = fresh();
  indexed();
  const auto path = index_file();
  const auto whole = bytes_of(path);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    fs::remove(path);  // some file systems flush to disk what is truncated and rewritten
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_EQ(told(DumpIndex(folder.path("index"), {}).scan(form(), dump, true)), text) << at;
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    fs::remove(path);
    std::ofstream(path, std::ios::binary) << whole.substr(0, size);
    EXPECT_EQ(told(DumpIndex(folder.path("index"), {}).scan(form(), dump, true)), text) << size;
  }
  for (const std::string foreign : {"x", "bedscope index of a dump, version 0\n1234"}) {
    std::ofstream(path, std::ios::binary) << foreign;
    EXPECT_EQ(indexed(), text);
    EXPECT_EQ(bytes_of(path), whole);  // written anew
  }
}

TEST_F(Index, OneSnapshotOrGzipHaveNone) {
  DumpIndex index(folder.path("index"), folder.path("index"));
  const auto one = folder.write("one.dump", small_dump(1, 5));
  const auto packed = folder.write("all.gz", gzip(dumps(1, 5)));
  const auto vtk = folder.write("one.vtk", small_vtk(4));
  EXPECT_EQ(told(index.scan(form(), packed, true)), fresh());
  EXPECT_EQ(index.scan(identify(one), one, true).snapshots.size(), 1U);
  EXPECT_EQ(index.scan(identify(vtk), vtk, true).snapshots.size(), 1U);
  index.save();
  EXPECT_FALSE(fs::exists(folder.path("index")));
}

TEST_F(Index, AFolderThatCannotBeWrittenIsNamed) {
  DumpIndex index({}, folder.path("all.dump/index"));
  index.scan(form(), dump, true);
  EXPECT_NE(error_of([&] { index.save(); }).find("all.dump/index: Not a dir"), std::string::npos);
}

TEST_F(Index, SeriesWithAndWithoutAreTheSame) {
  append(small_dump(6, 60).substr(0, 700));
  for (int look = 0; look < 2; ++look) {
    DumpIndex index(folder.path("index"), folder.path("index"));
    const auto with = Series::open(dump, {Repeated::refuse, &index});
    const auto without = Series::open(dump);
    index.save();
    ASSERT_EQ(with.size(), without.size());
    EXPECT_EQ(with.problems(), without.problems());
    EXPECT_EQ(with.columns(), without.columns());
    Snapshot a, b;
    Scratch scratch;
    for (std::size_t i = 0; i < with.size(); ++i) {
      with.read(i, request_of({"x", "radius"}), a, scratch);
      without.read(i, request_of({"x", "radius"}), b, scratch);
      EXPECT_EQ(a.columns, b.columns);
      EXPECT_EQ(with.place(i, 3), without.place(i, 3));
    }
  }
}

TEST_F(Index, ADumpInAFolderOfThem) {
  fs::create_directories(folder.path("post"));
  fs::rename(dump, folder.path("post/dump.1"));
  std::ofstream(folder.path("post/dump.2")) << dumps(6, 9);
  for (int look = 0; look < 2; ++look) {
    DumpIndex index(folder.path("index"), folder.path("index"));
    EXPECT_EQ(Series::open(folder.path("post"), {Repeated::refuse, &index}).size(), 9U);
    index.save();
  }
  std::size_t files = 0;
  for (const auto& item : fs::directory_iterator(folder.path("index"))) files += item.exists();
  EXPECT_EQ(files, 2U);
}

TEST(Place, LinesAreThoseOfTheFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("all.dump", "\n\n" + dumps(1, 3, 4) + "\n\n" + dumps(4, 4, 2));
  const auto series = Series::open(path);
  ASSERT_EQ(series.size(), 4U);
  EXPECT_EQ(series.place(0, 0), path + ": line 12");
  EXPECT_EQ(series.place(2, 3), path + ": line 41");
  EXPECT_EQ(series.place(3, 1), path + ": line 54");
}

TEST(BytesRead, AreThoseOfTheSnapshotWhateverFollows) {
  const TemporaryFolder folder;
  const auto text = dumps(1, 2, 3000);
  const auto path = folder.write("all.dump", text + dumps(3, 3, 5));
  const auto longer = folder.write("longer.dump", text + dumps(3, 9, 3000));
  Snapshot a, b;
  Scratch scratch;
  for (const std::size_t i : {0U, 1U}) {
    Series::open(path).read(i, request_of({"x"}), a, scratch);
    Series::open(longer).read(i, request_of({"x"}), b, scratch);
    EXPECT_EQ(a.bytes_read, b.bytes_read);
    EXPECT_EQ(a.bytes_read, text.size() / 2 + 64);
  }
}

}  // namespace
}  // namespace bedscope::readers
