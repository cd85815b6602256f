#pragma once

/// The loops over the elements of one block, one function for each job, compiled for each instruction set.
/// Elements stand in groups of eight lanes; every array of a group is [entry][lane].

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tissu/base/isa.h"
#include "tissu/cell/chunk.h"
#include "tissu/law/law_kernels.h"

namespace tissu {

struct ElasticView;

/// The laws of a view at one point of the eight elements of a group: their sum, as F, P and dP/dF of
/// LawKernels, but written and not added. It lets one loop over elements serve any law.
struct PointLaws {
  void (*stress)(const ElasticView&, std::int32_t group, int point, const double* F, double* P);
  void (*stress_change)(const ElasticView&, std::int32_t group, int point, const double* F, const double* dF,
                        double* dP);
  void (*tangent)(const ElasticView&, std::int32_t group, int point, const double* F, double* A);
  /// The positive semi-definite tangent nearest to it.
  void (*definite)(const ElasticView&, std::int32_t group, int point, const double* F, double* A);
};

/// What a kernel reads of a block. Padding lanes repeat an element with zero volume, so they add nothing.
/// m is the reference dimension of the element. Where J is the same all over every cell, `rest` holds it
/// once: `rest_points` is 1.
struct ElasticView {
  const std::uint16_t* places;  ///< [group][node][8]: 4 times the node's number in its chunk
  const std::int32_t* slots;    ///< [group][a][b][8], blocks of the matrix
  const double* rest;  ///< [group][rest point][m m + 1, or 7][8]: J^-1 row by row, then the volume [m3]
  int rest_points;
  const double* weights;    ///< [point]: share of the volume in `rest` that belongs to the point
  const double* frames;     ///< [group][rest point][3][3][8]: axes that laws work in, null: those of space
  const double* constants;  ///< [group or one][constant][8], law after law
  std::ptrdiff_t constants_stride;  ///< doubles from one group to the next, 0 when one serves all
  // What kernels that are not made for one element and law look up:
  const double* gradients;  ///< [point][node][m], dN_a/dxi
  int points;
  const LawKernels* const* laws;  ///< their energies add up
  int law_count;
  const PointLaws* at_point;  ///< how they are asked
};

/// All functions add to what they write, but for `stress`. x, f, p are arrays of 3-vectors of the whole
/// world.
struct ElasticKernels {
  std::string_view element;     ///< empty: any element of this shape,
  std::string_view law;         ///< any law
  std::string_view quadrature;  ///< and any quadrature
  int nodes;
  int dimension;  ///< of the reference cell
  void (*force)(const ElasticView&, const Chunk&, const double* x, double* f);
  /// out += scale * (df/dx) p
  void (*product)(const ElasticView&, const Chunk&, const double* x, double scale, const double* p,
                  double* out);
  /// blocks += scale * df/dx
  void (*stiffness)(const ElasticView&, const Chunk&, const double* x, double scale, double* blocks);
  /// energy of each element [J], [group][8]
  void (*energy)(const ElasticView&, const Chunk&, const double* x, double* energies);
  /// mean over the element's volume of the Cauchy stress [Pa] xx yy zz yz xz xy, [group][6][8], and of det F,
  /// [group][8]
  void (*stress)(const ElasticView&, const Chunk&, const double* x, double* stresses, double* volume_ratios);
  /// Rest shapes hold the upper triangle of R^-1 with J = Q R: the law does not see Q.
  bool triangular = false;
  /// As `stiffness`, dP/dF replaced at every point by the nearest positive semi-definite one; null where it
  /// is so in every state.
  void (*definite)(const ElasticView&, const Chunk&, const double* x, double scale, double* blocks) = nullptr;
  /// Of a shape's kernels: what a view of its own laws takes for `at_point`.
  const PointLaws* at_point = nullptr;
};

/// The kernels of a shape, for any element and law on it; null when there are none.
const ElasticKernels* find_shape_kernels(Isa isa, int nodes, int dimension);

}  // namespace tissu
