#pragma once

#include <optional>
#include <vector>

#include "tissu/world/world.h"

namespace tissu {

/// The largest eigenfrequency of the free degrees of freedom at a state [rad/s]: omega with K y = omega^2 M
/// y, by Lanczos' method on M^-1/2 K M^-1/2 until it changes by less than a millionth. 0 when no stiffness is
/// positive. An explicit method without damping is stable while its step is below 2 / omega (symplectic
/// Euler).
double largest_frequency(const World& world, const State& state);

/// What limits explicit steps [rad/s, 1/s].
struct Vibration {
  double frequency = 0.0;        ///< the largest, omega
  double damping = 0.0;          ///< y . D y / y . M y of its shape y, D = -df/dv
  double largest_damping = 0.0;  ///< the largest eigenvalue of M^-1 D
};
/// Those at a state, to a thousandth.
Vibration fastest_vibration(const World& world, const State& state);
/// Frequency and damping of the shape y for which h^2 y . K y + 2 h y . D y is largest, with y . M y = 1.
/// Where neither the fastest shape nor the most damped one limits the step h [s], this one does: velocities
/// that are damped explicitly change their sign from step to step where that is 4 (symplectic Euler).
Vibration stiffest_vibration(const World& world, const State& state, double h);

/// Which pairs of frequency and damping the shapes y of a state have: (y . K y, y . D y) with y . M y = 1.
/// All pairs together, of complex shapes, are a convex set (Toeplitz, Hausdorff), to which those of the modes
/// belong, whatever of the world is damped and however; of what is independent it is the convex hull.
class DampingRange {
 public:
  DampingRange(const World& world, const State& state);
  /// A shape with damping < ratio frequency^2 - offset, by more than two thousandths of what its nodes have
  /// of these, if there is one.
  [[nodiscard]] std::optional<Vibration> below(double ratio, double offset) const;

 private:
  const World& world_;
  const State& state_;
  // How much of each comes to a row, measured by products: what is soft counts beside what is stiff.
  std::vector<double> stiffness_;
  std::vector<double> damping_;
};

}  // namespace tissu
