#pragma once

/// The laws of a view at a point, behind the pointers of `PointLaws`. Nothing here depends on the nodes of a
/// cell: it is compiled once for each reference dimension M, and the loops over cells once for each shape.

#include <cstring>

#include "definite_tangent.h"
#include "tissu/cell/elastic_kernels.h"

namespace tissu::TISSU_KERNELS {

/// Calls f(law, its constants) for each law of the view, with the constants of the group at all its points.
struct LawsOfGroup {
  static bool isotropic(const ElasticView& view) {
    for (int l = 0; l < view.law_count; ++l) {
      if (!view.laws[l]->isotropic) return false;
    }
    return true;
  }
  template <class Function>
  TISSU_INLINE static void for_each(const ElasticView& view, std::int32_t group, int /*point*/,
                                    Function&& f) {
    const double* constants = view.constants + group * view.constants_stride;
    for (int l = 0; l < view.law_count; ++l) {
      f(*view.laws[l], constants);
      constants += static_cast<std::ptrdiff_t>(view.laws[l]->constants) * kLanes;
    }
  }
};

template <class Laws, int M>
struct LawsAtPoint {
  static constexpr int kEntries = 3 * M;  ///< of F and P
  static constexpr int kTangent = kEntries * (kEntries + 1) / 2;

  static void stress(const ElasticView& view, std::int32_t group, int point, const double* F, double* P) {
    std::memset(P, 0, sizeof(double[kEntries][kLanes]));
    Laws::for_each(view, group, point,
                   [&](const LawKernels& law, const double* c) { law.stress(c, 1, F, P); });
  }
  static void stress_change(const ElasticView& view, std::int32_t group, int point, const double* F,
                            const double* dF, double* dP) {
    std::memset(dP, 0, sizeof(double[kEntries][kLanes]));
    Laws::for_each(view, group, point,
                   [&](const LawKernels& law, const double* c) { law.stress_change(c, 1, F, dF, dP); });
  }
  static void tangent(const ElasticView& view, std::int32_t group, int point, const double* F, double* A) {
    std::memset(A, 0, sizeof(double[kTangent][kLanes]));
    Laws::for_each(view, group, point,
                   [&](const LawKernels& law, const double* c) { law.tangent(c, 1, F, A); });
  }
  static void definite(const ElasticView& view, std::int32_t group, int point, const double* F, double* A) {
    if constexpr (M == 3) {
      if (Laws::isotropic(view)) return isotropic_tangent(view, group, point, F, A);
    }
    tangent(view, group, point, F, A);
    make_tangents_semidefinite<kEntries>(A);
  }
  /// The definite tangent of laws that are isotropic.
  static void isotropic_tangent(const ElasticView& view, std::int32_t group, int point, const double* F,
                                double* A) {
    alignas(64) double stretch[kEntries * kLanes];
    PrincipalAxes axes[kLanes / kWidth];
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Matrix at;
      for (int k = 0; k < 9; ++k) at.m[k / 3][k % 3] = Batch::load(F + k * kLanes + lane);
      axes[lane / kWidth].find(at);
      for (int k = 0; k < 9; ++k) {
        axes[lane / kWidth].stretch.m[k / 3][k % 3].store(stretch + k * kLanes + lane);
      }
    }
    tangent(view, group, point, stretch, A);
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      Tangent<Batch> at;
      for (int k = 0; k < kTangent; ++k) at.a[k] = Batch::load(A + k * kLanes + lane);
      axes[lane / kWidth].make_definite(at);
      for (int k = 0; k < kTangent; ++k) at.a[k].store(A + k * kLanes + lane);
    }
  }
  static constexpr PointLaws table() { return {&stress, &stress_change, &tangent, &definite}; }
};

}  // namespace tissu::TISSU_KERNELS
