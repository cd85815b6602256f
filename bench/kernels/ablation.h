#pragma once

/// The force of St-Venant–Kirchhoff on tetrahedra with parts left out: what a part costs is what its absence
/// saves. A kernel of its own, so that the core has no switches.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tissu/cell/elastic_kernels.h"

namespace tissu::bench {

/// Tetrahedra in groups of eight lanes and in chunks, as the core stores them.
struct AblationBlock {
  const std::uint16_t* places;  ///< [group][4][8]
  const Chunk* chunks;
  std::size_t chunk_count;
  const double* rest;  ///< [group][10][8]: J^-1 row by row, volume [m3]
  std::size_t groups;
  double lambda;  ///< [Pa]
  double mu;      ///< [Pa]
};

struct AblationRow {
  const char* name;
  /// What is computed and not scattered is summed into sink[8].
  void (*run)(const AblationBlock& block, const double* x, double* f, double* sink);
};

using AblationKernels = std::array<AblationRow, 6>;

/// Adds the rows "ablation/...", all on the mesh of about `count` tetrahedra.
void add_ablation_rows(int count);

}  // namespace tissu::bench
