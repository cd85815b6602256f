#pragma once

/// The elastic energy of cells that a repair replaces, and of those that come instead.

#include <cstdint>
#include <optional>

#include "tissu/base/isa.h"
#include "tissu/edit/repair/plan_repair.h"
#include "tissu/model/elastic_block.h"

namespace tissu {

/// Whether the energy of the second patch differs from that of the first by at most a share of it. Changes
/// below the energy of a strain of 1e-6 are rounding. Both are made of what a cell of a block is made of.
bool is_small_jump(const ElasticBlock& block, std::size_t cell, std::optional<Isa> isa,
                   const PatchCells& before, const PatchCells& after, double share);

}  // namespace tissu
