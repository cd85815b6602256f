#include "tissu/step/part_balance.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

/// The norm of rows of a part.
double plain_norm(const ConnectedPart& part, ConstReals rows) {
  double squares = 0.0;
  for (const std::int32_t node : part.nodes) squares += block(rows, node).squaredNorm();
  return std::sqrt(squares);
}

}  // namespace

void PartBalance::prepare(const World& world) {
  world_ = &world;
  parts_ = parts_of(world);
  acting_.assign(parts_.size(), {});
}

double PartBalance::norm_of(const ConnectedPart& part, ConstReals impulses) const {
  if (part.is_held) return plain_norm(part, impulses);
  Vec3 velocity = Vec3::Zero();
  for (const std::int32_t node : part.nodes) velocity += block(impulses, node);
  velocity /= part.mass;
  const std::vector<double>& mass = world_->mass().nodal();
  double squares = 0.0;
  for (const std::int32_t node : part.nodes) {
    squares += (block(impulses, node) - mass[static_cast<std::size_t>(node)] * velocity).squaredNorm();
  }
  return std::sqrt(squares);
}

void PartBalance::set_external(double push, ConstReals force) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    acting_[k] = {push * norm_of(parts_[k], force), 0.0, 0.0};
  }
}

void PartBalance::set_contacts(double push, ConstReals force) {
  for (std::size_t k = 0; k < parts_.size(); ++k) acting_[k].contacts = push * plain_norm(parts_[k], force);
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
  const auto held_norm = [&](const ConnectedPart& part, ConstReals rows) {
    double squares = 0.0;
    for (const std::int32_t node : part.nodes) {
      const std::uint8_t mask = masks[static_cast<std::size_t>(node)];
      for (int axis = 0; axis < 3; ++axis) {
        if (((mask >> axis) & 1) != 0) squares += block(rows, node)[axis] * block(rows, node)[axis];
      }
    }
    return std::sqrt(squares);
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    acting_[k].reactions = std::min(held_norm(parts_[k], reactions), held_norm(parts_[k], strained));
  }
}

double PartBalance::acting(std::size_t part, ConstReals momentum_change) const {
  const Acting& of = acting_[part];
  return std::max({of.external, of.contacts, of.reactions, norm_of(parts_[part], momentum_change)});
}

bool PartBalance::leaves_more(Shares shares, double floor, ConstReals imbalance,
                              ConstReals momentum_change) const {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const double share = parts_[k].is_held ? shares.held : shares.free;
    if (plain_norm(parts_[k], imbalance) > share * acting(k, momentum_change) + floor) return true;
  }
  return false;
}

}  // namespace tissu
