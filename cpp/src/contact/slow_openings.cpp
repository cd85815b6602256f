/// Depths of rigid contacts, which open over a whole step: a part of it opens its share of them.
///
/// Opened at once in a short part, a depth becomes a velocity that throws light bodies away.

#include <algorithm>

#include "tissu/contact/contact.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

/// Of what is rigid: a soft body takes up the depth itself, and its parts are as stiff as they are short.
void ContactRun::open_slowly() {
  const auto& vertices = contact_.surfaces().vertices();
  const auto is_soft = [&](double vertex) {
    return vertex >= 0.0 && vertices[static_cast<std::size_t>(vertex)].is_soft();
  };
  for (std::size_t i = 0; i < looked_.size(); ++i) {
    const ContactNumbers& c = looked_[i];
    if (std::ranges::any_of(c.vertex, is_soft)) continue;
    const Vec3 n = vector_of(c.normal);
    const double slack = (1.0 - share_) * (c.apart - n.dot(vector_of(c.place) - gone(c)));
    if (!(slack > 0.0)) continue;
    gaps_[i] += slack;
    predicted_[i] = n.dot(reach(c, goal_)) < c.apart - slack ? 1 : 0;
  }
}

}  // namespace tissu
