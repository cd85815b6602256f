#pragma once

/// Small meshes that several tests of this room look at.

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>

#include "tissu/mesh/box.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu::test {

inline constexpr std::array kSplits{Split::none, Split::six, Split::five, Split::six_mirrored};

/// A box of 3 x 2 x 2 grid cells and 6 m3, off the origin.
inline Mesh sample_box(Split split) {
  return box_mesh(Vec3(-1.0, 0.5, 2.0), Vec3(3.0, 2.0, 1.0), {3, 2, 2}, split);
}

/// The reference hexahedron [0, 1]^3.
inline Mesh unit_hexahedron() { return box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}, Split::none); }

/// The tetrahedron on the origin and the three axes.
inline Mesh unit_tetra() { return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}}; }

inline constexpr std::array kTypes{CellType::tetra,        CellType::hexahedron,   CellType::tetra10,
                                   CellType::hexahedron20, CellType::hexahedron27, CellType::wedge,
                                   CellType::wedge15,      CellType::pyramid,      CellType::pyramid13};

inline std::string type_name(const testing::TestParamInfo<CellType>& param) {
  return std::string(info(param.param).name);
}

/// Volume of the reference cell.
inline double reference_volume(CellType type) {
  const int corners = info(type).corners;
  return corners == 4 ? 1.0 / 6.0 : corners == 5 ? 4.0 / 3.0 : corners == 6 ? 1.0 : 8.0;
}

/// Positions of the corners of the reference cell.
inline std::vector<double> reference_corners(CellType type) {
  switch (info(type).corners) {
    case 4:
      return {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    case 5:
      return {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 1};
    case 6:
      return {0, 0, -1, 1, 0, -1, 0, 1, -1, 0, 0, 1, 1, 0, 1, 0, 1, 1};
    default:
      return {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
  }
}

/// The reference cell of a type, nodes of the edges in their middles and nodes of the faces in theirs.
inline Mesh one_cell(CellType type) {
  const auto nodes = static_cast<std::size_t>(info(type).nodes);
  Mesh mesh{reference_corners(type), {{type, std::vector<std::int32_t>(nodes)}}};
  std::iota(mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.end(), 0);
  mesh.positions.resize(3 * nodes, 0.0);
  if (info(type).order == 1) return mesh;
  const auto place = [&](std::int32_t node, const Vec3& x) { block(Reals(mesh.positions), node) = x; };
  std::int32_t next = info(type).corners;
  for (const auto& [a, b] : edges(type)) place(next++, (mesh.node(a) + mesh.node(b)) / 2.0);
  for (const LocalFace& face : faces(type))
    if (face.nodes == 9) place(face.node[8], (mesh.node(face.node[0]) + mesh.node(face.node[2])) / 2.0);
  return mesh;
}

}  // namespace tissu::test
