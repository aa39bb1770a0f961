// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_file.hpp"

#include <algorithm>
#include <filesystem>

#include "readers/numbers.hpp"
#include "readers/openfoam_cloud.hpp"
#include "readers/openfoam_folders.hpp"

namespace bedscope::readers {
namespace {

namespace fs = std::filesystem;

struct NeedsMesh {};

class Summariser {
 public:
  explicit Summariser(const std::string& path) : path_(path), file_(path) {}

  FoamFileSummary run() {
    made_.collated = file_.collated();
    made_.compressed = file_.stream().compressed();
    for (std::size_t block = 0; file_.next(); ++block) {
      const auto& header = file_.header();
      if (block == 0) {
        made_.class_name = header.class_name;
        made_.binary = header.binary;
        made_.arch = header.arch;
      }
      const auto before = made_.count.value_or(0);
      add_block(block);
      if (made_.count) made_.blocks.push_back(*made_.count - before);
    }
    if (needs_mesh_) try {
        place_by_mesh();
      } catch (const FileError& error) {
        made_.problems.push_back(
            fmt::format("barycentric coordinates without their mesh: {}", error.what()));
      }
    if (made_.non_finite > 0)
      made_.problems.push_back(fmt::format("{} {} are nan or inf, the first is {}",
                                           made_.non_finite, made_.what, first_non_finite_));
    return std::move(made_);
  }

 private:
  void add_block(std::size_t block) {
    const auto& name = made_.class_name;
    auto& stream = file_.stream();
    const auto layout = layout_of(file_.header(), path_);
    if (mesh_field_type(name) != nullptr) {
      add_mesh_field();
    } else if (!expected(block) && add_uniform_list(block)) {
    } else if (const auto* type = list_type(name)) {
      NonFinite bad = read_values(stream, layout, *type, expected(block), values_);
      if (name == "vectorField" && fs::path(path_).filename().string().starts_with("points"))
        made_.what = "points";
      add_values(type->components, bad);
    } else if (name == "labelField" || name == "labelList") {
      read_labels(stream, layout, labels_, expected(block));
      add_labels("labels");
    } else if (name.ends_with("Set") && !name.ends_with("topoSet")) {
      FoamLayout ascii = layout;
      ascii.binary = false;  // sets are text in binary files too
      read_labels(stream, ascii, labels_);
      add_labels("labels");
    } else if (name == "faceList" || name == "faceCompactList") {
      add_faces(layout);
    } else if (name.starts_with("Cloud<")) {
      add_parcels(block);
    } else if (name == "polyBoundaryMesh") {
      add("patches", read_named_list(stream).entries.size());
    } else if (name == "dictionary") {
      FoamDictionary dictionary;
      FoamEntries(stream).all(dictionary);
      add("entries", dictionary.entries.size());
    }
  }

  void add(std::string_view what, std::size_t count) {
    if (made_.what.empty()) made_.what = what;
    made_.count = made_.count.value_or(0) + count;
  }

  void add_values(unsigned components, const NonFinite& bad) {
    made_.ranges.resize(components);
    add_to_ranges(values_, made_.ranges);
    if (bad.values > 0 && made_.non_finite == 0)
      first_non_finite_ = made_.count.value_or(0) + bad.first;
    made_.non_finite += bad.values;
    add("values", values_.size() / components);
  }

  void add_mesh_field() {
    FieldValues field;
    try {
      read_field(file_, std::nullopt, field);
    } catch (const CodeError& error) {
      made_.problems.emplace_back(error.what());
      return;
    }
    made_.dimensions = field.dimensions;
    made_.dimensions_known = field.dimensions_known;
    made_.what = field.class_name.starts_with("vol")       ? "cells"
                 : field.class_name.starts_with("surface") ? "faces"
                                                           : "points";
    values_ = std::move(field.values);
    const auto count = made_.count;
    add_values(field.components, field.non_finite);
    if (!field.uniform) return;
    made_.uniform = true;
    made_.count = count;
  }

  // `N{value}` with nothing beside it that bounds N: the value is taken, not repeated.
  bool add_uniform_list(std::size_t block) {
    FoamBlocks again(path_);
    for (std::size_t k = 0; k <= block; ++k)
      if (!again.next()) return false;
    auto& stream = again.stream();
    const auto count = stream.next();
    std::int64_t number = 0;
    bool overflow = false;
    if (!parse_integer(count.text, number, overflow) || number < 0 || !stream.take('{'))
      return false;
    values_.clear();
    for (auto token = stream.next(); !token.is('}'); token = stream.next()) {
      if (token.at_end()) stream.fail_cut("expected \"}}\" of a uniform list, found end of file");
      if (token.kind == FoamToken::Kind::sign) continue;
      double value = 0;
      if (!parse_number(token.text.data(), token.text.data() + token.text.size(), value))
        stream.fail(token.offset, "not a number in a uniform list: \"{}\"", token.text);
      values_.push_back(value);
    }
    made_.uniform = true;
    made_.ranges.resize(values_.size());
    add_to_ranges(values_, made_.ranges);
    add("values", static_cast<std::size_t>(number));
    return true;
  }

  void add_labels(std::string_view what) {
    values_.assign(labels_.begin(), labels_.end());
    made_.what = what;
    add_values(1, {});
  }

  void add_faces(const FoamLayout& layout) {
    std::vector<std::int32_t> starts, points;
    read_faces(file_.stream(), layout, made_.class_name == "faceCompactList", starts, points);
    values_.clear();
    for (std::size_t f = 0; f + 1 < starts.size(); ++f)
      values_.push_back(starts[f + 1] - starts[f]);
    made_.what = "faces";
    add_values(1, {});
  }

  void add_parcels(std::size_t block) {
    CloudPoints points;
    made_.what = "parcels";
    try {
      read_cloud_points(
          file_, []() -> const CloudMesh& { throw NeedsMesh(); }, points);
    } catch (const NeedsMesh&) {
      needs_mesh_ = true;
      add("parcels", parcels_of(path_, block));
      return;
    }
    values_.clear();
    for (const auto& point : points.at) values_.insert(values_.end(), point.begin(), point.end());
    add_values(3, {});
  }

  // The case around <root>/<time>/[region/]lagrangian/<cloud>/coordinates.
  void place_by_mesh() {
    const auto cloud = fs::absolute(path_).lexically_normal().parent_path();
    auto time = cloud.parent_path().parent_path();
    OpenFoamOptions options;
    double unused = 0;
    const auto is_time = [&](const fs::path& folder) {
      const auto name = folder.filename().string();
      return parse_number(name.data(), name.data() + name.size(), unused);
    };
    if (!is_time(time)) {
      options.region = time.filename().string();
      time = time.parent_path();
    }
    auto root = time.parent_path();
    if (root.filename().string().starts_with("processors")) {
      options.decomposition = Decomposition::collated;
      root = root.parent_path();
    } else {
      options.decomposition = Decomposition::reconstructed;
    }
    const auto foam = OpenFoamCase::open(root.string(), options);
    std::size_t t = 0;
    while (t < foam.times().size() && foam.times()[t].name != time.filename().string()) ++t;
    if (t == foam.times().size())
      throw FormatError("{}: expected time {} in {}, found it left out", path_,
                        time.filename().string(), root.string());
    Snapshot parcels;
    const auto name = cloud.filename().string();
    for (auto& problem : foam.read_cloud(t, name, {{"x"}, {"y"}, {"z"}}, parcels))
      made_.problems.push_back(std::move(problem));
    made_.ranges.resize(3);
    for (std::size_t k = 0; k < 3; ++k)
      for (const double x : parcels.columns[k]) made_.ranges[k].add(x);
  }

  // scalarField, vectorList ...: their type of values.
  static const FoamType* list_type(std::string_view name) {
    for (const std::string_view end : {"Field", "List"})
      if (name.ends_with(end)) return foam_type(name.substr(0, name.size() - end.size()));
    return nullptr;
  }

  // A uniform list is bounded by the positions of its cloud.
  std::optional<FoamCount> expected(std::size_t block) const {
    for (const auto* name : {"coordinates", "positions"}) {
      const auto path = plain_or_gz((fs::path(path_).parent_path() / name).string());
      if (path.empty()) continue;
      return FoamCount{parcels_of(path, block), "positions", "entries"};
    }
    return std::nullopt;
  }

  static std::size_t parcels_of(const std::string& path, std::size_t block) {
    FoamBlocks positions(path);
    for (std::size_t k = 0; k <= block; ++k)
      if (!positions.next()) return 0;
    return read_cloud_count(positions);
  }

  const std::string path_;
  FoamBlocks file_;
  FoamFileSummary made_;
  std::vector<double> values_;
  std::vector<std::int32_t> labels_;
  std::size_t first_non_finite_ = 0;
  bool needs_mesh_ = false;
};

}  // namespace

bool is_openfoam_file(const std::string& path) {
  FoamStream head(read_head(path), path);
  try {
    if (head.peek() != 'F') return false;
  } catch (const FormatError&) {
    return false;  // a comment that is not closed
  }
  const std::string_view rest(head.at(), static_cast<std::size_t>(head.end() - head.at()));
  return rest.starts_with("FoamFile");
}

FoamFileSummary summarise_openfoam_file(const std::string& path) { return Summariser(path).run(); }

}  // namespace bedscope::readers
