#include "tissu/haptic/tank.h"

#include <algorithm>
#include <cmath>

namespace tissu::haptic {

void Tank::settle(const TankSettings& settings, double work, double stored, double dissipated) noexcept {
  const double credit = settings.credit * dissipated;
  given_out += work;
  credited += credit;
  energy = std::min(settings.cap, energy - (work + stored) + credit);
}

double Tank::pay(const TankSettings& settings, double more) noexcept {
  double share = 1.0;
  if (more > 0.0 && settings.gate) share = std::clamp(energy / more, 0.0, 1.0);
  energy = std::min(settings.cap, energy - share * more);
  models += share * more;
  return share;
}

void Tank::observe(const TankSettings& settings, double period) noexcept {
  if (!settings.gate) return;
  constexpr double kRoundOff = 1e-9;  // [J]: a tank that has paid all it had is empty, and has no debt
  if (energy < debt - kRoundOff) {
    stiffness = std::max(0.125, 0.5 * stiffness);
    debt = energy;
    ++trips;
  } else if (energy >= -kRoundOff) {
    debt = 0.0;
    stiffness = std::min(1.0, stiffness * (1.0 + 0.1 * period));
  }
}

Joints Tank::damping(const Joints& viscous, const Joints& v, const Joints& slow,
                     double period) const noexcept {
  Joints tau = Joints::Zero();
  if (!(energy < 0.0)) return tau;
  double power = 0.0;
  for (int i = 0; i < kJoints; ++i) {
    if (std::abs(v[i]) > slow[i]) power += viscous[i] * v[i] * v[i];
  }
  if (!(power > 0.0)) return tau;
  const double beta = std::min(1.0, -energy / (period * power));
  for (int i = 0; i < kJoints; ++i) {
    if (std::abs(v[i]) > slow[i]) tau[i] = -beta * viscous[i] * v[i];
  }
  return tau;
}

}  // namespace tissu::haptic
