#include "tissu/step/part_balance.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

double square_sum(const ConnectedPart& part, ConstReals rows) {
  double squares = 0.0;
  for (const std::int32_t node : part.nodes) squares += block(rows, node).squaredNorm();
  return squares;
}

/// The body that a part begins in; bodies are in the order of their nodes.
std::size_t body_of(const World& world, const ConnectedPart& part) {
  const auto& bodies = world.bodies();
  const auto after = std::ranges::upper_bound(bodies, part.nodes.front(), {}, &Body::first_node);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - bodies.begin()) - 1);
}

}  // namespace

double PartBalance::Acting::norm() const {
  return std::sqrt(std::max({external, contacts, reactions, momentum}));
}

void PartBalance::prepare(const World& world) {
  world_ = &world;
  parts_ = parts_of(world);
  acting_.assign(parts_.size(), {});
  bodies_.assign(std::max<std::size_t>(1, world.bodies().size()), {});
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    OfBody& body = bodies_[body_of(world, parts_[k])];
    body.parts.push_back(k);
    body.is_held = body.is_held || parts_[k].is_held;
  }
  on_held_body_.assign(parts_.size(), 0);
  for (const OfBody& body : bodies_) {
    for (const std::size_t k : body.parts) on_held_body_[k] = body.is_held ? 1 : 0;
  }
}

double PartBalance::square_of(std::size_t k, ConstReals impulses) const {
  const ConnectedPart& part = parts_[k];
  if (on_held_body_[k] != 0) return square_sum(part, impulses);
  Vec3 velocity = Vec3::Zero();
  for (const std::int32_t node : part.nodes) velocity += block(impulses, node);
  velocity /= part.mass;
  const std::vector<double>& mass = world_->mass().nodal();
  double squares = 0.0;
  for (const std::int32_t node : part.nodes) {
    squares += (block(impulses, node) - mass[static_cast<std::size_t>(node)] * velocity).squaredNorm();
  }
  return squares;
}

void PartBalance::set_external(double push, ConstReals force) {
  for (std::size_t k = 0; k < parts_.size(); ++k) acting_[k] = {push * push * square_of(k, force)};
}

void PartBalance::set_contacts(double push, ConstReals force) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    acting_[k].contacts = push * push * square_sum(parts_[k], force);
  }
}

void PartBalance::lay_strained(ConstReals given, Reals out) const {
  const std::vector<std::uint8_t>& masks = world_->fixed().masks();
  std::ranges::fill(out, 0.0);
  const auto lay = [&](std::int32_t row, const Vec3& mean) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((masks[static_cast<std::size_t>(row)] >> axis) & 1) == 0) continue;
      block(out, row)[axis] = block(given, row)[axis] - mean[axis];
    }
  };
  for (const ConnectedPart& part : parts_) {
    if (!part.is_held) continue;
    const Vec3 mean = carried(*world_, part, given).velocity;
    for (const std::int32_t node : part.nodes) lay(node, mean);
    for (const std::int32_t k : part.frames) {
      lay(world_->frames()[static_cast<std::size_t>(k)].rotation, Vec3::Zero());
    }
  }
}

void PartBalance::set_reactions(ConstReals reactions, ConstReals strained) {
  const std::vector<std::uint8_t>& masks = world_->fixed().masks();
  const auto held_squares = [&](const ConnectedPart& part, ConstReals rows) {
    double squares = 0.0;
    for (const std::int32_t node : part.nodes) {
      const std::uint8_t mask = masks[static_cast<std::size_t>(node)];
      for (int axis = 0; axis < 3; ++axis) {
        if (((mask >> axis) & 1) != 0) squares += block(rows, node)[axis] * block(rows, node)[axis];
      }
    }
    return squares;
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    acting_[k].reactions = std::min(held_squares(parts_[k], reactions), held_squares(parts_[k], strained));
  }
}

PartBalance::Acting PartBalance::all_acting(std::size_t k, ConstReals momentum_change) const {
  Acting all = acting_[k];
  all.momentum = square_of(k, momentum_change);
  return all;
}

double PartBalance::acting(std::size_t k, ConstReals momentum_change) const {
  return all_acting(k, momentum_change).norm();
}

bool PartBalance::leaves_more(Shares shares, double floor, ConstReals imbalance,
                              ConstReals momentum_change) const {
  return std::ranges::any_of(bodies_, [&](const OfBody& body) {
    Acting sum;
    double left = 0.0;
    for (const std::size_t k : body.parts) {
      const Acting one = all_acting(k, momentum_change);
      sum.external += one.external;
      sum.contacts += one.contacts;
      sum.reactions += one.reactions;
      sum.momentum += one.momentum;
      left += square_sum(parts_[k], imbalance);
    }
    return std::sqrt(left) > (body.is_held ? shares.held : shares.free) * sum.norm() + floor;
  });
}

}  // namespace tissu
