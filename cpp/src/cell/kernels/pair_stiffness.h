#pragma once

/// The stiffness between nodes of a law whose dP/dF has a short form: K_ab = grad_a . dP/dF . grad_b without
/// the tensor of 45 numbers.

#include "tissu/base/batch.h"
#include "tissu/law/generated/stvk.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {

/// Of a law that has none.
template <class Law>
struct PairStiffness {
  static constexpr bool kHas = false;
};

/// P = F S with S = lambda tr(E) I + 2 mu E gives, with u_a = F grad_a,
/// K_ab = (grad_a . S grad_b) I + lambda u_a u_b^T + mu (u_b u_a^T + (grad_a . grad_b) F F^T).
template <>
struct PairStiffness<StVK<Batch>> {
  static constexpr bool kHas = true;
  using Vector = Batch[3];

  Tensor2<Batch> F;
  Batch lambda;
  Batch mu;
  Batch S[6];  ///< 00 01 02 11 12 22
  Batch B[6];  ///< mu F F^T

  /// `scale` multiplies the law.
  TISSU_INLINE PairStiffness(const StVK<Batch>& law, const Tensor2<Batch>& at, Batch scale)
      : F(at), lambda(law.lambda * scale), mu(law.mu * scale) {
    int n = 0;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = i; j < 3; ++j, ++n) {
        S[n] = F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j);
        B[n] = mu * (F(i, 0) * F(j, 0) + F(i, 1) * F(j, 1) + F(i, 2) * F(j, 2));
      }
    }
    const Batch pressure = Batch(0.5) * lambda * (S[0] + S[3] + S[5] - Batch(3.0)) - mu;
    TISSU_UNROLL
    for (Batch& s : S) s = mu * s;
    S[0] += pressure;
    S[3] += pressure;
    S[5] += pressure;
  }

  TISSU_INLINE static Batch dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  /// F grad
  TISSU_INLINE void carry(const Vector& grad, Vector& u) const {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) u[i] = F(i, 0) * grad[0] + F(i, 1) * grad[1] + F(i, 2) * grad[2];
  }
  /// S grad
  TISSU_INLINE void pull(const Vector& grad, Vector& t) const {
    t[0] = S[0] * grad[0] + S[1] * grad[1] + S[2] * grad[2];
    t[1] = S[1] * grad[0] + S[3] * grad[1] + S[4] * grad[2];
    t[2] = S[2] * grad[0] + S[4] * grad[1] + S[5] * grad[2];
  }

  /// K += K_ab of the pairs a <= b of the nodes from kFirst on, pair after pair, column by column.
  template <int kFirst, int kNodes, int kPairs>
  TISSU_INLINE void add(const Batch (&grad)[kNodes][3], Batch (&K)[kPairs][9]) const {
    constexpr int kSymmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    Batch u[kNodes][3];
    TISSU_UNROLL
    for (int a = kFirst; a < kNodes; ++a) carry(grad[a], u[a]);
    int pair = 0;
    for (int b = kFirst; b < kNodes; ++b) {
      Vector t;
      pull(grad[b], t);
      Vector ub_lambda;
      Vector ub_mu;
      TISSU_UNROLL
      for (int k = 0; k < 3; ++k) {
        ub_lambda[k] = lambda * u[b][k];
        ub_mu[k] = mu * u[b][k];
      }
      for (int a = kFirst; a <= b; ++a, ++pair) {
        const Batch along = dot(grad[a], grad[b]);
        const Batch level = dot(grad[a], t);
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          TISSU_UNROLL
          for (int i = 0; i < 3; ++i) {
            Batch sum = u[a][i] * ub_lambda[k] + ub_mu[i] * u[a][k] + along * B[kSymmetric[i][k]];
            if (i == k) sum += level;
            K[pair][3 * k + i] += sum;
          }
        }
      }
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
