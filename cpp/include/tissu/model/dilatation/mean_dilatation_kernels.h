#pragma once

/// The loops over the cells of a block with one volume ratio for each patch of cells, compiled for each
/// instruction set. The cells of a patch stand in one chunk, so that a kernel puts them together itself.

#include <cstdint>

#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// Cells of a chunk; those of larger cells have fewer.
inline constexpr int kMostChunkCells = 256;

struct MeanDilatationView {
  ElasticView cells;
  /// [group], and one more: the first patch of the chunk that begins at the group; of no meaning elsewhere.
  const std::int32_t* first_patch;
  const std::int32_t* first_lane;  ///< [patch], and one more: in `lanes`
  const std::int32_t* lanes;       ///< patch after patch, 8 times the group plus the lane of each cell
  const double* inverse_volumes;   ///< [group][8]: 1 / V of the patch at rest [1/m3], 0 for padding
};

/// What the cells of a chunk give to the matrices K = d2E/dx2 of their patches, by the number of the lane in
/// the chunk: with m and b summed over the patch,
///   K = sum_cells K_cell + slope (m b^T + b m^T) + curvature b b^T.
struct PatchParts {
  double* matrices;    ///< [lane][pair a <= b][9], column by column
  double* stresses;    ///< m: [lane][node][3]
  double* volumes;     ///< b = dv/dx: [lane][node][3]
  double* slopes;      ///< [lane], the same for all of a patch
  double* curvatures;  ///< [lane], the same for all of a patch
};

/// As ElasticKernels, but for `stiffness`, which writes and does not add.
struct MeanDilatationKernels {
  int nodes;
  void (*force)(const MeanDilatationView&, const Chunk&, const double* x, double* f);
  void (*product)(const MeanDilatationView&, const Chunk&, const double* x, double scale, const double* p,
                  double* out);
  void (*stiffness)(const MeanDilatationView&, const Chunk&, const double* x, const PatchParts& parts);
  void (*energy)(const MeanDilatationView&, const Chunk&, const double* x, double* energies);
  void (*stress)(const MeanDilatationView&, const Chunk&, const double* x, double* stresses,
                 double* volume_ratios);
};

/// Null when there are none for cells of so many nodes.
const MeanDilatationKernels* find_mean_dilatation_kernels(Isa isa, int nodes);

}  // namespace tissu
