// SPDX-License-Identifier: BSD-3-Clause
// Small dumps of each kind, cut at every byte and with every byte changed: they are read, or
// refused with an Error; nothing else, and without memory for counts that lie.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

#include "readers/forms.hpp"
#include "tests/readers/bin_dump.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path data = BEDSCOPE_TEST_DATA;

/// The beginning of a dump of few particles: enough of every section.
std::string first_rows(const std::string& dump, std::size_t particles) {
  const auto count = dump.find("NUMBER OF ATOMS\n") + 16;
  auto rows = dump.find("ITEM: ATOMS");
  for (std::size_t row = 0; row <= particles; ++row) rows = dump.find('\n', rows) + 1;
  return dump.substr(0, count) + std::to_string(particles) +
         dump.substr(dump.find('\n', count), rows - dump.find('\n', count));
}

std::string tiny_vtk(bool binary, const std::string& version) {
  // Two particles; all numbers are 0 except the first byte of each, so that the bytes are the same
  // in any order.
  const auto numbers = [&](std::size_t count, std::size_t size) {
    if (binary) return std::string(count * size, '\0') + "\n";
    std::string text;
    for (std::size_t k = 0; k < count; ++k) text += "0 ";
    return text + "\n";
  };
  std::string text = "# vtk DataFile Version " + version + "\nt\n" + (binary ? "BINARY" : "ASCII") +
                     "\nDATASET UNSTRUCTURED_GRID\nFIELD F 1\nTimeValue 1 1 double\n" +
                     numbers(1, 8) + "POINTS 2 float\n" + numbers(6, 4);
  if (version >= "5")
    text += "CELLS 3 2\nOFFSETS vtktypeint64\n" + numbers(3, 8) + "CONNECTIVITY vtktypeint64\n" +
            numbers(2, 8);
  else
    text += "CELLS 2 4\n" + numbers(4, 4);
  text += "CELL_TYPES 2\n";
  text += binary ? std::string("\0\0\0\1\0\0\0\1\n", 9) : "1\n1\n";
  text += "POINT_DATA 2\nSCALARS radius double 1\nLOOKUP_TABLE default\n" + numbers(2, 8) +
          "VECTORS v float\n" + numbers(6, 4) + "FIELD F 3\nid 1 2 int\n" + numbers(2, 4) +
          "METADATA\nINFORMATION 0\n\nelement 1 2 string\n" +
          (binary ? std::string("\xC2"
                                "ab\xC1"
                                "c\n")
                  : std::string("ab\nc\n")) +
          "c_st[1-3] 3 2 double\n" + numbers(6, 8);
  return text;
}

struct Fixture {
  const char* name;
  std::string content;
};

std::vector<Fixture> fixtures() {
  const auto text = data / "liggghts_text";
  const auto triclinic = first_rows(bytes_of(text / "triclinic_2000.liggghts"), 4);
  const auto scaled = first_rows(bytes_of(text / "scaled_10500.liggghts"), 5);
  const auto append = first_rows(bytes_of(text / "append.liggghts"), 3);
  return {{"triclinic", triclinic},
          {"scaled", scaled},
          {"several", append + replaced(append, "\n100\n", "\n200\n") + small_dump(300, 0) +
                          small_dump(400, 2)},
          {"time", "ITEM: UNITS\nsi\nITEM: TIME\n0.5\n" + small_dump(1, 3)},
          {"text_gzip", gzip(append) + gzip(small_dump(200, 3))},
          {"vtk_ascii", tiny_vtk(false, "2.0")},
          {"vtk_ascii_5", tiny_vtk(false, "5.1")},
          {"vtk_binary", tiny_vtk(true, "3.0")},
          {"vtk_binary_5", tiny_vtk(true, "5.1")},
          {"vtk_gzip", gzip(tiny_vtk(true, "4.2"))},
          {"bin", bin_dump({.step = 5, .chunks = {3, 2}}) + bin_dump({.step = 6, .triclinic = 1})},
          {"bin_lammps", bin_dump({.step = 5, .revision = 2, .time = 0.5})},
          {"bin_gzip", gzip(bin_dump({.step = 5, .chunks = {9}}))},
          {"unnamed", replaced(small_dump(7, 4), " id type x y z radius ", "")},
          {"mesh", bytes_of(data / "vtk_legacy" / "triclinic_boundingBox_2000.vtk")}};
}

struct Outcomes {
  std::size_t read = 0, refused = 0;
  std::chrono::steady_clock::duration slowest{};
};

/// x, y, z ... for the columns of a file that names none.
std::shared_ptr<const std::vector<std::string>> names_for(const std::vector<std::string>& columns) {
  std::vector<std::string> names{"x", "y", "z"};
  while (names.size() < columns.size()) names.push_back(columns[names.size()]);
  names.resize(columns.size());
  return std::make_shared<const std::vector<std::string>>(std::move(names));
}

/// All that a program does with one file. Anything but an Error ends the test program.
void use(const std::string& path, Outcomes& outcomes) {
  static const Request request{
      {"x"}, {"y"}, {"z"}, {"radius", false}, {"vx", false}, {"id", false}, {"c_st[2]", false}};
  const auto start = std::chrono::steady_clock::now();
  try {
    const auto& form = identify(path);
    Snapshot snapshot;
    Scratch scratch;
    for (const bool thorough : {true, false}) {  // as a series does: the thorough look comes first
      const auto found = form.scan(path, thorough);
      EXPECT_TRUE(!found.not_particles.empty() || !found.snapshots.empty());
      if (!found.not_particles.empty()) break;
      for (auto located : found.snapshots) {
        if (!located.named) located.columns = names_for(*located.columns);
        form.read(path, located, request, snapshot, scratch);
        for (const auto& column : snapshot.columns)
          EXPECT_TRUE(column.empty() || column.size() == snapshot.particles);
        if (form.place != nullptr) form.place(path, located, 0);
      }
    }
    ++outcomes.read;
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(path + ": ")) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    ++outcomes.refused;
  }
  outcomes.slowest = std::max(outcomes.slowest, std::chrono::steady_clock::now() - start);
}

class Damage : public testing::TestWithParam<Fixture> {
 protected:
  void expect_calm() const {
    // A count that lies would take longer than this to be filled, let alone 8 TB of it.
    EXPECT_LT(outcomes.slowest, std::chrono::seconds(2));
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(usage.ru_maxrss, 100 * 1024) << "kB";
#endif
  }
  TemporaryFolder folder;
  Outcomes outcomes;
};

TEST_P(Damage, WholeFilesAreGood) {
  use(folder.write("dump", GetParam().content), outcomes);
  EXPECT_EQ(outcomes.read, 1U);
}

TEST_P(Damage, FilesCutAtAnyByteAreReadOrRefused) {
  const auto& content = GetParam().content;
  for (std::size_t size = 0; size < content.size(); ++size)
    use(folder.write("dump", content.substr(0, size)), outcomes);
  EXPECT_GT(outcomes.refused, content.size() / 4);
  expect_calm();
}

TEST_P(Damage, FilesWithAnyByteChangedAreReadOrRefused) {
  const auto& content = GetParam().content;
  std::mt19937_64 random(1);
  const std::size_t stride = content.size() / 300 + 1;  // a sample of the larger files: time
  for (std::size_t at = 0; at < content.size(); at += stride)
    for (const int value : {0, int{'9'}, static_cast<int>(random() % 256)}) {
      auto changed = content;
      changed[at] = static_cast<char>(value);
      use(folder.write("dump", changed), outcomes);
    }
  EXPECT_GT(outcomes.refused, 50U);
  EXPECT_GT(outcomes.read, 10U);
  expect_calm();
}

TEST_P(Damage, FilesWithPiecesMovedAboutAreReadOrRefused) {
  // Lines left out, doubled and swapped, digits put in: what no single byte does.
  const auto& content = GetParam().content;
  std::mt19937_64 random(2);
  for (int i = 0; i < 500; ++i) {
    auto changed = content;
    for (int change = 0; change < 3; ++change) {
      const auto at = random() % changed.size();
      const auto length = random() % std::min<std::size_t>(60, changed.size() - at);
      const auto piece = changed.substr(at, length);
      switch (random() % 3) {
        case 0:
          changed.erase(at, length);
          break;
        case 1:
          changed.insert(random() % changed.size(), piece);
          break;
        default:
          changed.insert(at, std::array{"9", "99999999999", "4611686018427387904", "-", " ",
                                        "\n"}[random() % 6]);
      }
      if (changed.empty()) changed = content;
    }
    use(folder.write("dump", changed), outcomes);
  }
  expect_calm();
}

INSTANTIATE_TEST_SUITE_P(Readers, Damage, testing::ValuesIn(fixtures()),
                         [](const auto& fixture) { return std::string(fixture.param.name); });

}  // namespace
}  // namespace bedscope::readers
