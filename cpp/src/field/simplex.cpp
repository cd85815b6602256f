#include "simplex.h"

#include <cmath>
#include <numbers>

namespace tissu {
namespace {

/// |d! volume| over (mean square edge)^(d/2), as a share of that of the regular simplex.
double simplex_quality(int dimension, const std::array<Vec3, 4>& corners, double volume) {
  if (dimension == 0) return 1.0;
  double squares = 0.0;
  int edges = 0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(dimension); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++edges) squares += (corners[i] - corners[j]).squaredNorm();
  }
  constexpr std::array<double, 4> kRegular{1.0, 1.0, 2.0 * std::numbers::inv_sqrt3, std::numbers::sqrt2};
  const double edge = std::sqrt(squares / edges);
  return kRegular[static_cast<std::size_t>(dimension)] * std::abs(volume) / std::pow(edge, dimension);
}

}  // namespace

// With edges e_1 .. e_d from corner 0, completed by the normals of the span: dw_1/dX = e_2 x e_3 / V,
// V = e_1 . e_2 x e_3 [m^d], and so on in a circle; w_i = dw_i/dX . (X - x_0); w_0 = 1 - sum_i w_i.
Simplex barycentric(const AffineSpan& span, const std::array<Vec3, 4>& corners, const Vec3& x) {
  std::array<Vec3, 3> e;
  for (int i = 0; i < 3; ++i) {
    const auto n = static_cast<std::size_t>(i);
    e[n] = i < span.dimension ? Vec3(corners[n + 1] - corners[0]) : Vec3(span.axes.col(i));
  }
  const double volume = e[0].dot(e[1].cross(e[2]));
  Simplex simplex;
  simplex.quality = simplex_quality(span.dimension, corners, volume);
  if (!(simplex.quality > 0.0)) return simplex;
  simplex.weights[0] = 1.0;
  simplex.gradients.fill(Vec3::Zero());
  for (std::size_t i = 0; i < static_cast<std::size_t>(span.dimension); ++i) {
    const Vec3 gradient = e[(i + 1) % 3].cross(e[(i + 2) % 3]) / volume;
    const double w = gradient.dot(x - corners[0]);
    simplex.weights[i + 1] = w;
    simplex.weights[0] -= w;
    simplex.gradients[i + 1] = gradient;
    simplex.gradients[0] -= gradient;
    simplex.excess += std::abs(w);
  }
  simplex.excess += std::abs(simplex.weights[0]);
  return simplex;
}

}  // namespace tissu
