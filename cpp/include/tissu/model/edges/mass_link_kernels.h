#pragma once

/// The loops of the mass-link model over the tetrahedra of one block, compiled for each instruction set.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tissu/base/isa.h"
#include "tissu/cell/elastic_kernels.h"

namespace tissu {

/// What the loops read. Constants of lanes that only pad make no force.
struct MassLinkView {
  const std::uint16_t* places;  ///< [group][4][8]: 4 times the node's number in its chunk
  const std::int32_t* slots;    ///< [group][a][b][8], blocks of the matrix
  const double* constants;      ///< [group][reals][8]
};

/// All functions add to what they write, but for `stress`. x, f, p are arrays of 3-vectors of the whole
/// world.
struct MassLinkKernels {
  std::string_view law;
  int reals;  ///< constants of a tetrahedron
  void (*force)(const MassLinkView&, const Chunk&, const double* x, double* f);
  /// out += scale * (df/dx) p
  void (*product)(const MassLinkView&, const Chunk&, const double* x, double scale, const double* p,
                  double* out);
  /// blocks += scale * df/dx
  void (*stiffness)(const MassLinkView&, const Chunk&, const double* x, double scale, double* blocks);
  /// energy of each element [J], [group][8]
  void (*energy)(const MassLinkView&, const Chunk&, const double* x, double* energies);
  /// Cauchy stress [Pa] xx yy zz yz xz xy, [group][6][8], and volume as it is now [m3], [group][8]
  void (*stress)(const MassLinkView&, const Chunk&, const double* x, double* stresses, double* volumes);
  /// As `stiffness`, each cell's matrix replaced by the nearest positive semi-definite one.
  void (*definite)(const MassLinkView&, const Chunk&, const double* x, double scale, double* blocks);
};

/// Null when the law has no form in edge lengths here.
const MassLinkKernels* find_mass_link_kernels(Isa isa, std::string_view law);

}  // namespace tissu
