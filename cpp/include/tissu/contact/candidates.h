#pragma once

/// Pairs of features that may meet, from boxes that overlap.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "tissu/contact/broad_phase.h"
#include "tissu/contact/surface_set.h"
#include "tissu/contact/travel.h"

namespace tissu {

/// Two features that may come near each other: p of `PairWay` are the places of `vertex`.
struct Candidate {
  PairKind kind;
  std::int32_t a;     ///< number of the vertex, of the first edge
  std::int32_t b;     ///< number of the triangle, of the second edge, of the other vertex
  std::int32_t pair;  ///< of the description
  std::array<std::int32_t, 4> vertex;
  double apart;  ///< at which they rest, xi [m]
};

/// A vertex before a plane that it may not pass.
struct PlaneCandidate {
  std::int32_t vertex;
  std::int32_t obstacle;
  std::int32_t pair;
  double apart;
};

/// The list of candidates is a superset of what comes as near as the gap on straight ways between two states.
/// It is kept while all ways stay inside the boxes that it was made of; making it earlier or later changes
/// nothing of what follows from it.
class Candidates {
 public:
  /// Of the distance at rest: where the walls of a cut are held apart that began nearer than they would rest.
  static constexpr double kOfWalls = 0.99;

  Candidates(const ContactDescription& description, const SurfaceSet& surfaces);

  /// Covers the ways of all vertices between two states. True when the list was made anew. `sways`: of each
  /// vertex, how far it may leave its straight way [m]; empty: not at all.
  bool cover(ConstReals from, ConstReals to, ConstReals sways = {});
  [[nodiscard]] const std::vector<Candidate>& list() const { return list_; }
  /// The pair stays farther apart than `reach` all along the ways that were covered last, and on shorter
  /// ones: its distance when the list was made, less what its vertices may have gone since.
  [[nodiscard]] bool is_far(std::size_t i, double reach) const {
    const Candidate& c = list_[i];
    const auto gone = [&](std::size_t k) {
      return c.vertex[k] < 0 ? 0.0 : gone_[static_cast<std::size_t>(c.vertex[k])];
    };
    const double first = c.kind == PairKind::edge_edge ? std::max(gone(0), gone(1)) : gone(0);
    const double second = c.kind == PairKind::edge_edge ? std::max(gone(2), gone(3))
                                                        : std::max(std::max(gone(1), gone(2)), gone(3));
    return distance_[i] - first - second > reach;
  }
  [[nodiscard]] const std::vector<PlaneCandidate>& planes() const { return planes_; }
  [[nodiscard]] const BroadPhase& broad_phase() const { return *broad_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// Of surfaces a and b, a <= b: the number of their pair; -1: they do not meet.
  [[nodiscard]] std::int32_t pair_of(std::int32_t a, std::int32_t b) const;
  void box(ConstReals from, ConstReals to, ConstReals sways);
  void search();
  void list_features(const BoxPair& pair);
  void add(PairKind kind, std::int32_t a, std::int32_t b, std::array<std::int32_t, 4> vertex);
  [[nodiscard]] bool may_meet(const ContactPair& pair, const std::array<std::int32_t, 4>& vertex) const;
  /// What pairs of one body that are nearer at rest are held apart by.
  [[nodiscard]] double apart_at_rest(PairKind kind, const std::array<std::int32_t, 4>& vertex,
                                     double apart) const;
  void list_planes();
  void measure(ConstReals places);
  void follow(ConstReals from, ConstReals to, ConstReals sways);

  const ContactDescription& description_;
  const SurfaceSet& surfaces_;
  std::vector<std::int32_t> pair_;             ///< [a][b] of surfaces
  std::vector<std::vector<std::uint8_t>> on_;  ///< of each pair: vertices that alone meet; empty: all
  std::vector<double> reach_;                  ///< of each surface: what its boxes are grown by [m]
  std::vector<double> skin_;
  std::unique_ptr<BroadPhase> broad_;
  std::vector<Box> ways_;  ///< of each vertex: from where to where it goes
  std::vector<Box> needed_;
  std::vector<Box> searched_;
  std::vector<BoxPair> found_;
  std::vector<Candidate> list_;
  std::vector<std::size_t> begin_;     ///< of each pair that was found: its first candidate; and the end
  std::vector<BoxPair> found_before_;  ///< the same of the search before
  std::vector<Candidate> list_before_;
  std::vector<std::size_t> begin_before_;
  std::vector<double> distance_;  ///< of each when the list was made [m], less round-off
  std::vector<double> made_;      ///< places of all vertices then
  std::vector<double> gone_;      ///< how far each may be from there on the ways covered last [m]
  std::vector<PlaneCandidate> planes_;
};

/// Number of vertices of a kind of pair.
constexpr int vertices_of(PairKind kind) {
  switch (kind) {
    case PairKind::vertex_face:
    case PairKind::edge_edge:
      return 4;
    case PairKind::vertex_edge:
      return 3;
    case PairKind::vertex_vertex:
      break;
  }
  return 2;
}
/// How many of them are of the first feature; the others are of the second.
constexpr int vertices_of_first(PairKind kind) { return kind == PairKind::edge_edge ? 2 : 1; }

}  // namespace tissu
