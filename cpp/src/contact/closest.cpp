#include "tissu/contact/closest.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace tissu {
namespace {

/// Sines below this are round-off: a triangle is its edges, edges are parallel. What that leaves out of a
/// distance is half of it times the size.
constexpr double kSine = 16.0 * std::numeric_limits<double>::epsilon();

bool inside(double share) { return share > 0.0 && share < 1.0; }

/// The share of the edge, which starts at the origin, at which `point` is nearest to it.
double nearest_share(const Vec3& point, const Vec3& edge) {
  const double along = point.dot(edge);
  const double square = edge.squaredNorm();
  if (!(along > 0.0)) return 0.0;
  if (!(along < square)) return 1.0;
  return along / square;
}

Part edge_part(double share) {
  if (inside(share)) return Part::interior;
  return share > 0.0 ? Part::vertex1 : Part::vertex0;
}

/// The corner across the longest side: its angle is the widest, so that its two sides are the least alike.
std::size_t widest_corner(const std::array<Vec3, 3>& side) {
  const double square0 = side[0].squaredNorm();
  const double square1 = side[1].squaredNorm();
  const double square2 = side[2].squaredNorm();
  if (square1 >= square0 && square1 >= square2) return 0;
  return square0 >= square2 ? 2 : 1;
}

/// The nearest of a triangle's three sides. `side`: from each corner to the next.
Closest closest_on_sides(const std::array<Vec3, 4>& p, const std::array<Vec3, 3>& side, Part& part) {
  Closest best{{}, Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const Vec3 from = p[0] - p[1 + i];
    const double share = nearest_share(from, side[i]);
    const Vec3 r = from - share * side[i];
    const double square = r.squaredNorm();
    if (!(square < best.square)) continue;
    best = {{1.0, 0.0, 0.0, 0.0}, r, square};
    best.beta[1 + i] = share - 1.0;
    best.beta[1 + next] = -share;
    part = static_cast<Part>(static_cast<std::size_t>(Part::edge01) + i);
    if (!inside(share)) part = static_cast<Part>(share > 0.0 ? next : i);
  }
  return best;
}

/// r of the points at shares s and t of two edges whose starts are `apart`.
Closest at_shares(double s, double t, const Vec3& edge0, const Vec3& edge1, const Vec3& apart) {
  const Vec3 r = s * edge0 - t * edge1 - apart;
  return {{1.0 - s, s, t - 1.0, -t}, r, r.squaredNorm()};
}

/// The share of the first edge where the lines through both are nearest, or, of parallel edges, the middle of
/// where they face each other; negative where there is none.
double share_of_lines(const Vec3& edge0, const Vec3& edge1, const Vec3& apart) {
  const Vec3 normal = edge0.cross(edge1);
  const double square0 = edge0.squaredNorm();
  const double square1 = edge1.squaredNorm();
  if (normal.squaredNorm() > kSine * kSine * square0 * square1) {
    return apart.cross(edge1).dot(normal) / normal.squaredNorm();
  }
  if (!(square0 > 0.0) || !(square1 > 0.0)) return -1.0;
  const double start = apart.dot(edge0) / square0;
  const double end = (apart + edge1).dot(edge0) / square0;
  const double low = std::max(std::min(start, end), 0.0);
  const double high = std::min(std::max(start, end), 1.0);
  return low < high ? 0.5 * (low + high) : -1.0;
}

}  // namespace

Closest closest_point_edge(const std::array<Vec3, 4>& p, Part& part) {
  const Vec3 edge = p[2] - p[1];
  const Vec3 from = p[0] - p[1];
  const double share = nearest_share(from, edge);
  part = edge_part(share);
  const Vec3 r = from - share * edge;
  return {{1.0, share - 1.0, -share, 0.0}, r, r.squaredNorm()};
}

// Coordinates along one side and along what of the other is normal to it: the normal equations lose twice the
// digits on a sliver. What round-off moves the foot by then grows with the distance over the triangle's
// height, and a distance changes by the square of that.
Closest closest_point_triangle(const std::array<Vec3, 4>& p, Part& part) {
  const std::array<Vec3, 3> side = {p[2] - p[1], p[3] - p[2], p[1] - p[3]};
  const std::size_t corner = widest_corner(side);
  const Vec3& first = side[corner];
  const Vec3 second = -side[(corner + 2) % 3];
  const double square = first.squaredNorm();
  const double skew = first.dot(second) / square;
  const Vec3 height = second - skew * first;
  if (!(height.squaredNorm() > kSine * kSine * second.squaredNorm())) return closest_on_sides(p, side, part);
  const Vec3 from = p[0] - p[1 + corner];
  const double along = from.dot(first) / square;
  const double v = (from - along * first).dot(height) / height.squaredNorm();
  const double u = along - v * skew;
  if (!(u > 0.0 && v > 0.0 && u + v < 1.0)) return closest_on_sides(p, side, part);
  part = Part::interior;
  const Vec3 r = from - u * first - v * second;
  Closest closest{{1.0, 0.0, 0.0, 0.0}, r, r.squaredNorm()};
  closest.beta[1 + corner] = u + v - 1.0;
  closest.beta[1 + (corner + 1) % 3] = -u;
  closest.beta[1 + (corner + 2) % 3] = -v;
  return closest;
}

// The share of the lines comes from cross products, and the other share from the point at the first: of edges
// that are nearly parallel both are then wrong together, along the edges, which changes no distance.
Closest closest_edge_edge(const std::array<Vec3, 4>& p, Part& first, Part& second) {
  const Vec3 edge0 = p[1] - p[0];
  const Vec3 edge1 = p[3] - p[2];
  const Vec3 apart = p[2] - p[0];
  const double s = share_of_lines(edge0, edge1, apart);
  if (inside(s)) {
    const double t = nearest_share(s * edge0 - apart, edge1);
    if (inside(t)) {
      first = second = Part::interior;
      return at_shares(s, t, edge0, edge1, apart);
    }
  }
  Closest best = at_shares(0.0, nearest_share(-apart, edge1), edge0, edge1, apart);
  const auto look = [&](double share0, double share1) {
    const Closest other = at_shares(share0, share1, edge0, edge1, apart);
    if (other.square < best.square) best = other;
  };
  look(1.0, nearest_share(edge0 - apart, edge1));
  look(nearest_share(apart, edge0), 0.0);
  look(nearest_share(apart + edge1, edge0), 1.0);
  first = edge_part(best.beta[1]);
  second = edge_part(-best.beta[3]);
  return best;
}

}  // namespace tissu
