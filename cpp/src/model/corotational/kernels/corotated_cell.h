#pragma once

/// A cell seen from its own rotation R: y_a = R^T x_a, in which it is linear elastic.

#include "cell/kernels/elastic.h"
#include "cell/kernels/rotation.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/model/corotational/corotational_kernels.h"

namespace tissu::TISSU_KERNELS {

/// Hooke's law in axes that turn with the cell: those of the rest shape do not matter, so J may be
/// triangular.
template <class T>
struct TurningHooke : Hooke<T> {
  static constexpr bool kIsotropic = true;
};

[[gnu::noinline]] inline void find_rotation(Rotation kind, const Matrix& F, Matrix& R) {
  if (kind == Rotation::polar) {
    Batch trace;
    R = polar_rotation(F, trace);
  } else if (kind == Rotation::frame) {
    R = frame_rotation(F);
  } else {
    for (int k = 0; k < 9; ++k) R.m[k / 3][k % 3] = Batch(k % 4 == 0 ? 1.0 : 0.0);
  }
}

TISSU_INLINE void cross(const Batch (&a)[3], const Batch (&b)[3], Batch (&c)[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/// t += sum_k A_k x T_k over the columns: the moment that a stress T has about a shape A.
TISSU_INLINE void add_moment(const Matrix& A, const Matrix& T, Batch (&t)[3]) {
  TISSU_UNROLL
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    TISSU_UNROLL
    for (int c = 0; c < 3; ++c) t[i] += A(j, c) * T(k, c) - A(k, c) * T(j, c);
  }
}

template <class Element, class Rule, template <class> class LawOf>
struct CorotatedCell : Elastic<Element, Rule, LawOf> {
  using Base = Elastic<Element, Rule, LawOf>;
  using Base::kNodes;
  using typename Base::Inverse;
  using typename Base::Lanes;
  using typename Base::MaterialLaw;
  using Nodal = Batch[kNodes][3];

  /// One point at the centroid; what a cell of one point has there it has everywhere.
  struct CentreRule {
    static constexpr int kPoints = 1;
    static constexpr auto points = Element::Reduced::points;
    static_assert(Element::Reduced::kPoints == 1);
  };
  using Centre = FusedPoint<Element, CentreRule, TurningHooke>;
  using CentreInverse = InverseJacobian<true>;

  TISSU_INLINE static const double* centre_of(const CorotationalView& view, const Lanes& lanes,
                                              std::int32_t group, int lane) {
    if (view.centres == nullptr) return lanes.rest;
    return view.centres + static_cast<std::ptrdiff_t>(group) * 6 * kLanes + lane;
  }

  Lanes lanes;
  CentreInverse centre;
  Matrix R;
  Matrix A;  ///< R^T F at the centre
  Nodal y;

  TISSU_INLINE CorotatedCell(const CorotationalView& view, const PackedNodes& positions, std::int32_t group,
                             int lane)
      : lanes(view.cells, group, lane), centre(centre_of(view, lanes, group, lane)) {
    lanes.gather_all(positions, y);
    const Matrix F = Centre::gradient(0, y, centre);
    find_rotation(view.rotation, F, R);
    A = transposed_product(R, F);
    turn_in(y);
  }

  /// u_a = R^T u_a
  TISSU_INLINE void turn_in(Nodal& u) const {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      const Batch v[3] = {u[a][0], u[a][1], u[a][2]};
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) u[a][i] = R(0, i) * v[0] + R(1, i) * v[1] + R(2, i) * v[2];
    }
  }
  /// f_a = R f_a, the first node's of an affine element from the others'
  TISSU_INLINE void turn_out(Nodal& f) const {
    TISSU_UNROLL
    for (int a = Element::kAffine ? 1 : 0; a < kNodes; ++a) {
      const Batch v[3] = {f[a][0], f[a][1], f[a][2]};
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) f[a][i] = R(i, 0) * v[0] + R(i, 1) * v[1] + R(i, 2) * v[2];
    }
    Base::close(f);
  }

  /// R^T F at a point
  TISSU_INLINE Matrix shape_at(int g, const Inverse& Jinv) const {
    if constexpr (Rule::kPoints == 1 && MaterialLaw::kIsotropic) return A;
    return Base::gradient(g, y, Jinv);
  }
  /// s sigma, sigma = lambda tr(e) I + 2 mu e, e = sym(A) - I
  TISSU_INLINE Matrix stress_at(const Matrix& shape, Batch s) const {
    return Base::scaled(lanes.law, s, [&](const MaterialLaw& law) { return law.stress(shape); });
  }
  TISSU_INLINE Matrix stress_change(const Matrix& change, Batch s) const {
    return Base::scaled(lanes.law, s, [&](const MaterialLaw& law) { return law.stress_change(A, change); });
  }
};

}  // namespace tissu::TISSU_KERNELS
