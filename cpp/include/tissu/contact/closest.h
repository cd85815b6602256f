#pragma once

/// Distances between points, edges and triangles, and the places where they are taken. Coordinates are
/// shifted to a vertex of the pair first, so that what round-off leaves of a distance is 32 epsilon times the
/// size of the pair, wherever it lies in space. Triangles and edges without extent are what is left of them.
/// Answers are finite for sizes up to 1e70; below 1e-70 products of lengths lose digits.

#include <array>

#include "tissu/base/vec.h"

namespace tissu {

/// Two points that are nearest to each other: r = sum of beta_k p_k over the four vertices of the pair, whose
/// beta sum to zero, and goes from the second of the pair to the first.
struct Closest {
  std::array<double, 4> beta;
  Vec3 r;         ///< [m]
  double square;  ///< |r|^2 [m2]
};

/// Which part of a triangle or edge is nearest.
enum class Part : std::uint8_t { vertex0, vertex1, vertex2, edge01, edge12, edge20, interior };

/// A point p[0] and the triangle p[1] p[2] p[3]: beta = (1, -b1, -b2, -b3), b >= 0.
Closest closest_point_triangle(const std::array<Vec3, 4>& p, Part& part);
/// A point p[0] and the edge p[1] p[2]: beta = (1, -b1, -b2, 0). Part: vertex0, vertex1 or interior.
Closest closest_point_edge(const std::array<Vec3, 4>& p, Part& part);
/// The edges p[0] p[1] and p[2] p[3]: beta = (1 - s, s, t - 1, -t), s and t in [0, 1]. Of parallel edges, the
/// middle of where they face each other. `first` and `second`: vertex0, vertex1 or interior.
Closest closest_edge_edge(const std::array<Vec3, 4>& p, Part& first, Part& second);

}  // namespace tissu
