// SPDX-License-Identifier: BSD-3-Clause
// Memory that ends is an exception for the caller, wherever in an analysis it ends: also in the
// loops that are compiled for several processors, through which GCC 12 lets none pass.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "analysis/analyse_run.hpp"
#include "tests/readers/test_files.hpp"

namespace {

// The one of the large allocations that brings `left` to 0 fails. Small ones do not: libstdc++ ends
// the program where its directory_iterator gets no memory for a name.
constexpr std::size_t large = 1024;  // less than the sums of a type, more than a path
std::size_t left = std::numeric_limits<std::size_t>::max();

void* until_it_ends(std::size_t size) {
  if (size >= large && --left == 0) throw std::bad_alloc();
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return until_it_ends(size); }
void* operator new[](std::size_t size) { return until_it_ends(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace bedscope::analysis {
namespace {

// Every particle has a type of its own, so that the loop over them must allocate for each.
std::string dump() {
  constexpr int particles = 6;
  auto text = readers::dump_header(100, particles, "id type x y z vx vz radius temperature",
                                   "ff ff ff\n0 0.1\n0 0.01\n0 0.2\n");
  for (int i = 0; i < particles; ++i)
    text += fmt::format("{0} {0} {1:.6g} 0.005 {2:.6g} 0.1 0 0.001 350 \n", i + 1, 0.01 * (i + 1),
                        0.02 * (i + 1));
  return text;
}

TEST(NoMemory, IsAnExceptionWhereverItEnds) {
  const readers::TemporaryFolder folder;
  RunSettings settings;
  settings.label = "run";
  settings.particles = folder.write("dump100.liggghts", dump());
  settings.time_step = 1e-4;
  settings.domain = {{{0, 0, 0}, {0.1, 0.01, 0.2}}};
  settings.cell = {0.005, 0.005};
  settings.density.all = 2500;
  settings.average = {-INFINITY, INFINITY};
  settings.species = {{"hot", "temperature", SpeciesRule::Comparison::greater, 340}};
  AnalysisOptions options;
  options.threads = 1;
  options.pictures = false;
  std::size_t failed = 0;
  for (const char* mapping : {"centre", "exact", "divided", "gaussian"}) {
    settings.mapping = mapping;
    for (std::size_t last = 1;; ++last) {
      left = last;
      try {
        analyse_run(settings, options);
        const bool never_ended = left > 0 && left < last;
        left = std::numeric_limits<std::size_t>::max();
        ASSERT_TRUE(never_ended) << "caught where nobody was told, allocation " << last;
        break;
      } catch (const std::bad_alloc&) {
        ++failed;
      }
    }
  }
  EXPECT_GT(failed, 4U * 2U * 5U);  // of each mapping, two for each type: its sums, its profiles
}

}  // namespace
}  // namespace bedscope::analysis
