/// What pushes the simulated tool: motors, friction, ends, weight and hand; and a step of its motion.

#include <algorithm>
#include <cmath>

#include "haptic/midpoint_step.h"
#include "tissu/haptic/simulated_device.h"

namespace tissu::haptic {

/// First order towards the commanded torques, the middle of the substep; of depth what the rollers pass.
Joints SimulatedDevice::motors(double h) noexcept {
  const double share = line_.motor_lag > 0.0 ? -std::expm1(-h / line_.motor_lag) : 1.0;
  const Joints before = torque_;
  torque_ += share * (target_ - torque_);
  Joints middle = line_.motor_lag > 0.0 ? Joints(0.5 * (before + torque_)) : torque_;
  const double most = mechanism_.roller_force;
  const double force = middle[3];
  if (slip_rate_ != 0.0 || std::abs(force) > most) {
    const double passed = std::copysign(most, slip_rate_ != 0.0 ? slip_rate_ : force);
    const double rate = slip_rate_ + h * (force - passed) / mechanism_.inertia.cradle[3];
    const bool stops = slip_rate_ * rate < 0.0;
    slip_ += 0.5 * h * (slip_rate_ + (stops ? 0.0 : rate));
    slip_rate_ = stops ? 0.0 : rate;
    middle[3] = passed;
  }
  return middle;
}

/// Viscous friction, Dahl's bristles (dz/dx = (1 - z sgn v) / x_s, F = f_c z) and what the transmission
/// loses: (1 - eta) of the torque while the motor drives the hand, 1/eta - 1 of it while the hand drives the
/// motor.
Joints SimulatedDevice::friction(const Joints& v, const Joints& motor, double h,
                                 MotionForces* forces) const noexcept {
  Joints Q;
  for (int i = 0; i < kJoints; ++i) {
    const double way = 0.5 * h / mechanism_.presliding[i];
    const double below = 1.0 + way * std::abs(v[i]);
    const double z = (bristle_[i] + way * v[i]) / below;
    const double eta = mechanism_.efficiency[i];
    const double lost = std::abs(motor[i]) * (motor[i] * v[i] > 0.0 ? 1.0 - eta : 1.0 / eta - 1.0);
    const double moving = std::clamp(v[i] / mechanism_.blend[i], -1.0, 1.0);
    Q[i] = -mechanism_.friction.viscous[i] * v[i] - mechanism_.friction.coulomb[i] * z - lost * moving;
    if (forces == nullptr) continue;
    forces->damping(i, i) += mechanism_.friction.viscous[i] + mechanism_.friction.coulomb[i] * way / below +
                             (std::abs(moving) < 1.0 ? lost / mechanism_.blend[i] : 0.0);
  }
  return Q;
}

Joints SimulatedDevice::ends(const Joints& q, MotionForces* forces) const noexcept {
  Joints Q = Joints::Zero();
  for (const int i : {0, 1, 3}) {
    const double beyond = q[i] - std::clamp(q[i], mechanism_.low[i], mechanism_.high[i]);
    if (beyond == 0.0) continue;
    Q[i] = -mechanism_.stop_stiffness[i] * beyond;
    if (forces != nullptr) forces->stiffness(i, i) += mechanism_.stop_stiffness[i];
  }
  return Q;
}

Joints SimulatedDevice::hand_torques(const Joints& q, const Joints& v, double time,
                                     MotionForces* forces) const noexcept {
  if (!holding_) return Joints::Zero();
  const HandSettings& hand = hand_->settings();
  const Hand::Wanted wanted = hand_->wanted(time);
  const Mat3 omega = tool_turns(q);
  const Vec3 tip = q[3] * omega.col(2);
  Jacobian J;
  J << omega.col(0).cross(tip), omega.col(1).cross(tip), Vec3::Zero(), omega.col(2);
  const Vec3 force = hand.stiffness * (wanted.tip - tip) + hand.damping * (wanted.velocity - J * v);
  Joints Q = J.transpose() * force;
  Q[2] += hand.turn_stiffness * (wanted.psi - q[2]) + hand.turn_damping * (wanted.rate - v[2]);
  if (forces != nullptr) {
    const Eigen::Matrix4d square = J.transpose() * J;
    forces->stiffness += hand.stiffness * square;
    forces->damping += hand.damping * square;
    forces->stiffness(2, 2) += hand.turn_stiffness;
    forces->damping(2, 2) += hand.turn_damping;
  }
  return Q;
}

void SimulatedDevice::let_go() noexcept {
  const Inertia before(inertia_, state_.q);
  const Joints v = before.matrix().ldlt().solve(state_.p);
  const double kinetic = 0.5 * v.dot(state_.p);
  inertia_.held = 0.0;
  state_.p = Inertia(inertia_, state_.q).matrix() * v;
  work_.hand += 0.5 * v.dot(state_.p) - kinetic;  // the hand takes its own part with it
  holding_ = false;
}

void SimulatedDevice::substep(double h) noexcept {
  if (holding_ && !hand_->holds(time_)) let_go();
  take_commands();
  const Joints motor = motors(h);
  const double middle = time_ + 0.5 * h;
  const Vec3 weight = mechanism_.inertia.mass * mechanism_.gravity;
  const bool heavy = !weight.isZero(0.0);
  const auto forces = [&](const Joints& q, const Joints& v) {
    MotionForces f;
    f.Q = motor + friction(v, motor, h, &f) + ends(q, &f) + hand_torques(q, v, middle, &f);
    if (heavy) {
      Joints centre = q;
      centre[3] -= mechanism_.inertia.centre;
      f.Q += axis_torques(centre, weight);
    }
    return f;
  };
  const Joints before = state_.q;
  midpoint_step(inertia_, h, forces, state_, v_);
  const Joints at = 0.5 * (before + state_.q);
  work_.motor += h * motor.dot(v_);
  work_.friction -= h * friction(v_, motor, h, nullptr).dot(v_);
  work_.hand += h * hand_torques(at, v_, middle, nullptr).dot(v_);
  for (int i = 0; i < kJoints; ++i) {
    const double way = 0.5 * h / mechanism_.presliding[i];
    bristle_[i] =
        (bristle_[i] * (1.0 - way * std::abs(v_[i])) + 2.0 * way * v_[i]) / (1.0 + way * std::abs(v_[i]));
  }
}

DeviceEnergy SimulatedDevice::energy() const noexcept {
  DeviceEnergy e = work_;
  e.kinetic = 0.5 * state_.p.dot(rates());
  const double arm = state_.q[3] - mechanism_.inertia.centre;
  e.potential = -mechanism_.inertia.mass * arm * mechanism_.gravity.dot(tool_axis(state_.q));
  for (const int i : {0, 1, 3}) {
    const double beyond = state_.q[i] - std::clamp(state_.q[i], mechanism_.low[i], mechanism_.high[i]);
    e.potential += 0.5 * mechanism_.stop_stiffness[i] * beyond * beyond;
  }
  return e;
}

Joints SimulatedDevice::rates() const noexcept {
  return Inertia(inertia_, state_.q).matrix().ldlt().solve(state_.p);
}

Vec3 SimulatedDevice::hand_force() const noexcept {
  if (!holding_) return Vec3::Zero();
  const Hand::Wanted wanted = hand_->wanted(time_);
  const Joints v = rates();
  const TrocarKinematics kinematics;
  const Vec3 tip = kinematics.point(state_.q, Vec3::Zero());
  const Vec3 velocity = kinematics.jacobian(state_.q, Vec3::Zero()) * v;
  return hand_->settings().stiffness * (wanted.tip - tip) +
         hand_->settings().damping * (wanted.velocity - velocity);
}

}  // namespace tissu::haptic
