#pragma once

/// The constants of a block's laws, laid as kernels read them.

#include <cstddef>
#include <cstdint>
#include <span>

#include "tissu/base/array.h"
#include "tissu/model/elastic_block.h"

namespace tissu {

struct LawConstants {
  AlignedVector<double> values;  ///< [group or one][constant][8], law after law
  std::ptrdiff_t stride = 0;     ///< from one group to the next; 0 where one group serves all cells
};

/// `cells` holds the cell of each lane, whole groups of them. Pieces of a dimension below 3 are free to thin:
/// their laws get the lambda of that, where they have one.
LawConstants lay_law_constants(const ElasticBlock& block, std::span<const std::int32_t> cells, int dimension);

}  // namespace tissu
