#include "tissu/step/body_balance.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/norm.h"

namespace tissu {

void BodyBalance::prepare(const World& world) {
  world_ = &world;
  bodies_.clear();
  const std::vector<std::uint8_t>& masks = world.fixed().masks();
  const std::vector<double>& mass = world.mass().nodal();
  for (const Body& body : world.bodies()) {
    const auto nodes = static_cast<std::size_t>(body.node_count + body.room);
    const auto first = static_cast<std::size_t>(body.first_node);
    bool free = true;
    double sum = 0.0;
    for (std::size_t i = first; i < first + nodes; ++i) {
      sum += mass[i];
      free = free && (masks[i] == 0 || mass[i] == 0.0);
    }
    bodies_.push_back({3 * first, 3 * nodes, free ? sum : 0.0});
  }
}

double BodyBalance::norm_of(const Row& body, ConstReals impulses) const {
  const ConstReals own = impulses.subspan(body.first, body.count);
  if (body.mass == 0.0) return norm(own);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < own.size(); k += 3) sum += Vec3(own[k], own[k + 1], own[k + 2]);
  const Vec3 velocity = sum / body.mass;
  const std::vector<double>& mass = world_->mass().nodal();
  double squares = 0.0;
  for (std::size_t k = 0; k < own.size(); k += 3) {
    const Vec3 rest = Vec3(own[k], own[k + 1], own[k + 2]) - mass[(body.first + k) / 3] * velocity;
    squares += rest.squaredNorm();
  }
  return std::sqrt(squares);
}

void BodyBalance::set_external(double push, ConstReals force) {
  for (Row& body : bodies_) body.external = push * norm_of(body, force);
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

bool BodyBalance::leaves_more(Shares shares, double floor, ConstReals imbalance,
                              ConstReals momentum_change) const {
  return std::ranges::any_of(bodies_, [&](const Row& body) {
    const double changed = norm_of(body, momentum_change);
    const double acting = std::max({body.external, body.contacts, body.reactions, changed});
    const double share = body.mass == 0.0 ? shares.held : shares.free;
    return norm(imbalance.subspan(body.first, body.count)) > share * acting + floor;
  });
}

}  // namespace tissu
