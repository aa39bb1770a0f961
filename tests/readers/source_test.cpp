// SPDX-License-Identifier: BSD-3-Clause
// Plain and gzip files as one stream of bytes: order of reading, members, ends, things that are no
// files.
#include "readers/source.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <random>

#include "readers/byte_window.hpp"
#include "readers/text_file.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

std::string lines_of_numbers(std::size_t size, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::string text;
  while (text.size() < size)
    text += std::to_string(random() % 1'000'000) + (random() % 8 ? " " : "\n");
  text.resize(size);
  return text;
}

std::string read_all(Source& source, std::size_t piece = 10'000) {
  std::string all, part(piece, '\0');
  while (const auto got = source.read(part)) all.append(part, 0, got);
  return all;
}

std::string read_all(const std::string& path) {
  Source source(path);
  return read_all(source);
}

TEST(Source, GzipIsKnownByItsFirstBytesWhateverTheName) {
  const TemporaryFolder folder;
  const auto text = lines_of_numbers(500'000);
  for (const auto& path : {folder.write("dump.gz", gzip(text)), folder.write("dump", gzip(text)),
                           folder.write("plain", text), folder.write("plain.gz", text)})
    EXPECT_EQ(read_all(path), text) << path;
}

TEST(Source, OneByteAndNoByteAreFiles) {
  const TemporaryFolder folder;
  for (const std::string text : {"", "\x1f", "a", "\x1f\x8a"}) {
    const auto path = folder.write("short", text);
    EXPECT_EQ(read_all(path), text);
    EXPECT_EQ(Source(path).size_bound(), text.size());
    EXPECT_EQ(read_head(path), text);
  }
  EXPECT_EQ(read_all(folder.write("none.gz", gzip(""))), "");
}

TEST(Source, MembersOfGzipFollowEachOtherWhereverTheInputBufferEnds) {
  const TemporaryFolder folder;
  const std::string second = "second member";
  // Stored blocks make the length of the first member a matter of choice: its end moves across the
  // 64 kB of one refill, so that the next member's two magic bytes are met whole, halved and apart.
  for (std::size_t shift = 0; shift <= 24; ++shift) {
    const auto size = std::size_t{1 << 16} - 12 + shift;
    std::string first = lines_of_numbers(65'000);
    while (gzip(first, 0).size() < size) first += 'x';
    ASSERT_LE(gzip(first, 0).size(), size + 6);
    const auto path = folder.write("two.gz", gzip(first, 0) + gzip(second) + gzip("") + gzip("!"));
    EXPECT_EQ(read_all(path), first + second + "!") << shift;
    const auto followed = folder.write("followed.gz", gzip(first, 0) + "\x1fz");
    Source source(followed);
    EXPECT_EQ(read_all(source), first);
    EXPECT_EQ(source.trailing(), fmt::format("bytes after the gzip stream ignored, from offset {}",
                                             gzip(first, 0).size()));
  }
}

TEST(Source, AGzipStreamThatEndsEarlyGivesWhatItHoldsAndSaysWhere) {
  const TemporaryFolder folder;
  const auto text = lines_of_numbers(300'000);
  const auto packed = gzip(text);
  for (std::size_t size :
       {packed.size() - 1, packed.size() - 8, packed.size() / 2, std::size_t{10}}) {
    Source source(folder.write("cut.gz", packed.substr(0, size)));
    const auto got = read_all(source);
    EXPECT_EQ(got, text.substr(0, got.size()));
    EXPECT_EQ(source.cut(), fmt::format("gzip stream ends early at offset {}", size));
  }
}

TEST(Source, DamageInsideGzipIsAnErrorWithItsOffset) {
  const TemporaryFolder folder;
  auto packed = gzip(lines_of_numbers(300'000));
  for (std::size_t k = 0; k < 40; ++k) packed[packed.size() / 2 + k] ^= 0x5a;
  const auto path = folder.write("damaged.gz", packed);
  EXPECT_NE(error_of([&] { read_all(path); }).find("gzip stream damaged"), std::string::npos);
}

TEST(Source, SeekingGivesTheBytesThatReadingGives) {
  const TemporaryFolder folder;
  const auto text = lines_of_numbers(700'000);
  std::mt19937_64 random(6);
  for (const auto& path :
       {folder.write("plain", text),
        folder.write("gz", gzip(text.substr(0, 250'001)) + gzip(text.substr(250'001)))}) {
    Source source(path);
    std::string part;
    for (int i = 0; i < 60; ++i) {
      const auto offset = random() % text.size();
      part.resize(random() % 3000);
      source.seek(offset);
      ASSERT_EQ(source.position(), offset);
      const auto got = source.read(part);
      ASSERT_EQ(part.substr(0, got), text.substr(offset, part.size()));
    }
  }
}

TEST(Source, ACheckpointOpensAnotherSourceInTheMiddleOfAGzipFile) {
  const TemporaryFolder folder;
  const auto text = lines_of_numbers(3'000'000);
  const auto packed = gzip(text.substr(0, 1'000'001)) + gzip(text.substr(1'000'001));
  const auto path = folder.write("dump.gz", packed);
  std::vector<std::shared_ptr<const Checkpoint>> checkpoints;
  std::vector<std::uint64_t> offsets;
  {
    Source source(path);
    std::string part(90'001, '\0');
    do {
      checkpoints.push_back(source.checkpoint());
      offsets.push_back(source.position());
    } while (source.read(part) == part.size());
    EXPECT_EQ(source.checkpoint(), nullptr);  // nothing follows the end
  }
  for (std::size_t k = checkpoints.size(); k-- > 0;) {
    Source source(path);
    source.resume(checkpoints[k]);
    ASSERT_EQ(source.position(), offsets[k]);
    std::string part(200'000, '\0');
    part.resize(source.read(part));
    ASSERT_EQ(part, text.substr(offsets[k], 200'000));
    if (k > 0) {
      ASSERT_LT(source.bytes_from_disk(), packed.size());
    }
    source.seek(offsets[k] / 2);  // back behind the checkpoint still works
    part.resize(100);
    part.resize(source.read(part));
    ASSERT_EQ(part, text.substr(offsets[k] / 2, 100));
  }
}

TEST(Source, NoFileCanHoldMoreThanItsBound) {
  const TemporaryFolder folder;
  std::string zeros;
  zeros.resize(10'000'000, '0');  // the best that deflate can do
  const auto path = folder.write("zeros.gz", gzip(zeros));
  EXPECT_GE(Source(path).size_bound(), zeros.size());
  EXPECT_EQ(Source(path).likely_size(), zeros.size());
}

TEST(Source, WhatIsNoRegularFileIsRefusedAtOnceWithTheReason) {
  const TemporaryFolder folder;
  const auto open_error = [](const std::string& path) {
    return error_of([&] { Source source(path); });
  };
  ASSERT_EQ(::mkfifo(folder.path("fifo").c_str(), 0600), 0);
  fs::create_symlink("loop_b", folder.path("loop_a"));
  fs::create_symlink("loop_a", folder.path("loop_b"));
  fs::create_symlink("/dev/zero", folder.path("zero"));
  fs::create_symlink("nowhere", folder.path("dangling"));
  fs::permissions(folder.write("noperm", "x"), fs::perms::none);
  EXPECT_EQ(open_error(folder.path("fifo")), folder.path("fifo") + ": not a regular file");
  EXPECT_EQ(open_error(folder.path("zero")), folder.path("zero") + ": not a regular file");
  EXPECT_EQ(open_error(folder.path("loop_a")),
            folder.path("loop_a") + ": too many levels of symbolic links");
  EXPECT_EQ(open_error(folder.path("dangling")), folder.path("dangling") + ": no such file");
  EXPECT_EQ(open_error(folder.path()), folder.path() + ": is a directory, expected a file");
  if (::geteuid() != 0) {  // root may read everything
    EXPECT_EQ(open_error(folder.path("noperm")), folder.path("noperm") + ": permission denied");
  }
}

TEST(Source, LinesAreCountedFromOneInPlainAndGzipFiles) {
  const TemporaryFolder folder;
  const std::string text = "a\nbb\r\n\nccc";
  for (const auto& path : {folder.write("plain", text), folder.write("gz", gzip(text))}) {
    const std::vector<std::uint64_t> lines{1, 1, 2, 2, 2, 2, 3, 4, 4, 4, 4};
    for (std::uint64_t offset = 0; offset < lines.size(); ++offset)
      EXPECT_EQ(line_at(path, offset), lines[offset]) << offset;
    EXPECT_EQ(line_at(path, 1'000), 4U);
  }
}

TEST(ByteWindow, LinesAreWholeHoweverSmallTheWindow) {
  const TemporaryFolder folder;
  std::string text;
  std::vector<std::string> expected;
  std::mt19937_64 random(7);
  for (int i = 0; i < 500; ++i) {
    expected.emplace_back(random() % (i % 50 == 0 ? 5000 : 90), static_cast<char>('a' + i % 26));
    text += expected.back() + (i % 3 == 0 ? "\r\n" : "\n");
  }
  expected.emplace_back("last, without an end");
  const auto path = folder.write("lines", text + expected.back());
  for (const std::size_t size : {1U, 2U, 3U, 64U, 100U, 4096U, 1U << 18}) {
    Source source(path);
    std::vector<char> buffer;
    ByteWindow window(source, buffer, size);
    std::uint64_t offset = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      ASSERT_EQ(window.offset(), offset);
      const auto line = window.line();
      ASSERT_TRUE(line.has_value());
      ASSERT_EQ(*line, expected[k]) << size;
      ASSERT_EQ(window.closed(), k + 1 < expected.size());
      offset += expected[k].size() + (k % 3 == 0 ? 2 : 1);
    }
    ASSERT_FALSE(window.line().has_value());
  }
}

TEST(TextFile, IsReadWholeAndRefusedWhereItIsLongerThanAccepted) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0, 1, 65'535, 65'536, 65'537, 300'000}) {
    const auto text = lines_of_numbers(size);
    for (const auto& path : {folder.write("plain", text), folder.write("gzip", gzip(text))}) {
      EXPECT_EQ(read_text(path), text);
      EXPECT_EQ(read_text(path, std::max<std::size_t>(size, 1)), text);
      if (size > 1) {
        EXPECT_NE(error_of([&] { read_text(path, size - 1); }), "") << size;
      }
    }
  }
  const auto cut = folder.write("cut", gzip(lines_of_numbers(1000)).substr(0, 200));
  EXPECT_NE(error_of([&] { read_text(cut); }).find("ends early"), std::string::npos);
}

TEST(TextFile, IsNoPipeNoDeviceAndNoFolder) {
  const TemporaryFolder folder;
  const auto pipe = folder.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { read_text(pipe); }), pipe + ": not a regular file");
  EXPECT_EQ(error_of([&] { read_text("/dev/zero"); }), "/dev/zero: not a regular file");
  EXPECT_EQ(error_of([&] { read_text(folder.path()); }),
            folder.path() + ": is a directory, expected a file");
}

}  // namespace
}  // namespace bedscope::readers
