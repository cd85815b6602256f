#pragma once

/// The loops of the mass-tensor model over the nodes, edges, faces or tetrahedra of one block, compiled for
/// each instruction set.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tissu/base/isa.h"
#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// What the loops read. Constants of lanes that only pad are zero.
struct MassTensorView {
  const std::uint16_t* places;  ///< [group][size][8]: 4 times the node's number in its chunk
  const std::int32_t* slots;    ///< [group][a][b][8], blocks of the matrix
  const double* constants;      ///< [group][reals][8]
  const double* rest;           ///< positions at rest [m], of the whole world
  std::int32_t origin;          ///< node from whose displacement the others are counted
};

/// All functions add to what they write. x, f, p are arrays of 3-vectors of the whole world.
struct MassTensorKernels {
  bool linear;  ///< Hooke: only the matrices B
  int size;     ///< nodes: 1 a node, 2 an edge, 3 a face, 4 a tetrahedron
  int reals;    ///< constants of each
  void (*force)(const MassTensorView&, const Chunk&, const double* x, double* f);
  /// out += scale * (df/dx) p
  void (*product)(const MassTensorView&, const Chunk&, const double* x, double scale, const double* p,
                  double* out);
  /// blocks += scale * df/dx
  void (*stiffness)(const MassTensorView&, const Chunk&, const double* x, double scale, double* blocks);
  /// energy of each node, edge, face or tetrahedron [J], [group][8]
  void (*energy)(const MassTensorView&, const Chunk&, const double* x, double* energies);
};

/// Null when there are none of this size: Hooke has no constants on faces and tetrahedra.
const MassTensorKernels* find_mass_tensor_kernels(Isa isa, bool linear, int size);

}  // namespace tissu
