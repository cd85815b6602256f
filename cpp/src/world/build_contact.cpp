#include <algorithm>
#include <utility>

#include "builder.h"
#include "tissu/contact/audit.h"

namespace tissu {

/// Nodes of other bodies that carry a surface get numbers beyond those of its body, or below zero, by where
/// they stand in the world.
void WorldBuilder::find_others(SurfaceDescription& surface) const {
  const Body& body = world_.body(surface.name);
  for (std::int32_t& node : surface.riders.node) {
    if (node < body.node_count) continue;
    const BodyNode& other = surface.riders.others.at(static_cast<std::size_t>(node - body.node_count));
    const Body& of = world_.body(other.body);
    const std::string where = "a surface in contact of \"" + body.name + "\"";
    node = shifted({other.node}, of.first_node, of.node_count, where).front() - body.first_node;
  }
  surface.riders.others.clear();
}

void WorldBuilder::add_contact() {
  if (!description_.contact) return;
  ContactDescription described = *description_.contact;
  std::vector<std::int32_t> first;
  for (SurfaceDescription& surface : described.bodies) {
    first.push_back(world_.body(surface.name).first_node);
    if (!surface.riders.others.empty()) find_others(surface);
  }
  auto contact =
      std::make_unique<Contact>(std::move(described), first, world_.rest_.positions, world_.frames());
  world_.contact_ = contact.get();
  world_.forces_.push_back(std::move(contact));
}

/// Rows of bodies that no other body is joined to: they may be moved as a whole.
std::vector<RowRange> WorldBuilder::loose_bodies() const {
  if (description_.links || !description_.contact) return {};
  std::vector<std::string> joined;
  for (const BodyDescription& body : description_.bodies) {
    if (body.shared.empty()) continue;
    joined.push_back(body.name);
    for (const SharedNode& node : body.shared) joined.push_back(node.body);
  }
  for (const SurfaceDescription& surface : description_.contact->bodies) {
    for (const BodyNode& other : surface.riders.others)
      joined.insert(joined.end(), {surface.name, other.body});
  }
  std::vector<RowRange> loose;
  for (const Body& body : world_.bodies_) {
    if (std::ranges::find(joined, body.name) != joined.end()) continue;
    loose.push_back({body.first_node, body.first_node + body.node_count});
  }
  return loose;
}

/// An edit goes on from where things are: surfaces that it uncovers are not moved, and nothing is refused.
void WorldBuilder::separate_surfaces() {
  if (world_.contact_ == nullptr) return;
  world_.shape_ = world_.rest_.positions;
  if (before_ == nullptr && !description_.separated.empty()) {
    world_.rest_.positions = description_.separated;
    return;
  }
  if (before_ == nullptr) {
    separate(*world_.contact_, world_.fixed_, loose_bodies(), world_.rest_);
    return;
  }
  world_.rest_.positions = before_->rest_positions();
  for (const BodyDescription& body : description_.bodies) {
    const std::int32_t first = world_.body(body.name).first_node;
    auto copy = first + static_cast<std::int32_t>(body.positions.size() / 3 - body.copies_of.size());
    const ConstReals before(before_->rest_positions());
    for (const std::int32_t node : body.copies_of) {
      Vec3 place = Vec3::Zero();
      if (node >= 0) {
        place = block(before, first + node);
      } else {
        const FirstDayPoint& point = body.points[static_cast<std::size_t>(-1 - node)];
        for (std::size_t i = 0; i < 4 && point.node[i] >= 0; ++i)
          place += point.weight[i] * block(before, first + point.node[i]);
        // On an edge that a repair made between more than four nodes of the first day:
        if (point.node[0] < 0) place = block(ConstReals(body.positions), copy - first);
      }
      block(Reals(world_.rest_.positions), copy++) = place;
    }
  }
}

}  // namespace tissu
