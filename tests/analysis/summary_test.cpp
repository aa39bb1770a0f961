// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/summary.hpp"

#include <nlohmann/json.hpp>
#include <vector>

#include "readers/error.hpp"
#include "tests/analysis/example_result.hpp"

namespace bedscope::analysis {
namespace {

nlohmann::json summary(const RunResult& run) {
  return nlohmann::json::parse(summary_text(std::vector{run}));
}

TEST(Summary, HasTheKeysOfTheContractForEveryRun) {
  const TestFolder folder;
  write_summary(std::vector{example_run("K = 1"), example_run("K = 2")}, folder / "summary.json");
  const auto json = nlohmann::json::parse(content(folder / "summary.json"));
  ASSERT_EQ(json["runs"].size(), 2u);
  EXPECT_EQ(json["runs"][1]["label"], "K = 2");
  const auto& run = json["runs"][0];
  EXPECT_EQ(run["label"], "K = 1");
  EXPECT_EQ(run["snapshots"], 3);
  EXPECT_EQ(run["from"], 0.1);
  EXPECT_EQ(run["to"], 0.3);
  EXPECT_EQ(run["mean_holdup"], 0.0123);
  EXPECT_EQ(run["mean_holdup_ci95"], 0.0004);
  EXPECT_EQ(run["inventory_kg"], 0.31);
  EXPECT_EQ(run["inventory_kg_ci95"], 0.001);
  EXPECT_EQ(run["mean_occurrence"], 4.0 / 3);
  EXPECT_EQ(run["mean_occurrence_ci95"], 0.2);
  EXPECT_EQ(run["mean_bed_voidage"], 0.6);
  EXPECT_EQ(run["independent_samples"], 2.5);
  EXPECT_EQ(run["outside_fraction"], 1e-6);
  EXPECT_EQ(run["bytes_read"], 123'456'789'012);
  EXPECT_EQ(run["seconds"], 1.25);
  EXPECT_EQ(run["mapping"], "exact");
  EXPECT_EQ(run["domain_assumed"], false);
  EXPECT_EQ(run["window"], (nlohmann::json{{"automatic", false}, {"steady", true}}));
  EXPECT_EQ(run["problems"], nlohmann::json{"dump.3: cut after 17 of 20 particles"});
  EXPECT_EQ(json["checks"], nlohmann::json::array());
  EXPECT_TRUE(json["version"].is_string());
}

TEST(Summary, SaysNullWhereAValueIsUndefined) {
  RunResult run = example_run("run");
  run.mean_holdup = {undefined, std::numeric_limits<double>::infinity()};
  const auto undefined_mean = summary(run)["runs"][0];
  EXPECT_TRUE(undefined_mean["mean_holdup"].is_null());
  EXPECT_TRUE(undefined_mean["mean_holdup_ci95"].is_null());
  EXPECT_TRUE(undefined_mean["mean_bed_voidage_ci95"].is_null());
  EXPECT_TRUE(undefined_mean["inventory_kg"].is_number());
  run.time_known = run.density_known = false;
  const auto steps = summary(run)["runs"][0];
  EXPECT_TRUE(steps["from"].is_null() && steps["to"].is_null());
  EXPECT_TRUE(steps["inventory_kg"].is_null() && steps["inventory_kg_ci95"].is_null());
}

TEST(Summary, KeepsQuotesAndLineBreaksAndReplacesWhatIsNoText) {
  EXPECT_EQ(summary(example_run("a \"b\"\n\\c"))["runs"][0]["label"], "a \"b\"\n\\c");
  EXPECT_EQ(summary(example_run("caf\xe9"))["runs"][0]["label"], "caf\xef\xbf\xbd");
}

TEST(Fingerprint, IsFnv1aOfNameSizeAndContent) {
  const TestFolder folder;
  put(folder / "a", "");
  // 64-bit FNV-1a of 'a', 0 and eight bytes 0 of the size: computed by hand-written Python
  EXPECT_EQ(fingerprint({(folder / "a").string()}), "65d2073907ab1664");
}

TEST(Fingerprint, SeesNameSizeBothEndsAndOrder) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "moved");
  std::string text(20'000, 'x');
  const auto of = [&](const char* name) {
    put(folder / name, text);
    return fingerprint({(folder / name).string()});
  };
  const std::string first = of("a");
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(of("moved/a"), first);
  EXPECT_NE(of("b"), first);
  text.front() = 'y';
  EXPECT_NE(of("a"), first);
  text.front() = 'x';
  text.back() = 'y';
  EXPECT_NE(of("a"), first);
  text.back() = 'x';
  text += 'x';
  EXPECT_NE(of("a"), first);
  const std::string a = (folder / "a").string(), b = (folder / "b").string();
  EXPECT_NE(fingerprint({a, b}), fingerprint({b, a}));
}

TEST(Fingerprint, IsNoneWhereAFileIsGone) {
  const TestFolder folder;
  RunResult run = example_run("run");
  put(folder / "a", "x");
  run.inputs = {(folder / "a").string()};
  const auto whole = summary(run)["inputs"][0];
  EXPECT_EQ(whole["run"], "run");
  EXPECT_EQ(whole["files"], 1);
  EXPECT_EQ(whole["hash"], fingerprint(run.inputs));
  run.inputs.push_back((folder / "gone").string());
  EXPECT_TRUE(summary(run)["inputs"][0]["hash"].is_null());
  run.inputs.clear();
  EXPECT_TRUE(summary(run)["inputs"][0]["hash"].is_null());
}

TEST(Summary, AFolderThatCannotBeWrittenIsAFileError) {
  const TestFolder folder;
  put(folder / "file", "");
  EXPECT_THROW(write_summary(std::vector{example_run("run")}, folder / "file" / "summary.json"),
               FileError);
}

}  // namespace
}  // namespace bedscope::analysis
