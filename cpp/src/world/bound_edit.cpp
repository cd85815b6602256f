/// Supports, loads and pressures of a world that is edited in place.

#include <algorithm>
#include <iterator>
#include <utility>

#include "builder.h"
#include "tissu/base/index.h"
#include "tissu/force/load.h"
#include "tissu/world/world_edit.h"

namespace tissu {

void WorldEdit::list_bound(std::size_t number) {
  const BodyDescription& body = world_.description()->bodies[number];
  EditedBody& edited = bodies_[number];
  edited.bound.assign(body.positions.size() / 3, 0);
  edited.held_at_first = edited.bound;
  edited.faces = edited.bound;
  for (const FixedNodes& fixed : world_.description()->fixed) {
    if (fixed.body != body.name) continue;
    for (const std::int32_t node : fixed.nodes) edited.bound[at(node)] = 1;
    if (!fixed.positions.empty()) continue;
    const std::vector<std::int32_t>& first = fixed.first_day.empty() ? fixed.nodes : fixed.first_day;
    for (const std::int32_t node : first) edited.held_at_first[at(node)] = 1;
  }
  for (const LoadDescription& load : world_.description()->loads) {
    if (load.body != body.name) continue;
    for (const std::int32_t node : load.nodes) edited.bound[at(node)] = 1;
    for (const FaceCells& some : load.faces) {
      for (const std::int32_t node : some.nodes) edited.faces[at(node)] = 1;
    }
  }
}

/// Whether cells change at faces that a load acts on.
bool WorldEdit::changes_faces(std::size_t number, const BodyChange& change) const {
  const BodyDescription& body = world_.description()->bodies[number];
  const auto nodes = body.positions.size() / 3;
  const auto first_day = nodes - body.copies_of.size();
  const auto is_on = [&](std::int32_t node) { return node >= 0 && bodies_[number].faces[at(node)] != 0; };
  return std::ranges::any_of(change.nodes, [&](std::int32_t node) {
    if (at(node) < first_day) return is_on(node);
    if (at(node) >= nodes) return false;
    const std::int32_t root = body.copies_of[at(node) - first_day];
    return root >= 0 ? is_on(root) : std::ranges::any_of(body.points[at(-1 - root)].node, is_on);
  });
}

bool WorldEdit::parts_bound(std::string_view body, const BodyChange& change) const {
  const std::size_t number = number_of(body);
  const EditedBody& edited = bodies_[number];
  const auto bound = [&](std::int32_t node) {
    return at(node) < edited.bound.size() && edited.bound[at(node)] != 0;
  };
  if (changes_faces(number, change)) return true;
  const auto is_bound_copy = [&](std::int32_t node) { return node >= 0 && bound(node); };
  if (std::ranges::any_of(change.copied, is_bound_copy) || std::ranges::any_of(change.loose, bound))
    return true;
  const auto between_held = [&](const FirstDayPoint& point) {
    return std::ranges::all_of(
        point.node, [&](std::int32_t node) { return node < 0 || edited.held_at_first[at(node)] != 0; });
  };
  if (std::ranges::any_of(change.points, between_held)) return true;
  // The copies of a loaded node share its load as they share its mass.
  const BodyDescription& described = world_.description()->bodies[number];
  const auto first_day = described.positions.size() / 3 - described.copies_of.size();
  const auto is_parted = [&](std::int32_t node) {
    return at(node) >= first_day || std::ranges::find(described.copies_of, node) != described.copies_of.end();
  };
  if (std::ranges::any_of(change.nodes, [&](std::int32_t node) { return bound(node) && is_parted(node); })) {
    return true;
  }
  std::vector<std::int32_t> emptied;
  std::ranges::set_difference(change.bare, world_.description()->bodies[number].bare,
                              std::back_inserter(emptied));
  return std::ranges::any_of(emptied, bound);
}

bool WorldEdit::may_part_bound(std::string_view name, const BodyChange& change, const State& state) const {
  const WorldDescription& all = *world_.description();
  const auto leaves = [&](std::int32_t node) {
    return std::ranges::binary_search(change.loose, node) || std::ranges::binary_search(change.bare, node);
  };
  const bool held = std::ranges::all_of(all.fixed, [&](const FixedNodes& fixed) {
    return fixed.body != name || fixed.name.empty() ||
           (!world_.fixed_.is_led_live(fixed.name, state) && !std::ranges::all_of(fixed.nodes, leaves));
  });
  return held && std::ranges::all_of(all.loads, [&](const LoadDescription& load) {
           return load.body != name || state.memory[world_.memory_.find(load.name)].empty();
         });
}

/// They begin where the description has their nodes, as in a world that is built from it.
void WorldEdit::renew_supports() {
  const WorldDescription& description = *world_.description();
  std::vector<double>& rest = world_.rest_.positions;
  const bool is_apart = !world_.shape_.empty();
  if (is_apart) rest.swap(world_.shape_);
  WorldBuilder(world_, description, nullptr, false).renew_supports();
  if (is_apart) rest.swap(world_.shape_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].editors.empty()) list_bound(i);
  }
}

/// The world has its loads in the order of the description.
void WorldEdit::renew_loads(std::string_view name) {
  const Body& body = world_.body(name);
  const auto& all = world_.description()->loads;
  auto described = all.begin();
  for (const auto& force : world_.forces_) {
    auto* load = dynamic_cast<NodalLoad*>(force.get());
    if (load == nullptr) continue;
    if (described->body == body.name) {
      load->act_on(shifted(described->nodes, body.first_node, body.node_count, "a load"), described->forces);
      load->set_left(described->left, described->along_normals);
    }
    ++described;
  }
}

/// The world has its pressures in the order of the description.
void WorldEdit::renew_pressures(std::string_view name) {
  const Body& body = world_.body(name);
  const auto& all = world_.description()->pressures;
  auto described = all.begin();
  for (const auto& force : world_.forces_) {
    auto* pressure = dynamic_cast<Pressure*>(force.get());
    if (pressure == nullptr) continue;
    if (described->body == body.name) {
      PressedFaces pressed = faces_of(*described, body);
      pressure->act_on(std::move(pressed.faces), std::move(pressed.carried), std::move(pressed.parts));
    }
    ++described;
  }
}

}  // namespace tissu
