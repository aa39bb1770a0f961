// SPDX-License-Identifier: BSD-3-Clause
#include "readers/forms.hpp"

#include <algorithm>
#include <array>

#include "readers/error.hpp"
#include "readers/source.hpp"
#include "readers/vtk_xml.hpp"

namespace bedscope::readers {

extern const Form liggghts_bin, liggghts_text, openfoam_cloud, vtk_legacy, vtk_xml;

std::span<const Form* const> forms() {
  static constexpr std::array<const Form*, 5> all{&liggghts_bin, &liggghts_text, &openfoam_cloud,
                                                  &vtk_legacy, &vtk_xml};
  return all;
}

namespace {

/// Files that are often taken for particle dumps, by what their first bytes hold.
struct Stranger {
  std::string_view begins;
  std::string_view what;
};
constexpr std::array strangers{
    Stranger{"version https://git-lfs", "a git-lfs pointer, not data: run git lfs pull"},
    Stranger{"vtk DataFile", "line 1: expected \"# vtk DataFile Version\""},
    Stranger{"# vtk", "line 1: expected \"# vtk DataFile Version\""},
    Stranger{"solid ", "an STL mesh, not particles"},
    Stranger{"STL File", "an STL mesh, not particles"},
    Stranger{"<!DOCTYPE html", "an HTML page, not particles"},
    Stranger{"<html", "an HTML page, not particles"},
    Stranger{"LIGGGHTS (", "a LIGGGHTS log, not particles"},
    Stranger{"LAMMPS data file", "a LIGGGHTS data file (write_data), not a dump"},
    Stranger{"# Probe ", "a table of OpenFOAM's probes: probes = ... of a [[run]]"},
    Stranger{"LAMMPS (", "a LAMMPS log, not particles"},
    Stranger{"LammpS RestartT", "a LAMMPS restart file, not a dump"},
    Stranger{"---\ncreator: LAMMPS", "a dump in YAML, a form not known; use dump custom"},
    Stranger{"\x89HDF", "an HDF5 file, a form not known for particles; use dump custom"},
    Stranger{"CDF", "a NetCDF file, a form not known for particles; use dump custom"},
    Stranger{"\x28\xb5\x2f\xfd", "compressed by zstd: unpack it, or use gzip"},
    Stranger{"\xfd"
             "7zXZ",
             "compressed by xz: unpack it, or use gzip"},
    Stranger{"\xff\xfeI", "text in UTF-16: save it as UTF-8 or ASCII"},
    Stranger{"BZh", "compressed by bzip2: unpack it, or use gzip"},
    Stranger{"\x04\x22\x4d\x18", "compressed by lz4: unpack it, or use gzip"},
    Stranger{"PK\x03\x04", "a zip archive (or .npz): unpack it"},
    Stranger{"\x93NUMPY", "an array of numpy, a form not known; use dump custom"},
    Stranger{"Number of particles = ", "a dump cfg, a form not known; use dump custom"},
    Stranger{"#format x_y_z_r", "text of Yade's export, a form not known; use its VTKRecorder"},
};

/// `dump xyz` and `dump extxyz`: the number of atoms, "Atoms. Timestep: 100" or "Timestep: 100 ...
/// Properties=species:S:1:pos:R:3", rows of a type and a position.
bool is_xyz(std::string_view head) {
  const auto line = head.find('\n');
  if (line == 0 || head.substr(0, line).find_first_not_of("0123456789 \t\r") != head.npos)
    return false;
  const auto comment = head.substr(std::min(line, head.size() - 1) + 1);
  return comment.starts_with("Atoms") ||
         comment.substr(0, comment.find('\n')).find("Properties=") != comment.npos;
}

/// The mark of a tar archive behind the name and the numbers of its first member.
bool is_tar(std::string_view head) { return head.size() > 262 && head.substr(257, 5) == "ustar"; }

}  // namespace

const Form& identify(const std::string& path) { return identify(path, read_head(path)); }

const Form& identify(const std::string& path, std::string_view head) {
  if (head.empty()) throw FormatError("{}: file is empty", path);
  for (const auto* form : forms())
    if (form->matches != nullptr && form->matches(head)) return *form;
  for (const auto& stranger : strangers)
    if (head.starts_with(stranger.begins)) throw FormatError("{}: {}", path, stranger.what);
  if (head.find("FoamFile") != head.npos)
    throw FormatError("{}: a file of an OpenFOAM case: name the case", path);
  if (is_tar(head)) throw FormatError("{}: a tar archive: unpack it", path);
  if (is_xyz(head)) throw FormatError("{}: an xyz dump: it holds no radius; use dump custom", path);
  if (const auto type = xml_root_type(head); !type.empty())
    throw FormatError("{}: VTK XML of type {}, not particles", path, type);
  if (head.substr(0, 64).find("LIGGGHTS") != head.npos)
    throw FormatError("{}: offset 0: a LIGGGHTS restart file, not a dump", path);
  if (head.find_first_not_of("\r\n \t") == head.npos)
    throw FormatError("{}: no \"ITEM:\" found, only line ends", path);
  std::string names;
  for (const auto* form : forms()) names += (names.empty() ? "" : ", ") + std::string(form->name);
  throw FormatError("{}: not a particle dump of a known form ({})", path, names);
}

}  // namespace bedscope::readers
