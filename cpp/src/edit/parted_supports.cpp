#include "parted_supports.h"

#include <algorithm>
#include <span>

#include "tissu/edit/cut_state.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

bool contains(std::span<const std::int32_t> list, std::int32_t value) {
  return std::ranges::find(list, value) != list.end();
}

/// Whether a support held a node of the first day, or all those that a place on an edge lies between.
bool was_held(const FixedNodes& fixed, const BodyDescription& body, std::int32_t root) {
  if (root >= 0) return std::ranges::binary_search(fixed.first_day, root);
  const FirstDayPoint& point = body.points[static_cast<std::size_t>(-1 - root)];
  if (point.node[0] < 0) return false;  // on an edge that a repair made
  return std::ranges::all_of(point.node, [&](std::int32_t one) {
    return one < 0 || std::ranges::binary_search(fixed.first_day, one);
  });
}

/// A face, an edge or the whole of a cell.
struct Part {
  int dimension;
  std::size_t corners;
  Numbers nodes;  ///< the corners first
};

std::vector<Part> parts_of(const Hosts& hosts, std::int32_t cell) {
  const auto nodes = hosts.nodes(cell);
  const std::size_t corners = hosts.corners(cell).size();
  const CellType type = hosts.type(cell);
  std::vector<Part> parts{{info(type).dimension, corners, {nodes.begin(), nodes.end()}}};
  for (const LocalFace& face : faces(type)) {
    Part& part = parts.emplace_back(Part{2, static_cast<std::size_t>(face.corners), {}});
    for (int i = 0; i < face.nodes; ++i) part.nodes.push_back(nodes[face.node[static_cast<std::size_t>(i)]]);
  }
  const auto ends = edges(type);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    Part& part = parts.emplace_back(Part{1, 2, {nodes[ends[i][0]], nodes[ends[i][1]]}});
    if (corners + i < nodes.size()) part.nodes.push_back(nodes[corners + i]);
  }
  return parts;
}

/// Whether a cell that was cut has material of the dimension of a part in this part.
bool reaches(const Material& material, std::int32_t cell, const Part& part) {
  const auto stored = material.cells.find(cell);
  if (stored == material.cells.end()) return true;  // it is whole
  const auto corners = std::span(part.nodes).first(part.corners);
  const auto is_in = [&](std::int32_t vertex) {
    if (vertex >= 0) return contains(corners, vertex);
    const Rider& rider = material.riders[static_cast<std::size_t>(-1 - vertex)];
    return std::ranges::all_of(std::span(rider.node).first(static_cast<std::size_t>(rider.count)),
                               [&](std::int32_t node) { return contains(corners, node); });
  };
  return std::ranges::any_of(stored->second, [&](const MaterialTetra& tetra) {
    const auto vertices = std::span(tetra.vertices).first(tetra.corners());
    return std::ranges::count_if(vertices, is_in) > part.dimension;
  });
}

bool is_needed(const FixedNodes& fixed, const BodyDescription& body, std::int32_t node) {
  const auto& [hosts, material] = *body.cut;
  return std::ranges::any_of(hosts.cells_at(node), [&](std::int32_t cell) {
    return std::ranges::any_of(parts_of(hosts, cell), [&](const Part& part) {
      const auto held = [&](std::int32_t one) { return was_held(fixed, body, hosts.root(one)); };
      return contains(part.nodes, node) && std::ranges::all_of(part.nodes, held) &&
             reaches(material, cell, part);
    });
  });
}

/// Debris is not the support of a scene, and has no copies.
bool is_support(const FixedNodes& fixed, const BodyDescription& body) {
  return fixed.body == body.name && fixed.positions.empty();
}

}  // namespace

void free_unneeded(WorldDescription& description, const BodyDescription& body) {
  for (FixedNodes& fixed : description.fixed) {
    if (!is_support(fixed, body)) continue;
    std::erase_if(fixed.nodes, [&](std::int32_t node) {
      return std::ranges::binary_search(body.bare, node) &&
             (body.cut == nullptr || !is_needed(fixed, body, node));
    });
  }
}

void part_supports(WorldDescription& description, const BodyDescription& body, const Numbers& copied) {
  const auto first = static_cast<std::int32_t>(body.positions.size() / 3 - copied.size());
  for (FixedNodes& fixed : description.fixed) {
    if (!is_support(fixed, body)) continue;
    if (fixed.first_day.empty()) {
      fixed.first_day = fixed.nodes;
      std::ranges::sort(fixed.first_day);
    }
    for (std::size_t k = 0; k < copied.size(); ++k) {  // of a divided edge, copies of new nodes follow these
      const bool is_held =
          copied[k] >= 0 ? contains(fixed.nodes, copied[k]) : was_held(fixed, body, copied[k]);
      if (is_held) fixed.nodes.push_back(first + static_cast<std::int32_t>(k));
    }
  }
  free_unneeded(description, body);
}

}  // namespace tissu
