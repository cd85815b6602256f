#pragma once

/// A hand on the tool: a mass on a spring and a damper that follow a path. About the path it is passive.

#include <array>
#include <cstdint>
#include <vector>

#include "tissu/haptic/kinematics.h"

namespace tissu::haptic {

/// Where the hand wants the tip to be at a time. Positions in the port's frame.
struct PathPoint {
  double time = 0.0;        ///< [s], rising from point to point
  Vec3 tip = Vec3::Zero();  ///< [m]
  double psi = 0.0;         ///< own rotation [rad]
};

struct HandSettings {
  std::vector<PathPoint> path;  ///< at least one point; before the first and after the last it stands still
  bool smooth = true;  ///< between points by minimum jerk, at rest in each; false: straight, as recorded
  double mass = 0.3;   ///< goes along with the tip [kg]
  double stiffness = 400.0;     ///< [N/m]
  double damping = 6.0;         ///< [N s/m]
  double turn_stiffness = 0.2;  ///< about the tool's axis [N m/rad]
  double turn_damping = 2e-3;   ///< [N m s/rad]
  double tremor = 0.0;          ///< amplitude [m], three directions, at frequencies from 8 to 12 Hz
  double lets_go = 1e300;       ///< from this time on it does not hold the tool [s]
  std::uint64_t seed = 1;       ///< of the tremor
};

class Hand {
 public:
  /// Throws ParameterError where the path is empty or not in the order of time, or a number is not finite or
  /// negative.
  explicit Hand(HandSettings settings);

  /// Where the path is at a time, with the tremor: tip, its velocity, psi and its rate.
  struct Wanted {
    Vec3 tip = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    double psi = 0.0;
    double rate = 0.0;
  };
  [[nodiscard]] Wanted wanted(double time) const noexcept;
  /// From a time on it goes straight from where it is to a place, which it reaches after `over` [s], and
  /// stays there; the path is left until `follow`.
  void aim(double time, const Vec3& tip, double psi, double over) noexcept;
  /// It follows the path of the settings again.
  void follow() noexcept { aimed_ = false; }
  [[nodiscard]] bool holds(double time) const noexcept { return time < settings_.lets_go; }
  [[nodiscard]] const HandSettings& settings() const noexcept { return settings_; }

 private:
  [[nodiscard]] Wanted steady(double time) const noexcept;  ///< without the tremor

  HandSettings settings_;
  std::array<PathPoint, 2> aim_{};  ///< straight from the first to the second
  bool aimed_ = false;
  std::array<Vec3, 3> frequency_{};  ///< of three waves in each direction [rad/s]
  std::array<Vec3, 3> phase_{};
};

}  // namespace tissu::haptic
