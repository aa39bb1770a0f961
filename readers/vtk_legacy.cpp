// SPDX-License-Identifier: BSD-3-Clause
// Legacy VTK files of particles, ASCII or big-endian binary, versions 1.0 to 5.1, as LIGGGHTS
// (`dump custom/vtk`), LPP and ParaView write them. One snapshot a file; the step is in its name.
// Reference: VTK file formats (vtk.org), sections "Simple Legacy Formats" and, for 5.1, the OFFSETS
// and CONNECTIVITY arrays of cells.
#include <algorithm>
#include <array>

#include "readers/columns.hpp"
#include "readers/error.hpp"
#include "readers/forms.hpp"
#include "readers/vtk_legacy_walk.hpp"

namespace bedscope::readers {
namespace {

using vtk_legacy_file::LegacyWalk;

FileScan scan(const std::string& path, bool thorough) {
  constexpr std::size_t first_look = 4096;
  std::vector<char> buffer;
  LegacyWalk walk(path, buffer, thorough ? ByteWindow::piece : first_look);
  std::array<std::vector<double>, 3> positions;
  if (thorough) {
    for (int axis = 0; axis < 3; ++axis) walk.want(axis, positions[static_cast<std::size_t>(axis)]);
    walk.run();
  } else {
    walk.run_to_points();
  }
  FileScan found;
  if (thorough || walk.not_particles().starts_with("a "))
    found.not_particles = walk.not_particles();
  if (!found.not_particles.empty()) return found;
  Located located;
  located.particles = walk.points();
  located.time = walk.time();
  if (thorough) {
    located.columns = std::make_shared<const std::vector<std::string>>(walk.arrays());
    located.parts = std::make_shared<const std::vector<std::string>>(walk.names());
    const auto ghosts = walk.ghosts();
    located.ghosts = std::count(ghosts.begin(), ghosts.end(), true);
  }
  found.snapshots.push_back(std::move(located));
  if (!walk.trailing().empty()) found.problems.push_back(walk.trailing());
  return found;
}

void leave_out(const std::vector<bool>& ghosts, std::size_t columns, Scratch& scratch,
               Snapshot& out) {
  for (std::size_t k = 0; k < columns; ++k) drop_ghosts(ghosts, scratch.raw[k]);
  out.particles = static_cast<std::size_t>(std::count(ghosts.begin(), ghosts.end(), false));
}

void read(const std::string& path, const Located& where, const Request& request, Snapshot& out,
          Scratch& scratch) {
  // The names are known only after the walk, so the first guess is the snapshot before; a wrong one
  // costs a second walk.
  ColumnPlan plan;
  out.step = no_step;
  out.box = {};
  out.bytes_read = 0;
  for (bool sure = false;;) {
    bool planned = true;
    try {
      plan = plan_columns(scratch.names, request, path);
    } catch (const FormatError&) {
      if (sure) throw;
      planned = false;
    }
    if (!planned) plan.parse = {0, 1, 2};  // positions: numbers that are parsed are counted best
    LegacyWalk walk(path, scratch.bytes);
    if (scratch.raw.size() < plan.parse.size()) scratch.raw.resize(plan.parse.size());
    for (std::size_t k = 0; k < plan.parse.size(); ++k) walk.want(plan.parse[k], scratch.raw[k]);
    walk.run();
    if (const auto what = walk.not_particles(); !what.empty())
      throw FormatError("{}: {}", path, what);
    out.bytes_read += walk.bytes_from_disk();
    if (walk.points() == 0) {  // LPP writes a file of 0 particles without any array
      out.particles = 0;
      out.columns.assign(request.size(), {});
      return;
    }
    if (planned && (sure || walk.names() == scratch.names)) {
      out.particles = static_cast<std::size_t>(walk.points());
      out.time = walk.time();
      if (const auto ghosts = walk.ghosts(); where.without_ghosts && !ghosts.empty())
        leave_out(ghosts, plan.parse.size(), scratch, out);
      break;
    }
    scratch.names = walk.names();
    sure = true;
  }
  finish_columns(plan, scratch.raw, out, path);
}

std::string place(const std::string& path, const Located& where, std::size_t row) {
  if (!where.without_ghosts) return fmt::format("point {}", row);
  std::vector<char> buffer;
  LegacyWalk walk(path, buffer);
  walk.run();
  const auto ghosts = walk.ghosts();
  for (std::size_t point = 0; point < ghosts.size() && point <= row; ++point) row += ghosts[point];
  return fmt::format("point {}", row);
}

bool matches(std::string_view head) { return head.starts_with("# vtk DataFile Version"); }

}  // namespace

extern const Form vtk_legacy;
constinit const Form vtk_legacy{
    .name = "vtk-legacy",
    .description = "legacy VTK particles, ASCII or binary (dump custom/vtk, LPP, ParaView)",
    .reference = "https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html",
    .matches = matches,
    .scan = scan,
    .read = read,
    .place = place,
};

}  // namespace bedscope::readers
