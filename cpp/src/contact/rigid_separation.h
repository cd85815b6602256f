#pragma once

/// Rigid bodies that unknowns move, moved apart to their gaps at the start.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "tissu/contact/candidates.h"
#include "tissu/contact/contact.h"

namespace tissu {

/// Pairs of which a side is a free obstacle and nothing is soft. They are moved apart without turning, each
/// side by half where both are free, pair after pair until all are as far apart as they rest: what is nearer
/// would be pushed to the gap within the first step, and fly off.
class RigidSeparation {
 public:
  RigidSeparation(const Contact& contact, const State& start);

  [[nodiscard]] static bool is_rigid(const SurfaceSet& surfaces, const Candidate& c);
  [[nodiscard]] static bool is_rigid(const SurfaceSet& surfaces, const PlaneCandidate& c);

  /// Moves `places` of the movers; `normals` of the vertices, of any length. True when it moved something.
  bool run(Candidates& candidates, std::vector<double>& places, ConstReals normals) const;

 private:
  /// How far the first of two surfaces has to go along a direction, off the second.
  struct Way {
    double length = 0.0;
    Vec3 along = Vec3::Zero();
  };
  using Ways = std::map<std::pair<std::int32_t, std::int32_t>, Way>;

  [[nodiscard]] Ways ways(const Candidates& candidates, ConstReals places, ConstReals normals) const;
  [[nodiscard]] Way way_of(const Candidate& c, ConstReals places, ConstReals normals) const;
  [[nodiscard]] Way way_of(const PlaneCandidate& c, ConstReals places) const;
  [[nodiscard]] bool is_free(std::int32_t surface) const;
  void move(std::int32_t surface, const Vec3& by, Reals places) const;

  const Contact& contact_;
  const State& start_;
};

}  // namespace tissu
