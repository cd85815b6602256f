#include "tissu/contact/augmented.h"

namespace tissu {

std::optional<double> AugmentedContact::press(std::size_t i, ContactNumbers& c) {
  const double k = hard_stiffness(i);
  const double t = c.force - k * run_.gap(i);
  if (k == 0.0 || !(t > 0.0 || run_.is_predicted(i))) return std::nullopt;
  give(c, t, k);
  note_depth(c, -run_.gap(i));
  return c.force + (t - c.force) / (1.0 + share_of_stiffness(i));
}

}  // namespace tissu
