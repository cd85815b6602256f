#include "tissu/haptic/transmission.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu::haptic {

void Transmission::check() const {
  for (int i = 0; i < kJoints; ++i) {
    if (!(efficiency[i] > 0.0 && efficiency[i] <= 1.0)) {
      throw ParameterError("The efficiency of axis " + std::to_string(i) + " is " +
                           number_text(efficiency[i]) + "; above 0 and at most 1 is accepted.");
    }
    if (!(coulomb[i] >= 0.0) || !std::isfinite(coulomb[i])) {
      throw ParameterError("The Coulomb friction of axis " + std::to_string(i) + " is " +
                           number_text(coulomb[i]) + "; at least 0 is accepted.");
    }
  }
  if (!(share >= 0.0 && share <= 0.8)) {
    throw ParameterError("The share of friction that is compensated is " + number_text(share) +
                         "; 0 to 0.8 is accepted, since more is active.");
  }
}

Joints Transmission::compensation(const Joints& v, const Joints& slow) const noexcept {
  Joints made;
  for (int i = 0; i < kJoints; ++i) made[i] = share * coulomb[i] * std::clamp(v[i] / slow[i], -1.0, 1.0);
  return made;
}

Joints Transmission::motor(const Joints& tau, const Joints& v, const Joints& slow) const noexcept {
  Joints made = tau + compensation(v, slow);
  for (int i = 0; i < kJoints; ++i) {
    const double moving = std::clamp(v[i] / slow[i], -1.0, 1.0);
    const double s = made[i] < 0.0 ? -moving : moving;  // +1: the motor drives the hand
    // A joint at rest gets what it asks for; on either side one straight line in s.
    made[i] *= s >= 0.0 ? 1.0 + s * (1.0 / efficiency[i] - 1.0) : 1.0 + s * (1.0 - efficiency[i]);
  }
  return made;
}

}  // namespace tissu::haptic
