// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_dictionary.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include "openfoam_samples.hpp"

namespace bedscope::readers {
namespace {

using namespace samples;

FoamDictionary parse(const std::string& text) {
  FoamStream stream(text, "text");
  FoamDictionary dictionary;
  FoamEntries(stream).all(dictionary);
  return dictionary;
}

TEST(OpenFoamDictionary, HeaderMayStandOnOneLineWithCommentsAnywhere) {
  FoamStream stream(
      "/* banner\n * */ // more\nFoamFile//x\n{version 2.0;format/*or ascii*/binary;class "
      "Cloud<passiveParticle>;arch \"LSB;label=32;scalar=64\";}",
      "text");
  const auto header = read_header(stream);
  EXPECT_TRUE(header.present);
  EXPECT_TRUE(header.binary);
  EXPECT_EQ(header.class_name, "Cloud<passiveParticle>");
  EXPECT_EQ(header.arch, "LSB;label=32;scalar=64");
}

TEST(OpenFoamDictionary, FileWithoutHeaderSaysSo) {
  FoamStream stream("Foam 1;", "text");
  EXPECT_FALSE(read_header(stream).present);
  EXPECT_EQ(stream.next().text, "Foam");
}

TEST(OpenFoamDictionary, NamesHoldPointsColonsAndParentheses) {
  const auto d = parse("alpha.air 1; kinematicCloud:UCoeff 2; YH2O(l) 3; div(phi,U) Gauss linear;");
  EXPECT_EQ(d.value("YH2O(l)", ""), "3");
  EXPECT_EQ(d.value("kinematicCloud:UCoeff", ""), "2");
  EXPECT_EQ(d.value("div(phi,U)", ""), "Gauss linear");
}

TEST(OpenFoamDictionary, PatternsAreKeywordsAndTheLastOfANameHolds) {
  const auto d = parse("\"(inlet|outlet).*\" { type zeroGradient; } a 1; a 2;");
  ASSERT_NE(d.dictionary("(inlet|outlet).*"), nullptr);
  EXPECT_EQ(d.dictionary("(inlet|outlet).*")->value("type", ""), "zeroGradient");
  EXPECT_EQ(d.value("a", ""), "2");
}

TEST(OpenFoamDictionary, MacrosAreValuesOfTheSameFile) {
  const auto d = parse("u 3; in { speed 4; } U uniform (0 $u ${u}); v $in.speed; w $:in.speed;");
  EXPECT_EQ(d.value("U", ""), "uniform ( 0 3 3 )");
  EXPECT_EQ(d.value("v", ""), "4");
  EXPECT_EQ(d.value("w", ""), "4");
  const auto later =
      parse("u 3; in { speed 4; } v $in/speed; w uniform ($!in/speed $u 0); x $u// $u\n;");
  EXPECT_EQ(later.value("v", ""), "4");
  EXPECT_EQ(later.value("w", ""), "uniform ( 4 3 0 )");
  EXPECT_EQ(later.value("x", ""), "3");
}

TEST(OpenFoamDictionary, MacroInACircleOrWithoutAValueIsAnError) {
  const auto d = parse("a $b; b $a; c $none;");
  EXPECT_EQ(error_of([&] { d.value("a", "f"); }), "f: macros refer to one another in a circle");
  EXPECT_EQ(error_of([&] { d.value("c", "f"); }),
            "f: expected a value for $none, found none in the file");
}

TEST(OpenFoamDictionary, MacrosThatDoubleThirtyTimesDoNotFillTheMemory) {
  std::string text = "a0 xxxxxxxx;";
  for (int k = 1; k < 31; ++k) text += fmt::format("a{0} $a{1} $a{1};", k, k - 1);
  const auto d = parse(text);
  EXPECT_NE(error_of([&] { d.value("a30", "f"); }).find("more than"), std::string::npos);
}

TEST(OpenFoamDictionary, CodeIsNeverRunAndOnlyRemembered) {
  const auto d =
      parse("#includeEtc \"x\"\n a #calc \"1+1\"; b #codeStream { code #{ ; } #}; }; c 1;");
  EXPECT_EQ(d.value("c", ""), "1");
  EXPECT_EQ(d.value("a", ""), "#calc \"1+1\"");
  ASSERT_EQ(d.not_followed.size(), 1U);
  EXPECT_EQ(d.not_followed[0], "#includeEtc x");
}

TEST(OpenFoamDictionary, IncludeIsRelativeToTheFile) {
  const Folder folder;
  folder.write("0/include/initial", "speed 2;");
  const auto path =
      folder.write("0/U", header("dictionary") + "#include \"include/initial\"\nU $speed;\n");
  EXPECT_EQ(read_dictionary(path).value("U", ""), "2");
}

TEST(OpenFoamDictionary, AFileWithoutANameIsReadAndANameThatIsTooLongIsNoFile) {
  // As `bedscope info <(zcat p.gz)` and the fuzz targets give it: an open file, no path that leads
  // to it.
  const int file = ::memfd_create("U", 0);
  const auto text = header("dictionary") + "#include \"" + std::string(400, 'x') + "\"\nspeed 3;\n";
  ASSERT_EQ(::write(file, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  const auto d = read_dictionary(fmt::format("/proc/self/fd/{}", file));
  ::close(file);
  EXPECT_EQ(d.value("speed", "U"), "3");
  EXPECT_EQ(d.not_followed.size(), 1U);
}

TEST(OpenFoamDictionary, IncludeInACircleIsAnErrorWithItsLine) {
  const Folder folder;
  folder.write("a", "\n#include \"b\"\n");
  folder.write("b", "x 1;\n\n#include \"a\"\n");
  EXPECT_EQ(error_of([&] { read_dictionary(folder.path("a")); }),
            folder.path("b") + ": line 3: #include of a file that includes this one");
}

TEST(OpenFoamDictionary, AHeaderThatIncludesItsOwnFileIsAnErrorToo) {
  const Folder folder;
  folder.write("a", "FoamFile { version 2.0; #include \"b\"\n}\n");
  folder.write("b", "FoamFile { version 2.0; #include \"b\"\n}\n");
  EXPECT_EQ(error_of([&] { read_dictionary(folder.path("a")); }),
            folder.path("b") + ": line 1: #include of itself");
}

TEST(OpenFoamDictionary, ANameThatANulCutsIsNoFile) {
  // It would be "a": the file itself, again and again (found by the fuzzer).
  const Folder folder;
  const std::string text = "FoamFile { #include \"a" + std::string(3, '\0') + "\"\n}\nspeed 3;\n";
  folder.write("a", text);
  const auto d = read_dictionary(folder.path("a"));
  EXPECT_EQ(d.value("speed", "a"), "3");
}

TEST(OpenFoamDictionary, MissingIncludeMattersOnlyToTheEntryThatNeedsIt) {
  const auto d = parse("#include \"gone\"\na 1; b $fromThere;");
  EXPECT_EQ(d.value("a", ""), "1");
  EXPECT_EQ(error_of([&] { d.value("b", "f"); }),
            "f: expected a value for $fromThere, found none in the file; not followed: #include "
            "\"gone\"");
}

TEST(OpenFoamDictionary, ErrorsNameLineExpectedAndFound) {
  const Folder folder;
  const auto message = [&](std::string_view text) {
    const auto path = folder.write("d", text);
    return error_of([&] { read_dictionary(path); }).substr(path.size());
  };
  EXPECT_EQ(message("a 1;\nb (1 2;\n"),
            ": line 3: expected \";\" after the value of b, found end of file");
  EXPECT_EQ(message("a\n{\n b 1;\n"), ": line 4: expected \"}\", found end of file");
  EXPECT_EQ(message("a 1;\n(b) 2;"), ": line 2: expected a keyword, found \"(\"");
  EXPECT_EQ(message("a (1 ];\n"), ": line 1: expected \")\" in the value of a, found \"]\"");
  EXPECT_EQ(message("FoamFile { format text; }"),
            ": line 1: expected format ascii or binary, found text");
}

TEST(OpenFoamDictionary, NestingIsBounded) {
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "a {";
  EXPECT_NE(error_of([&] { parse(deep); }).find("dictionaries in one another"), std::string::npos);
}

}  // namespace
}  // namespace bedscope::readers
