#pragma once

/// Places on frames, which turn with them under a force, and whole numbers, as links and grabs keep them in
/// the memory of a state.

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>

#include "tissu/assembly/couplings.h"
#include "tissu/state/state.h"

namespace tissu {

/// From a frame's origin to a place in its axes, in space; zero for a node, whose frame is below zero.
inline Vec3 lever_arm(const State& state, std::int32_t frame, const Vec3& place) {
  if (frame < 0) return Vec3::Zero();
  return state.rotations[static_cast<std::size_t>(frame)] * place;
}

/// What the moment r x g of a force g that stays changes by as its arm r turns, d(r x g)/dtheta: symmetric,
/// as the stiffness of rotations is. What is left out, half of theta x (r x g), cancels where moments
/// balance.
inline Mat3 turning_arm(const Vec3& r, const Vec3& g) {
  return 0.5 * (r * g.transpose() + g * r.transpose()) - r.dot(g) * Mat3::Identity();
}

/// The nearest positive semi-definite matrix to -turning_arm.
inline Mat3 definite_turning_arm(const Vec3& r, const Vec3& g) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(-turning_arm(r, g));
  const Mat3& axes = eigen.eigenvectors();
  return axes * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * axes.transpose();
}

/// out += scale times the moment by which an arm that turns with p under a force answers, of a rotation.
inline void add_turning(const Vec3& arm, const Vec3& force, std::int32_t rotation, double scale, ConstReals p,
                        Reals out) {
  block(out, rotation) += scale * (turning_arm(arm, force) * block(p, rotation));
}

/// The same in a matrix, as far as it is definite.
inline void couple_turning(const Vec3& arm, const Vec3& force, std::int32_t rotation, double scale,
                           Couplings& couplings) {
  const Mat3 H = definite_turning_arm(arm, force);
  if (!H.isZero(0.0)) couplings.add({{rotation, 0, 0, 0}, {1.0, 0.0, 0.0, 0.0}, -scale * H});
}

/// Whether a number of the memory is whole, at least `from` and below `to`.
inline bool is_whole(double value, double from, double to) {
  return value == std::floor(value) && value >= from && value < to;
}

}  // namespace tissu
