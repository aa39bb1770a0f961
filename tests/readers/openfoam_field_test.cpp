// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "openfoam_samples.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

FieldValues read(const std::string& path, std::optional<FoamCount> cells = {},
                 std::size_t block = 0) {
  FoamBlocks file(path);
  for (std::size_t k = 0; k <= block; ++k) EXPECT_TRUE(file.next()) << path;
  FieldValues field;
  read_field(file, cells, field);
  return field;
}

// A field of two cells with this text, and the error it ends in without the path.
FieldValues field_of(std::string_view text, std::string_view class_name = "volScalarField") {
  const Folder folder;
  return read(folder.write("x", header(class_name) + std::string(text)), FoamCount{2});
}
std::string message(std::string_view text, std::string_view class_name = "volScalarField") {
  const Folder folder;
  const auto path = folder.write("x", header(class_name) + std::string(text));
  const auto error = error_of([&] { read(path, FoamCount{2}); });
  return error.starts_with(path) ? error.substr(path.size()) : error;
}

constexpr std::string_view rest = "boundaryField { \"wall.*\" { type zeroGradient; } }";

std::string with(std::string_view internal) {
  return fmt::format("dimensions [0 1 -1 0 0 0 0];\ninternalField {};\n{}", internal, rest);
}

TEST(OpenFoamField, SpellingsOfAUniformFieldAreTheSame) {
  for (const auto* text :
       {"uniform (1 2 3)", "nonuniform List<vector> 2{(1 2 3)}",
        "nonuniform List<vector> \n2\n(\n(1 2 3)\n(1 2 3)\n)\n", "nonuniform 2((1 2 3)(1 2 3))"})
    EXPECT_EQ(field_of(with(text), "volVectorField").values,
              (std::vector<double>{1, 2, 3, 1, 2, 3}))
        << text;
}

TEST(OpenFoamField, ValuesMayComeThroughMacros) {
  const std::vector<double> expected{0, 0, 5, 0, 0, 5};
  for (const auto* text :
       {"u 5; internalField uniform (0 0 $u);", "U (0 0 5); internalField uniform $U;",
        "all uniform (0 0 5); internalField $all;", "s { U (0 0 5); } internalField uniform $s.U;",
        "all nonuniform List<vector> 2((0 0 5)(0 0 5)); internalField $all;"})
    EXPECT_EQ(field_of(std::string(text) + std::string(rest), "volVectorField").values, expected)
        << text;
}

TEST(OpenFoamField, ValuesMayComeFromAnIncludedFile) {
  const Folder folder;
  folder.write("initial", "internalField uniform 4;");
  const auto path =
      folder.write("p", header("volScalarField") + "#include \"initial\"\n" + std::string(rest));
  EXPECT_EQ(read(path, FoamCount{2}).values, (std::vector<double>{4, 4}));
}

TEST(OpenFoamField, CodeIsNamedOnlyWhereItsValueIsNeeded) {
  EXPECT_NE(message(with("#codeStream { code #{ system(\"x\"); #}; }"))
                .find("#codeStream\", which is never run"),
            std::string::npos);
  EXPECT_NE(message(with("uniform #calc \"1+1\"")).find("#calc\", which is never run"),
            std::string::npos);
  EXPECT_EQ(
      field_of("x #calc \"1\"; internalField uniform 1; boundaryField { a { value #calc \"2\"; } }")
          .values[0],
      1);
}

TEST(OpenFoamField, InternalFieldsHaveAValueAndNoBoundary) {
  for (const auto* name : {"volScalarField::Internal", "volScalarField::DimensionedInternalField"})
    EXPECT_EQ(
        field_of("dimensions [0 0 0 0 0 0 0]; value nonuniform List<scalar> 2(1 2);", name).values,
        (std::vector<double>{1, 2}));
}

TEST(OpenFoamField, DimensionsTellPressureFromPressureOverDensity) {
  EXPECT_EQ(field_of("dimensions [1 -1 -2 0 0 0 0]; internalField uniform 0; boundaryField {}")
                .dimensions,
            (std::array<double, 7>{1, -1, -2, 0, 0, 0, 0}));
  EXPECT_EQ(
      field_of("dimensions [0 2 -2 0 0]; internalField uniform 0; boundaryField {}").dimensions,
      (std::array<double, 7>{0, 2, -2, 0, 0, 0, 0}));
  EXPECT_FALSE(
      field_of("dimensions [m s^-1]; internalField uniform 0; boundaryField {}").dimensions_known);
}

TEST(OpenFoamField, ErrorsNameLineExpectedAndFound) {
  EXPECT_EQ(message(with("nonuniform List<vector> 2((1 2 3)(1 2 3))")),
            ": line 3: class volScalarField but List<vector>");
  EXPECT_EQ(message(with("nonuniform List<scalar> 3(1 2 3)")),
            ": line 3: list declares 3 values, mesh has 2 cells");
  EXPECT_EQ(message(with("nonuniform List<scalar> (1 2 3)")),
            ": line 3: list holds 3 values, mesh has 2 cells");
  EXPECT_EQ(message(with("uniform (1 2 3)")),
            ": line 3: expected 1 numbers for volScalarField, found 3");
  EXPECT_EQ(message(with("1")), ": line 3: expected uniform or nonuniform, found \"1\"");
  EXPECT_EQ(message("internalField uniform 1;\nboundaryField\n  top { }\n"),
            ": line 4: expected \"{\" after boundaryField, found \"top\"");
  EXPECT_EQ(message("internalField uniform 1;\n"),
            ": line 3: expected boundaryField, found end of file");
  EXPECT_EQ(message("a 1;\n", "dictionary"),
            ": expected a field (volScalarField ...), found class dictionary");
}

TEST(OpenFoamField, BinaryListsOfTheBoundaryAreSteppedOver) {
  // Braces and quotes in the numbers would end the boundary or begin a string.
  std::string text =
      header("volScalarField", "binary") +
      "internalField uniform 1;\nboundaryField { in { value nonuniform List<scalar> 2\n(";
  text += "}}}}\"\"{{/*//;;$)";
  text += "); } out { value nonuniform 0(); } }\nlast 7;\n";
  const Folder folder;
  const auto path = folder.write("x", text);
  EXPECT_EQ(read(path, FoamCount{2}).values, (std::vector<double>{1, 1}));
  text.resize(text.size() - 40);
  EXPECT_NE(error_of([&] { read(folder.write("x", text), FoamCount{2}); }), "");
}

TEST(OpenFoamField, FileWithoutHeaderIsReadByTheTypeOfItsList) {
  const Folder folder;
  const auto field =
      read(folder.write("x", with("nonuniform List<symmTensor> 2((1 2 3 4 5 6)(1 2 3 4 5 6))")));
  EXPECT_TRUE(field.no_header);
  EXPECT_EQ(field.components, 6U);
}

TEST(OpenFoamField, NonFiniteCellsAreCounted) {
  const auto field = field_of(with("nonuniform List<scalar> 2(1 nan)"));
  EXPECT_EQ(field.non_finite.values, 1U);
  EXPECT_EQ(field.non_finite.first, 1U);
  EXPECT_EQ(field_of(with("uniform inf")).non_finite.values, 2U);
}

// Reads every sort of file at hand; only an Error may come out.
void read_anything(const std::string& path) {
  error_of([&] {
    FoamBlocks file(path);
    FieldValues field;
    while (file.next()) read_field(file, std::nullopt, field);
  });
}

TEST(OpenFoamField, CutFilesGiveAnErrorEverywhere) {
  const Folder folder;
  for (const auto* name :
       {"ascii/0.003/U.air", "whole/0.003/U.air", "separate/processor0/0.003/U.air",
        "ascii/0.003/kinematicCloud:UTrans"}) {
    const auto whole = bytes_of(data / name);
    const auto closing =
        whole.rfind(name[0] == 'a' && std::string_view(name).ends_with("Trans") ? ';' : '}');
    for (std::size_t size = 0; size < closing; size += 53)
      EXPECT_NE(error_of([&] { read(folder.write("x", whole.substr(0, size))); }), "")
          << name << size;
  }
}

TEST(OpenFoamField, DamagedBytesGiveAnErrorOrAField) {
  const Folder folder;
  std::mt19937 random(1);
  for (const auto* name :
       {"ascii/0.003/U.air", "whole/0.003/U.air", "collated/processors2/0.003/U.air"}) {
    const auto whole = bytes_of(data / name);
    for (std::size_t k = 0; k < 300; ++k) {
      auto damaged = whole;
      // Most of the grammar is in the text around the numbers.
      const auto range = k % 2 == 0 ? std::min<std::size_t>(damaged.size(), 1600) : damaged.size();
      for (int flips = 0; flips < 3; ++flips)
        damaged[random() % range] = static_cast<char>(random());
      read_anything(folder.write("x", damaged));
    }
  }
}

// min, max and sum of a component, by the corpus' own reader.
TEST(OpenFoamField, CorpusFieldsHaveTheirExpectedNumbers) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  std::size_t compared = 0;
  std::string last;
  FieldValues field;
  for (const auto& row : csv(shared / "corpus" / "expected_arrays.csv")) {
    if (row.size() < 10 || row[2] != "field") continue;
    const auto path = (shared / "corpus" / row[0]).string();
    if (path + row[1] != last) {
      last = path + row[1];
      FoamBlocks file(path);
      for (auto block = std::stoul(row[1]); file.next() && block > 0; --block) {
      }
      if (vol_field_type(file.header().class_name) == nullptr) {  // a surface field
        field.components = 0;
        continue;
      }
      read_field(file, FoamCount{std::stoul(row[6])}, field);
    }
    if (field.components == 0) continue;
    ASSERT_EQ(field.components, std::stoul(row[5])) << path;
    double low = INFINITY, high = -INFINITY, sum = 0, size = 0;
    for (auto i = std::stoul(row[4]); i < field.values.size(); i += field.components) {
      low = std::min(low, field.values[i]);
      high = std::max(high, field.values[i]);
      sum += field.values[i];
      size += std::abs(field.values[i]);
    }
    EXPECT_EQ(low, std::strtod(row[7].c_str(), nullptr)) << path;
    EXPECT_EQ(high, std::strtod(row[8].c_str(), nullptr)) << path;
    EXPECT_NEAR(sum, std::strtod(row[9].c_str(), nullptr), 1e-12 * size)
        << path;  // sums in another order
    ++compared;
  }
  EXPECT_GT(compared, 900U);
}

TEST(OpenFoamField, CorpusUniformFieldsHaveTheirExpectedValue) {
  if (!corpus_there()) GTEST_SKIP() << "no corpus beside the project";
  std::size_t compared = 0;
  for (const auto& row : csv(shared / "corpus" / "expected.csv")) {
    if (row.size() < 19 || !row[2].starts_with("of-vol") || row[5] != "uniform") continue;
    const auto path = (shared / "corpus" / row[0]).string();
    if (path.ends_with("ascii/0/T")) continue;  // #codeStream stands before the uniform value
    const auto field = read(path);
    auto numbers = row[18].substr(row[18].find('[') + 1);
    for (auto& c : numbers)
      if (c == ',' || c == ']') c = ' ';
    std::istringstream stream(numbers);
    std::vector<double> expected;
    for (double value = 0; stream >> value;) expected.push_back(value);
    EXPECT_EQ(field.values, expected) << path;
    ++compared;
  }
  EXPECT_GT(compared, 150U);
}

}  // namespace
}  // namespace bedscope::readers
