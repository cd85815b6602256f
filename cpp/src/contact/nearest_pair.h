#pragma once

/// The nearest points of a pair of any kind.

#include "tissu/contact/closest.h"
#include "tissu/contact/travel.h"

namespace tissu {

inline Closest nearest_of(PairKind kind, const std::array<Vec3, 4>& p) {
  Part first{};
  Part second{};
  switch (kind) {
    case PairKind::vertex_face:
      return closest_point_triangle(p, first);
    case PairKind::edge_edge:
      return closest_edge_edge(p, first, second);
    case PairKind::vertex_edge:
      return closest_point_edge(p, first);
    case PairKind::vertex_vertex:
      break;
  }
  const Vec3 r = p[0] - p[1];
  return {{1.0, -1.0, 0.0, 0.0}, r, r.squaredNorm()};
}

}  // namespace tissu
