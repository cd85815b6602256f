#pragma once

/// St-Venant–Kirchhoff as a textbook writes it (Bonet and Wood, Nonlinear Continuum Mechanics for Finite
/// Element Analysis, 2008, chapters 8 and 9): one element after the other, one number after the other.
///   F = sum_a x_a (x) grad_a,  E = (F^T F - I) / 2,  S = lambda tr(E) I + 2 mu E,  P = F S,
///   f_a = -sum_g w_g P grad_a,  K_ab = sum_g w_g (B_a^T D B_b + (grad_a . S grad_b) I)
/// It is compiled for the portable processor, without any thought of registers: what a kernel is compared
/// with.

#include <array>
#include <cstdint>
#include <vector>

#include "tissu/assembly/sparsity.h"
#include "tissu/base/vec.h"
#include "tissu/element/reference_cell.h"
#include "tissu/law/law.h"

namespace tissu::bench {

template <int kNodes>
class Textbook {
 public:
  /// `cells` holds cell after cell, node numbers into X [m].
  Textbook(const ReferenceCell& reference, std::vector<std::int32_t> cells, ConstReals X, Lame lame);
  /// Looks up the blocks of the matrix, before the first add_stiffness.
  void bind(const Sparsity& pattern);

  /// f += force [N]
  void add_force(const double* x, double* f) const;
  /// out += scale (df/dx) p
  void add_product(const double* x, double scale, const double* p, double* out) const;
  /// blocks += scale df/dx, [slot][9] column by column
  void add_stiffness(const double* x, double scale, double* blocks) const;

 private:
  struct Point {
    double gradient[kNodes][3];  ///< of N_a at rest [1/m]
    double weight;               ///< quadrature weight times det J [m3]
  };
  using Tensor = double[3][3];
  using Blocks = double[kNodes][kNodes][3][3];

  void second_piola(const Tensor& F, Tensor& S) const;
  void add_point(const Point& point, const double (&x)[kNodes][3], Blocks& K) const;

  Lame lame_;
  std::size_t points_per_cell_;
  std::vector<std::int32_t> cells_;
  std::vector<Point> points_;
  std::vector<std::array<std::int32_t, kNodes * kNodes>> slots_;
};

extern template class Textbook<4>;
extern template class Textbook<8>;

}  // namespace tissu::bench
