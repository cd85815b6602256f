#include "tissu/haptic/tick.h"

#include <algorithm>
#include <cmath>

#include "haptic/tick_parts.h"

namespace tissu::haptic {
namespace {

/// What carries the tool's weight: -J^T m g of its centre.
Joints weight_torques(const Settings& settings, const Joints& q) noexcept {
  if (settings.tool_mass == 0.0) return Joints::Zero();
  Joints centre = q;
  centre[3] -= settings.tool_centre;
  return -axis_torques(centre, settings.tool_mass * settings.gravity);
}

void fill_report(const Settings& settings, const TickInput& input, const Motion& motion, const Memory& m,
                 TickReport& report) noexcept {
  report.tick = m.tick;
  report.state = m.state;
  report.reason = m.reason;
  report.q = m.q;
  report.speed = motion.speed;
  report.grip = m.sample.counts[4] * settings.grip_size;
  report.torque = m.torque;
  report.stored = m.stored;
  report.share = m.share;
  report.stiffness = m.scale;
  report.tank = m.tank.energy;
  report.given_out = m.tank.given_out;
  report.model_age = model_age(input, m);
  report.stale = report.model_age > settings.stale;
  report.stamp = m.model.stamp;
  report.disagreement = m.disagreement;
  report.tag = m.sample.tag;
}

/// Joint speeds below which the sense of a motion is not known for sure: two counts in the longest window.
Joints slow_of(const Settings& settings) noexcept {
  return 2.0 / ((kWindow - 1) * settings.period) * settings.count_size;
}

/// From what the joints should feel to the command of the motors: limits, slew, transmission, weight.
Command to_motors(const Settings& settings, const Joints& wanted, const Motion& motion, Memory& m,
                  TickReport& report) noexcept {
  const Joints within = saturated(settings.limits, m.q, wanted);
  report.limited = within != wanted;
  const Joints tau = slewed(settings.limits, m.torque, within);
  report.slewed = tau != within;
  const Joints slow = slow_of(settings);
  const bool moves = m.state != State::homing;  // before, speeds and positions mean nothing
  const Joints v = moves ? motion.speed : Joints::Zero();
  const Joints weight = moves ? weight_torques(settings, m.q) : Joints::Zero();
  const Joints motor = settings.transmission.motor(tau + weight, v, slow);
  Command command;
  command.enable = true;
  if (!motor.allFinite()) {
    ++m.bad_torques;
    m.torque.setZero();
    m.paid.setZero();
    return command;
  }
  m.bad_torques = 0;
  m.torque = tau;
  m.paid = tau + settings.transmission.compensation(v, slow);
  for (int i = 0; i < kJoints; ++i) {
    const double most = settings.limits.torque[i];
    const double given = std::clamp(motor[i], -most, most);
    report.limited = report.limited || given != motor[i];
    command.torque[static_cast<std::size_t>(i)] = given;
  }
  return command;
}

}  // namespace

Memory start(const Settings& settings) noexcept {
  Memory m;
  m.tank.fill(settings.tank);
  m.acknowledged = settings.acknowledged;
  return m;
}

Command tick(const Kinematics& kinematics, const Settings& settings, const TickInput& input, Memory& m,
             TickReport& report) noexcept {
  report = {};
  ++m.tick;
  const Motion motion = take_sample(kinematics, settings, input, m, report);
  change_state(settings, input, motion, m);
  Command command;
  if (m.state == State::off || m.state == State::fault) {
    model_torques(kinematics, settings, input, motion, m, report);
    m.torque.setZero();
    m.paid.setZero();
    m.window.clear();
  } else {
    Joints wanted = model_torques(kinematics, settings, input, motion, m, report);
    if (m.state == State::homing) wanted = m.homing_way * settings.homing_torque;
    command = to_motors(settings, wanted, motion, m, report);
  }
  command.sequence = m.sample.sequence;
  fill_report(settings, input, motion, m, report);
  return command;
}

}  // namespace tissu::haptic
