// SPDX-License-Identifier: BSD-3-Clause
// bedscope-digitise: the program behind `bedscope digitise`.
#include <fmt/format.h>

#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/output_file.hpp"
#include "app/commands.hpp"
#include "app/figure_file.hpp"
#include "readers/error.hpp"
#include "validation/digitise/picture_file.hpp"
#include "validation/digitise/suggest.hpp"
#include "validation/digitise/table.hpp"

namespace bedscope::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  Common common;
  std::string figure, output;
  std::vector<std::string> images;
  bool suggest = false;
};

/// What one picture gives, ready to be written.
struct Product {
  fs::path csv, overlay;
  std::string table, picture;
  std::string image;
  digitise::Digitised found;
};

/// Throws InputError where `output` would overwrite one of `inputs`, whatever it is called.
void check_is_no_input(const fs::path& output, const std::vector<std::string>& inputs) {
  for (const auto& input : inputs) {
    std::error_code none;  // one of them is not there
    if (fs::equivalent(output, input, none))
      throw InputError("{}: expected a place to write to, found the input {}", output.string(),
                       input);
  }
}

/// Where the tables and the pictures go; each to a place of its own, and none onto an input.
std::vector<Product> places_of(const Options& options, const std::vector<std::string>& images) {
  const bool many = images.size() > 1;
  std::vector<Product> products;
  for (const auto& image : images) {
    fs::path csv = options.output;
    const auto own = fs::path(many ? image : options.figure).stem().string() + ".digitised.csv";
    if (options.output.empty())
      csv = fs::path(many ? image : options.figure).parent_path() / own;
    else if (many || fs::is_directory(csv))
      csv /= own;
    for (const auto& other : products)
      if (other.csv == csv)
        throw InputError("{}: expected pictures of different names, found {} and {}",
                         options.figure, other.image, image);
    Product product;
    product.image = image;
    product.csv = csv;
    product.overlay = csv.parent_path() / (fs::path(image).stem().string() + ".digitised.png");
    if (product.overlay.lexically_normal() == csv.lexically_normal())
      throw InputError("{}: expected another name for the table than that of the picture beside it",
                       csv.string());
    products.push_back(std::move(product));
  }
  auto inputs = images;
  inputs.push_back(options.figure);
  for (const auto& product : products) {
    check_is_no_input(product.csv, inputs);
    check_is_no_input(product.overlay, inputs);
  }
  return products;
}

void digitise_one(const digitise::Figure& figure, Product& product) {
  const auto picture = digitise::read_picture(product.image);
  product.found = digitise::digitise(picture.image, picture.lossy, figure, product.image);
  if (picture.turned)
    product.found.notes.insert(product.found.notes.begin(),
                               "turned as the file's EXIF orientation says");
  product.table = digitise::table_of(product.found, figure);
  product.picture = digitise::png_of(product.found.overlay);
  product.found.overlay.release();
}

/// What may be wrong goes to stderr, even where nothing else is said.
void say(const Product& product, const Common& common) {
  const auto& found = product.found;
  for (const auto& doubt : found.doubts)
    fmt::print(stderr, "bedscope: {}: doubtful: {}\n", product.image, doubt);
  if (common.json) {
    nlohmann::ordered_json json{{"image", product.image},
                                {"csv", product.csv.string()},
                                {"overlay", product.overlay.string()},
                                {"rotation", found.angle},
                                {"series", nlohmann::ordered_json::array()},
                                {"notes", found.notes},
                                {"doubts", found.doubts}};
    for (const auto& series : found.series)
      json["series"].push_back(
          {{"name", series.name}, {"points", series.points.size()}, {"shape", series.shape}});
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  if (common.quiet) return;
  for (const auto& series : found.series)
    fmt::print("{}: {} points{}\n", series.name, series.points.size(),
               series.shape.empty() ? "" : fmt::format(" ({})", series.shape));
  if (found.angle != 0) fmt::print("turned upright by {:.2f} degrees\n", -found.angle);
  for (const auto& note : found.notes) fmt::print("{}\n", note);
  fmt::print("written: {}, {}\n", product.csv.string(), product.overlay.string());
}

void run_digitise(const Options& options) {
  auto file = read_figure(options.figure);
  if (!options.images.empty()) file.images = options.images;
  if (file.images.empty())
    throw InputError("{}: image is missing: expected a picture's name, there or as --image",
                     options.figure);
  auto products = places_of(options, file.images);
  for (auto& product : products) digitise_one(file.figure, product);
  std::deque<analysis::OutputFile> outputs;  // all of them, or none
  for (const auto& product : products) {
    analysis::write_part(outputs.emplace_back(product.csv), product.table);
    analysis::write_part(outputs.emplace_back(product.overlay), product.picture);
  }
  for (auto& output : outputs) output.commit();
  for (const auto& product : products) say(product, options.common);
}

void run_suggest(const Options& options) {
  if (!options.output.empty()) check_is_no_input(options.output, {options.figure});
  const auto picture = digitise::read_picture(options.figure);
  std::string text = picture.turned ? "# Pixels of the picture as viewers show it, turned.\n" : "";
  text +=
      digitise::suggest(picture.image, picture.lossy, fs::path(options.figure).filename().string());
  if (options.output.empty())
    fmt::print("{}", text);
  else
    analysis::write_file(options.output, text);
}

}  // namespace
}  // namespace bedscope::app

int main(int argc, char** argv) {
  using namespace bedscope;
  return app::exit_code_of([&] {
    app::Options options;
    CLI::App command("A curve out of a picture of a plot, with the uncertainty of every point");
    command.name("bedscope digitise");
    command
        .add_option("figure", options.figure,
                    "the figure's file (TOML), or a picture with --suggest")
        ->required();
    command.add_option("-o,--output", options.output,
                       "the table (CSV); a folder for several pictures");
    command.add_option("--image", options.images,
                       "pictures of the figure's layout, instead of the file's");
    command.add_flag("--suggest", options.suggest,
                     "print a figure file with the axes and ticks of a picture");
    app::add_common(command, options.common);
    try {
      command.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help
      return command.exit(asked);
    }
    if (options.suggest)
      app::run_suggest(options);
    else
      app::run_digitise(options);
    return app::done;
  });
}
