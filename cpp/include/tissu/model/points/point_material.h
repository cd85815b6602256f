#pragma once

/// The laws of a block at points in groups of eight lanes. A sheet is free to thin, and a line to thin all
/// around: the stretch s across is where no stress is left,
///   W(F) = min_s W'(F S),   S = I + (s - 1) n n^T (sheet of normal n), s I + (1 - s) t t^T (line along t),
/// so that P = P' S, and any law of volumes serves lines and sheets.

#include <span>
#include <vector>

#include "tissu/base/array.h"
#include "tissu/base/isa.h"
#include "tissu/law/law_kernels.h"
#include "tissu/model/elastic_block.h"
#include "tissu/model/frames/frame_points.h"

namespace tissu {

class PointMaterial {
 public:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kNine = 9 * kLanes;      ///< numbers of a tensor in a group
  static constexpr std::size_t kTangent = 45 * kLanes;  ///< of a tangent, upper triangle row after row

  PointMaterial() = default;
  /// `lanes` holds the point of each lane, group after group. Refuses what the laws refuse.
  PointMaterial(const ElasticBlock& block, const FramePoints& points, std::span<const std::int32_t> lanes,
                Isa isa);

  /// W += energy density [J/m3], [8]
  void energy(std::int32_t group, const double* F, double* W) const;
  /// P = dW/dF [Pa]
  void stress(std::int32_t group, const double* F, double* P) const;
  /// dP = dP/dF : dF
  void stress_change(std::int32_t group, const double* F, const double* dF, double* dP) const;
  /// A = dP/dF
  void tangent(std::int32_t group, const double* F, double* A) const;
  /// F S, which is F of volumes.
  void stretch(std::int32_t group, const double* F, double* whole) const;
  [[nodiscard]] std::size_t bytes() const { return (constants_.size() + axes_.size()) * sizeof(double); }

 private:
  struct Thin;  ///< a group with its stretch
  [[nodiscard]] const double* constants_of(std::int32_t group) const {
    return constants_.data() + static_cast<std::ptrdiff_t>(group) * stride_;
  }
  void law_stress(const double* constants, const double* F, double* P) const;
  void law_change(const double* constants, const double* F, const double* dF, double* dP) const;
  void find_stretch(std::int32_t group, const double* F, Thin& thin) const;

  int dimension_ = 3;
  std::vector<const LawKernels*> laws_;
  AlignedVector<double> constants_;  ///< [group or one][constant][8]
  std::ptrdiff_t stride_ = 0;
  AlignedVector<double> axes_;  ///< [group][3][8]; of volumes empty
};

}  // namespace tissu
