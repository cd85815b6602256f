/// Degrees of freedom of a world whose motion is given.

#include "builder.h"
#include "checks.h"
#include "tissu/base/error.h"

namespace tissu {

void WorldBuilder::add_supports() {
  world_.fixed_ = FixedDofs(world_.blocks());
  for (const FixedNodes& fixed : description_.fixed) hold(fixed);
  hold_eliminated();
}

void WorldBuilder::hold(const FixedNodes& fixed) {
  const Body& on = world_.body(fixed.body);
  const auto nodes =
      shifted(fixed.nodes, on.first_node, on.node_count, "a fixed part of body \"" + on.name + "\"");
  const std::string where = "the motion of body \"" + on.name + "\"";
  check_table(where, fixed.motion.times, fixed.motion.displacements.size());
  check_table(where, fixed.motion.times, fixed.motion.angles.size());
  if (!fixed.positions.empty()) check_size(where, fixed.positions.size(), 3 * fixed.nodes.size());
  std::vector<double> start = world_.rest_positions();
  for (std::size_t i = 0; i < fixed.positions.size() / 3; ++i) {
    block(Reals(start), nodes[i]) = block(ConstReals(fixed.positions), static_cast<std::int32_t>(i));
  }
  if (fixed.translations) world_.fixed_.add(nodes, start, fixed.axes, fixed.motion, fixed.name);
  if (!fixed.rotations) return;
  std::vector<std::int32_t> numbers;
  numbers.reserve(nodes.size());
  for (const std::int32_t node : nodes) numbers.push_back(on.first_frame + node - on.first_node);
  world_.fixed_.add_rotations(rotations_of(on, nodes, where), numbers, world_.rest_.rotations, fixed.motion,
                              fixed.name);
}

std::vector<std::int32_t> WorldBuilder::rotations_of(const Body& body, std::vector<std::int32_t> nodes,
                                                     const std::string& where) const {
  if (body.first_frame < 0) {
    throw ParameterError(where + " names rotations of body \"" + body.name +
                         "\", whose nodes have none; only nodes that are frames do.");
  }
  for (std::int32_t& node : nodes) {
    node = world_.frames()[static_cast<std::size_t>(body.first_frame + node - body.first_node)].rotation;
  }
  return nodes;
}

/// Eliminated nodes are not unknowns: they are held for the solver, and their model says where they are.
void WorldBuilder::hold_eliminated() {
  for (const Body& body : world_.bodies_) {
    for (const BodyModel* model : body.models) {
      const auto eliminated = model->eliminated();
      if (eliminated.empty()) continue;
      refuse_touched(body, *model, description_, world_.fixed_);
      world_.fixed_.add(eliminated, world_.rest_positions(), FixedDofs::kAllAxes, {});
    }
  }
}

}  // namespace tissu
