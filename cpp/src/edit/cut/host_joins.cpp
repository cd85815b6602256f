#include "edit/cut/host_joins.h"

#include <algorithm>

#include "edit/cut/patch.h"
#include "edit/cut/shared_corners.h"
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

bool HostJoins::is_simplex(std::int32_t cell) const {
  return hosts_.corners(cell).size() == 1 + static_cast<std::size_t>(info(hosts_.type(cell)).dimension);
}

bool HostJoins::share_face(std::int32_t a, std::int32_t b) {
  const std::vector<Face>& of_a = faces_of(a);
  const std::vector<Face>& of_b = faces_of(b);
  return std::ranges::any_of(of_a, [&](const Face& face) { return std::ranges::binary_search(of_b, face); });
}

std::vector<std::int32_t> HostJoins::of(std::int32_t cell) {
  const auto of_face = static_cast<std::size_t>(info(hosts_.type(cell)).dimension);
  const auto is_whole_simplex = [&](std::int32_t one) { return is_simplex(one) && is_whole(one); };
  const bool whole = is_whole_simplex(cell);
  std::vector<std::int32_t> result;
  for_cells_at_corners(hosts_, cell, [&](std::int32_t other, std::size_t shared) {
    if (shared < of_face || other == cell) return;
    // Two whole simplices share the corners of a face.
    if ((whole && is_whole_simplex(other)) || share_face(cell, other)) result.push_back(other);
  });
  return result;
}

}  // namespace tissu
