#pragma once

/// A point whose volume ratio is replaced by that of its patch:
///
///   Fbar = s F,   s = (rho(theta) / rho(J))^(1/3),   J = det F,   theta = v / V of the patch,
///
/// rho(J) = J from kCollapsed on, so that det Fbar = theta; below it bends away, twice continuously
/// differentiable, to kCollapsed / 2 for J <= 0. A crushed or inverted point so keeps a finite s > 0 and the
/// law sees the sign of its own J: what the law does with inverted cells is left to it, as in `fem`.

#include "cell/kernels/shape.h"

namespace tissu::TISSU_KERNELS {

/// rho'/rho and its derivative, with rho.
struct Bounded {
  static constexpr double kCollapsed = 0.1;
  Batch rho;
  Batch slope;      ///< d ln rho / dJ: 1 / J
  Batch curvature;  ///< d2 ln rho / dJ2: -1 / J^2

  /// rho = J + kCollapsed (1/2 + y^3 - y^4/2 - y), y = J / kCollapsed between 0 and 1, J from 0 on.
  TISSU_INLINE explicit Bounded(Batch J) {
    const Batch one(1.0);
    const Batch y = one - positive(one - positive(J * Batch(1.0 / kCollapsed)));
    const Batch y3 = y * y * y;
    rho = positive(J) + Batch(kCollapsed) * (Batch(0.5) + y3 - Batch(0.5) * y3 * y - y);
    const Batch inverse = one / rho;
    slope = y * y * (Batch(3.0) - Batch(2.0) * y) * inverse;
    curvature = Batch(6.0 / kCollapsed) * y * (one - y) * inverse - slope * slope;
  }
};

/// F, G = dJ/dF (the cofactors), Fbar and what belongs to them, of the eight cells of a group.
struct DilatedPoint {
  using Point = double[9][kLanes];
  alignas(64) Point F;
  alignas(64) Point G;
  alignas(64) Point Fbar;
  alignas(64) double J[kLanes];
  alignas(64) double s[kLanes];
  alignas(64) double slope[kLanes];      ///< of rho at J
  alignas(64) double curvature[kLanes];  ///< of rho at J

  TISSU_INLINE static Batch dot(const Point& A, const Point& B, int lane) {
    Batch sum = Batch::load(A[0] + lane) * Batch::load(B[0] + lane);
    for (int k = 1; k < 9; ++k) sum += Batch::load(A[k] + lane) * Batch::load(B[k] + lane);
    return sum;
  }
  /// A x B: the cofactors' derivative, so that dG = F x dF and 2 G = F x F.
  TISSU_INLINE static Batch cross(const Point& A, const Point& B, int i, int j, int lane) {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    const int j1 = (j + 1) % 3;
    const int j2 = (j + 2) % 3;
    const auto a = [&](int r, int c) { return Batch::load(A[3 * r + c] + lane); };
    const auto b = [&](int r, int c) { return Batch::load(B[3 * r + c] + lane); };
    return a(i1, j1) * b(i2, j2) + b(i1, j1) * a(i2, j2) - a(i1, j2) * b(i2, j1) - b(i1, j2) * a(i2, j1);
  }

  /// G and J of F.
  void measure() {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      for (int k = 0; k < 9; ++k) (Batch(0.5) * cross(F, F, k / 3, k % 3, lane)).store(G[k] + lane);
      Batch det(0.0);
      for (int k = 0; k < 3; ++k) det += Batch::load(F[k] + lane) * Batch::load(G[k] + lane);
      det.store(J + lane);
    }
  }
  /// All the rest; theta of each lane's patch.
  void dilate(const double* theta) {
    measure();
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const Bounded own(Batch::load(J + lane));
      const Batch scale = cbrt(Bounded(Batch::load(theta + lane)).rho / own.rho);
      scale.store(s + lane);
      own.slope.store(slope + lane);
      own.curvature.store(curvature + lane);
      for (int k = 0; k < 9; ++k) (scale * Batch::load(F[k] + lane)).store(Fbar[k] + lane);
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
