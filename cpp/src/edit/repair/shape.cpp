#include "edit/repair/shape.h"

#include <algorithm>
#include <cmath>

#include "edit/cut/remedies.h"

namespace tissu {
namespace {

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a).norm(); }

/// 3 rho_in / rho_out; rho_in = 3 v / sum s, and rho_out = sqrt((a+b+c)(-a+b+c)(a-b+c)(a+b-c)) / (24 v) where
/// a, b, c are the products of opposite edges.
double radii(const CellCorners& p) {
  const double v = tetra_volume(p);
  if (!(v > 0.0)) return 0.0;
  const auto l = [&](std::size_t i, std::size_t j) { return (p[i] - p[j]).norm(); };
  const double a = l(0, 1) * l(2, 3);
  const double b = l(0, 2) * l(1, 3);
  const double c = l(0, 3) * l(1, 2);
  const double s =
      area(p[0], p[1], p[2]) + area(p[0], p[1], p[3]) + area(p[0], p[2], p[3]) + area(p[1], p[2], p[3]);
  const double product = (a + b + c) * (b + c - a) * (a - b + c) * (a + b - c);
  return 216.0 * v * v / (s * std::sqrt(std::max(product, 0.0)));
}

CellCorners corners_at(const RepairCell& cell, ConstReals places) {
  CellCorners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = block(places, cell.nodes[i]);
  return corners;
}

}  // namespace

CellCorners rest_corners(const RepairMesh& mesh, const RepairCell& cell) {
  return corners_at(cell, mesh.all_rest());
}

CellCorners present_corners(const RepairMesh& mesh, const RepairCell& cell) {
  return corners_at(cell, mesh.all_now());
}

double tetra_volume(const CellCorners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) / 6.0; }

double tetra_quality(const CellCorners& c) { return tetra_quality(c[0], c[1], c[2], c[3]); }

double worst_measure(const CellCorners& c, double below) {
  double shortest = (c[0] - c[1]).norm();
  double longest = shortest;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      shortest = std::min(shortest, (c[i] - c[k]).norm());
      longest = std::max(longest, (c[i] - c[k]).norm());
    }
  }
  return std::min({tetra_quality(c), radii(c), 0.5 * shortest / longest}) / below;
}

}  // namespace tissu
