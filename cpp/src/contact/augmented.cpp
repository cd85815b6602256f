#include "tissu/contact/augmented.h"

namespace tissu {
namespace {

constexpr int kHolds = 3;  ///< systems in which a contact that opened is kept for what it did: it may pull

}  // namespace

std::optional<double> AugmentedContact::press(std::size_t i, ContactNumbers& c) {
  const double k = hard_stiffness(i);
  const double t = c.force - k * run_.gap(i);
  const bool holds_on = run_.holds_on() && c.force > 0.0 && systems() < kHolds;
  if (k == 0.0 || !(t > 0.0 || run_.is_predicted(i) || holds_on)) return std::nullopt;
  give(c, t, k);
  note_depth(c, -run_.gap(i));
  return c.force + (t - c.force) / (1.0 + share_of_stiffness(i));
}

void AugmentedContact::take() {
  if (systems() == 0) {
    extrapolation_.forget();
  } else if (run_.holds_on()) {
    extrapolation_.lead(run_.acting(), pressing());
  }
  ImplicitContact::take();
}

}  // namespace tissu
