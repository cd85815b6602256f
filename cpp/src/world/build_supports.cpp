/// Degrees of freedom of a world whose motion is given.

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "builder.h"
#include "checks.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

/// A mass whose frames of these numbers have no products of inertia between the axes in `mask` and the
/// others: what holds a frame takes the moments that they make. The inertia is exact where two axes are held,
/// for the frame then turns about the third alone; where one is held, to the first order of the frame's turn.
Mass uncoupled(const Mass& mass, std::span<const std::int32_t> numbers, std::uint8_t mask) {
  std::vector<Frame> frames = mass.frames();
  const auto is_held = [mask](int axis) { return ((mask >> axis) & 1) != 0; };
  for (const std::int32_t number : numbers) {
    Mat3& inertia = frames[static_cast<std::size_t>(number)].inertia;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (is_held(i) != is_held(j)) inertia(i, j) = 0.0;
      }
    }
  }
  return {mass.nodal(), std::move(frames)};
}

}  // namespace

void WorldBuilder::add_supports() {
  world_.fixed_ = FixedDofs(world_.blocks());
  for (const FixedNodes& fixed : description_.fixed) hold(fixed);
  hold_room();
  hold_eliminated();
}

void WorldBuilder::renew_supports() {
  const FixedDofs before = std::move(world_.fixed_);
  add_supports();
  world_.fixed_.keep_places(before);
}

void WorldBuilder::hold_room() {
  for (const Body& body : world_.bodies_) {
    if (body.room == 0) continue;
    std::vector<std::int32_t> rows(static_cast<std::size_t>(body.room));
    std::iota(rows.begin(), rows.end(), body.first_node + body.node_count);
    world_.fixed_.add(rows, world_.rest_positions(), FixedDofs::kAllAxes, {});
    if (body.first_frame >= 0) {
      world_.fixed_.hold_turning(rotations_of(body, std::move(rows), "the room of a body"),
                                 FixedDofs::kAllAxes);
    }
  }
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
  if (fixed.axes != 0) world_.fixed_.add(nodes, start, fixed.axes, fixed.motion, fixed.name);
  const bool loose = !fixed.positions.empty();  // what an edit left behind stays as it has turned
  if (loose && on.first_frame >= 0) {
    world_.fixed_.hold_turning(rotations_of(on, nodes, where), FixedDofs::kAllAxes);
  } else if (fixed.rotations != 0) {
    hold_rotations(fixed, on, nodes, where);
  }
}

void WorldBuilder::hold_rotations(const FixedNodes& fixed, const Body& on,
                                  const std::vector<std::int32_t>& nodes, const std::string& where) {
  std::vector<std::int32_t> numbers;
  numbers.reserve(nodes.size());
  for (const std::int32_t node : nodes) numbers.push_back(on.first_frame + node - on.first_node);
  const auto blocks = rotations_of(on, nodes, where);
  if (fixed.rotations == FixedDofs::kAllAxes) {
    world_.fixed_.add_rotations(blocks, numbers, world_.rest_.rotations, fixed.motion, fixed.name);
    return;
  }
  if (std::ranges::any_of(fixed.motion.angles, [](double angle) { return angle != 0.0; })) {
    throw ParameterError(where +
                         " turns nodes whose rotation it gives about some axes only; let it give the " +
                         "rotation about all axes or none.");
  }
  world_.fixed_.hold_turning(blocks, fixed.rotations);
  world_.mass_ = uncoupled(world_.mass_, numbers, fixed.rotations);
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
