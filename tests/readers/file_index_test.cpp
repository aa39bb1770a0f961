// SPDX-License-Identifier: BSD-3-Clause
// .pvtp, .pvtu, .pvd, .vtm and .series: which files are one snapshot, which times they have, and
// which wins where several name the same.
#include "readers/file_index.hpp"

#include <random>

#include "readers/series.hpp"
#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

const fs::path data = BEDSCOPE_TEST_DATA;

std::string all(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}

/// A .vtp of particles with the ids first .. last; `extra` is one more array.
std::string vtp(int first, int last, const std::string& extra = "") {
  std::string ids, points;
  for (int id = first; id <= last; ++id) {
    ids += fmt::format("{} ", id);
    points += fmt::format("{} 0 0 ", id);
  }
  return fmt::format(
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"{}\"><PointData><DataArray "
      "type=\"Int32\" Name=\"id\">{}</DataArray>{}</PointData><Points><DataArray "
      "type=\"Float64\" NumberOfComponents=\"3\">{}</DataArray></Points></Piece></PolyData>"
      "</VTKFile>\n",
      last - first + 1, ids, extra, points);
}

std::string pvtp(const std::vector<std::string>& pieces) {
  std::string text = "<VTKFile type=\"PPolyData\">\n<PPolyData GhostLevel=\"0\">\n";
  for (const auto& piece : pieces) text += fmt::format("<Piece Source=\"{}\"/>\n", piece);
  return text + "</PPolyData>\n</VTKFile>\n";
}

std::string vtm(const std::vector<std::string>& blocks) {
  std::string text = "<VTKFile type=\"vtkMultiBlockDataSet\">\n<vtkMultiBlockDataSet>\n";
  for (const auto& block : blocks)
    text += fmt::format("<DataSet index=\"0\" file=\"{}\"/>\n", block);
  return text + "</vtkMultiBlockDataSet>\n</VTKFile>\n";
}

using Files = std::vector<std::pair<std::string, std::string>>;  // time, name

std::string pvd(const Files& files) {
  std::string text = "<VTKFile type=\"Collection\">\n<Collection>\n";
  int part = 0;
  for (const auto& [time, name] : files)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", time, part++, name);
  return text + "</Collection>\n</VTKFile>\n";
}

std::string series_file(const Files& files) {
  std::string list;
  for (const auto& [time, name] : files)
    list += fmt::format("{}\n{{ \"name\" : \"{}\", \"time\" : {} }}", list.empty() ? "" : ",", name,
                        time);
  return "{ \"file-series-version\" : \"1.0\", \"files\" : [" + list + " ] }\n";
}

struct Found {
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<std::vector<double>> ids;

  bool operator==(const Found&) const = default;
};

Found look(const Series& series) {
  Found found;
  Snapshot snapshot;
  Scratch scratch;
  for (std::size_t i = 0; i < series.size(); ++i) {
    series.read(i, request_of({"id"}), snapshot, scratch);
    found.steps.push_back(series.step(i));
    found.times.push_back(series.time(i));
    found.ids.push_back(snapshot.columns[0]);
    EXPECT_EQ(series.particles(i), static_cast<std::int64_t>(snapshot.particles));
  }
  return found;
}

using Ids = std::vector<std::vector<double>>;

TEST(FileIndex, PiecesAreCountedOnceWhicheverWayOneNamesThem) {
  const TemporaryFolder folder;
  for (const int step : {100, 200}) {
    folder.write(fmt::format("par_{}_0.vtp", step), vtp(1, 2));
    folder.write(fmt::format("par_{}_1.vtp", step), vtp(3, 3));
    folder.write(fmt::format("par_{}.pvtp", step),
                 pvtp({fmt::format("par_{}_0.vtp", step), fmt::format("par_{}_1.vtp", step)}));
  }
  for (const char* name : {"", "*.pvtp", "par_*"}) {
    const auto series = Series::open(folder.path(name));
    const auto found = look(series);
    EXPECT_EQ(found.steps, (std::vector<std::int64_t>{100, 200}));
    EXPECT_EQ(found.ids, (Ids{{1, 2, 3}, {1, 2, 3}}));
    EXPECT_TRUE(series.left_out().empty());
    EXPECT_TRUE(series.problems().empty());
  }
  EXPECT_EQ(look(Series::open(folder.path("par_200.pvtp"))).ids, (Ids{{1, 2, 3}}));
}

TEST(FileIndex, TimesOfACollectionOrderTheSeries) {
  const TemporaryFolder folder;
  for (const int k : {0, 1, 2}) folder.write(fmt::format("bed_000{}.vtp", k), vtp(k, k));
  const Files files{{" 0.2007407E-01", "bed_0002.vtp"},
                    {" 0.0000000E+00", "bed_0000.vtp"},
                    {" 0.1044444E-01", "bed_0001.vtp"}};
  for (const auto& path : {folder.write("bed.pvd", pvd(files)), folder.path()}) {
    const auto series = Series::open(path);
    const auto found = look(series);
    EXPECT_EQ(found.times, (std::vector<double>{0, 0.01044444, 0.02007407}));
    EXPECT_EQ(found.ids, (Ids{{0}, {1}, {2}}));
    EXPECT_TRUE(series.has_steps());
    EXPECT_EQ(found.steps, (std::vector<std::int64_t>{0, 1, 2}));
  }
}

TEST(FileIndex, OfACollectionThatEndsEarlyTheWholeEntriesAreUsedAndItIsTold) {
  const TemporaryFolder folder;
  for (const int k : {0, 1, 2}) folder.write(fmt::format("bed_{}.vtp", k), vtp(k, k));
  const auto whole = pvd({{"0.5", "bed_0.vtp"}, {"1.5", "bed_1.vtp"}, {"2.5", "bed_2.vtp"}});
  const auto second = whole.find("bed_2.vtp");
  for (const auto& [text, snapshots] : {std::pair(whole.substr(0, whole.find("</Collection>")), 3U),
                                        {whole.substr(0, second + 4), 2U}}) {
    const auto path = folder.write("bed.pvd", text);
    const auto series = Series::open(path);
    ASSERT_EQ(series.size(), snapshots);
    EXPECT_EQ(series.time(1), 1.5);
    ASSERT_EQ(series.problems().size(), 1U);
    EXPECT_NE(series.problems()[0].find("XML ends inside"), std::string::npos);
  }
}

TEST(FileIndex, PiecesWithoutParticlesNeedNoArrays) {
  const std::string bare =
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"0\"/></PolyData></VTKFile>";
  const std::string none = "<VTKFile type=\"PolyData\"><PolyData></PolyData></VTKFile>";
  for (const auto& empty : {bare, none})
    for (const bool first : {true, false}) {
      const TemporaryFolder folder;
      folder.write("a_1_0.vtp", first ? empty : vtp(3, 5));
      folder.write("a_1_1.vtp", first ? vtp(3, 5) : empty);
      const auto series = Series::open(folder.write("a_1.pvtp", pvtp({"a_1_0.vtp", "a_1_1.vtp"})));
      EXPECT_EQ(look(series).ids, (Ids{{3, 4, 5}}));
      EXPECT_EQ(series.columns(), (std::vector<std::string>{"id"}));
      EXPECT_EQ(series.path(0), folder.path(first ? "a_1_1.vtp" : "a_1_0.vtp"));
    }
}

TEST(FileIndex, TimesThatOnlyCountAreNoTimes) {
  // LIGGGHTS' write_pvd_file.
  const TemporaryFolder folder;
  folder.write("case_1000.vtp", vtp(1, 1));
  folder.write("case_1500.vtp", vtp(2, 2));
  folder.write("run.pvd", pvd({{"0", "case_1000.vtp"}, {"1", "case_1500.vtp"}}));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(look(series).steps, (std::vector<std::int64_t>{1000, 1500}));
  EXPECT_TRUE(std::isnan(series.time(1)));
  EXPECT_NE(all(series.notes()).find("running number"), std::string::npos);
}

TEST(FileIndex, WithoutNumbersInTheNamesSnapshotsAreNumberedByTime) {
  const TemporaryFolder folder;
  folder.write("late.vtp", vtp(2, 2));
  folder.write("early.vtp", vtp(1, 1));
  const auto series = Series::open(
      folder.write("s.series", series_file({{"0.5", "late.vtp"}, {"0.25", "early.vtp"}})));
  EXPECT_FALSE(series.has_steps());
  const auto found = look(series);
  EXPECT_EQ(found.times, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(found.steps, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(found.ids, (Ids{{1}, {2}}));
}

TEST(FileIndex, NumbersThatRunAgainstTheTimesAreSaid) {
  const TemporaryFolder folder;
  folder.write("a_1.vtp", vtp(1, 1));
  folder.write("a_2.vtp", vtp(2, 2));
  const auto series = Series::open(
      folder.write("a.series", series_file({{"0.5", "a_1.vtp"}, {"0.25", "a_2.vtp"}})));
  EXPECT_EQ(look(series).ids, (Ids{{2}, {1}}));
  EXPECT_FALSE(series.has_steps());
  EXPECT_NE(all(series.problems()).find("not in the order of the times"), std::string::npos);
}

TEST(FileIndex, BlocksThatAreNoParticlesAreLeftOut) {
  const auto series = Series::open((data / "liggghts_parallel" / "case_1000.vtm").string());
  EXPECT_EQ(series.size(), 1U);
  EXPECT_EQ(series.particles(0), 304);
  const auto left = all(series.left_out());
  for (const char* what : {"a triangle mesh", "contacts", "the bounding box"})
    EXPECT_NE(left.find(what), std::string::npos) << what;
}

TEST(FileIndex, WhereNothingIsNamedThereWereNoParticles) {  // so LIGGGHTS 3.8 writes them
  const TemporaryFolder folder;
  const auto box = bytes_of(data / "liggghts_parallel" / "case_1000" / "case_1000_3.vtr");
  for (const auto* name : {"box_0.vtr", "box_10.vtr"}) folder.write(name, box);
  folder.write("a_10.vtp", vtp(1, 2));
  folder.write("p_0.pvtp", pvtp({}));
  folder.write("p_10.pvtp", pvtp({"a_10.vtp"}));
  folder.write("c_0.vtm", vtm({"box_0.vtr"}));
  folder.write("c_10.vtm", vtm({"a_10.vtp", "box_10.vtr"}));
  folder.write("p.pvd", pvd({{"0.5", "p_0.pvtp"}, {"1.5", "p_10.pvtp"}}));
  for (const char* name : {"p_*", "c_*", "p.pvd"}) {
    const auto series = Series::open(folder.path(name));
    const auto found = look(series);
    EXPECT_EQ(found.steps, (std::vector<std::int64_t>{0, 10}));
    EXPECT_EQ(found.ids, (Ids{{}, {1, 2}}));
    EXPECT_EQ(series.columns(), (std::vector<std::string>{"id"}));
    EXPECT_TRUE(series.problems().empty());
  }
}

TEST(FileIndex, IndicesInIndicesAreFollowed) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("case_10"));
  fs::create_directory(folder.path("case_20"));
  Files files;
  for (const int step : {10, 20}) {
    const auto sub = fmt::format("case_{}", step);
    folder.write(sub + "/a.vtp", vtp(step, step));
    folder.write(sub + "/b.vtp", vtp(step + 1, step + 1));
    folder.write(sub + "/all.pvtp", pvtp({"a.vtp", "b.vtp"}));
    folder.write(sub + "/mesh.vtp", bytes_of(data / "vtk_xml" / "liggghts_mesh.vtp"));
    folder.write(sub + ".vtm", vtm({sub + "/mesh.vtp", sub + "/all.pvtp"}));
    files.emplace_back(fmt::format("0.{}", step), sub + ".vtm");
  }
  folder.write("case.pvd", pvd(files));
  for (const char* name : {"", "case.pvd"}) {
    const auto found = look(Series::open(folder.path(name)));
    EXPECT_EQ(found.steps, (std::vector<std::int64_t>{10, 20}));
    EXPECT_EQ(found.times, (std::vector<double>{0.1, 0.2}));
    EXPECT_EQ(found.ids, (Ids{{10, 11}, {20, 21}}));
  }
}

TEST(FileIndex, OfTwoThatNameOneFileTheOneWithTimesWins) {
  const TemporaryFolder folder;
  folder.write("a_10.vtp", vtp(1, 1));
  folder.write("a_20.vtp", vtp(2, 2));
  folder.write("a.pvd", pvd({{"0", "a_10.vtp"}, {"1", "a_20.vtp"}}));
  folder.write("z.series", series_file({{"0.5", "a_10.vtp"}, {"1.5", "a_20.vtp"}}));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(look(series).times, (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(all(series.left_out()),
            folder.path("a.pvd") + ": names files that " + folder.path("z.series") + " names too");
}

TEST(FileIndex, GhostPointsOfPiecesAreCountedOnce) {
  const TemporaryFolder folder;
  const auto ghosts = [](const char* types) {
    return fmt::format("<DataArray type=\"UInt8\" Name=\"vtkGhostType\">{}</DataArray>", types);
  };
  folder.write("a.vtp", vtp(1, 4, ghosts("0 0 0 1")));      // 4 belongs to b, and 2 and 3 to a
  folder.write("b.vtp", vtp(2, 6, ghosts("1 33 0 32 0")));  // 32: another bit, no copy
  const auto series = Series::open(folder.write("c.pvtp", pvtp({"a.vtp", "b.vtp"})));
  EXPECT_EQ(look(series).ids, (Ids{{1, 2, 3, 4, 5, 6}}));
  EXPECT_EQ(series.place(0, 2), folder.path("a.vtp") + ": point 2");
  EXPECT_EQ(series.place(0, 3), folder.path("b.vtp") + ": point 2");
  EXPECT_EQ(look(Series::open(folder.path("a.vtp"))).ids, (Ids{{1, 2, 3, 4}}));  // by itself
}

// Legacy files have no index of pieces of their own: a .pvd names them.
TEST(FileIndex, GhostPointsOfLegacyFilesAreCountedOnce) {
  const TemporaryFolder folder;
  const auto vtk = [](int first, int last, const std::string& array, const std::string& values) {
    std::string points, cells, ids;
    for (int id = first; id <= last; ++id) {
      points += fmt::format("{} 0 0\n", id);
      cells += fmt::format("1 {}\n", id - first);
      ids += fmt::format("{} ", id);
    }
    const int n = last - first + 1;
    return fmt::format(
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS {0} float\n{1}VERTICES {0} "
        "{2}\n{3}POINT_DATA {0}\nSCALARS {4} unsigned_char 1\nLOOKUP_TABLE default\n{5}\nFIELD "
        "FieldData 2\nid 1 {0} int\n{6}\nradius 1 {0} float\n{7}\n",
        n, points, 2 * n, cells, array, values, ids,
        fmt::join(std::vector<double>(static_cast<std::size_t>(n), 0.5), " "));
  };
  folder.write("a.vtk", vtk(1, 4, "vtkGhostType", "0 0 0 1"));
  folder.write("b.vtk", vtk(2, 6, "vtkGhostType", "1 33 0 32 0"));
  folder.write("d.vtk", vtk(1, 4, "vtkGhostLevels", "0 0 0 1"));
  folder.write("e.vtk", vtk(2, 6, "vtkGhostLevels", "2 1 0 0 0"));
  for (const auto& [first, second] : {std::pair{"a.vtk", "b.vtk"}, {"d.vtk", "e.vtk"}}) {
    const auto list = pvd({{"0.5", first}, {"0.5", second}});
    const auto series = Series::open(folder.write("c.pvd", list));
    EXPECT_EQ(look(series).ids, (Ids{{1, 2, 3, 4, 5, 6}})) << first;
    EXPECT_EQ(series.place(0, 3), folder.path(second) + ": point 2");
  }
  EXPECT_EQ(look(Series::open(folder.path("a.vtk"))).ids, (Ids{{1, 2, 3, 4}}));  // by itself
}

TEST(FileIndex, FilesOfOneTimeAreOneSnapshot) {
  const TemporaryFolder folder;
  folder.write("a.vtp", vtp(1, 1));
  folder.write("b.vtp", vtp(2, 2));
  const auto path = folder.write("c.pvd", pvd({{"0.5", "a.vtp"}, {"0.5", "b.vtp"}}));
  EXPECT_EQ(look(Series::open(path)).ids, (Ids{{1, 2}}));
}

TEST(FileIndex, AListThatNamesMissingFilesIsNotUsedInAFolder) {
  const TemporaryFolder folder;
  folder.write("a_10.vtp", vtp(1, 1));
  const auto list = folder.write("a.pvd", pvd({{"0.5", "a_10.vtp"}, {"0.6", "a_20.vtp"}}));
  const auto series = Series::open(folder.path());
  EXPECT_EQ(look(series).ids, (Ids{{1}}));
  EXPECT_EQ(all(series.problems()), list + ": line 4: file a_20.vtp not found: not used");
  EXPECT_EQ(error_of([&] { Series::open(list); }), list + ": line 4: file a_20.vtp not found");
}

TEST(FileIndex, OfALastSnapshotThePieceThatIsNotThereYetLeavesItOut) {
  const TemporaryFolder folder;
  for (const int step : {10, 20}) {
    folder.write(fmt::format("a_{}_0.vtp", step), vtp(1, 2));
    folder.write(fmt::format("a_{}.pvtp", step),
                 pvtp({fmt::format("a_{}_0.vtp", step), fmt::format("a_{}_1.vtp", step)}));
  }
  folder.write("a_10_1.vtp", vtp(3, 4));
  auto series = Series::open(folder.path());
  EXPECT_EQ(look(series).steps, (std::vector<std::int64_t>{10}));
  EXPECT_TRUE(series.cut());
  folder.write("a_20_1.vtp", vtp(3, 4).substr(0, 150));
  series = Series::open(folder.path());
  EXPECT_EQ(look(series).steps, (std::vector<std::int64_t>{10}));
  folder.write("a_20_1.vtp", vtp(3, 4));
  fs::remove(folder.path("a_10_1.vtp"));
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }).find("a_10_1.vtp not found"),
            std::string::npos);
}

TEST(FileIndex, AnIndexOfTheLastSnapshotThatIsNotWholeYetLeavesItOut) {
  const TemporaryFolder folder;
  for (const int step : {10, 20}) {
    folder.write(fmt::format("a_{}_0.vtp", step), vtp(1, 2));
    folder.write(fmt::format("a_{}.pvtp", step), pvtp({fmt::format("a_{}_0.vtp", step)}));
  }
  const auto whole = bytes_of(folder.path("a_20.pvtp"));
  for (const auto& text : {whole.substr(0, 40), whole.substr(0, whole.size() - 20)}) {
    folder.write("a_20.pvtp", text);
    const auto series = Series::open(folder.path());
    EXPECT_EQ(look(series).steps, (std::vector<std::int64_t>{10}));
    EXPECT_TRUE(series.cut());
    EXPECT_NE(all(series.problems()).find("a_20.pvtp: "), std::string::npos);
  }
  folder.write("a_20.pvtp", whole);
  folder.write("a_10.pvtp", whole.substr(0, 40));
  EXPECT_NE(error_of([&] { Series::open(folder.path()); }).find("a_10.pvtp: "), std::string::npos);
}

TEST(FileIndex, ErrorsNameTheLineOfTheIndex) {
  const TemporaryFolder folder;
  folder.write("good.vtp", vtp(1, 2));
  folder.write("more.vtp", vtp(3, 4, "<DataArray type=\"Int32\" Name=\"q\">1 2</DataArray>"));
  folder.write("text.vtp", "hello\n");
  const auto error = [&](const std::string& name, const std::string& text) {
    const auto path = folder.write(name, text);
    const auto told = error_of([&] { Series::open(path); });
    EXPECT_TRUE(told.starts_with(path + ": ")) << told;
    return told.substr(std::min(path.size() + 2, told.size()));
  };
  EXPECT_EQ(error("a.pvtp", pvtp({"good.vtp", "nothere.vtp"})),
            "line 4: piece nothere.vtp not found");
  EXPECT_EQ(error("a.pvtp", pvtp({"a.pvtp"})), "line 3: piece a.pvtp is the index itself");
  EXPECT_EQ(error("a.pvtp", pvtp({"../good.vtp"})),
            "line 3: piece ../good.vtp lies outside the folder of the index");
  EXPECT_EQ(error("a.pvtp", pvtp({"/etc/passwd"})),
            "line 3: piece /etc/passwd lies outside the folder of the index");
  EXPECT_EQ(error("a.pvtp", pvtp({"good.vtp", "more.vtp"})).substr(0, 39),
            "line 3: piece good.vtp has no array q, ");
  EXPECT_TRUE(error("a.pvtp", pvtp({"text.vtp"})).starts_with("line 3: piece text.vtp: "));
  EXPECT_EQ(error("a.pvd", pvd({})), "names no files");
  EXPECT_EQ(error("a.pvd", pvd({{"x", "good.vtp"}})), "line 3: expected a time, found 'x'");
  EXPECT_EQ(error("a.series", series_file({{"1", "good.vtp"}, {"2", "gone.vtp"}})),
            "line 3: file gone.vtp not found");
  EXPECT_EQ(error("a.series", series_file({{"\"1\"", "good.vtp"}})),
            "file 1 of the list: expected a \"name\" and a \"time\"");
  const auto inner = folder.write("b.vtm", vtm({"a.vtm"}));  // names the one that names it
  EXPECT_EQ(error_of([&] { Series::open(folder.write("a.vtm", vtm({"b.vtm"}))); }),
            inner + ": line 3: block a.vtm is the index itself");
}

TEST(FileIndex, DamagedIndicesAreUsedOrRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"a.vtp", "b.vtp"}) folder.write(name, vtp(name[0], name[0]));
  for (const auto& content :
       {pvtp({"a.vtp", "b.vtp"}), vtm({"a.vtp", "b.vtp"}), pvd({{"0.5", "a.vtp"}, {"1", "b.vtp"}}),
        series_file({{"0.5", "a.vtp"}, {"1", "b.vtp"}})}) {
    std::size_t refused = 0, used = 0;  // refused, or a cut list of which the end is told
    const auto use = [&](const std::string& text) {
      const auto path = folder.write("index", text);
      bool told = false;
      const auto error = error_of([&] {
        const auto series = Series::open(path);
        look(series);
        told = !series.problems().empty();
      });
      EXPECT_TRUE(error.empty() || error.starts_with(folder.path())) << error;
      ++(error.empty() && !told ? used : refused);
    };
    for (std::size_t size = 0; size < content.size(); ++size) use(content.substr(0, size));
    EXPECT_GT(refused, content.size() * 9 / 10);
    std::mt19937_64 random(1);
    for (std::size_t at = 0; at < content.size(); ++at)
      for (const int value : {0, int{'/'}, static_cast<int>(random() % 256)}) {
        auto changed = content;
        changed[at] = static_cast<char>(value);
        use(changed);
      }
    EXPECT_GT(used, 5U);
  }
}

}  // namespace
}  // namespace bedscope::readers
