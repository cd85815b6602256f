#include "tissu/haptic/hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"
#include "tissu/haptic/random.h"

namespace tissu::haptic {
namespace {

void check(const HandSettings& s) {
  if (s.path.empty()) throw ParameterError("The path of a hand has no point; it needs at least one.");
  for (std::size_t i = 0; i < s.path.size(); ++i) {
    const PathPoint& p = s.path[i];
    if (!std::isfinite(p.time) || !p.tip.allFinite() || !std::isfinite(p.psi)) {
      throw ParameterError("Point " + std::to_string(i) + " of the path of a hand is not finite.");
    }
    if (i > 0 && !(p.time > s.path[i - 1].time)) {
      throw ParameterError("Point " + std::to_string(i) + " of the path of a hand is at " +
                           number_text(p.time) + " s; it must be later than the point before it.");
    }
  }
  for (const double value : {s.mass, s.stiffness, s.damping, s.turn_stiffness, s.turn_damping, s.tremor}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw ParameterError(
          "The mass, stiffness, damping and tremor of a hand must be finite and at least 0.");
    }
  }
}

}  // namespace

Hand::Hand(HandSettings settings) : settings_(std::move(settings)) {
  check(settings_);
  Random random(settings_.seed);
  for (std::size_t wave = 0; wave < 3; ++wave) {
    for (int i = 0; i < 3; ++i) {
      frequency_[wave][i] = 2.0 * std::numbers::pi * random.between(8.0, 12.0);
      phase_[wave][i] = random.between(0.0, 2.0 * std::numbers::pi);
    }
  }
}

void Hand::aim(double time, const Vec3& tip, double psi, double over) noexcept {
  const Wanted now = steady(time);
  aim_ = {PathPoint{time, now.tip, now.psi}, PathPoint{time + over, tip, psi}};
  aimed_ = true;
}

Hand::Wanted Hand::steady(double time) const noexcept {
  const std::span<const PathPoint> path =
      aimed_ ? std::span<const PathPoint>(aim_) : std::span<const PathPoint>(settings_.path);
  const bool smooth = settings_.smooth && !aimed_;
  Wanted w;
  if (time >= path.back().time) {
    w.tip = path.back().tip;
    w.psi = path.back().psi;
  } else if (time <= path.front().time) {
    w.tip = path.front().tip;
    w.psi = path.front().psi;
  } else {
    const auto next = std::ranges::upper_bound(path, time, {}, &PathPoint::time);
    const PathPoint& to = *next;
    const PathPoint& from = *(next - 1);
    const double span = to.time - from.time;
    const double s = (time - from.time) / span;
    // Minimum jerk, Flash and Hogan 1985: 10 s^3 - 15 s^4 + 6 s^5.
    const double share = smooth ? s * s * s * (10.0 + s * (6.0 * s - 15.0)) : s;
    const double rate = (smooth ? 30.0 * s * s * (1.0 - s) * (1.0 - s) : 1.0) / span;
    w.tip = from.tip + share * (to.tip - from.tip);
    w.velocity = rate * (to.tip - from.tip);
    w.psi = from.psi + share * (to.psi - from.psi);
    w.rate = rate * (to.psi - from.psi);
  }
  return w;
}

Hand::Wanted Hand::wanted(double time) const noexcept {
  Wanted w = steady(time);
  if (settings_.tremor > 0.0) {
    for (std::size_t wave = 0; wave < 3; ++wave) {
      const Vec3 angle = frequency_[wave] * time + phase_[wave];
      w.tip += settings_.tremor / 3.0 * angle.array().sin().matrix();
      w.velocity += settings_.tremor / 3.0 * angle.array().cos().matrix().cwiseProduct(frequency_[wave]);
    }
  }
  return w;
}

}  // namespace tissu::haptic
