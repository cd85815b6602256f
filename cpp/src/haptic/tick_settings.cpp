#include <cmath>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/haptic/tick.h"

namespace tissu::haptic {
namespace {

/// Collects what is wrong; one sentence each.
class Problems {
 public:
  void require(bool good, const std::string& sentence) {
    if (good) return;
    if (!text_.empty()) text_ += '\n';
    text_ += sentence;
  }
  void raise() const {
    if (!text_.empty()) throw ParameterError(text_);
  }

 private:
  std::string text_;
};

bool all_above(const Joints& values, double low) {
  return values.allFinite() && (values.array() > low).all();
}
bool all_from(const Joints& values, double low) {
  return values.allFinite() && (values.array() >= low).all();
}

constexpr const char* kAxis[] = {"pitch", "roll", "own rotation", "depth"};

void check_stiffness(const Settings& s, double delay, Problems& problems) {
  const Joints most = passive_stiffness(s.friction, s.count_size, s.period, delay, 1.0);
  for (int i = 0; i < kJoints; ++i) {
    problems.require(s.stiffness[i] <= most[i] * (1.0 + 1e-12),
                     "The stiffness of " + std::string(kAxis[i]) + " is " + number_text(s.stiffness[i]) +
                         "; at most " + number_text(most[i]) + " is passive for its friction, a period of " +
                         number_text(s.period) + " s and a delay of " + number_text(delay) +
                         " s; lower it or take the automatic one.");
  }
}

void check_limits(const Settings& s, Problems& problems) {
  problems.require(all_above(s.limits.torque, 0.0) && s.limits.force > 0.0 && std::isfinite(s.limits.force) &&
                       s.limits.speed > 0.0 && std::isfinite(s.limits.speed),
                   "The limits of torque, force and speed must be finite and above 0.");
  problems.require(
      s.limits.slew > 0.0 && s.limits.slew <= 1.0,
      "The slew is " + number_text(s.limits.slew) + "; above 0 and at most 1 of the limit is accepted.");
  for (int i = 0; i < kJoints; ++i) {
    problems.require(s.joints.low[i] < s.joints.high[i] &&
                         (i > 1 || (s.joints.low[i] >= -1.31 && s.joints.high[i] <= 1.31)),
                     "The limits of " + std::string(kAxis[i]) + " are " + number_text(s.joints.low[i]) +
                         " and " + number_text(s.joints.high[i]) +
                         "; the low one must be below, and of pitch and roll neither beyond 75 degrees.");
  }
  problems.require(s.joints.low[3] > 0.0,
                   "The least depth must be above 0 m, where the mechanism is singular.");
}

void check_times(const Settings& s, Problems& problems) {
  problems.require(
      s.ramp >= 0.0 && s.fade > 0.0 && s.stall > 0.0 && s.stale > 0.0 && s.homing_still > 0.0 &&
          std::isfinite(s.ramp + s.fade + s.stall + s.stale + s.homing_still),
      "The ramp must be at least 0 s; fade, stall, stale and the still time of homing above 0 s.");
  problems.require(s.sweeps.sweeps >= 1 && s.sweeps.tolerance >= 0.0,
                   "The patch solver needs at least one sweep and a tolerance of at least 0.");
  problems.require(s.tank.cap > 0.0 && s.tank.start >= 0.0 && s.tank.start <= s.tank.cap &&
                       s.tank.reserve >= 0.0 && s.tank.reserve <= s.tank.start && s.tank.credit >= 0.0 &&
                       s.tank.credit <= 1.0,
                   "The tank's cap must be above 0 J, its start between 0 and the cap, its reserve between 0 "
                   "and the start, its credit from 0 to 1.");
  problems.require(s.turn_counts >= 0, "The counts of a turn must be at least 0.");
  problems.require(
      s.homing_torque.allFinite() && s.gravity.allFinite() && s.tool_mass >= 0.0 &&
          std::isfinite(s.tool_mass + s.tool_centre),
      "The homing torque, gravity and the tool's mass and centre must be finite, the mass at least 0.");
}

}  // namespace

void check(const Settings& s, double delay) {
  Problems problems;
  problems.require(s.period >= 0.999e-4 && s.period <= 1.0 / 299.9,
                   "The rate is " + number_text(1.0 / s.period) + " Hz; 300 Hz to 10 kHz is accepted.");
  problems.require(delay >= 0.0 && std::isfinite(delay), "The delay must be at least 0 s.");
  const bool known = all_above(s.friction.viscous, 0.0) && all_above(s.friction.coulomb, 0.0) &&
                     all_above(s.count_size, 0.0) && s.period > 0.0 && delay >= 0.0;
  problems.require(known, "Friction and the size of a count must be finite and above 0 on every axis.");
  problems.require(all_above(s.stiffness, 0.0), "The stiffness must be finite and above 0 on every axis.");
  problems.require(all_from(s.damping, 0.0),
                   "The virtual damping must be finite and at least 0 on every axis.");
  if (known && all_above(s.stiffness, 0.0)) check_stiffness(s, delay, problems);
  check_limits(s, problems);
  check_times(s, problems);
  try {
    s.transmission.check();
  } catch (const ParameterError& error) {
    problems.require(false, error.what());
  }
  problems.raise();
}

}  // namespace tissu::haptic
