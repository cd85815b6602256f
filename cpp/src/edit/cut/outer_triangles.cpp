#include "edit/cut/outer_triangles.h"

#include <span>

#include "edit/cut/quad_halves.h"
#include "tissu/base/index.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

/// The outer faces of a cell that no blade met: its quads where both halves are outside.
void add_whole(const Hosts& hosts, std::int32_t cell, std::span<const MaterialFace> faces_of,
               std::vector<OuterTriangle>& triangles) {
  const auto nodes = hosts.corners(cell);
  const auto add = [&](const MaterialFace& half) { triangles.push_back({half.vertices, false}); };
  const auto root = [&](std::int32_t node) { return hosts.root(node); };
  std::size_t next = 0;
  for (const LocalFace& face : faces(hosts.type(cell))) {
    const MaterialFace& first = faces_of[next++];
    if (face.corners == 3) {
      if (first.across < 0) add(first);
      continue;
    }
    const MaterialFace& second = faces_of[next++];
    if (first.across < 0 && second.across < 0) {
      std::vector<std::array<std::int32_t, 3>> halves;
      add_halves(hosts.rest(),
                 {nodes[face.node[0]], nodes[face.node[1]], nodes[face.node[2]], nodes[face.node[3]]}, root,
                 halves);
      for (const auto& half : halves) triangles.push_back({half, false});
    } else if (first.across < 0) {
      add(first);
    } else if (second.across < 0) {
      add(second);
    }
  }
}

}  // namespace

std::vector<OuterTriangles> outer_triangles(const Hosts& hosts, const MaterialFaces& all) {
  std::vector<OuterTriangles> result;
  std::vector<OuterTriangle> own;
  for (std::size_t f = 0; f < all.faces.size();) {
    const std::int32_t unit = all.faces[f].unit;
    const MaterialUnit& of = all.units[at(unit)];
    std::size_t end = f;
    while (end < all.faces.size() && all.faces[end].unit == unit) ++end;
    const auto faces_of = std::span(all.faces).subspan(f, end - f);
    own.clear();
    if (of.tetra < 0) {
      add_whole(hosts, of.cell, faces_of, own);
    } else {
      for (const MaterialFace& face : faces_of) {
        if (face.across < 0) own.push_back({face.vertices, face.cut});
      }
    }
    f = end;
    if (own.empty()) continue;
    if (result.empty() || result.back().cell != of.cell) result.push_back({of.cell, {}});
    std::vector<OuterTriangle>& triangles = result.back().triangles;
    triangles.insert(triangles.end(), own.begin(), own.end());
  }
  return result;
}

}  // namespace tissu
