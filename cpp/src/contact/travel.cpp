#include "tissu/contact/travel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tissu/contact/closest.h"

namespace tissu {
namespace {

constexpr double kKept = 0.1;  ///< share of the distance above `least` that is left
constexpr int kRounds = 64;

struct Sides {
  std::size_t first;  ///< vertices of the first side
  std::size_t end;    ///< of both
};

Sides sides_of(PairKind kind) {
  switch (kind) {
    case PairKind::vertex_face:
      return {1, 4};
    case PairKind::edge_edge:
      return {2, 4};
    case PairKind::vertex_edge:
      return {1, 3};
    case PairKind::vertex_vertex:
      break;
  }
  return {1, 2};
}

using Four = std::array<Vec3, 4>;

/// r of the pair, from its second side to its first.
Vec3 shortest(PairKind kind, const Four& p) {
  Part part{};
  Part other{};
  switch (kind) {
    case PairKind::vertex_face:
      return closest_point_triangle(p, part).r;
    case PairKind::edge_edge:
      return closest_edge_edge(p, part, other).r;
    case PairKind::vertex_edge:
      return closest_point_edge(p, part).r;
    case PairKind::vertex_vertex:
      break;
  }
  return p[0] - p[1];
}

/// The pair in coordinates that its first vertex starts from, and that go with the mean of its ways: what is
/// common to all four changes no distance.
struct Moving {
  explicit Moving(const PairWay& pair) : kind(pair.kind), sides(sides_of(pair.kind)) {
    for (std::size_t i = 0; i < sides.end; ++i) mean += pair.way[i];
    mean /= static_cast<double>(sides.end);
    for (std::size_t i = 0; i < sides.end; ++i) {
      from[i] = pair.from[i] - pair.from[0];
      way[i] = pair.way[i] - mean;
    }
  }
  [[nodiscard]] Four at(double share) const {
    Four p;
    for (std::size_t i = 0; i < sides.end; ++i) p[i] = from[i] + share * way[i];
    return p;
  }
  /// No point of one side goes farther than this as seen from a point of the other.
  [[nodiscard]] double relative_way() const {
    double first = 0.0;
    double second = 0.0;
    for (std::size_t i = 0; i < sides.end; ++i) {
      double& side = i < sides.first ? first : second;
      side = std::max(side, way[i].squaredNorm());
    }
    return std::sqrt(first) + std::sqrt(second);
  }
  PairKind kind;
  Sides sides;
  Vec3 mean = Vec3::Zero();  ///< of the ways
  Four from;
  Four way;
};

/// The share of the way, after `p`, on which the two sides stay at least `wanted` apart along `normal`. Ways
/// are straight, so that each vertex of one side and each of the other come nearer at a constant rate.
double share_along(const Moving& moving, const Four& p, const Vec3& normal, double wanted) {
  double share = 1.0;
  for (std::size_t i = 0; i < moving.sides.first; ++i) {
    for (std::size_t j = moving.sides.first; j < moving.sides.end; ++j) {
      const double above = normal.dot(p[i] - p[j]) - wanted;
      const double closing = normal.dot(moving.way[j] - moving.way[i]);
      if (!(above >= 0.0)) return 0.0;  // the normal of a distance near round-off
      if (closing > 0.0 && above < share * closing) share = above / closing;
    }
  }
  return share;
}

/// Whether a plane across `normal`, of length 1, has each side on its own side of it at both ends.
bool separates(const PairWay& pair, const Vec3& normal, double least) {
  const Sides sides = sides_of(pair.kind);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double sum = 0.0;  // a NaN is neither low nor high
  for (std::size_t i = 0; i < sides.end; ++i) {
    const double start = normal.dot(pair.from[i] - pair.from[0]);
    const double end = start + normal.dot(pair.way[i]);
    sum += end;
    if (i < sides.first) {
      low = std::min({low, start, end});
    } else {
      high = std::max({high, start, end});
    }
  }
  return low - high >= least && std::isfinite(sum);
}

}  // namespace

Vec3 shortest_line(const PairWay& pair) {
  Four p;
  for (std::size_t i = 0; i < sides_of(pair.kind).end; ++i) p[i] = pair.from[i] - pair.from[0];
  return shortest(pair.kind, p);
}

bool is_kept_apart(const PairWay& pair, double least) {
  return is_kept_apart(pair, shortest_line(pair), least);
}

bool is_kept_apart(const PairWay& pair, const Vec3& start, double least) {
  const double distance = start.norm();
  if (distance > 0.0 && separates(pair, start / distance, least)) return true;
  Four p;
  for (std::size_t i = 0; i < sides_of(pair.kind).end; ++i) p[i] = pair.from[i] - pair.from[0] + pair.way[i];
  const Vec3 end = shortest(pair.kind, p);
  const double at_end = end.norm();
  return at_end > 0.0 && separates(pair, end / at_end, least);
}

double free_share(const PairWay& pair, double least) { return free_share(pair, shortest_line(pair), least); }

double free_share(const PairWay& pair, const Vec3& from, double least) {
  const Moving moving(pair);
  Four p = moving.from;
  Vec3 r = from;
  double distance = r.norm();
  const double start = distance - least;
  if (!(start > 0.0) || !moving.mean.allFinite()) return 0.0;
  if (moving.relative_way() <= (1.0 - kKept) * start) return 1.0;
  const double kept = least + kKept * start;
  double share = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const Vec3 normal = r / distance;
    const double sure = share + share_along(moving, p, normal, kept);
    if (sure >= 1.0) return 1.0;
    const double above = std::min(distance - least, start);
    share = std::min(share + share_along(moving, p, normal, least + kKept * above), 1.0);
    p = moving.at(share);
    r = shortest(moving.kind, p);
    distance = r.norm();
    if (!(distance >= kept)) return sure;
    if (share >= 1.0) return 1.0;
  }
  return share;
}

}  // namespace tissu
