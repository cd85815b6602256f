#pragma once

/// The implicit midpoint rule for a tool in the trocar.

#include <Eigen/Cholesky>
#include <cmath>

#include "tissu/haptic/tool_motion.h"

namespace tissu::haptic {

/// One step of h: q1 = q0 + h v, p1 = p0 + h (dT/dq + Q) at ((q0 + q1) / 2, v), v = M^-1 (p0 + p1) / 2.
/// `forces(q, v)` gives MotionForces; `v` is where the iteration begins, and what it ends with. Without
/// forces energy is kept up to a bounded term of the order h^2: the rule is symplectic.
template <class Forces>
void midpoint_step(const ToolInertia& tool, double h, const Forces& forces, ToolState& state,
                   Joints& v) noexcept {
  constexpr int kMost = 30;
  constexpr double kClose = 1e-13;
  Joints push;
  for (int i = 0; i < kMost; ++i) {
    const Joints middle = state.q + 0.5 * h * v;
    const Inertia inertia(tool, middle);
    const MotionForces f = forces(middle, v);
    push = h * (inertia.slope(v) + f.Q);
    const Joints residual = 2.0 * (inertia.matrix() * v - state.p) - push;
    if (residual.isZero(0.0)) break;
    const Eigen::Matrix4d slope = 2.0 * inertia.matrix() + h * f.damping + 0.5 * h * h * f.stiffness;
    const Joints change = slope.ldlt().solve(residual);
    v -= change;
    if (change.cwiseAbs().maxCoeff() <= kClose * v.cwiseAbs().maxCoeff()) break;
  }
  const Inertia inertia(tool, state.q + 0.5 * h * v);
  state.p = 2.0 * inertia.matrix() * v - state.p;
  state.q += h * v;
}

}  // namespace tissu::haptic
