#pragma once

/// How far a pair may go on straight ways without coming nearer than a distance.

#include <array>

#include "tissu/base/vec.h"

namespace tissu {

enum class PairKind : std::uint8_t {
  vertex_face,  ///< a vertex, three of a triangle
  edge_edge,    ///< two and two
  vertex_edge,  ///< a vertex, two of an edge, the fourth unused
  vertex_vertex
};

struct PairWay {
  PairKind kind;
  std::array<Vec3, 4> from;  ///< [m]
  std::array<Vec3, 4> way;   ///< [m]
};

/// The plane test: whether one plane keeps the two sides at least `least` apart at both ends, and so on the
/// whole way. Planes tried: across the shortest line at the start, then at the end. Sufficient, cheap, and
/// still true when any of the ways is shortened.
bool is_kept_apart(const PairWay& pair, double least);
/// The same where `start` is known: the shortest line between the sides at the start, as `shortest_line` has
/// it.
bool is_kept_apart(const PairWay& pair, const Vec3& start, double least);
/// From the second side to the first at the start. What is common to all four vertices changes nothing of it.
Vec3 shortest_line(const PairWay& pair);

/// The share of the way, in [0, 1], up to which the pair keeps `least` >= 0 between its sides, but for the
/// round-off that closest.h states, which `least` has to contain (additive conservative advancement: Li et
/// al. 2021, ACM Transactions on Graphics 40(4), Codimensional Incremental Potential Contact, section 4; the
/// relative way is bounded along the shortest line). 1: the whole way. At the share at least a tenth of the
/// distance above `least` at the start is left. 0 where the start is nearer than `least` or not finite. No
/// cubic is solved; after 64 rounds the share that was reached is the answer, which is safe.
double free_share(const PairWay& pair, double least);
double free_share(const PairWay& pair, const Vec3& start, double least);

}  // namespace tissu
