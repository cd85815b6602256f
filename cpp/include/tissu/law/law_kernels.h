#pragma once

/// A law at many points at once, behind one call for each group of eight elements: what lets any law meet any
/// element without being compiled for it, and what a law made at run time has to offer.

#include <string_view>

#include "tissu/base/isa.h"

namespace tissu {

/// Arrays are [point][entry][8]; constants are [constant][8]. `dimension` is that of the reference cell, m: F
/// and P have 3 m entries, row after row, the tangent 3 m (3 m + 1) / 2, the upper triangle row after row.
/// Every function adds to what it writes, so that laws add up.
struct LawKernels {
  static constexpr int kLanes = 8;  ///< points side by side
  std::string_view name;
  bool linear;  ///< the tangent does not depend on F
  int dimension;
  int constants;
  void (*energy)(const double* constants, int points, const double* F, double* W);
  void (*stress)(const double* constants, int points, const double* F, double* P);
  void (*stress_change)(const double* constants, int points, const double* F, const double* dF, double* dP);
  void (*tangent)(const double* constants, int points, const double* F, double* A);
  bool isotropic = false;  ///< blind to rotation, and to the axes of the rest shape
};

/// The kernels of a law of the library for a reference dimension, or null when it has none.
const LawKernels* find_law_kernels(Isa isa, std::string_view law, int dimension);

}  // namespace tissu
