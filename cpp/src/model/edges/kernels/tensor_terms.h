#pragma once

/// The expanded energy of Picinbono on one node, edge, face or tetrahedron, for every instruction set.
///
/// With u_i the displacements of its nodes, m = (i, j) a pair of them and q_m = u_i . u_j,
///   W = 1/2 sum u_i . B_ij u_j + sum_v (u_i(v) . c_v) q_m(v) + 1/2 sum_mn Q_mn q_m q_n       [J]
///   w_m = dW/dq_m = sum_v:m (u_i . c_v) + sum_n Q_mn q_n
///   dW/du_p = sum_j B_pj u_j + sum_v:p q_m c_v + sum_m w_m dq_m/du_p
/// and the tangent is one derivative more. Which vectors c and which numbers Q there are is a pattern,
/// written out by the compiler; f = -dW/du.

#include "cell/kernels/packed.h"
#include "tensor_patterns.h"
#include "tissu/law/tensor.h"
#include "tissu/model/edges/mass_tensor_kernels.h"

namespace tissu::TISSU_KERNELS {

template <class Pattern>
struct TensorTerms : Pattern {
  using Pattern::kMatrices;
  using Pattern::kNodes;
  using Pattern::kNumbers;
  using Pattern::kPairs;
  using Pattern::kVectors;
  using Pattern::number;
  using Pattern::pair;
  using Pattern::vector;

  static constexpr int count_reals() {
    int count = 9 * kMatrices + 3 * kVectors;
    for (int k = 0; k < kNumbers; ++k) count += number[k].stored;
    return count;
  }
  static constexpr int kReals = count_reals();
  static constexpr int first_stored(int k) {
    int at = 9 * kMatrices + 3 * kVectors;
    for (int n = 0; n < k; ++n) at += number[n].stored;
    return at;
  }
  static constexpr int at_least_one(int count) { return count > 0 ? count : 1; }
  using Vectors = Batch[kNodes][3];
  using Pairs = Batch[at_least_one(kPairs)];

  /// One batch of a group.
  struct Lanes {
    const std::uint16_t* places;
    const std::int32_t* slots;
    const double* constants;

    TISSU_INLINE Lanes(const MassTensorView& view, std::int32_t group, int lane)
        : places(view.places + static_cast<std::ptrdiff_t>(group) * kNodes * kLanes + lane),
          slots(view.slots + static_cast<std::ptrdiff_t>(group) * kNodes * kNodes * kLanes + lane),
          constants(view.constants + static_cast<std::ptrdiff_t>(group) * kReals * kLanes + lane) {}
    TISSU_INLINE void gather(const PackedNodes& nodes, Vectors& u) const {
      TISSU_UNROLL
      for (int a = 0; a < kNodes; ++a) gather_packed(nodes.values, places + a * kLanes, u[a]);
    }
    TISSU_INLINE void scatter(const Vectors& f, PackedNodes& sums) const {
      TISSU_UNROLL
      for (int a = 0; a < kNodes; ++a) scatter_packed(sums.values, places + a * kLanes, f[a]);
    }
    TISSU_INLINE Batch constant(int k) const { return Batch::load(constants + k * kLanes); }
    TISSU_INLINE Batch c(int v, int i) const { return constant(9 * kMatrices + 3 * v + i); }
    TISSU_INLINE Batch quadratic(int k) const {
      const Batch first = constant(first_stored(k));
      return number[k].stored == 1 ? first : first + constant(first_stored(k) + 1);
    }
  };

  TISSU_INLINE static Batch dot(const Batch (&a)[3], const Batch (&b)[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  TISSU_INLINE static void add(Batch s, const Batch (&a)[3], Batch (&to)[3]) {
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) to[i] += s * a[i];
  }

  TISSU_INLINE static void products(const Vectors& u, Pairs& q) {
    TISSU_UNROLL
    for (int m = 0; m < kPairs; ++m) q[m] = dot(u[pair[m][0]], u[pair[m][1]]);
  }
  /// w of u and q; dw of du and dq.
  TISSU_INLINE static void weights(const Lanes& lanes, const Vectors& u, const Pairs& q, Pairs& w) {
    TISSU_UNROLL
    for (int m = 0; m < kPairs; ++m) w[m] = Batch(0.0);
    TISSU_UNROLL
    for (int v = 0; v < kVectors; ++v) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) w[vector[v].pair] += u[vector[v].node][i] * lanes.c(v, i);
    }
    TISSU_UNROLL
    for (int k = 0; k < kNumbers; ++k) {
      const Batch Q = lanes.quadratic(k);
      w[number[k].m] += Q * q[number[k].n];
      if (number[k].m != number[k].n) w[number[k].n] += Q * q[number[k].m];
    }
  }
  /// r_p += sum_j B_pj u_j + sum_v:p q c
  TISSU_INLINE static void add_constant_part(const Lanes& lanes, const Vectors& u, const Pairs& q,
                                             Vectors& r) {
    TISSU_UNROLL
    for (int i = 0; i < (kMatrices > 0 ? 3 : 0); ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) {
        const Batch B = lanes.constant(3 * i + j);
        r[0][i] += B * u[kNodes - 1][j];
        if (kNodes == 2) r[kNodes - 1][j] += B * u[0][i];
      }
    }
    TISSU_UNROLL
    for (int v = 0; v < kVectors; ++v) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) r[vector[v].node][i] += q[vector[v].pair] * lanes.c(v, i);
    }
  }
  /// r_p += sum_m w_m dq_m/du_p
  TISSU_INLINE static void add_pairs(const Pairs& w, const Vectors& u, Vectors& r) {
    TISSU_UNROLL
    for (int m = 0; m < kPairs; ++m) {
      const int i = pair[m][0];
      const int j = pair[m][1];
      add(i == j ? w[m] + w[m] : w[m], u[j], r[i]);
      if (i != j) add(w[m], u[i], r[j]);
    }
  }
  TISSU_INLINE static void clear(Vectors& r) {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) r[a][i] = Batch(0.0);
    }
  }

  /// dq_m/du_s times one axis.
  TISSU_INLINE static Batch slope(int m, int s, const Vectors& u, int axis) {
    const int i = pair[m][0];
    const int j = pair[m][1];
    if (i == j) return i == s ? u[i][axis] + u[i][axis] : Batch(0.0);
    return i == s ? u[j][axis] : j == s ? u[i][axis] : Batch(0.0);
  }
  static constexpr bool holds(int m, int s) { return pair[m][0] == s || pair[m][1] == s; }

  /// dw_m/du_s
  TISSU_INLINE static void weight_slopes(const Lanes& lanes, int s, const Vectors& u,
                                         Batch (&g)[at_least_one(kPairs)][3]) {
    TISSU_UNROLL
    for (int m = 0; m < kPairs; ++m) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) g[m][i] = Batch(0.0);
    }
    TISSU_UNROLL
    for (int v = 0; v < kVectors; ++v) {
      if (vector[v].node != s) continue;
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) g[vector[v].pair][i] += lanes.c(v, i);
    }
    TISSU_UNROLL
    for (int k = 0; k < kNumbers; ++k) {
      const int m = number[k].m;
      const int n = number[k].n;
      const Batch Q = lanes.quadratic(k);
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        if (holds(n, s)) g[m][i] += Q * slope(n, s, u, i);
        if (m != n && holds(m, s)) g[n][i] += Q * slope(m, s, u, i);
      }
    }
  }

  /// d2W/du_p du_s, column by column.
  TISSU_INLINE static void node_pair(const Lanes& lanes, int p, int s, const Vectors& u, const Pairs& w,
                                     const Batch (&g)[at_least_one(kPairs)][3], Batch (&K)[9]) {
    const bool has_matrix = kMatrices > 0 && (kNodes == 1 || p != s);
    TISSU_UNROLL
    for (int c = 0; c < 9; ++c) {
      const int i = c % 3;
      const int k = c / 3;
      Batch sum = has_matrix ? lanes.constant(3 * i + k) : Batch(0.0);
      TISSU_UNROLL
      for (int v = 0; v < kVectors; ++v) {
        if (vector[v].node == p && holds(vector[v].pair, s)) {
          sum += lanes.c(v, i) * slope(vector[v].pair, s, u, k);
        }
      }
      TISSU_UNROLL
      for (int m = 0; m < kPairs; ++m) {
        if (holds(m, p)) sum += slope(m, p, u, i) * g[m][k];
        if (i != k || !holds(m, p) || !holds(m, s)) continue;
        if (p == s && pair[m][0] == pair[m][1]) sum += w[m] + w[m];
        if (p != s) sum += w[m];
      }
      K[c] = sum;
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
