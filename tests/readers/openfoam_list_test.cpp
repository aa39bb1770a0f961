// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_list.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "openfoam_samples.hpp"
#include "readers/openfoam_blocks.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

std::vector<double> values_of(const std::string& path, std::string_view type,
                              std::optional<FoamCount> expected = {}) {
  FoamBlocks file(path);
  EXPECT_TRUE(file.next());
  std::vector<double> values;
  read_values(file.stream(), layout_of(file.header(), path), *foam_type(type), expected, values);
  return values;
}

std::vector<double> ascii(std::string_view text, std::string_view type = "scalar",
                          std::optional<FoamCount> expected = {}) {
  const Folder folder;
  return values_of(folder.write("list", header("scalarField") + std::string(text)), type, expected);
}

// Numbers as another build would write them.
template <class Scalar>
std::string binary_list(const std::vector<double>& values, unsigned components, bool swap) {
  auto text = fmt::format("{}\n(", values.size() / components);
  for (const double value : values) {
    const auto number = static_cast<Scalar>(value);
    std::array<char, sizeof(Scalar)> bytes;
    std::memcpy(bytes.data(), &number, sizeof(Scalar));
    if (swap) std::reverse(bytes.begin(), bytes.end());
    text.append(bytes.begin(), bytes.end());
  }
  return text + ")\n";
}

TEST(OpenFoamList, FormsOfAsciiListsGiveTheSameNumbers) {
  const std::vector<double> expected{1, 2.5, -3e-5};
  EXPECT_EQ(ascii("3\n(\n1\n2.5\n-3e-05\n)\n"), expected);
  EXPECT_EQ(ascii("3(1 2.5 -3e-05)"), expected);
  EXPECT_EQ(ascii("3 ( 1\r\n\t2.5 /* no */ -3e-05 // end\n )"), expected);
  EXPECT_EQ(ascii("(1 2.5 -3e-05)"), expected);
  EXPECT_EQ(ascii("1((1 2.5 -3e-05))", "vector"), expected);
  EXPECT_EQ(ascii("( ( 1 2.5 -3e-05 ) )", "vector"), expected);
}

TEST(OpenFoamList, UniformListIsRepeatedAsOftenAsExpected) {
  EXPECT_EQ(ascii("3{1.5}", "scalar", FoamCount{3}), std::vector<double>(3, 1.5));
  EXPECT_EQ(ascii("2{(1 2 3)}", "vector", FoamCount{2}), (std::vector<double>{1, 2, 3, 1, 2, 3}));
}

TEST(OpenFoamList, EmptyListsAreEmpty) {
  for (const auto* text : {"0()", "0", "0\n(\n)\n", "()", "0 ;"})
    EXPECT_TRUE(ascii(text).empty()) << text;
}

TEST(OpenFoamList, EveryTypeHasItsNumbers) {
  EXPECT_EQ(ascii("1((1 2 3 4 5 6))", "symmTensor").size(), 6U);
  EXPECT_EQ(ascii("1((1 2 3 4 5 6 7 8 9))", "tensor").size(), 9U);
  EXPECT_EQ(ascii("1((4))", "sphericalTensor"), std::vector<double>{4});
}

TEST(OpenFoamList, AsciiNumbersAreTheNearestDoubles) {
  std::mt19937_64 random(7);
  std::string text;
  std::vector<double> expected;
  for (int k = 0; k < 20000; ++k) {
    double value = 0;
    const auto bits = random();
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const auto number = k % 2 != 0 ? fmt::format("{:.6g}", value) : fmt::format("{}", value);
    expected.push_back(std::strtod(number.c_str(), nullptr));
    text += number + (k % 3 != 0 ? "\n" : " ");
  }
  EXPECT_EQ(ascii(fmt::format("{}({})", expected.size(), text)), expected);
}

TEST(OpenFoamList, NumbersThatAreNoneAreRefusedWithLineAndOffset) {
  for (const auto* number : {"0,003", "3.0D-03", "0x1p-8", "1.2.3", "e5", "1e", "--1"})
    EXPECT_NE(error_of([&] { ascii(fmt::format("2\n(\n1\n{}\n)\n", number)); }), "") << number;
  const Folder folder;
  const auto path = folder.write("list", header("scalarField") + "2\n(\n1\n1,5\n)\n");
  EXPECT_EQ(error_of([&] { values_of(path, "scalar"); }),
            fmt::format("{}: line 5: value 1 of 2: not a number at offset {}: \"1,5\"", path,
                        header("scalarField").size() + 6));
}

TEST(OpenFoamList, BinaryOfEveryArchitectureGivesTheSameNumbers) {
  const std::vector<double> expected{1, -0.5, 0.25, 1e10, 3, 8};  // exact in float, too
  const Folder folder;
  const auto read = [&](std::string_view arch, const std::string& list) {
    return values_of(folder.write("l", header("vectorField", "binary", arch) + list), "vector");
  };
  EXPECT_EQ(read("", binary_list<double>(expected, 3, false)), expected);
  EXPECT_EQ(read("arch \"LSB;label=64;scalar=64\";", binary_list<double>(expected, 3, false)),
            expected);
  EXPECT_EQ(read("arch \"LSB;label=32;scalar=32\";", binary_list<float>(expected, 3, false)),
            expected);
  EXPECT_EQ(read("arch \"MSB;label=32;scalar=64\";", binary_list<double>(expected, 3, true)),
            expected);
  EXPECT_EQ(read("arch \"MSB;label=32;scalar=32\";", binary_list<float>(expected, 3, true)),
            expected);
}

TEST(OpenFoamList, BinaryOfAnotherSizeFailsAtTheClosingParenthesis) {
  const Folder folder;
  const auto list = binary_list<float>({1, 2, 3, 4, 5, 6, 7, 8}, 1, false) + std::string(64, ' ');
  const auto path = folder.write("l", header("scalarField", "binary") + list);
  EXPECT_NE(error_of([&] { values_of(path, "scalar"); })
                .find("expected \")\" after 64 bytes of a binary list (no arch: "
                      "LSB;label=32;scalar=64 assumed)"),
            std::string::npos);
}

TEST(OpenFoamList, BytesThatLookLikeParenthesesDoNotEndABinaryList) {
  double brackets = 0;
  std::memcpy(&brackets, ")(\n))(\n)", 8);
  const std::vector<double> expected(9, brackets);
  const Folder folder;
  const auto path =
      folder.write("l", header("scalarField", "binary") + binary_list<double>(expected, 1, false));
  EXPECT_EQ(values_of(path, "scalar"), expected);
}

TEST(OpenFoamList, ListsLongerThanAPieceHaveNoSeams) {
  std::vector<double> expected(300003);
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<double>(i) / 8;
  const Folder folder;
  const auto binary =
      folder.write("b", header("vectorField", "binary") + binary_list<double>(expected, 3, false));
  EXPECT_EQ(values_of(binary, "vector"), expected);
  std::string text = fmt::format("{}\n(\n", expected.size() / 3);
  for (std::size_t i = 0; i < expected.size(); i += 3)
    text += fmt::format("({} {} {})\n", expected[i], expected[i + 1], expected[i + 2]);
  const auto plain = folder.write("a", header("vectorField") + text + ")\n");
  EXPECT_EQ(values_of(plain, "vector"), expected);
  auto* gz = gzopen(folder.path("g").c_str(), "wb1");
  const auto all = header("vectorField") + text + ")\n";
  gzwrite(gz, all.data(), static_cast<unsigned>(all.size()));
  gzclose(gz);
  EXPECT_EQ(values_of(folder.path("g"), "vector"), expected);
}

TEST(OpenFoamList, CountsAreClaims) {
  for (const auto* text : {"1099511627776\n(1 2 3)", "9223372036854775807(1)", "-3(1)",
                           "4\n(\n1\n2\n3\n)\n", "2(1 2 3)", "1e3(1)", "99999999999999999999(1)"})
    EXPECT_NE(error_of([&] { ascii(text); }), "") << text;
  EXPECT_NE(error_of([&] {
              ascii("1099511627776{1}", "scalar", FoamCount{300});
            }).find("list declares 1099511627776 values, mesh has 300 cells"),
            std::string::npos);
  EXPECT_NE(error_of([&] { ascii("1099511627776{1}"); }), "");
}

TEST(OpenFoamList, NonFiniteValuesAreCountedByValue) {
  const Folder folder;
  FoamBlocks file(folder.write("l", header("vectorField") + "3((1 2 3)(nan inf 0)(-nan 1 -inf))"));
  ASSERT_TRUE(file.next());
  std::vector<double> values;
  const auto bad = read_values(file.stream(), {}, *foam_type("vector"), {}, values);
  EXPECT_EQ(bad.values, 2U);
  EXPECT_EQ(bad.first, 1U);
}

TEST(OpenFoamList, FacesOfBothFormsAreTheSame) {
  const Folder folder;
  const auto read = [&](const std::string& text, bool compact) {
    FoamBlocks file(folder.write("faces", header("faceList") + text));
    EXPECT_TRUE(file.next());
    std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> faces;
    read_faces(file.stream(), {}, compact, faces.first, faces.second);
    return faces;
  };
  const auto list = read("2\n(\n4(0 1 2 3)\n3(7 6 5)\n)\n", false);
  EXPECT_EQ(list.first, (std::vector<std::int32_t>{0, 4, 7}));
  EXPECT_EQ(list.second, (std::vector<std::int32_t>{0, 1, 2, 3, 7, 6, 5}));
  EXPECT_EQ(read("3(0 4 7)\n7(0 1 2 3 7 6 5)", true), list);
  EXPECT_NE(error_of([&] { read("3(0 5 4)\n4(0 1 2 3)", true); }), "");
  EXPECT_NE(error_of([&] { read("2(4(0 1 2 3) 3(7 6))", false); }), "");
}

// min, max and sum of a component, by the corpus' own reader.
TEST(OpenFoamList, CorpusListsHaveTheirExpectedNumbers) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  std::size_t compared = 0;
  std::string last;
  std::vector<double> values;
  for (const auto& row : csv(shared / "corpus" / "expected_arrays.csv")) {
    if (row.size() < 10 || row[2] != "list") continue;
    const auto path = (shared / "corpus" / row[0]).string();
    const auto components = std::stoul(row[5]), component = std::stoul(row[4]);
    if (path + row[1] != last) {
      FoamBlocks file(path);
      for (auto block = std::stoul(row[1]); file.next() && block > 0; --block) {
      }
      const auto layout = layout_of(file.header(), path);
      if (file.header().class_name.starts_with("label")) {
        std::vector<std::int32_t> labels;
        read_labels(file.stream(), layout, labels, FoamCount{std::stoul(row[6])});
        values.assign(labels.begin(), labels.end());
      } else {
        read_values(file.stream(), layout, *foam_type(components == 3 ? "vector" : "scalar"),
                    FoamCount{std::stoul(row[6])}, values);
      }
      last = path + row[1];
    }
    ASSERT_EQ(values.size(), components * std::stoul(row[6])) << path;
    if (values.empty()) continue;
    double low = INFINITY, high = -INFINITY, sum = 0, size = 0;
    for (std::size_t i = component; i < values.size(); i += components) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
      sum += values[i];
      size += std::abs(values[i]);
    }
    EXPECT_EQ(low, std::strtod(row[7].c_str(), nullptr)) << path;
    EXPECT_EQ(high, std::strtod(row[8].c_str(), nullptr)) << path;
    EXPECT_NEAR(sum, std::strtod(row[9].c_str(), nullptr), 1e-12 * size)
        << path;  // sums in another order
    ++compared;
  }
  EXPECT_GT(compared, 1000U);
}

}  // namespace
}  // namespace bedscope::readers
