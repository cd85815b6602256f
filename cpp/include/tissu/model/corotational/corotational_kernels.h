#pragma once

/// The loops over the cells of a corotational block, compiled for each instruction set.

#include <cstdint>

#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// Which rotation a cell has: none, that of its edges at the centre, or the one nearest to F at the centre.
enum class Rotation : std::uint8_t { small, frame, polar };

struct CorotationalView {
  ElasticView cells;
  /// [group][6][8]: upper triangle of J^-1 at the centre; null where one J serves the whole cell.
  const double* centres;
  Rotation rotation;
};

/// As ElasticKernels: all functions add to what they write, but for `stress`.
struct CorotationalKernels {
  std::string_view element;
  bool affine;  ///< one J for each cell, upper triangular
  bool exact;   ///< the force is the gradient of the energy, and the tangent its derivative
  void (*force)(const CorotationalView&, const Chunk&, const double* x, double* f);
  void (*product)(const CorotationalView&, const Chunk&, const double* x, double scale, const double* p,
                  double* out);
  void (*stiffness)(const CorotationalView&, const Chunk&, const double* x, double scale, double* blocks);
  void (*energy)(const CorotationalView&, const Chunk&, const double* x, double* energies);
  void (*stress)(const CorotationalView&, const Chunk&, const double* x, double* stresses,
                 double* volume_ratios);
  /// As `stiffness`, each cell's matrix replaced by the nearest positive semi-definite one; null where it is
  /// so in every state.
  void (*definite)(const CorotationalView&, const Chunk&, const double* x, double scale, double* blocks);
};

/// Null when there are none.
const CorotationalKernels* find_corotational_kernels(Isa isa, std::string_view element, bool affine,
                                                     bool exact);

}  // namespace tissu
