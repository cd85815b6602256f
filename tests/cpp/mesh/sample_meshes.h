#pragma once

/// Small meshes that several tests of this room look at.

#include <array>

#include "tissu/mesh/box.h"

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

}  // namespace tissu::test
