// SPDX-License-Identifier: BSD-3-Clause
// An OpenFOAM case on disk, read without OpenFOAM: its times, its mesh, its fields, whether whole,
// decomposed (processor0 ...) or collated (processors4, processors4_0-1).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/gas_form.hpp"
#include "readers/snapshot.hpp"

namespace bedscope::readers {

/// Which copy is read where a case holds several.
enum class Decomposition {
  automatic,  ///< reconstructed if that has every time, else the ranks; never a guess between two
  reconstructed,  ///< the times in the case itself
  processors,     ///< the ranks, whichever kind is there
  separate,       ///< processor0, processor1 ...
  collated        ///< processorsN
};

struct OpenFoamOptions {
  Decomposition decomposition = Decomposition::automatic;
  std::string region;  ///< empty: the default region
  /// A case whose clouds alone are wanted needs no mesh, unless they name its cells.
  bool mesh_optional = false;
};

/// Is the folder a case: does it hold a mesh, ranks, or times with clouds?
bool is_openfoam_case(const std::string& folder);

/// The regions of a case that have a mesh, "" for the default one.
std::vector<std::string> openfoam_regions(const std::string& folder);

/// Opening lists the times, reads the mesh and makes sure that the last time is whole. All further
/// reading is const, thread-safe, and keeps no file open.
class OpenFoamCase final : public GasForm {
 public:
  struct Impl;  ///< openfoam_case_impl.hpp

  /// Throws InputError where the case leaves a choice (both kinds of ranks, several regions), and
  /// FormatError for a mesh that is wrong or a case without one complete time.
  static OpenFoamCase open(const std::string& path, const OpenFoamOptions& options = {});

  /// In ascending order, those only that every rank has.
  const std::vector<GasTime>& times() const override;
  const std::vector<std::string>& fields_at(std::size_t time) const;

  /// Cells in the order of the whole case where cellProcAddressing gives it, else rank after rank.
  const Mesh& mesh() const;  ///< at the first time
  bool moving() const;       ///< do times bring points or faces of their own?
  /// The mesh at a time: the one of mesh(), or read from disk if the mesh moves.
  std::shared_ptr<const Mesh> mesh_at(std::size_t time) const override;

  void read(std::size_t time, std::string_view field, FieldValues& out) const override;
  /// The files of a field at a time: one, or one a rank.
  std::vector<std::string> files(std::size_t time, std::string_view field) const override;

  /// Lagrangian clouds at a time (kinematicCloud ...); a cloud without parcels may be absent. One
  /// that bears the name of its time (CFDEM in serial) is called particleCloud.
  std::vector<std::string> clouds_at(std::size_t time) const;
  /// The number of parcels as declared, without reading them. 0 also where the solver has the cloud
  /// and wrote no parcels; nothing where the time does not know it. Throws FormatError.
  std::optional<std::size_t> parcels(std::size_t time, std::string_view cloud) const;
  /// The columns of a cloud: x y z, vx vy vz (U or v), its fields by name (vectors as f[1] f[2]
  /// f[3]) and by ours: radius, diameter, id (origId), type (typeId).
  std::vector<std::string> cloud_columns(std::size_t time, std::string_view cloud) const;
  /// Reads a cloud as particles, rank after rank. One parcel stands for nParticle particles.
  /// Returns what is worth a warning. Throws FormatError (counts that differ, negative diameters).
  std::vector<std::string> read_cloud(std::size_t time, std::string_view cloud,
                                      const Request& request, Snapshot& out) const;

  /// Things worth a warning: times that a rank lacks, fields missing at some times, a last time
  /// that is cut (and left out), .gz beside plain files.
  const std::vector<std::string>& problems() const override;
  const std::vector<std::string>& regions() const;  ///< besides the default one
  std::size_t ranks() const;                        ///< 1 for a whole case
  bool collated() const;                            ///< are the ranks in common files?

 private:
  explicit OpenFoamCase(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

}  // namespace bedscope::readers
