#pragma once

/// What a point asks of an element that is compiled for its shape, quadrature and law: everything stays in
/// registers.
///
/// An isotropic law does not see the axes that X is written in, so J is turned to upper triangular form,
/// J = Q R, and R^-1 is kept: six numbers, and a third fewer operations. A law that is in proportion to its
/// constants gets the volume there, in two products, not in nine.

#include "packed.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {

/// dN_a/dxi_k at every point, as numbers the compiler folds into the code.
template <class Element, class Rule>
struct GradientTable {
  double dN[Rule::kPoints][Element::kNodes][3];
  constexpr GradientTable() : dN{} {
    for (int g = 0; g < Rule::kPoints; ++g) {
      const auto gradients = Element::gradients(Rule::points[static_cast<unsigned>(g)].xi);
      TISSU_UNROLL
      for (int a = 0; a < Element::kNodes; ++a) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k)
          dN[g][a][k] = gradients[static_cast<unsigned>(a)][static_cast<unsigned>(k)];
      }
    }
  }
};

/// J^-1, all of it or its upper triangle.
template <bool kTriangular>
struct InverseJacobian {
  static constexpr int kSize = kTriangular ? 6 : 9;
  Batch entry[kSize];
  static constexpr bool holds(int i, int j) { return !kTriangular || i <= j; }
  static constexpr int index(int i, int j) {
    return kTriangular ? i * 3 - i * (i - 1) / 2 + (j - i) : 3 * i + j;
  }

  TISSU_INLINE explicit InverseJacobian(const double* values) {
    TISSU_UNROLL
    for (int k = 0; k < kSize; ++k) entry[k] = Batch::load(values + k * kLanes);
  }
  /// A J^-1
  TISSU_INLINE Tensor2<Batch> after(const Tensor2<Batch>& A) const {
    Tensor2<Batch> C;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int j = 0; j < 3; ++j) {
        Batch sum = A(i, 0) * entry[index(0, j)];
        TISSU_UNROLL
        for (int k = 1; k < 3; ++k) {
          if (holds(k, j)) sum += A(i, k) * entry[index(k, j)];
        }
        C(i, j) = sum;
      }
    }
    return C;
  }
  /// A J^-T
  TISSU_INLINE Tensor2<Batch> transposed_after(const Tensor2<Batch>& A) const {
    Tensor2<Batch> C;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = 0; k < 3; ++k) {
        Batch sum = A(i, 2) * entry[index(k, 2)];
        TISSU_UNROLL
        for (int j = 0; j < 2; ++j) {
          if (holds(k, j)) sum += A(i, j) * entry[index(k, j)];
        }
        C(i, k) = sum;
      }
    }
    return C;
  }
  /// J^-T dN
  TISSU_INLINE void rest_gradient(const double (&dN)[3], Batch (&grad)[3]) const {
    TISSU_UNROLL
    for (int j = 0; j < 3; ++j) {
      Batch sum = entry[index(0, j)] * dN[0];
      TISSU_UNROLL
      for (int k = 1; k < 3; ++k) {
        if (holds(k, j)) sum += entry[index(k, j)] * dN[k];
      }
      grad[j] = sum;
    }
  }
};

template <class Element, class Rule, template <class> class LawOf>
struct FusedPoint {
  using Tensor = Tensor2<Batch>;
  using MaterialLaw = LawOf<Batch>;
  using Inverse = InverseJacobian<MaterialLaw::kIsotropic>;
  static constexpr int kNodes = Element::kNodes;
  static constexpr int kRest = Inverse::kSize + 1;
  static constexpr int kConstants = static_cast<int>(sizeof(MaterialLaw) / sizeof(Batch));
  static constexpr GradientTable<Element, Rule> kTable{};

  /// The lanes of one batch of a group.
  struct Lanes {
    const std::uint16_t* places;
    const std::int32_t* slots;
    const double* rest;
    int point_stride;  ///< of `rest`
    const double* weights;
    MaterialLaw law;

    TISSU_INLINE Lanes(const ElasticView& view, std::int32_t group, int lane)
        : places(view.places + static_cast<std::ptrdiff_t>(group) * kNodes * kLanes + lane),
          slots(view.slots + static_cast<std::ptrdiff_t>(group) * kNodes * kNodes * kLanes + lane),
          rest(view.rest + static_cast<std::ptrdiff_t>(group) * view.rest_points * kRest * kLanes + lane),
          point_stride(view.rest_points == 1 ? 0 : kRest * kLanes),
          weights(view.weights) {
      const double* constants = view.constants + group * view.constants_stride + lane;
      Batch* values = reinterpret_cast<Batch*>(&law);
      TISSU_UNROLL
      for (int c = 0; c < kConstants; ++c) values[c] = Batch::load(constants + c * kLanes);
    }
    TISSU_INLINE void gather_all(const PackedNodes& from, Batch (&to)[kNodes][3]) const {
      TISSU_UNROLL
      for (int a = 0; a < kNodes; ++a) gather_packed(from.values, places + a * kLanes, to[a]);
    }
    TISSU_INLINE void scatter_all(PackedNodes& to, const Batch (&from)[kNodes][3]) const {
      TISSU_UNROLL
      for (int a = 0; a < kNodes; ++a) scatter_packed(to.values, places + a * kLanes, from[a]);
    }
    TISSU_INLINE Inverse inverse_jacobian(int point) const { return Inverse(rest + point * point_stride); }
    TISSU_INLINE Batch weight(int point) const {
      const Batch volume = Batch::load(rest + point * point_stride + Inverse::kSize * kLanes);
      return Rule::kPoints == 1 ? volume : volume * Batch(weights[point]);
    }
  };

  /// s times a quantity in proportion to the law: f(law with s in its constants, 1), or f(law, s).
  template <class Function>
  TISSU_INLINE static Tensor scaled(const MaterialLaw& law, Batch s, Function&& f) {
    if constexpr (MaterialLaw::kHomogeneous) {
      MaterialLaw weighted = law;
      Batch* values = reinterpret_cast<Batch*>(&weighted);
      TISSU_UNROLL
      for (int c = 0; c < kConstants; ++c) values[c] = values[c] * s;
      return f(weighted);
    } else {
      Tensor A = f(law);
      TISSU_UNROLL
      for (int k = 0; k < 9; ++k) A.m[k / 3][k % 3] = A.m[k / 3][k % 3] * s;
      return A;
    }
  }

  static constexpr bool counts(double dN) { return dN != 0.0; }

  /// sum_a u_a (x) dN_a/dxi, times J^-1: F when u = x, dF when u is a change of x.
  TISSU_INLINE static Tensor gradient(int point, const Batch (&u)[kNodes][3], const Inverse& Jinv) {
    Tensor G;
    TISSU_UNROLL
    for (int i = 0; i < 3; ++i) {
      TISSU_UNROLL
      for (int k = 0; k < 3; ++k) {
        Batch sum = u[0][i] * kTable.dN[point][0][k];
        TISSU_UNROLL
        for (int a = 1; a < kNodes; ++a) {
          if (!__builtin_constant_p(kTable.dN[point][a][k]) || counts(kTable.dN[point][a][k])) {
            sum += u[a][i] * kTable.dN[point][a][k];
          }
        }
        G(i, k) = sum;
      }
    }
    return Jinv.after(G);
  }

  /// f_a += P J^-T dN_a/dxi; for an affine cell f_0 = -sum of the others is left to close().
  TISSU_INLINE static void spread(int point, const Tensor& P, const Inverse& Jinv, Batch (&f)[kNodes][3]) {
    const Tensor H = Jinv.transposed_after(P);
    if constexpr (kNodes == 4 && Rule::kPoints == 1) {  // the gradients of the last three are unit vectors
      TISSU_UNROLL
      for (int a = 1; a < kNodes; ++a) {
        TISSU_UNROLL
        for (int i = 0; i < 3; ++i) f[a][i] = H(i, a - 1);
      }
      return;
    }
    TISSU_UNROLL
    for (int a = Element::kAffine ? 1 : 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        TISSU_UNROLL
        for (int k = 0; k < 3; ++k) {
          if (!__builtin_constant_p(kTable.dN[point][a][k]) || counts(kTable.dN[point][a][k])) {
            f[a][i] += H(i, k) * kTable.dN[point][a][k];
          }
        }
      }
    }
  }
  /// Forces of an affine cell sum to zero, as its gradients do.
  TISSU_INLINE static void close(Batch (&f)[kNodes][3]) {
    if constexpr (Element::kAffine) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) {
        Batch sum = f[1][i];
        TISSU_UNROLL
        for (int a = 2; a < kNodes; ++a) sum += f[a][i];
        f[0][i] = -sum;
      }
    }
  }

  TISSU_INLINE static void clear(Batch (&f)[kNodes][3]) {
    TISSU_UNROLL
    for (int a = 0; a < kNodes; ++a) {
      TISSU_UNROLL
      for (int i = 0; i < 3; ++i) f[a][i] = Batch(0.0);
    }
  }
};

}  // namespace tissu::TISSU_KERNELS
