/// Round obstacles that are led and turn about their own axis. Their vertices are their middle, which such a
/// turn leaves where it is; their surface goes along under what they touch.

#include <algorithm>

#include "tissu/base/index.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

void ContactRun::list_round() {
  const SurfaceSet& surfaces = contact_.surfaces();
  for (const auto& surface : surfaces.surfaces()) {
    if (surface.obstacle < 0 || surface.carrier >= 0) continue;
    const auto first = surfaces.vertices().begin() + surface.first_vertex;
    const auto last = surfaces.vertices().begin() + surface.last_vertex;
    if (std::any_of(first, last, [](const SurfaceVertex& vertex) { return vertex.radius > 0.0; })) {
      round_.push_back(surface.obstacle);
    }
  }
  if (!round_.empty()) led_turns_.assign(contact_.description().obstacles.size(), Vec3::Zero());
}

/// How the obstacles turn in the step.
void ContactRun::turn_led() {
  turns_led_ = false;
  for (const std::int32_t obstacle : round_) {
    Vec3& turn = led_turns_[at(obstacle)];
    turn = contact_.turn_of(obstacle, *start_, start_->time, end_);
    turns_led_ = turns_led_ || !turn.isZero(0.0);
  }
}

/// What r of a contact has of that: where they touch stays where it is seen from the middle, and in the whole
/// step the surface goes by turn x outward there, however far it turns.
Vec3 ContactRun::turned_by(const ContactNumbers& contact) const {
  const SurfaceSet& surfaces = contact_.surfaces();
  Vec3 way = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] < 0.0) continue;
    const SurfaceVertex& vertex = surfaces.vertices()[static_cast<std::size_t>(contact.vertex[k])];
    if (vertex.is_free() || vertex.radius == 0.0) continue;
    const Vec3& turn = led_turns_[at(surfaces.surfaces()[at(vertex.surface)].obstacle)];
    way += contact.beta[k] * turn.cross(contact_.outward(contact, k));
  }
  return way;
}

}  // namespace tissu
