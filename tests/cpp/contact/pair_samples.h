#pragma once

/// Pairs of four vertices for the tests of contact: general ones, and those that round-off and ties are hard
/// on.

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>

#include "tissu/base/vec.h"

namespace tissu {

using Four = std::array<Vec3, 4>;

/// The largest coordinate when the first vertex is the origin: what round-off of distances is stated in.
inline double size_of(const Four& p) {
  double size = 0.0;
  for (const Vec3& vertex : p) size = std::max(size, (vertex - p[0]).cwiseAbs().maxCoeff());
  return size;
}

class PairSamples {
 public:
  explicit PairSamples(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 vector(double size = 1.0) {
    const double x = uniform(-size, size);
    const double y = uniform(-size, size);
    return {x, y, uniform(-size, size)};
  }
  /// On a coarse grid: many coincide, lie in a line or in a plane.
  Vec3 grid_vector() {
    std::uniform_int_distribution<int> step(-2, 2);
    const int x = step(random_);
    const int y = step(random_);
    return {0.5 * x, 0.5 * y, 0.5 * step(random_)};
  }
  /// 10^-digits to 1, evenly in the logarithm.
  double small(double digits) { return std::pow(10.0, uniform(-digits, 0.0)); }

  /// Vertices 1, 2, 3 are a triangle.
  Four point_and_triangle(std::size_t number) {
    Four p = {vector(), vector(), vector(), vector()};
    switch (number % 8) {
      case 0:  // a sliver with two long sides and a short one
        p[2] = p[1] + small(6) * vector();
        break;
      case 1:  // a sliver with a wide angle, and the point near it
        p[3] = p[1] + uniform(0, 1) * (p[2] - p[1]) + small(6) * vector();
        p[0] = p[1] + uniform(0, 1) * (p[2] - p[1]) + small(12) * vector();
        break;
      case 2:  // vertices in a line, but for round-off
        p[3] = p[1] + uniform(-1, 2) * (p[2] - p[1]);
        break;
      case 3:  // vertices that coincide
        p[1 + number / 8 % 3] = p[1 + number / 16 % 3];
        break;
      case 4:
        p = {grid_vector(), grid_vector(), grid_vector(), grid_vector()};
        break;
      case 5:  // near the triangle
        p[0] = p[1] + uniform(0, 1) * (p[2] - p[1]) + uniform(0, 1) * (p[3] - p[1]) + small(15) * vector();
        break;
      case 6:  // far from it
        p[0] *= 1.0 / small(6);
        break;
      default:
        break;
    }
    return p;
  }

  /// Vertices 0, 1 are an edge, 2, 3 another.
  Four two_edges(std::size_t number) {
    Four p = {vector(), vector(), vector(), vector()};
    switch (number % 8) {
      case 0:  // nearly parallel
        p[3] = p[2] + uniform(-2, 2) * (p[1] - p[0]) + small(18) * vector();
        break;
      case 1:  // nearly parallel, and near
        p[2] = p[0] + uniform(-1, 2) * (p[1] - p[0]) + small(15) * vector();
        p[3] = p[2] + uniform(-2, 2) * (p[1] - p[0]) + small(18) * vector();
        break;
      case 2:  // of unlike lengths
        p[3] = p[2] + small(9) * vector();
        break;
      case 3:  // without extent
        p[1] = p[0];
        if (number % 16 == 3) p[3] = p[2];
        break;
      case 4:
        p = {grid_vector(), grid_vector(), grid_vector(), grid_vector()};
        break;
      case 5: {  // near to crossing each other
        const Vec3 place = p[0] + uniform(0, 1) * (p[1] - p[0]) + small(15) * vector();
        const Vec3 way = small(3) * vector();
        p[2] = place - way;
        p[3] = place + uniform(0, 1) * way;
        break;
      }
      case 6:
        p[2] = p[1];  // a vertex is shared
        break;
      default:
        break;
    }
    return p;
  }

 private:
  std::mt19937 random_;
};

}  // namespace tissu
