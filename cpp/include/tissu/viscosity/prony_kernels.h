#pragma once

/// The loops of the Prony series over the elements of one block, compiled for each instruction set.

#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// Constants are Lamé's, [group or one][2][8].
struct PronyView : ElasticView {
  /// [group][point][1 + branches][6][8], xx yy zz yz xz xy: E at the end of the last step, then each branch's
  /// elastic strain q.
  const double* memory;
  int branches;
  // Of each branch, for the time since the memory was written:
  const double* shares;  ///< g
  const double* decay;   ///< a = exp(-h / tau)
  const double* rise;    ///< b = (tau / h) (1 - a): q = a q0 + b (E - E0)
};

struct PronyKernels {
  int nodes;
  const PointLaws* at_point;  ///< of a PronyView: with it the kernels of the shape serve for the forces
  /// Energy in the branches' springs of each element [J], [group][8], added.
  void (*energy)(const PronyView&, const Chunk&, const double* x, double* energies);
  /// Writes the memory at the end of a step into `memory`, which may be that of the view.
  void (*advance)(const PronyView&, const Chunk&, const double* x, double* memory);
};

/// Of a volume element; null when there are none.
const PronyKernels* find_prony_kernels(Isa isa, int nodes);

}  // namespace tissu
