// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/choice_cost.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>

#include "analysis/run_sums.hpp"
#include "readers/error.hpp"

namespace bedscope::analysis {
namespace {

/// CPU time of this thread [s].
double cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Removed at the end, whatever happens.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    auto pattern = (std::filesystem::temp_directory_path() / "bedscope_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw FileError("{}: {}", pattern, std::strerror(errno));
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// CPU time of the fastest of some repetitions [s].
template <class Work>
double fastest(int repeats, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int r = 0; r < repeats; ++r) {
    const double before = cpu_seconds();
    work();
    least = std::min(least, cpu_seconds() - before);
  }
  return least;
}

/// Reading a snapshot that is in memory from a file of another form.
ChoiceCost read_as(readers::DumpForm form, const readers::Snapshot& snapshot,
                   const readers::Request& request, int repeats) {
  const TemporaryFolder folder;
  const auto path = folder.path() / (form == readers::DumpForm::text     ? "dump1.liggghts"
                                     : form == readers::DumpForm::binary ? "dump1.bin"
                                                                         : "dump1.vtk");
  readers::write_dump(path, form, snapshot, request);
  readers::SeriesOptions options;
  for (std::size_t k = 0; k < request.size() && form == readers::DumpForm::binary; ++k)
    if (!snapshot.columns[k].empty()) options.columns.push_back(request[k].name);
  const auto series = readers::Series::open(path.string(), options);
  readers::Snapshot again;
  readers::Scratch scratch;
  ChoiceCost cost;
  cost.read = fastest(repeats, [&] { series.read(0, request, again, scratch); });
  cost.bytes = static_cast<double>(again.bytes_read);
  return cost;
}

}  // namespace

std::vector<ChoiceCost> time_choices(const readers::Series& series,
                                     const std::vector<RunSetup>& setups,
                                     const std::vector<Variant>& variants, const Window& window,
                                     std::size_t snapshots, int repeats) {
  std::vector<ChoiceCost> costs(variants.size());
  snapshots = std::min(snapshots, window.snapshots);
  const auto& request = setups.front().request_without_id;
  ProductScratch scratch;
  std::vector<RunSums> sums;
  sums.reserve(variants.size());
  for (const auto& setup : setups) sums.emplace_back(setup, false, false);
  std::vector<SnapshotProduct> products(variants.size());
  for (std::size_t k = 0; k < snapshots; ++k) {
    const std::size_t i = window.first + k * window.snapshots / snapshots;
    const double read =
        fastest(repeats, [&] { series.read(i, request, scratch.snapshot, scratch.reader); });
    const auto bytes = static_cast<double>(scratch.snapshot.bytes_read);
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const auto form = variants[v].form;
      const auto one = form == readers::DumpForm::as_it_is
                           ? ChoiceCost{.read = read, .bytes = bytes}
                           : read_as(form, scratch.snapshot, request, repeats);
      costs[v].read += one.read;
      costs[v].bytes += one.bytes;
      costs[v].products += fastest(repeats, [&] {
        sum_snapshot(setups[v], i, products[v], scratch);
        sums[v].add(products[v], 1);
      });
    }
  }
  for (auto& cost : costs)
    for (auto* part : {&cost.read, &cost.products, &cost.bytes})
      *part /= static_cast<double>(snapshots);
  return costs;
}

}  // namespace bedscope::analysis
