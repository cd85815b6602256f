#pragma once

/// What a rod's section changes in the shear of its points. Four points around the axis carry round sections
/// with a shear factor of one; to their energies come
///   W = 1/2 sum_d c_d g_d^2,   g_d = (F t) . (F d),   d the two axes of the section, t the rod's,
/// with the c_d, of either sign, for which the points together have the shear stiffnesses k_d G A and the
/// torsional stiffness G J of the section. g_d is twice Green's strain, which no rotation changes; G is the
/// law's at rest.

#include <cstdint>
#include <span>

#include "tissu/base/array.h"
#include "tissu/base/vec.h"

namespace tissu {

class SectionShear {
 public:
  static constexpr std::size_t kLanes = 8;

  /// What one point has: t, the two axes of the section, and c along each [Pa].
  struct Point {
    Vec3 t;
    Vec3 own;  ///< the axis that the point stands on
    Vec3 other;
    double c_own;
    double c_other;
  };

  SectionShear() = default;
  /// One for each lane, group after group.
  explicit SectionShear(std::span<const Point> lanes);

  [[nodiscard]] bool empty() const { return lanes_.empty(); }
  /// W += energy density [J/m3], of groups of eight lanes, as PointMaterial has them.
  void add_energy(std::int32_t group, const double* F, double* W) const;
  /// P += dW/dF
  void add_stress(std::int32_t group, const double* F, double* P) const;
  /// dP += dP/dF : dF
  void add_stress_change(std::int32_t group, const double* F, const double* dF, double* dP) const;
  /// A += dP/dF, upper triangle row after row
  void add_tangent(std::int32_t group, const double* F, double* A) const;
  [[nodiscard]] std::size_t bytes() const { return lanes_.size() * sizeof(Point); }

 private:
  [[nodiscard]] const Point* of_group(std::int32_t group) const {
    return lanes_.data() + static_cast<std::ptrdiff_t>(group) * static_cast<std::ptrdiff_t>(kLanes);
  }

  std::vector<Point> lanes_;
};

}  // namespace tissu
