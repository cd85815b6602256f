#pragma once

/// The loops over the springs of a block, compiled for each instruction set. Springs stand in groups of eight
/// lanes, in chunks as elements do.

#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// Every array is [group][8] but for the first two. Padding lanes have neither stiffness nor damping.
struct SpringView {
  const std::uint16_t* places;  ///< [group][end][8]: 4 times the node's number in its chunk
  const std::int32_t* slots;    ///< [group][aa ab ba bb][8], blocks of the matrix
  const double* stiffness;      ///< k [N/m]
  const double* length;         ///< l0 at rest [m]
  const double* damping;        ///< c [N s/m]; only dampers look at it
};

/// Of springs f_b = -k (1 - l0 / l) d, d = x_b - x_a, l = |d|, and of dampers f_b = -c n (n . dd/dt), n = d /
/// l. All functions add.
struct SpringKernels {
  void (*force)(const SpringView&, const Chunk&, const double* x, double* f);
  /// out += scale * (df/dx) p
  void (*product)(const SpringView&, const Chunk&, const double* x, double scale, const double* p,
                  double* out);
  void (*stiffness)(const SpringView&, const Chunk&, const double* x, double scale, double* blocks);
  /// k (l - l0)^2 / 2 of each spring [J], [group][8]
  void (*energy)(const SpringView&, const Chunk&, const double* x, double* energies);
  /// out += scale * (df/dv) p of the dampers
  void (*damping_product)(const SpringView&, const Chunk&, const double* x, double scale, const double* p,
                          double* out);
  void (*damping)(const SpringView&, const Chunk&, const double* x, double scale, double* blocks);
  /// As `stiffness`, each spring's matrix positive semi-definite: one that is shorter than at rest does not
  /// push sideways.
  void (*definite)(const SpringView&, const Chunk&, const double* x, double scale, double* blocks);
};

const SpringKernels* find_spring_kernels(Isa isa);

}  // namespace tissu
