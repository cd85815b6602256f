#include "tissu/step/body_balance.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/norm.h"

namespace tissu {

void BodyBalance::prepare(const World& world) {
  bodies_.clear();
  for (const Body& body : world.bodies()) {
    const auto count = static_cast<std::size_t>(body.node_count + body.room);
    bodies_.push_back({3 * static_cast<std::size_t>(body.first_node), 3 * count});
  }
}

void BodyBalance::set_external(double push, ConstReals force) {
  for (Row& body : bodies_) body.external = push * norm(force.subspan(body.first, body.count));
}

void BodyBalance::set_contacts(double push, ConstReals force) {
  for (Row& body : bodies_) body.contacts = push * norm(force.subspan(body.first, body.count));
}

void BodyBalance::clear_reactions() {
  for (Row& body : bodies_) body.reactions = 0.0;
}

void BodyBalance::set_reactions(const FixedDofs& fixed, ConstReals impulses) {
  const auto& masks = fixed.masks();
  for (Row& body : bodies_) {
    double sum = 0.0;
    for (std::size_t k = body.first; k < body.first + body.count; ++k) {
      if (((masks[k / 3] >> (k % 3)) & 1) != 0) sum += impulses[k] * impulses[k];
    }
    body.reactions = std::sqrt(sum);
  }
}

bool BodyBalance::leaves_more(double share, double floor, ConstReals imbalance,
                              ConstReals momentum_change) const {
  return std::ranges::any_of(bodies_, [&](const Row& body) {
    const double changed = norm(momentum_change.subspan(body.first, body.count));
    const double acting = std::max({body.external, body.contacts, body.reactions, changed});
    return norm(imbalance.subspan(body.first, body.count)) > share * acting + floor;
  });
}

}  // namespace tissu
