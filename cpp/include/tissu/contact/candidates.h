#pragma once

/// Pairs of features that may meet, from boxes that overlap.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
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
  /// Share of it to which they may come near on the way of a step, though not at its end.
  double kept = kKept;
  static constexpr double kKept = 0.1;
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
///
/// Ways may be seen in two manners. `apart`: each vertex may go any share of its way, whatever the others do.
/// `together`: all go the same share. Then what a whole surface has in common changes no distance inside it,
/// and pairs within one surface are looked for as seen from the mean of its vertices. So a body that falls
/// has as few candidates as one at rest.
class Candidates {
 public:
  /// Of the distance at rest: where the walls of a cut are held apart that began nearer than they would rest.
  static constexpr double kOfWalls = 0.99;
  enum class Ways { apart, together };

  Candidates(const ContactDescription& description, const SurfaceSet& surfaces, Ways ways = Ways::apart);

  /// Covers the ways of all vertices between two states. True when the list was made anew. `sways`: of each
  /// vertex, how far it may leave its straight way [m]; empty: not at all.
  bool cover(ConstReals from, ConstReals to, ConstReals sways = {});
  [[nodiscard]] const std::vector<Candidate>& list() const { return list_; }
  /// Numbers in the list, ascending, of all that may come nearer than `apart` and the gap of their pair while
  /// the list is kept.
  [[nodiscard]] const std::vector<std::int32_t>& near() const { return near_; }
  /// The pair stays farther apart than `reach` all along the ways that were covered last, and on shorter
  /// ones: its distance when the list was made, less what its vertices may have gone since.
  [[nodiscard]] bool is_far(std::size_t i, double reach) const {
    const Seen& seen = seen_of(list_[i]);
    if (is_farther(i, gone(list_[i], seen.gone) + reach)) return true;
    return !seen.shifts.empty() && is_farther(i, gone_together(list_[i], seen.shifts) + reach);
  }
  [[nodiscard]] const std::vector<PlaneCandidate>& planes() const { return planes_; }
  /// The search between surfaces; where there is none, that within them.
  [[nodiscard]] const BroadPhase& broad_phase() const { return *(fixed_.broad ? fixed_ : own_).broad; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// Ways as seen from one place: from a fixed one, or from the mean of each surface.
  struct Seen {
    std::unique_ptr<BroadPhase> broad;  ///< null: no pair is seen so
    std::vector<std::uint8_t> meets;    ///< of each surface: it has a pair that is seen so
    std::vector<Box> ways;              ///< of each vertex, as searched last or as it may sway
    std::vector<Box> searched;          ///< the same when the list was made, with a margin
    std::vector<double> room;           ///< how far that margin lets each go from where it was then [m]
    std::vector<double> gone;           ///< how far each may be from there on the ways covered last [m]
    std::vector<double> shifts;  ///< from there to where these begin and end [m]; of ways gone together
    std::vector<BoxPair> found;
  };
  /// Of the vertices of a pair, whose first feature goes as far as the farthest of its vertices.
  [[nodiscard]] static double gone(const Candidate& c, const std::vector<double>& ways) {
    const auto way = [&](std::size_t k) {
      return c.vertex[k] < 0 ? 0.0 : ways[static_cast<std::size_t>(c.vertex[k])];
    };
    const bool edges = c.kind == PairKind::edge_edge;
    const double first = edges ? std::max(way(0), way(1)) : way(0);
    const double second = edges ? std::max(way(2), way(3)) : std::max(std::max(way(1), way(2)), way(3));
    return first + second;
  }
  /// How much nearer a pair may come when all its vertices go the same share of their ways.
  [[nodiscard]] static double gone_together(const Candidate& c, ConstReals shifts);
  [[nodiscard]] const Seen& seen_of(const Candidate& c) const {
    return is_own_[static_cast<std::size_t>(c.pair)] != 0 ? own_ : fixed_;
  }
  /// Of surfaces a and b, a <= b: the number of their pair; -1: they do not meet.
  [[nodiscard]] std::int32_t pair_of(std::int32_t a, std::int32_t b) const;
  void find_means(ConstReals from, ConstReals to);
  void lay_ways(Seen& seen, ConstReals from, ConstReals to, ConstReals sways) const;
  [[nodiscard]] bool is_covered(const Seen& seen, ConstReals from, ConstReals to) const;
  [[nodiscard]] bool is_covered(const Seen& seen) const;
  void search();
  void search(Seen& seen);
  void list_features(const BoxPair& pair);
  void add(PairKind kind, std::int32_t a, std::int32_t b, std::array<std::int32_t, 4> vertex);
  [[nodiscard]] bool may_meet(const ContactPair& pair, const std::array<std::int32_t, 4>& vertex) const;
  /// What pairs of one body that are nearer at rest are held apart by.
  [[nodiscard]] double apart_at_rest(PairKind kind, const std::array<std::int32_t, 4>& vertex,
                                     double apart) const;
  void list_planes();
  /// The pair was farther apart than that when the list was made. Distances are found when two vertices that
  /// stand for the features do not answer it.
  [[nodiscard]] bool is_farther(std::size_t i, double than) const;
  void measure(ConstReals places);
  void follow(Seen& seen, ConstReals from, ConstReals to, ConstReals sways) const;
  template <class Function>
  void for_seen(const Seen& seen, Function&& f) const;

  const ContactDescription& description_;
  const SurfaceSet& surfaces_;
  std::vector<std::int32_t> pair_;             ///< [a][b] of surfaces
  std::vector<std::vector<std::uint8_t>> on_;  ///< of each pair: vertices that alone meet; empty: all
  std::vector<std::uint8_t> is_own_;           ///< of each pair: it is seen from the mean of its surface
  std::vector<double> reach_;                  ///< of each surface: what its boxes are grown by [m]
  std::vector<double> skin_;
  Seen fixed_;
  Seen own_;
  Ways ways_;
  bool is_listed_ = false;
  std::vector<double> mean_from_;  ///< of each surface: the mean of its vertices; empty: not needed
  std::vector<double> mean_to_;
  std::vector<double> mean_made_;
  std::vector<Box> boxes_;  ///< of primitives, while they are searched
  std::vector<BoxPair> found_;
  std::vector<Candidate> list_;
  std::vector<std::size_t> begin_;     ///< of each pair that was found: its first candidate; and the end
  std::vector<BoxPair> found_before_;  ///< the same of the search before
  std::vector<Candidate> list_before_;
  std::vector<std::size_t> begin_before_;
  mutable std::vector<double> distance_;  ///< when the list was made [m], less round-off; < 0: not found yet
  std::vector<std::int32_t> near_;
  std::vector<double> made_;  ///< places of all vertices then
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
