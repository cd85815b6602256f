#include "edit/cut/outward.h"

namespace tissu {

Vec3 outward(const Patch& patch, const Patch::Tetra& tetra, std::size_t face, Vec3 Patch::Vertex::*at) {
  const auto corner = [&](std::size_t i) -> const Vec3& { return patch.vertex(tetra.vertices[i]).*at; };
  const auto& [a, b, c] = kOpposite[face];
  if (tetra.corners() == 2) return corner(a) - corner(face);
  if (tetra.corners() == 4) return (corner(b) - corner(a)).cross(corner(c) - corner(a));
  const Vec3& from = corner((face + 1) % 3);
  const Vec3 along = corner((face + 2) % 3) - from;
  const Vec3 away = from - corner(face);
  return (away - along * (along.dot(away) / along.squaredNorm())).normalized() * along.norm();
}

}  // namespace tissu
