// SPDX-License-Identifier: BSD-3-Clause
// Particles that must not enter a mean are counted, and the first ones named.
#include "readers/flaws.hpp"

#include <random>
#include <set>

#include "tests/readers/test_files.hpp"

namespace bedscope::readers {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t doubled(const std::vector<double>& ids) {
  std::vector<std::uint64_t> scratch;
  Flaws flaws;
  find_doubled_ids(ids, 0, scratch, flaws);
  return static_cast<std::size_t>(flaws.doubled_id.particles);
}

TEST(Flaws, DoubledIdsAreThoseThatASetFinds) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    // Dense ids are marked in bits, sparse ones sorted; both must count alike.
    const double spread = i % 2 == 0 ? 1000 : 1e12;
    std::vector<double> ids(random() % 300);
    for (auto& id : ids) id = std::floor(spread * static_cast<double>(random() % 400) / 400);
    const std::set<double> different(ids.begin(), ids.end());
    ASSERT_EQ(doubled(ids), ids.size() - different.size());
  }
}

TEST(Flaws, IdsThatCannotBeComparedAreNotCounted) {
  EXPECT_EQ(doubled({}), 0U);
  EXPECT_EQ(doubled({1, nan, 1}), 0U);
  EXPECT_EQ(doubled({-1, -1}), 0U);
  EXPECT_EQ(doubled({1e300, 1e300}), 0U);
  EXPECT_EQ(doubled({5e14, 5e14}), 1U);  // sparse: sorted, no memory for 5e14 bits
}

TEST(Flaws, MergingSnapshotsCountsBothAndKeepsTheFirstPlace) {
  Flaws total;
  for (std::size_t snapshot = 2; snapshot < 5; ++snapshot) {
    Flaws one;
    for (std::size_t row = 0; row < snapshot; ++row)
      one.not_finite.add(snapshot, 10 * snapshot + row, 7);
    one.farthest = static_cast<double>(snapshot);
    total.merge(one);
  }
  EXPECT_EQ(total.not_finite.particles, 2 + 3 + 4);
  EXPECT_EQ(total.not_finite.snapshots, 3);
  EXPECT_EQ(total.not_finite.snapshot, 2U);
  EXPECT_EQ(total.not_finite.rows, (std::vector<std::size_t>{20, 21}));
  EXPECT_EQ(total.farthest, 4);
  EXPECT_EQ(total.no_size.particles, 0);
}

TEST(Flaws, AnIdIsNamedWithItsOwnRowEvenWhereOthersHaveNone) {
  const TemporaryFolder folder;
  const auto path = folder.write("dump1", small_dump(1, 9));
  Flaws flaws;
  flaws.no_size.add(0, 1, nan);
  flaws.no_size.add(0, 3, 17);
  const auto lines = flaws.describe(Series::open(path));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0],
            "2 particles in 1 snapshots have a radius of zero or less, excluded from all that "
            "needs a size, "
            "counted; first: " +
                path + ": line 11, line 13 (id 17)");
}

TEST(Flaws, AtMostFourAreNamed) {
  const TemporaryFolder folder;
  const auto path = folder.write("dump1", small_dump(1, 9));
  Flaws flaws;
  for (std::size_t row = 0; row < 6; ++row) flaws.not_finite.add(0, row, static_cast<double>(row));
  const auto line = flaws.describe(Series::open(path)).at(0);
  EXPECT_TRUE(line.starts_with("6 particles in 1 snapshots are not finite")) << line;
  EXPECT_TRUE(line.ends_with("line 13 (id 3), ...")) << line;
}

TEST(Flaws, PositionsOfOtherWorldsAreDoubted) {
  const TemporaryFolder folder;
  const auto series = Series::open(folder.write("dump1", small_dump(1, 9)));
  Flaws flaws;
  flaws.farthest = 9e3;
  EXPECT_TRUE(flaws.describe(series).empty());
  flaws.farthest = 2e30;
  EXPECT_NE(flaws.describe(series).at(0).find("positions up to 2e+30 m are implausible"),
            std::string::npos);
}

}  // namespace
}  // namespace bedscope::readers
