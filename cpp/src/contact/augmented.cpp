#include "tissu/contact/augmented.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

constexpr int kHolds = 3;  ///< systems in which a contact that opened is kept: it may pull

}  // namespace

/// Another system has to follow, without what pulled.
bool AugmentedContact::holds_on() const {
  return in_time_ && systems() < std::min(kHolds, contact_.description().iterations - 1);
}

std::optional<double> AugmentedContact::press(std::size_t i, ContactNumbers& c) {
  const double k = hard_stiffness(i);
  const double t = c.force - k * run_.gap(i);
  const bool is_held_on = run_.holds_on() && c.force > 0.0;
  if (k == 0.0 || !(t > 0.0 || run_.is_predicted(i) || is_held_on)) return std::nullopt;
  give(c, t, k);
  // What presses where it is open is as wrong as what is deep: it throws surfaces apart.
  note_depth(c, t > 0.0 ? std::abs(run_.gap(i)) : -run_.gap(i));
  return c.force + (t - c.force) / (1.0 + share_of_stiffness(i));
}

void AugmentedContact::take() {
  if (systems() == 0) {
    extrapolation_.forget();
  } else if (in_time_) {
    extrapolation_.lead(run_.acting(), pressing());
  }
  ImplicitContact::take();
}

}  // namespace tissu
