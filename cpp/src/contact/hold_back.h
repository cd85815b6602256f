#pragma once

/// Travel: no way leads through anything.

#include <cstdint>
#include <vector>

#include "tissu/contact/candidates.h"
#include "tissu/contact/contact.h"

namespace tissu {

/// A plane where it stands.
struct PlacedPlane {
  Vec3 point;
  Vec3 normal;
};

/// The share of a pair's way that is free, and whether that is so however ways are shortened.
struct FreeWay {
  double share;
  bool whatever;
};

/// Shortens ways so that every candidate stays apart. A pair passes by one of three tests, cheapest first:
/// none of its vertices goes as far as 0.45 of the distance that is left; one plane keeps its sides apart at
/// both ends; additive conservative advancement along the whole way. The first two hold however ways are
/// shortened. The vertices of pairs that pass by the third form islands, which go the least share of their
/// pairs together, for apart from each other their ways would be others than those that were tested. What is
/// shortened are the ways of movers: of a vertex that rows carry those of its rows.
class HoldBack {
 public:
  /// `given`: of each mover, whether its way is given, so that it is never shortened.
  HoldBack(const SurfaceSet& surfaces, const std::vector<std::uint8_t>& given)
      : surfaces_(surfaces), given_(given) {}

  /// Whether all ways are free as they are, so that none has to be shortened. `candidates`: of ways that are
  /// gone together.
  [[nodiscard]] bool is_free(const Candidates& candidates, std::span<const PlacedPlane> planes,
                             ConstReals from, ConstReals to, ConstReals bends, ConstReals sways) const;
  /// Shares of the ways, in [0, 1], for every mover; true when one is below 1. `planes`: of each obstacle;
  /// `bends`: as `free_way` has them. The vertices of a rigid body go one share.
  bool find(const Candidates& candidates, std::span<const PlacedPlane> planes, ConstReals from, ConstReals to,
            ConstReals bends = {}, ConstReals sways = {});
  [[nodiscard]] double share(std::int32_t mover) const { return shares_[root(mover)]; }
  /// The lowest mover of the island that a mover belongs to; itself where it belongs to none.
  [[nodiscard]] std::int32_t island(std::int32_t mover) const {
    return static_cast<std::int32_t>(root(mover));
  }
  /// Something that is given, such as an obstacle or a plane, stops a mover's island.
  [[nodiscard]] bool is_stopped_by_given(std::int32_t mover) const { return anchored_[root(mover)] != 0; }
  /// Contacts of the pairs whose whole way is not free, in the order of the list.
  [[nodiscard]] const std::vector<std::int32_t>& stopped() const { return stopped_; }
  [[nodiscard]] const std::vector<std::int32_t>& stopped_at_planes() const { return stopped_at_planes_; }

  /// The pairs that were stopped, and the same again in a list that was made anew.
  [[nodiscard]] std::vector<Candidate> stopped_pairs(const Candidates& candidates) const;
  void stop_again(const Candidates& candidates, std::vector<Candidate> pairs);

  /// Every mover goes its whole way, and is an island.
  void release();
  void forget() {
    stopped_.clear();
    stopped_at_planes_.clear();
  }

  /// The nearest that a pair may come: a share of what it rests at, or half of what it begins with, or the
  /// same share of that where it is larger.
  static double least(double apart, double start, double kept = Candidate::kKept);

 private:
  [[nodiscard]] std::size_t root(std::int32_t mover) const;
  void join(std::span<const std::int32_t> vertices, double share, bool before_plane = false);
  void join(std::int32_t& first, std::int32_t mover);
  /// The share of the way of a vertex that leads to no plane's other side.
  [[nodiscard]] FreeWay free_way_to_plane(const PlaneCandidate& candidate, const PlacedPlane& plane,
                                          ConstReals from, ConstReals to, ConstReals bends,
                                          ConstReals sways) const;

  const SurfaceSet& surfaces_;
  const std::vector<std::uint8_t>& given_;
  mutable std::vector<std::int32_t> parent_;
  std::vector<double> shares_;
  std::vector<std::uint8_t> anchored_;  ///< of each island: something given stops it
  std::vector<std::int32_t> stopped_;
  std::vector<std::int32_t> stopped_at_planes_;
};

/// Of a pair. `bends`: of each vertex, |arm| theta^2 of the rigid body that turns by theta while it carries
/// it: the arc up to a share s of the way leaves the chord by no more than s (1 - s) / 2 of that [m]. Empty
/// for none. `sways`: of each vertex that rows carry, how far it may leave its straight way when those go
/// different shares of theirs [m]. Empty for none.
FreeWay free_way(const Candidate& candidate, ConstReals from, ConstReals to, ConstReals bends = {},
                 ConstReals sways = {});

}  // namespace tissu
