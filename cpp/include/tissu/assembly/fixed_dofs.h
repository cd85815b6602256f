#pragma once

/// Degrees of freedom whose motion is given: fixed nodes and nodes that are led.

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/state/state.h"

namespace tissu {

/// A rigid motion given at a few times, linear between them and held before the first and after the last:
/// rotation by `angles` about `axis` through `center`, then displacement.
struct Motion {
  std::vector<double> times;        ///< ascending [s]; empty: at rest for ever
  std::vector<Vec3> displacements;  ///< [m]
  std::vector<double> angles;       ///< [rad]
  Vec3 center = Vec3::Zero();       ///< [m]
  Vec3 axis = Vec3::UnitX();        ///< of length 1

  [[nodiscard]] Vec3 position(const Vec3& rest, double time) const;
};

class FixedDofs {
 public:
  static constexpr std::uint8_t kAllAxes = 7;

  FixedDofs() = default;
  explicit FixedDofs(std::int32_t rows) : masks_(static_cast<std::size_t>(rows), 0) {}

  /// Gives the motion of the axes in `mask` (x=1 y=2 z=4) of some nodes, whose rest positions are given too.
  void add(std::span<const std::int32_t> nodes, ConstReals rest_positions, std::uint8_t mask,
           const Motion& motion);

  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] const std::vector<std::int32_t>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<std::uint8_t>& masks() const { return masks_; }

  /// Sets the led components of v so that x + h v is where they are to be at `time`; `share` < 1 goes only
  /// that part of the way.
  void set_velocities(ConstReals x, double time, double h, double share, Reals v) const;
  /// to = from in the led components.
  void copy(ConstReals from, Reals to) const;
  /// Zero in the led components.
  void clear(Reals values) const;

 private:
  struct Led {
    std::int32_t node;
    std::uint8_t mask;
    std::int32_t motion;
    Vec3 rest;
  };
  std::vector<std::int32_t> rows_;
  std::vector<std::uint8_t> masks_;
  std::vector<Led> led_;
  std::vector<Motion> motions_;
};

/// The value at `time` of a table, linear between its times, held at its ends; `empty_value` when it is
/// empty.
double interpolate(std::span<const double> times, std::span<const double> values, double time,
                   double empty_value);

}  // namespace tissu
