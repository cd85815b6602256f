#pragma once

/// What frames' points are made of: the laws, and of rods what their section adds to the shear.

#include "tissu/model/frames/section_shear.h"
#include "tissu/model/points/point_material.h"

namespace tissu {

class FrameMaterial {
 public:
  static constexpr std::size_t kNine = PointMaterial::kNine;
  static constexpr std::size_t kTangent = PointMaterial::kTangent;

  FrameMaterial() = default;
  /// As PointMaterial; `points.sections` are of rods whose points stand around the axis.
  FrameMaterial(const ElasticBlock& block, const FramePoints& points, std::span<const std::int32_t> lanes,
                Isa isa);

  [[nodiscard]] const PointMaterial& law() const { return law_; }
  void energy(std::int32_t group, const double* F, double* W) const {
    law_.energy(group, F, W);
    if (!shear_.empty()) shear_.add_energy(group, F, W);
  }
  void stress(std::int32_t group, const double* F, double* P) const {
    law_.stress(group, F, P);
    if (!shear_.empty()) shear_.add_stress(group, F, P);
  }
  void stress_change(std::int32_t group, const double* F, const double* dF, double* dP) const {
    law_.stress_change(group, F, dF, dP);
    if (!shear_.empty()) shear_.add_stress_change(group, F, dF, dP);
  }
  void tangent(std::int32_t group, const double* F, double* A) const {
    law_.tangent(group, F, A);
    if (!shear_.empty()) shear_.add_tangent(group, F, A);
  }
  [[nodiscard]] std::size_t bytes() const { return law_.bytes() + shear_.bytes(); }

 private:
  PointMaterial law_;
  SectionShear shear_;
};

}  // namespace tissu
