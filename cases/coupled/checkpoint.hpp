// SPDX-License-Identifier: GPL-3.0-or-later
// The complete state of a run, in checkpoint/<step>/: dem.restart by LIGGGHTS, gas.<rank> with the
// bits of all fields, state.json with the rest. A folder appears under its name when it is
// complete.
#pragma once

#include <mpi.h>

#include <nlohmann/json.hpp>

#include "cases/coupled/dem.hpp"
#include "cases/coupled/feed.hpp"
#include "cases/coupled/gas.hpp"

namespace bedscope::coupled {

/// Collective. Earlier checkpoints are removed once this one is complete.
void save_checkpoint(MPI_Comm comm, const Gas& gas, Dem& dem, const Feed& feed,
                     const nlohmann::json& record);

/// Opens dem, loads gas and feed, from the latest checkpoint; gives the record back. Throws
/// BadInput where there is none or it is of another run.
nlohmann::json load_checkpoint(MPI_Comm comm, Gas& gas, Dem& dem, Feed& feed);

/// The particles of the checkpoint just written, as a run that is resumed would have them.
void reopen(Dem& dem);

bool has_checkpoint();

}  // namespace bedscope::coupled
