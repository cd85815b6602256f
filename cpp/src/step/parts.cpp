#include "tissu/step/parts.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/disjoint_sets.h"

namespace tissu {

std::vector<ConnectedPart> parts_of(const World& world) {
  const auto rows = static_cast<std::size_t>(world.blocks());
  DisjointSets sets(rows);
  std::vector<char> has_cell(rows, 0);
  for (const Body& body : world.bodies()) {
    for (const BodyModel* model : body.models) {
      const std::vector<std::int32_t>& cells = model->block().cells;
      const auto size = static_cast<std::size_t>(model->nodes_per_cell());
      for (std::size_t i = 0; i < cells.size(); ++i) {
        has_cell[static_cast<std::size_t>(cells[i])] = 1;
        if (i % size != 0) sets.join(cells[i - 1], cells[i]);
      }
    }
  }
  const std::vector<double>& mass = world.mass().nodal();
  const std::vector<std::uint8_t>& masks = world.fixed().masks();
  std::vector<std::int32_t> number(rows, -1);  // of the part of the node that stands for it
  std::vector<ConnectedPart> parts;
  for (std::size_t i = 0; i < rows; ++i) {
    if (has_cell[i] == 0 || mass[i] == 0.0) continue;
    const auto node = static_cast<std::int32_t>(i);
    std::int32_t& own = number[static_cast<std::size_t>(sets.first(node))];
    if (own < 0) {
      own = static_cast<std::int32_t>(parts.size());
      parts.emplace_back();
    }
    ConnectedPart& part = parts[static_cast<std::size_t>(own)];
    part.nodes.push_back(node);
    part.mass += mass[i];
    part.is_held = part.is_held || masks[i] != 0;
  }
  const std::vector<Frame>& frames = world.frames();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto node = static_cast<std::size_t>(frames[k].block);
    if (has_cell[node] == 0 || mass[node] == 0.0) continue;
    ConnectedPart& part =
        parts[static_cast<std::size_t>(number[static_cast<std::size_t>(sets.first(frames[k].block))])];
    part.frames.push_back(static_cast<std::int32_t>(k));
    part.is_held = part.is_held || masks[static_cast<std::size_t>(frames[k].rotation)] != 0;
  }
  return parts;
}

Carried carried(const World& world, const ConnectedPart& part, ConstReals velocities) {
  Carried result;
  if (!part.is_held) return result;
  const std::vector<std::uint8_t>& masks = world.fixed().masks();
  for (int axis = 0; axis < 3; ++axis) {
    const auto each = [&](const auto& f) {
      for (const std::int32_t node : part.nodes) {
        if (((masks[static_cast<std::size_t>(node)] >> axis) & 1) != 0) f(block(velocities, node)[axis]);
      }
    };
    double sum = 0.0;
    double count = 0.0;
    each([&](double v) {
      sum += v;
      count += 1.0;
    });
    if (count == 0.0) continue;
    result.velocity[axis] = sum / count;
    each([&](double v) { result.spread = std::max(result.spread, std::abs(v - result.velocity[axis])); });
  }
  return result;
}

}  // namespace tissu
