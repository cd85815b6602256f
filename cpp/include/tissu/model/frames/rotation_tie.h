#pragma once

/// What ties the rotations of frames in a volume to the turn of the material. With linear weights and half
/// levers a turn that all frames share moves no point, nor do some that differ; the material's own rotation
/// is the one that the exact solution has, so that a tie to it costs no accuracy (Hughes and Brezzi, On
/// drilling degrees of freedom, Comput. Methods Appl. Mech. Eng. 72, 1989):
///   W = 1/4 G |s|^2,   s = sum_k m_k x f_k,   M = sum_a w_a R_a,
/// m_k and f_k the rows of M and F: s is the axial vector of M^T F, zero where F is M times a symmetric
/// tensor. G is the shear modulus of the law at rest.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/base/vec.h"
#include "tissu/model/frames/frame_kernels.h"

namespace tissu {

class RotationTie {
 public:
  static constexpr std::size_t kLanes = 8;

  RotationTie() = default;
  /// `weights` [group][k][8] and `shear` [group][8], 0 for lanes that only pad.
  RotationTie(AlignedVector<double> weights, std::vector<double> shear, int neighbours)
      : weights_(std::move(weights)), shear_(std::move(shear)), neighbours_(neighbours) {}

  [[nodiscard]] bool empty() const { return shear_.empty(); }
  /// W += energy density [J/m3] of a group's lanes, of frames q and F as FrameKernels has them.
  void add_energy(const FrameView& view, std::int32_t group, const double* q, const double* F,
                  double* W) const;
  /// P += dW/dF, and the moments of dW/dM to the group's shares.
  void add_stress(const FrameView& view, std::int32_t group, const double* q, const double* F,
                  double* P) const;
  void add_moments(const FrameView& view, std::int32_t group, const double* q, const double* F,
                   double* shares) const;
  /// What P and moments change by for dF and dq [frame][6].
  void add_stress_change(const FrameView& view, std::int32_t group, const double* q, const double* F,
                         const double* dq, const double* dF, double* dP) const;
  void add_moments_change(const FrameView& view, std::int32_t group, const double* q, const double* F,
                          const double* dq, const double* dF, double* shares) const;
  /// A += d2W/dF2, upper triangle row after row.
  void add_tangent(const FrameView& view, std::int32_t group, const double* q, double* A) const;
  /// blocks += scale times what d2W/dF2 leaves of the matrix; `whole`: with what s itself makes, which is
  /// indefinite.
  void add_stiffness(const FrameView& view, std::int32_t group, const double* q, const double* F, bool whole,
                     double scale, double* blocks) const;
  [[nodiscard]] std::size_t bytes() const { return (weights_.size() + shear_.size()) * sizeof(double); }

 private:
  struct Lane;  ///< one point: M, F, s
  struct LaneMatrix;
  [[nodiscard]] Lane lane_of(const FrameView& view, std::int32_t group, std::size_t lane, const double* q,
                             const double* F) const;
  [[nodiscard]] double weight(std::int32_t group, int a, std::size_t lane) const {
    return weights_[(static_cast<std::size_t>(group) * static_cast<std::size_t>(neighbours_) +
                     static_cast<std::size_t>(a)) *
                        kLanes +
                    lane];
  }

  AlignedVector<double> weights_;
  std::vector<double> shear_;
  int neighbours_ = 0;
};

}  // namespace tissu
