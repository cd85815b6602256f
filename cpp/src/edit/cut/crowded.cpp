#include "edit/cut/crowded.h"

#include <algorithm>

#include "tissu/base/index.h"

namespace tissu {
namespace {

constexpr double kTurned = 0.5;  ///< cosine between the normals of a blade that may pass a cell twice

Vec3 normal_of(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

bool turns(const SweepPart& part, std::span<const std::int32_t> triangles) {
  return std::ranges::any_of(triangles, [&](std::int32_t t) {
    return normal_of(part.triangles[at(t)]).dot(normal_of(part.triangles[at(triangles.front())])) < kTurned;
  });
}

/// Of each cell, the box of all tetrahedra at its vertices.
std::vector<Eigen::AlignedBox3d> boxes_with_neighbours(const Patch& patch) {
  std::vector<Eigen::AlignedBox3d> of_vertices(patch.vertices.size());
  std::vector<Eigen::AlignedBox3d> of_cells(patch.cells.size());
  const auto each_vertex = [&](const auto& visit) {
    for (const Patch::Tetra& tetra : patch.tetrahedra) {
      for (std::size_t i = 0; i < tetra.corners(); ++i) visit(tetra, tetra.vertices[i]);
    }
  };
  each_vertex([&](const Patch::Tetra& tetra, std::int32_t v) {
    for (std::size_t i = 0; i < tetra.corners(); ++i)
      of_vertices[at(v)].extend(patch.vertex(tetra.vertices[i]).place);
  });
  each_vertex([&](const Patch::Tetra& tetra, std::int32_t v) {
    of_cells[at(tetra.cell)].extend(of_vertices[at(v)]);
  });
  return of_cells;
}

}  // namespace

CrowdedCells::CrowdedCells(const Patch& patch, const SweepPart& part, const NearCells& near,
                           const BladeSheets& sheets)
    : patch_(patch), near_(near), crowded_(patch.cells.size(), 0) {
  if (part.triangles.size() < 2) return;
  const std::vector<Eigen::AlignedBox3d> boxes = boxes_with_neighbours(patch);
  for (std::size_t c = 0; c < boxes.size(); ++c) {
    if (near.triangles(patch.cells[c].number).empty()) continue;
    const BladeSheets::Inside around = sheets.in(boxes[c]);
    crowded_[c] = around.count > 1 || turns(part, around.triangles) ? 1 : 0;
  }
}

}  // namespace tissu
