#include "tissu/contact/implicit_penalty.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tissu {

ImplicitPenalty::ImplicitPenalty(const Contact& contact, const FixedDofs& fixed, const Mass* mass,
                                 std::vector<double> rest)
    : ImplicitContact(contact, fixed), mass_(mass), rest_(std::move(rest)) {
  for (const ContactPair& pair : contact.description().pairs) zetas_.push_back(damping_of(pair));
}

bool ImplicitPenalty::may_press(std::size_t i) const {
  const ContactNumbers& c = run_.looked()[i];
  return c.force > 0.0 || run_.gap(i) < pair_of(c).gap;
}

double ImplicitPenalty::damper_over_step(const ContactNumbers& contact, double k) const {
  if (mass_ == nullptr) return 0.0;
  double inverse = 0.0;
  run_.for_parts(contact, [&](const CarriedPart& part) {
    if (part.turns) return;  // damped less than what turns
    inverse += part.weight * part.weight / mass_->nodal()[static_cast<std::size_t>(part.row)];
  });
  const double zeta = zetas_[static_cast<std::size_t>(contact.pair)];
  return inverse > 0.0 ? 2.0 * zeta * std::sqrt(k / inverse) / h() : 0.0;
}

void ImplicitPenalty::begin_press() {
  const auto looked = run_.looked();
  depths_.assign(looked.size(), 0.0);
  ranges_ = shares_ = depths_;
  for (std::size_t i = 0; i < looked.size(); ++i) {
    if (!may_press(i)) continue;
    const double range = spring_range(contact_, looked[i]);
    depths_[i] = std::max(0.0, range - run_.gap(i));
    ranges_[i] = range + std::min(pair_of(looked[i]).gap, looked[i].apart);
    shares_[i] = depths_[i] / ranges_[i];
  }
  find_stiffnesses(rest_, 1.0, shares_, springs_);
}

std::optional<double> ImplicitPenalty::press(std::size_t i, ContactNumbers& c) {
  const ContactPair& pair = pair_of(c);
  const bool own = pair.stiffness && c.area > 0.0;
  const double k = own ? run_.weight(i) * *pair.stiffness * c.area : springs_[i];
  double force = 0.0;
  double slope = 0.0;
  if (depths_[i] > 0.0) {
    const SpringForce spring = spring_force(contact_.description().penalty, k, depths_[i], ranges_[i]);
    const double damper = damper_over_step(c, k);
    force = spring.force - damper * vector_of(c.normal).dot(run_.gone(c));
    slope = spring.slope + damper;
  }
  const double beyond = spring_stop(contact_, c) - c.apart - run_.gap(i);
  const double hard = std::max(k, hard_stiffness(i));
  note_depth(c, beyond);
  if (const double stop = c.force + hard * beyond; stop > force) {
    force = stop;
    slope = hard;
  }
  if (!(force > 0.0)) return std::nullopt;
  give(c, force, slope);
  return force;
}

}  // namespace tissu
