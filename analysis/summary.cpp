// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/summary.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "analysis/output_file.hpp"

namespace bedscope::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t end_bytes = 4096;  // hashed at each end of a file

class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      hash_ ^= static_cast<unsigned char>(byte);
      hash_ *= 0x100000001b3ULL;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

bool add_part(Fnv1a& hash, std::FILE* file, std::uint64_t offset, std::size_t size) {
  std::array<char, 2 * end_bytes> bytes{};
  if (::fseeko(file, static_cast<off_t>(offset), SEEK_SET) != 0) return false;
  if (std::fread(bytes.data(), 1, size, file) != size) return false;
  hash.add({bytes.data(), size});
  return true;
}

bool add_file(Fnv1a& hash, const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (error || !file) return false;
  std::setvbuf(file.get(), nullptr, _IONBF, 0);  // or each end would cost a buffer's length
  hash.add(path.filename().string());
  hash.add(std::string_view("\0", 1));
  std::array<char, 8> size_bytes{};
  for (std::size_t i = 0; i < size_bytes.size(); ++i)
    size_bytes[i] = static_cast<char>(size >> (8 * i) & 0xFF);
  hash.add({size_bytes.data(), size_bytes.size()});
  if (size <= 2 * end_bytes) return add_part(hash, file.get(), 0, size);
  return add_part(hash, file.get(), 0, end_bytes) &&
         add_part(hash, file.get(), size - end_bytes, end_bytes);
}

Json bubble_summary(const RunResult& run) {
  if (!run.bubbles) return nullptr;
  const Bubbles& bubbles = *run.bubbles;
  return {{"mean_number", bubbles.number.value},     {"mean_number_ci95", bubbles.number.ci95},
          {"mean_diameter", bubbles.diameter.value}, {"mean_diameter_ci95", bubbles.diameter.ci95},
          {"mean_velocity", bubbles.velocity.value}, {"mean_velocity_ci95", bubbles.velocity.ci95}};
}

// nlohmann::json writes NaN and infinities as null, which is what we promise.
Json run_summary(const RunResult& run) {
  const Json unknown = nullptr;
  Json summary = {
      {"label", run.label},
      {"snapshots", run.window.snapshots},
      {"from", run.time_known ? Json(run.window.from) : unknown},
      {"to", run.time_known ? Json(run.window.to) : unknown},
      {"mean_holdup", run.mean_holdup.value},
      {"mean_holdup_ci95", run.mean_holdup.ci95},
      {"inventory_kg", run.density_known ? Json(run.inventory_mass.value) : unknown},
      {"inventory_kg_ci95", run.density_known ? Json(run.inventory_mass.ci95) : unknown},
      {"mean_occurrence", run.mean_occurrence.value},
      {"mean_occurrence_ci95", run.mean_occurrence.ci95},
      {"mean_bed_voidage", run.bed_voidage.value},
      {"mean_bed_voidage_ci95", run.bed_voidage.ci95},
      {"independent_samples", run.independent_samples},
      {"outside_fraction", run.outside_fraction},
      {"bytes_read", run.bytes_read},
      {"seconds", run.seconds},
      {"mapping", run.mapping},
      {"domain_assumed", run.domain_assumed},
      {"window", {{"automatic", run.window.automatic}, {"steady", run.window.steady}}},
      {"problems", run.problems}};
  if (run.gas.present)
    summary.update({{"gas_times", run.gas.times},
                    {"gas_matched", run.gas.checks.size()},
                    {"voidage_ratio", run.gas.voidage_ratio.value},
                    {"voidage_ratio_ci95", run.gas.voidage_ratio.ci95},
                    {"pressure_drop", run.gas.pressure_drop.value},
                    {"pressure_drop_ci95", run.gas.pressure_drop.ci95},
                    {"bed_weight_over_area", run.gas.bed_weight_by_area}});
  return summary;
}

Json input_summary(const RunResult& run) {
  const std::string hash = fingerprint(run.inputs);
  return {{"run", run.label},
          {"files", run.inputs.size()},
          {"hash", hash.empty() ? Json(nullptr) : Json(hash)},
          {"hashed", fmt::format("FNV-1a 64 of name, size, first and last {} bytes of each file",
                                 end_bytes)}};
}

}  // namespace

std::string fingerprint(const std::vector<std::string>& files) {
  Fnv1a hash;
  for (const std::string& file : files)
    if (!add_file(hash, file)) return {};
  return files.empty() ? std::string() : fmt::format("{:016x}", hash.value());
}

std::string summary_text(std::span<const RunResult> runs) {
  Json summary = {{"runs", Json::array()},
                  {"checks", Json::array()},
                  {"version", BEDSCOPE_VERSION},
                  {"inputs", Json::array()}};
  for (const RunResult& run : runs) {
    summary["runs"].push_back(run_summary(run));
    summary["inputs"].push_back(input_summary(run));
  }
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(std::span<const RunResult> runs, const std::filesystem::path& path) {
  write_file(path, summary_text(runs));
}

}  // namespace bedscope::analysis
