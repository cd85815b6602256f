#pragma once

/// A law at the points of eight elements: the loops that LawKernels names, around the four functions of a
/// law. They are not inlined: the numbers of a law are the same wherever it is asked.

#include "tissu/base/batch.h"
#include "tissu/law/law_kernels.h"
#include "tissu/law/tensor.h"

namespace tissu::TISSU_KERNELS {

/// M is the reference dimension.
template <template <class> class LawOf, int M = 3>
struct LawAtPoints {
  using MaterialLaw = LawOf<Batch>;
  using Tensor = Columns<Batch, M>;
  static constexpr int kEntries = 3 * M;  ///< of F and P
  static constexpr int kTangent = ColumnsTangent<Batch, M>::kSize;
  static constexpr int kConstants = static_cast<int>(sizeof(MaterialLaw) / sizeof(Batch));

  TISSU_INLINE static MaterialLaw load_law(const double* constants) {
    MaterialLaw law;
    Batch* values = reinterpret_cast<Batch*>(&law);
    for (int c = 0; c < kConstants; ++c) values[c] = Batch::load(constants + c * kLanes);
    return law;
  }
  TISSU_INLINE static Tensor load_tensor(const double* values) {
    Tensor F;
    for (int k = 0; k < kEntries; ++k) F.m[k / M][k % M] = Batch::load(values + k * kLanes);
    return F;
  }
  TISSU_INLINE static void add(const Batch& value, double* to) { (Batch::load(to) + value).store(to); }

  static void energy(const double* constants, int points, const double* F, double* W) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const MaterialLaw law = load_law(constants + lane);
      for (int g = 0; g < points; ++g) {
        add(law.energy(load_tensor(F + g * kEntries * kLanes + lane)), W + g * kLanes + lane);
      }
    }
  }
  [[gnu::noinline]] static void stress(const double* constants, int points, const double* F, double* P) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const MaterialLaw law = load_law(constants + lane);
      for (int g = 0; g < points; ++g) {
        const Tensor result = law.stress(load_tensor(F + g * kEntries * kLanes + lane));
        for (int k = 0; k < kEntries; ++k)
          add(result.m[k / M][k % M], P + (g * kEntries + k) * kLanes + lane);
      }
    }
  }
  [[gnu::noinline]] static void stress_change(const double* constants, int points, const double* F,
                                              const double* dF, double* dP) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const MaterialLaw law = load_law(constants + lane);
      for (int g = 0; g < points; ++g) {
        const Tensor result = law.stress_change(load_tensor(F + g * kEntries * kLanes + lane),
                                                load_tensor(dF + g * kEntries * kLanes + lane));
        for (int k = 0; k < kEntries; ++k)
          add(result.m[k / M][k % M], dP + (g * kEntries + k) * kLanes + lane);
      }
    }
  }
  [[gnu::noinline]] static void tangent(const double* constants, int points, const double* F, double* A) {
    for (int lane = 0; lane < kLanes; lane += kWidth) {
      const MaterialLaw law = load_law(constants + lane);
      for (int g = 0; g < points; ++g) {
        const ColumnsTangent<Batch, M> result = law.tangent(load_tensor(F + g * kEntries * kLanes + lane));
        for (int k = 0; k < kTangent; ++k) add(result.a[k], A + (g * kTangent + k) * kLanes + lane);
      }
    }
  }

  static constexpr LawKernels table() {
    return {MaterialLaw::kName, MaterialLaw::kLinear,   M, kConstants, &energy, &stress, &stress_change,
            &tangent,           MaterialLaw::kIsotropic};
  }
};

}  // namespace tissu::TISSU_KERNELS
