#include "edit/cut/host_joins.h"

#include <algorithm>

#include "edit/cut/patch.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {

const std::vector<HostJoins::Face>& HostJoins::faces_of(std::int32_t cell) {
  const auto known = faces_.find(cell);
  if (known != faces_.end()) return known->second;
  std::vector<Face>& faces = faces_[cell];
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    Face face{a, b, c};
    std::ranges::sort(face);
    faces.push_back(face);
  };
  const auto stored = material_.cells.find(cell);
  if (stored != material_.cells.end()) {
    for (const MaterialTetra& tetra : stored->second) {
      for (std::size_t f = 0; f < tetra.corners(); ++f) {
        if ((tetra.cut >> f & 1U) != 0) continue;
        const auto& [a, b, c] = kOpposite[f];
        add(tetra.vertices[a], tetra.vertices[b], tetra.vertices[c]);
      }
    }
  } else {
    for (const MaterialTetra& tetra : whole_material(hosts_, cell)) {
      for (std::size_t f = 0; f < tetra.corners(); ++f) {
        const auto& [a, b, c] = kOpposite[f];
        add(tetra.vertices[a], tetra.vertices[b], tetra.vertices[c]);
      }
    }
  }
  std::ranges::sort(faces);
  return faces;
}

bool HostJoins::joined(std::int32_t a, std::int32_t b) {
  if (is_whole(a) && is_whole(b)) {
    const auto simplex = [&](std::int32_t cell) {
      return hosts_.corners(cell).size() == 1 + static_cast<std::size_t>(info(hosts_.type(cell)).dimension);
    };
    if (simplex(a) && simplex(b)) return true;  // they share the corners of a face
  }
  const std::vector<Face> of_a = faces_of(a);
  const std::vector<Face>& of_b = faces_of(b);
  return std::ranges::any_of(of_a, [&](const Face& face) { return std::ranges::binary_search(of_b, face); });
}

std::vector<std::int32_t> HostJoins::of(std::int32_t cell) {
  std::vector<std::int32_t> near;
  for (const std::int32_t node : hosts_.corners(cell)) {
    const auto there = hosts_.cells_at(node);
    near.insert(near.end(), there.begin(), there.end());
  }
  std::ranges::sort(near);
  const auto of_face = static_cast<std::size_t>(info(hosts_.type(cell)).dimension);
  std::vector<std::int32_t> result;
  for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end) {
    while (end < near.size() && near[end] == near[begin]) ++end;
    if (end - begin >= of_face && near[begin] != cell && joined(cell, near[begin]))
      result.push_back(near[begin]);
  }
  return result;
}

}  // namespace tissu
