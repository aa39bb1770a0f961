// SPDX-License-Identifier: BSD-3-Clause
// The folder that write_report leaves: files, page, what is left out and why.
#include <fmt/format.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "readers/error.hpp"
#include "report/figures.hpp"
#include "report/page.hpp"
#include "tests/report/synthetic_run.hpp"

namespace bedscope::tests {
namespace {

namespace fs = std::filesystem;
using analysis::RunResult;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Some place for reports, removed after the last test that uses it.
class Place {
 public:
  explicit Place(const std::string& name)
      : folder_(fs::path(testing::TempDir()) /
                fmt::format("bedscope_report_{}_{}", ::getpid(), name)) {
    fs::remove_all(folder_);
  }
  ~Place() { fs::remove_all(folder_); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  const fs::path& folder() const { return folder_; }
  fs::path figure(const std::string& name) const { return folder_ / "figures" / name; }
  std::string page() const { return content(folder_ / "index.html"); }

 private:
  fs::path folder_;
};

/// Tests with a folder of their own. Most need no PNG, which takes two thirds of the time.
class Report : public testing::Test {
 protected:
  void write(const std::vector<RunResult>& runs, bool png = false, int refresh = 0) const {
    report::write_report(runs, "a <title> & more", folder(), {png, refresh});
  }
  const fs::path& folder() const { return place_.folder(); }
  fs::path figure(const std::string& name) const { return place_.figure(name); }
  std::string page() const { return place_.page(); }

 private:
  Place place_{testing::UnitTest::GetInstance()->current_test_info()->name()};
};

const std::vector<std::string> all_names{
    "fields",      "axial_holdup", "axial_holdup_species", "lateral",
    "inventory",   "occurrence",   "clusters_lateral",     "snapshots_1",
    "snapshots_2", "temperature",  "temperature_pdf"};

std::vector<RunResult> two_runs() {
  SyntheticOptions second;
  second.label = "K = 2";
  second.cells = {7, 1, 30};
  second.shift = 0.01;
  return {synthetic_run(), synthetic_run(second)};
}

/// Tests that look at one and the same report of two runs.
class WholeReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = std::make_unique<Place>("two_runs");
    report::write_report(two_runs(), "two runs", place_->folder());
  }
  static void TearDownTestSuite() { place_.reset(); }
  static fs::path figure(const std::string& name) { return place_->figure(name); }
  static const fs::path& folder() { return place_->folder(); }
  static std::string page() { return place_->page(); }

 private:
  inline static std::unique_ptr<Place> place_;
};

/// Why there is no figure `name`; empty where it is drawn.
std::string reason(const std::vector<RunResult>& runs, const std::string& name) {
  for (const report::Figure& figure : report::make_figures(runs)) {
    if (figure.name == name) return figure.missing;
  }
  return "no such figure";
}

/// Width and height in a PNG's header.
std::pair<unsigned, unsigned> png_size(const std::string& png) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value = value << 8 | static_cast<unsigned char>(png[at + i]);
    return value;
  };
  return {number(16), number(20)};
}

/// Well-formed as far as tags go: each is closed in order.
bool tags_match(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    if (xml[at + 1] == '?' || xml[at + 1] == '!') continue;
    char quote = 0;
    std::size_t end = at + 1;
    for (; end < xml.size() && (quote != 0 || xml[end] != '>'); ++end) {
      if (quote != 0 ? xml[end] == quote : xml[end] == '"' || xml[end] == '\'') {
        quote = quote == 0 ? xml[end] : '\0';
      }
    }
    if (end == xml.size()) return false;
    const std::size_t name_at = at + (xml[at + 1] == '/' ? 2 : 1);
    const std::string name = xml.substr(name_at, xml.find_first_of(" \t\n/>", name_at) - name_at);
    if (xml[at + 1] == '/') {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else if (xml[end - 1] != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty();
}

TEST_F(WholeReport, HasSvgPngScriptAndDataOfEveryFigure) {
  for (const std::string& name : all_names) {
    const std::string svg = content(figure(name + ".svg")), png = content(figure(name + ".png"));
    EXPECT_TRUE(svg.starts_with("<?xml")) << name;
    EXPECT_TRUE(tags_match(svg)) << name;
    EXPECT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n")) << name;
    EXPECT_TRUE(png.ends_with("IEND\xAE\x42\x60\x82")) << name;
    EXPECT_GT(fs::file_size(figure(name + ".gp")), 0U) << name;
    EXPECT_GT(fs::file_size(figure(name + ".dat")), 0U) << name;
    EXPECT_NE(page().find(fmt::format("<section id=\"{}\">", name)), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(figure(".part"))) << "half-made files are removed";
}

TEST_F(WholeReport, PngsHave300DotsPerInchOfTheirPrintedSize) {
  for (const report::Figure& one : report::make_figures(two_runs())) {
    ASSERT_TRUE(one.missing.empty()) << one.name;
    EXPECT_LE(one.width, 170.0) << one.name;
    EXPECT_LE(one.height, 230.0) << one.name << " does not fit on A4";
    const auto [width, height] = png_size(content(figure(one.name + ".png")));
    EXPECT_NEAR(width, one.width / 25.4 * 300, 1.0) << one.name;  // rounded to whole dots
    EXPECT_NEAR(height, one.height / 25.4 * 300, 1.0) << one.name;
  }
}

TEST_F(WholeReport, ScriptsDrawTheSameFigureAgainByThemselves) {
  for (const std::string name : {"fields", "temperature"}) {
    const std::string before = content(figure(name + ".png"));
    fs::remove(figure(name + ".png"));
    fs::remove(figure(name + ".svg"));
    const std::string command =
        fmt::format("cd '{}' && gnuplot {}.gp 2>/dev/null", (folder() / "figures").string(), name);
    ASSERT_EQ(std::system(command.c_str()), 0) << name;
    EXPECT_TRUE(content(figure(name + ".png")) == before) << name;
    EXPECT_TRUE(fs::exists(figure(name + ".svg"))) << name;
  }
}

TEST_F(WholeReport, PageNeedsNoOtherFileAndNoScript) {
  const std::string html = page();
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_LT(html.size(), 5'000'000U);
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = html.find("src="); at != std::string::npos;
       at = html.find("src=", at + 1)) {
    EXPECT_EQ(html.compare(at, 31, "src=\"data:image/svg+xml;base64,"), 0);
    ++pictures;
  }
  EXPECT_EQ(pictures, all_names.size());
}

TEST_F(Report, EscapesUsersTexts) {
  SyntheticOptions options;
  options.label = "<b>&\"it's\" {x_y^2} \\n %d $x @ `ls` <script>alert(1)</script>\n";
  RunResult run = synthetic_run(options);
  run.types[1] = run.species[1].type = "hot & <i>slow</i>_'";
  for (auto& sample : run.temperature) {
    if (sample.type == "1") sample.type = run.types[1];
  }
  run.problems = {"dump <3> & \"4\" is cut"};
  write({run, synthetic_run()});
  const std::string html = page();
  EXPECT_EQ(html.find("<b>&\""), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_NE(html.find("&lt;b&gt;&amp;&quot;it&#39;s&quot; {x_y^2}"), std::string::npos);
  EXPECT_NE(html.find("<h1>a &lt;title&gt; &amp; more</h1>"), std::string::npos);
  EXPECT_NE(html.find("dump &lt;3&gt; &amp; &quot;4&quot; is cut"), std::string::npos);
  // In the figure the text stands as it was written.
  const std::string svg = content(figure("fields.svg"));
  EXPECT_TRUE(tags_match(svg));
  EXPECT_NE(svg.find("&lt;b>&amp;\"it's\" {x_y^2} \\n %d $x @ `ls`"), std::string::npos);
  EXPECT_TRUE(tags_match(content(figure("axial_holdup_species.svg"))));
}

TEST_F(Report, TableGivesMeansWithIntervalsAndProblems) {
  std::vector<RunResult> runs = two_runs();
  runs[0].problems = {"the last snapshot is cut: left out"};
  runs[1].outside_fraction = 0.0123;
  write(runs);
  const std::string html = page();
  EXPECT_NE(html.find("<td>0.0255 ± 0.0003</td>"), std::string::npos);
  EXPECT_NE(html.find("<td>40.2 ± 0.5</td>"), std::string::npos) << "grams";
  EXPECT_NE(html.find("<td>5.02 ± 0.21</td>"), std::string::npos);
  EXPECT_NE(html.find("<td>1.2 %</td>"), std::string::npos);
  EXPECT_NE(html.find("<b>K = 1</b>: the last snapshot is cut: left out"), std::string::npos);
}

TEST_F(Report, LinksToTheTablesThatAreThere) {
  fs::create_directories(folder() / "tables");
  for (const char* name : {"clusters.csv", "temperature_axial.csv"})
    std::ofstream(folder() / "tables" / name) << "run\n";
  std::ofstream(folder() / "results.h5") << "x";
  write({synthetic_run()});
  EXPECT_NE(page().find("href=\"tables/clusters.csv\""), std::string::npos);
  EXPECT_NE(page().find("href=\"tables/temperature_axial.csv\""), std::string::npos);
  EXPECT_NE(page().find("href=\"results.h5\""), std::string::npos);
  EXPECT_EQ(page().find("href=\"tables/temperature.csv\""), std::string::npos);
}

TEST_F(Report, LeavesFiguresWithoutDataOutAndSaysWhy) {
  SyntheticOptions options;
  options.clusters_each = 0;
  options.temperature = false;
  options.two_types = false;
  const std::vector<RunResult> runs{synthetic_run(options)};
  EXPECT_EQ(reason(runs, "occurrence"), "no clusters found");
  EXPECT_EQ(reason(runs, "clusters_lateral"), "no clusters found in the window");
  EXPECT_EQ(reason(runs, "temperature"), "no temperature column");
  EXPECT_EQ(reason(runs, "axial_holdup_species"), "there is one type of particles only");
  EXPECT_EQ(reason(runs, "snapshots"), "") << "snapshots without clusters are still worth seeing";
  write(runs);
  EXPECT_FALSE(fs::exists(figure("temperature.svg")));
  EXPECT_TRUE(fs::exists(figure("snapshots.svg")));
  EXPECT_NE(page().find("No figure: no temperature column."), std::string::npos);
}

TEST_F(Report, RemovesWhatAnEarlierReportDrewAndKeepsOtherFiles) {
  write(two_runs(), true);
  std::ofstream(figure("mine.svg")) << "x";
  SyntheticOptions options;
  options.temperature = false;
  write({synthetic_run(options)});
  EXPECT_FALSE(fs::exists(figure("temperature.png")));
  EXPECT_FALSE(fs::exists(figure("temperature.gp")));
  EXPECT_FALSE(fs::exists(figure("snapshots_2.svg")));
  EXPECT_TRUE(fs::exists(figure("snapshots.svg")));
  EXPECT_TRUE(fs::exists(figure("mine.svg")));
}

TEST_F(Report, LiveUpdateDrawsSvgOnlyAndReloads) {
  write({synthetic_run()}, true);
  EXPECT_TRUE(fs::exists(figure("lateral.png")));
  write({synthetic_run()}, false, 5);
  EXPECT_TRUE(fs::exists(figure("lateral.svg")));
  EXPECT_FALSE(fs::exists(figure("lateral.png"))) << "it would show an older state";
  EXPECT_NE(page().find("<meta http-equiv=\"refresh\" content=\"5\">"), std::string::npos);
  EXPECT_EQ(page().find(".png\""), std::string::npos);
}

TEST_F(Report, DrawsProfilesFullOfNan) {
  RunResult run = synthetic_run();
  for (analysis::SpeciesResult& one : run.species) {
    for (analysis::Estimate& value : one.axial.holdup) value = {};
    for (analysis::Profile& profile : one.lateral) {
      for (std::size_t i = 0; i + 1 < profile.holdup.size(); ++i) {
        profile.holdup[i] = profile.velocity_z[i] = profile.mass_flux_z[i] = {};
      }
    }
    one.fields.velocity_z.assign(one.fields.velocity_z.size(), std::nan(""));
  }
  for (analysis::Cluster& cluster : run.clusters) cluster.velocity_z = std::nan("");
  run.mean_holdup = {};
  write({run});
  EXPECT_EQ(reason({run}, "axial_holdup"), "no axial profile in the results");
  EXPECT_TRUE(fs::exists(figure("lateral.svg")));
  EXPECT_TRUE(fs::exists(figure("clusters_lateral.svg")));
  EXPECT_NE(content(figure("lateral.dat")).find("nan nan\n"), std::string::npos)
      << "gaps, not zeros";
  EXPECT_NE(page().find("<td>–</td>"), std::string::npos);
}

TEST_F(Report, DrawsSeveralHundredClustersASnapshotAndTenRuns) {
  std::vector<RunResult> runs;
  for (int r = 0; r < 10; ++r) {
    SyntheticOptions options;
    options.label = fmt::format("run {} with a label that is much too long for a panel", r);
    options.snapshots = 30;
    options.clusters_each = r == 0 ? 300 : 3;
    options.temperature = false;
    runs.push_back(synthetic_run(options));
  }
  write(runs);
  EXPECT_TRUE(fs::exists(figure("snapshots_10.svg")));
  EXPECT_NE(content(figure("snapshots_2.dat")).find("arrows of upward"), std::string::npos);
  EXPECT_EQ(content(figure("snapshots_1.dat")).find("arrows of"), std::string::npos)
      << "three hundred arrows would hide the clusters";
  EXPECT_LT(fs::file_size(folder() / "index.html"), 5'000'000U);
}

TEST_F(Report, SaysDomainAssumedStepsAndNoDensity) {
  RunResult run = synthetic_run();
  run.domain_assumed = true;
  run.time_known = run.density_known = false;
  for (analysis::SpeciesResult& one : run.species) {
    one.fields.mass_flux_z.assign(one.fields.mass_flux_z.size(), std::nan(""));
    for (analysis::Profile& profile : one.lateral) {
      for (analysis::Estimate& value : profile.mass_flux_z) value = {};
    }
  }
  for (auto& sample : run.inventory) sample.solids_mass = std::nan("");
  write({run});
  for (const std::string name : {"axial_holdup", "fields", "lateral", "snapshots", "inventory"}) {
    EXPECT_NE(content(figure(name + ".gp")).find("domain assumed"), std::string::npos) << name;
  }
  EXPECT_NE(content(figure("inventory.gp")).find("'step [-]'"), std::string::npos);
  EXPECT_EQ(content(figure("inventory.gp")).find("solids mass"), std::string::npos);
  EXPECT_EQ(content(figure("fields.gp")).find("mass flux"), std::string::npos);
  EXPECT_EQ(content(figure("lateral.gp")).find("kg/"), std::string::npos);
  EXPECT_NE(page().find("No mass flux"), std::string::npos);
  EXPECT_NE(page().find("<td>no density</td>"), std::string::npos);
}

TEST_F(Report, DrawsA3dGridAsItsMeanOverDepth) {
  SyntheticOptions options;
  options.cells = {6, 4, 20};
  RunResult run = synthetic_run(options);
  run.frames.clear();
  for (std::size_t i = 0; i < run.grid.size(); ++i) {
    const std::size_t j = i / 6 % 4;
    run.species[0].fields.holdup[i] = j == 0 ? 0.4 : 0.0;
    run.species[0].fields.velocity_z[i] = j == 0 ? 1.5 : std::nan("");
  }
  const std::vector<report::Figure> figures = report::make_figures(std::vector{run});
  const std::string& data = figures.front().data;
  EXPECT_NE(data.find("\n0.1 0.1 0.1 0.1 0.1 0.1\n"), std::string::npos) << "0.4 in 1 of 4 cells";
  EXPECT_NE(data.find("\n1.5 1.5 1.5 1.5 1.5 1.5\n"), std::string::npos)
      << "the velocity of the solids, wherever they are";
}

TEST_F(Report, NamesThePackageWhereGnuplotIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder().c_str(), 1);
  std::string words;
  try {
    write({synthetic_run()});
  } catch (const InputError& error) {
    words = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(words.find("gnuplot-nox"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder() / "index.html"));
}

TEST_F(Report, RefusesAStudyWithoutRuns) {
  EXPECT_THROW(report::write_report({}, "nothing", folder()), InputError);
}

}  // namespace
}  // namespace bedscope::tests
