// SPDX-License-Identifier: BSD-3-Clause
// The index of an all-in-one dump, with changes that its checksum does not show.
#include "readers/dump_index.hpp"

#include "readers/series.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

constexpr std::string_view snapshots =
    "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
    "ITEM: ATOMS id x y z radius \n1 .1 .2 .3 .01 \n2 .4 .5 .6 .01 \n"
    "ITEM: TIMESTEP\n2\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
    "ITEM: ATOMS id x y z radius \n1 .1 .2 .3 .01 \n"
    "ITEM: TIMESTEP\n3\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
    "ITEM: ATOMS id x y z radius q \n1 .1 .2 .3 .01 5 \n";

/// Reads every snapshot that the index says is there.
void read_all(const std::string& dump, DumpIndex& index) {
  const auto series = Series::open(dump, {.index = &index});
  Snapshot snapshot;
  Scratch scratch;
  for (std::size_t i = 0; i < series.size(); ++i) {
    series.read(i, {{"x"}, {"radius", false}}, snapshot, scratch);
    require(snapshot.columns[0].size() == snapshot.particles, "columns as long as declared");
  }
}

}  // namespace

void use(std::string_view input) {
  static const MemoryFolder folder({{"dump", snapshots}});
  static const auto dump = folder.path() + "/dump", where = folder.path() + "/index";
  static const KeptFile index(where, [] {
    DumpIndex made("", where);
    read_all(dump, made);
    made.save();
  });
  index.change(input);
  DumpIndex changed(where, "");
  read_all(dump, changed);
}

}  // namespace bedscope::fuzz
