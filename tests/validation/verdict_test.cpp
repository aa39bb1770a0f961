// SPDX-License-Identifier: BSD-3-Clause
// From a check to a verdict, on runs whose answer is known.
#include "validation/verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "readers/error.hpp"
#include "validation/family.hpp"

namespace bedscope::validation {
namespace {

/// A run whose axial holdup is `level` of 0.1 - 0.05 z, with intervals of `ci95`.
analysis::RunResult run(const std::string& label, double level, double ci95) {
  analysis::RunResult result;
  result.label = label;
  result.types = {"all"};
  result.window = {.from = 5, .to = 15, .snapshots = 1001};
  analysis::SpeciesResult all{.type = "all"};
  for (int i = 0; i < 50; ++i) {
    all.axial.coordinate.push_back((i + .5) * .02);
    all.axial.holdup.push_back({level * (.1 - .05 * all.axial.coordinate.back()), ci95});
    all.axial.velocity_z.push_back({1, ci95});
    all.axial.mass_flux_z.push_back({2, ci95});
  }
  result.species.push_back(all);
  result.mean_holdup = {.075 * level, ci95};
  return result;
}

Check against(double number, const char* metric, double limit) {
  return {.place = {.quantity = "mean holdup"}, .number = number, .metric = metric, .limit = limit};
}

Verdict verdict_of(const Check& check, const analysis::RunResult& result) {
  return evaluate(check, std::vector{result}, Curves{}, "study.toml").at(0);
}

TEST(Judge, HoldsFailsOrIsUndecidedByItsWholeInterval) {
  EXPECT_EQ(judge({.value = .1, .lo = .05, .hi = .15}, .2, true), Outcome::holds);
  EXPECT_EQ(judge({.value = .1, .lo = .05, .hi = .25}, .2, true), Outcome::undecided);
  EXPECT_EQ(judge({.value = .3, .lo = .25, .hi = .35}, .2, true), Outcome::does_not_hold);
  EXPECT_EQ(judge({.value = .9, .lo = .85, .hi = .95}, .8, false), Outcome::holds);
  EXPECT_EQ(judge({.value = .7, .lo = .65, .hi = .75}, .8, false), Outcome::does_not_hold);
  EXPECT_EQ(judge({.value = .2, .lo = .2, .hi = .2}, .2, true), Outcome::holds);
}

TEST(Verdicts, OfSingleValuesAreByHand) {
  const auto good = verdict_of(against(.075, "relative bias", .05), run("a", 1.02, .001));
  EXPECT_NEAR(good.metric.value, .02, 1e-12);
  EXPECT_EQ(good.outcome, Outcome::holds);
  const auto bad = verdict_of(against(.075, "relative bias", .05), run("a", 1.2, .001));
  EXPECT_EQ(bad.outcome, Outcome::does_not_hold);
}

TEST(Verdicts, InflatedErrorBarsDoNotPass) {
  for (const char* metric :
       {"relative rmse", "relative bias", "relative max error", "max error", "e over u"}) {
    const double limit = std::string(metric) == "e over u" ? 2 : .1;
    auto check = against(.075, metric, limit);
    check.number_u = .0001;
    EXPECT_NE(verdict_of(check, run("a", 1.5, .5)).outcome, Outcome::holds) << metric;
    check.place.quantity = "axial holdup";
    EXPECT_NE(verdict_of(check, run("a", 1.5, .5)).outcome, Outcome::holds) << metric;
  }
}

TEST(Verdicts, OneSnapshotOutOfManyDecidesNothing) {
  auto instant = run("a", 1, NAN);
  instant.window = {.from = 5, .to = 5, .snapshots = 1};
  auto check = against(.075, "relative bias", .05);
  EXPECT_EQ(verdict_of(check, instant).outcome, Outcome::holds);  // the run has no more
  instant.inventory = {{.time = 4, .type = "all"}, {.time = 5, .type = "all"}};
  const auto vague = verdict_of(check, instant);
  EXPECT_EQ(vague.outcome, Outcome::undecided);
  EXPECT_NE(vague.reason.find("1 of 2 snapshots"), std::string::npos) << vague.reason;
  check.place.at["time"] = 5;
  EXPECT_EQ(verdict_of(check, instant).outcome, Outcome::holds);
  check.place.at["time"] = 4;
  EXPECT_THROW(verdict_of(check, instant), InputError);
}

TEST(Verdicts, PointsWithoutAnIntervalAreCounted) {
  auto patchy = run("a", 1.02, .0001);
  for (int i = 40; i < 50; ++i) patchy.species[0].axial.holdup[i] = {9, NAN};
  Check check{
      .place = {.quantity = "axial holdup"}, .number = .075, .metric = "max error", .limit = 1};
  const auto verdict = verdict_of(check, patchy);
  EXPECT_EQ(verdict.outcome, Outcome::holds);
  EXPECT_NE(verdict.reason.find("at 10 more the result has no interval"), std::string::npos)
      << verdict.reason;
}

/// Ten snapshots a place, each with one cluster there; the lateral axis goes from 0 to 1 m.
analysis::RunResult run_with_clusters(const std::vector<double>& places) {
  auto result = run("a", 1, .001);
  result.grid.min[0] = 0;
  result.grid.max[0] = 1;
  result.window = {.from = 0, .to = 1e9, .snapshots = 10 * places.size()};
  for (std::size_t i = 0; i < 10 * places.size(); ++i) {
    result.occurrence.push_back({static_cast<double>(i), 1});
    analysis::Cluster cluster;
    cluster.snapshot = i;
    cluster.centre.x = places[i / 10];
    result.clusters.push_back(cluster);
  }
  return result;
}

TEST(Verdicts, OfAnAreaWhoseOrientationIsNotKnownTryBoth) {
  const auto folder = testing::TempDir();
  std::ofstream(folder + "/places.csv") << "x over width [-],density [-],density_u [-]\n"
                                           "0.25,0.5,0.01\n0.75,1.5,0.01\n";
  const Check check{.place = {.quantity = "cluster position"},
                    .against = folder + "/places.csv",
                    .metric = "area",
                    .limit = .1};
  const auto left = run_with_clusters({.1, .2, .3, .4, .1, .3, .2, .4, .1, .9, .7, .8});
  std::ofstream(folder + "/places.toml") << "orientation = \"unknown\"\n";
  const auto turned = verdict_of(check, left);
  std::ofstream(folder + "/places.toml") << "orientation = \"known\"\n";
  const auto as_it_stands = verdict_of(check, left);
  EXPECT_LT(turned.metric.value, .1);
  EXPECT_GT(as_it_stands.metric.value, .2);
  EXPECT_EQ(turned.reference.points.front().y, 1.5);
  const auto said = [](const Verdict& verdict, const char* words) {
    return std::any_of(verdict.assumptions.begin(), verdict.assumptions.end(),
                       [&](const auto& each) { return each.find(words) != each.npos; });
  };
  EXPECT_TRUE(said(turned, "turned round it fits better"));
  EXPECT_FALSE(said(as_it_stands, "both ways"));
}

TEST(Verdicts, OfPlacesOfClustersAreOfTheWindowAndOfSnapshotsThatKnowEachOther) {
  auto clusters = run_with_clusters({.1, .3, .6, .9, .1, .3, .6, .9, .1, .3, .6, .9});
  const auto all = sample(clusters, {.quantity = "cluster position"});
  // A bin has 30 of 120 clusters, which as counts err by sqrt(31) / 120 = 0.046; as 12 places that
  // are seen ten times each by sqrt(0.25 * 0.75 / 12) = 0.125. Bins are a twentieth wide.
  EXPECT_DOUBLE_EQ(all.value[2], .25 * 20);
  EXPECT_GT(all.u[2], .1 * 20);
  EXPECT_LT(all.u[2], .25 * 20);
  EXPECT_DOUBLE_EQ(all.u[4], 1 / 120. * 20);  // none seen
  clusters.window.to = 9;
  EXPECT_DOUBLE_EQ(sample(clusters, {.quantity = "cluster position"}).value[2], 20);
}

TEST(Verdicts, OfAFactorUnderInflatedUncertaintiesAreUndecided) {
  const auto check = against(.075, "model bias", .5);
  const auto vague = verdict_of(check, run("a", 1, .5));
  EXPECT_EQ(vague.outcome, Outcome::undecided);
  EXPECT_NE(vague.reason.find("0 of 1 points are above 0"), std::string::npos) << vague.reason;
  EXPECT_THROW(verdict_of(check, run("a", -1, .001)), InputError);
}

TEST(Verdicts, JustBesideTheirLimitAreShownInDigitsThatTellThem) {
  const auto beside = verdict_of(against(1, "max error", .5), run("a", 20 + 1e-7, 0));
  EXPECT_EQ(beside.outcome, Outcome::does_not_hold);
  EXPECT_NE(beside.reason.find("0.50000001 ["), std::string::npos) << beside.reason;
  const auto within = verdict_of(against(1, "max error", .6), run("a", 20, 0));
  EXPECT_NE(within.reason.find("0.5 [0.5, 0.5]"), std::string::npos) << within.reason;
}

TEST(Verdicts, SayTheUnitOfWhatHasOne) {
  auto warm = run("a", 1, .001);
  warm.series.push_back({"T", "K", {6, 7, 8, 9}, {300, 301, 302, 301}});
  Check check{.place = {.quantity = "series: T"}, .number = 300, .metric = "max error", .limit = 9};
  EXPECT_NE(verdict_of(check, warm).reason.find("] K against at most 9 K"), std::string::npos);
  check.metric = "relative bias";
  EXPECT_EQ(verdict_of(check, warm).reason.find(" K"), std::string::npos);
}

TEST(Verdicts, OfAnInstantSayWhatStandsForIt) {
  auto check = against(.075, "relative bias", .5);
  check.place.at["time"] = 7;
  const auto found = verdict_of(check, run("a", 1, .001));  // 5 to 15 s
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes[0].find("5 to 15 s stands for at.time = 7 s"), std::string::npos);
  check.place.at["time"] = 17;
  EXPECT_THROW(verdict_of(check, run("a", 1, .001)), InputError);
}

TEST(Verdicts, ThatAreTooVagueStillCountWhatLiesOutside) {
  auto check = against(.075, "e over u", 4);
  check.number_u = .02;
  check.place.quantity = "axial holdup";
  auto patchy = run("a", 1.005, .001);
  for (int i = 40; i < 50; ++i) patchy.species[0].axial.holdup[i] = {9, NAN};
  const auto vague = verdict_of(check, patchy);
  EXPECT_EQ(vague.outcome, Outcome::undecided);
  EXPECT_NE(vague.reason.find("at 10 more"), std::string::npos) << vague.reason;
  EXPECT_NE(vague.reason.find("accuracy"), std::string::npos) << vague.reason;
}

TEST(Verdicts, ErrorOverUncertaintyAlsoNeedsAnAccuracy) {
  auto check = against(.075, "e over u", 4);
  check.number_u = .0005;
  EXPECT_EQ(verdict_of(check, run("a", 1.005, .001)).outcome, Outcome::holds);
  check.number_u = .02;  // 52 % of the mean
  const auto vague = verdict_of(check, run("a", 1.005, .001));
  EXPECT_EQ(vague.outcome, Outcome::undecided);
  EXPECT_NE(vague.reason.find("accuracy"), std::string::npos);
  EXPECT_NE(vague.reason.find("the reference cannot settle it"), std::string::npos) << vague.reason;
  check.number_u = .0005;  // 1.96 u 0.2 of the mean, 0.1 asked for: a fourth of the time for half
  const auto short_run = verdict_of(check, run("a", 1.005, .015));
  EXPECT_EQ(short_run.outcome, Outcome::undecided);
  EXPECT_NE(short_run.reason.find("31 s more"), std::string::npos) << short_run.reason;
}

TEST(Verdicts, TheUndecidedSayHowMuchMoreSimulationWouldSettleThem) {
  // Half-width 0.02 / 0.075 about a bias of 0.02, limit 0.15: (0.267 / 0.13)^2 = 4.2 times 10 s.
  const auto verdict = verdict_of(against(.075, "relative bias", .15), run("a", 1.02, .02));
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_NE(verdict.reason.find("s more of simulation would settle it (10 s were averaged)"),
            std::string::npos)
      << verdict.reason;
}

TEST(Verdicts, OrThatTheReferenceCannot) {
  auto check = against(.075, "relative bias", .1);
  check.number_u = .02;
  const auto verdict = verdict_of(check, run("a", 1.02, .0001));
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_NE(verdict.reason.find("the reference cannot settle it"), std::string::npos);
}

TEST(Verdicts, OrThatTheCellsAreTooCoarse) {
  auto coarse = run("a", 1, .0001);
  auto& axial = coarse.species[0].axial;
  axial.coordinate = {0, 1, 2, 3, 4};
  axial.holdup = {{.1, .0001}, {.05, .0001}, {.1, .0001}, {.05, .0001}, {.1, .0001}};
  const Check check{.place = {.quantity = "axial holdup"},
                    .against = "run:b",
                    .metric = "max error",
                    .limit = .01};
  auto other = coarse;
  other.label = "b";
  for (double& z : other.species[0].axial.coordinate) z += .5;
  for (auto& holdup : other.species[0].axial.holdup) holdup.value = .075;
  const auto verdict = evaluate(check, std::vector{coarse, other}, Curves{}, "study.toml").at(0);
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_NE(verdict.reason.find("smaller cells might"), std::string::npos) << verdict.reason;
}

TEST(Verdicts, AreOfTheSameComparisonWhereOnlyMetricAndLimitDiffer) {
  const auto a = run("a", 1, .001);
  auto theory = Check{.place = {.quantity = "mean holdup"},
                      .against = "theory:bed weight",
                      .with = {{"area", 1}},
                      .metric = "max error",
                      .limit = 1};
  Verdict one{.check = theory, .run = "a"}, other = one;
  other.check.metric = "relative bias";
  other.check.limit = 2;
  EXPECT_TRUE(same_comparison(one, other));
  other.check.with["area"] = 2;
  EXPECT_FALSE(same_comparison(one, other));
  other = one;
  other.run = "b";
  EXPECT_FALSE(same_comparison(one, other));
  Verdict number = verdict_of(against(.075, "max error", 1), a);
  EXPECT_FALSE(same_comparison(number, verdict_of(against(.0750001, "max error", 1), a)));
}

TEST(Verdicts, AgainstAnotherRunAndAgainstAllOthers) {
  const std::vector runs{run("a", 1, 1e-6), run("b", 1.1, 1e-6), run("c", 1.3, 1e-6)};
  Check check{.place = {.quantity = "axial holdup"},
              .against = "run:a",
              .metric = "relative rmse",
              .limit = .15};
  const auto verdicts = evaluate(check, runs, Curves{}, "study.toml");
  ASSERT_EQ(verdicts.size(), 2U);  // a is not judged by itself
  EXPECT_EQ(verdicts[0].outcome, Outcome::holds);
  EXPECT_EQ(verdicts[1].outcome, Outcome::does_not_hold);
  check.against = "run:others";
  const auto family = evaluate(check, runs, Curves{}, "study.toml");
  ASSERT_EQ(family.size(), 3U);
  // b against the mean of a and c, 1.15: 0.05 / 1.15 of a profile that is proportional.
  EXPECT_NEAR(family[1].metric.value,
              .05 / 1.15 * std::sqrt(1 + std::pow(.05 * .02 * 14.43 / .075, 2)), .002);
}

TEST(Verdicts, OfSeriesAreTheirMeanInTheWindowOrAllOfThem) {
  auto result = run("a", 1, .01);
  result.series = {{"drag", "N", {4, 5, 10, 15}, {100, 2, 3, 4}}};
  Check check{
      .place = {.quantity = "series: drag"}, .number = 3, .metric = "max error", .limit = 10};
  const auto mean = verdict_of(check, result);
  EXPECT_NEAR(mean.metric.value, 0, 1e-12);  // 100 is before the window
  EXPECT_EQ(mean.comparison.y.unit, "N");
  check.place.quantity = "series: drag history";
  EXPECT_EQ(verdict_of(check, result).metric.value, 97);
  check.place.quantity = "series: lift";
  try {
    verdict_of(check, result);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("no series \"lift\" in its series.csv, which has drag"),
        std::string::npos)
        << error.what();
  }
}

TEST(Verdicts, FaultsNameTheStudysLine) {
  const auto text = [](Check check) {
    check.line = 12;
    try {
      evaluate(check, std::vector{run("a", 1, .01)}, Curves{}, "study.toml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Check check{
      .place = {.quantity = "lateral holdup"}, .number = 1, .metric = "max error", .limit = 1};
  EXPECT_NE(text(check).find("study.toml: line 12"), std::string::npos);
  EXPECT_NE(text(check).find("expected at = { height"), std::string::npos) << text(check);
  check.place = {.quantity = "mean temperature"};
  EXPECT_NE(text(check).find("has no mean temperature"), std::string::npos);
  check.place = {.quantity = "axial holdup", .species = "7"};
  EXPECT_NE(text(check).find("no species \"7\""), std::string::npos);
  check.place = {.quantity = "mean holdup"};
  check.run = "b";
  EXPECT_NE(text(check).find("no run \"b\", there are \"a\""), std::string::npos);
}

TEST(Families, TakeTheExperimentsOwnScatterOut) {
  // Model = 1.3 E exp(N(0, s_M)), experiment seen with s_E: bias and s_M come back.
  Verdict verdict{.check = {.place = {.quantity = "axial holdup"}}, .run = "a"};
  constexpr int n = 4000;
  constexpr double s_model = .2, s_experiment = .1;
  for (int i = 0; i < n; ++i) {
    // A quasi-random pair of normal deviates: sums of equidistributed sequences (Box and Muller).
    const double u1 = (i + .5) / n, u2 = std::fmod(i * .6180339887498949, 1.);
    const double r = std::sqrt(-2 * std::log(u1));
    const double a = r * std::cos(2 * M_PI * u2), b = r * std::sin(2 * M_PI * u2);
    const double reference = std::exp(s_experiment * b);
    verdict.comparison.points.push_back({.x = 1. * i,
                                         .result = 1.3 * std::exp(s_model * a),
                                         .reference = reference,
                                         .u_reference = s_experiment * reference});
  }
  const auto found = families(std::vector{verdict});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].scatter, s_model, .01);
  // Of the means: those of M and E are exp(s^2 / 2) above their medians.
  EXPECT_NEAR(found[0].bias, 1.3 * std::exp((s_model * s_model - s_experiment * s_experiment) / 2),
              .005);
  EXPECT_EQ(found[0].left_out, 0U);
}

}  // namespace
}  // namespace bedscope::validation
