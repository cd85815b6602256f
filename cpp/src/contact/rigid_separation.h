#pragma once

/// What moves as a whole, moved apart to its gaps at the start.

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tissu/contact/audit.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact.h"

namespace tissu {

/// Free obstacles, and bodies that nothing holds. They are moved apart without turning, each side by half
/// where both move, pair after pair until all are as far apart as they rest: what is nearer would be pushed
/// to the gap within the first step, and fly off. A body that cannot be so, as one that is clamped between
/// others, stays where it was, and its nodes are moved one by one.
class RigidSeparation {
 public:
  RigidSeparation(const Contact& contact, const FixedDofs& fixed, std::span<const RowRange> loose,
                  const State& start);

  /// Something moves as a whole.
  [[nodiscard]] bool has_any() const { return has_any_; }
  /// The pair is one of things that move as a whole, or of one and something that stays.
  [[nodiscard]] bool has(const Candidate& c) const;
  [[nodiscard]] bool has(const PlaneCandidate& c) const;

  /// Moves `places` of the movers; `normals` of the vertices, of any length. True when it moved something.
  bool run(Candidates& candidates, std::vector<double>& places, ConstReals normals);

  /// Moves the rows of bodies that were moved as a whole.
  void move_rows(Reals positions) const;

 private:
  /// How far the first of two surfaces has to go along a direction, off the second.
  struct Way {
    double length = 0.0;
    Vec3 along = Vec3::Zero();
  };
  using Ways = std::map<std::pair<std::int32_t, std::int32_t>, Way>;
  /// A body that moves as a whole.
  struct Loose {
    RowRange rows;
    Vec3 moved = Vec3::Zero();
  };

  /// Moves until nothing asks for more; what is left to ask after many sweeps.
  Ways move_all(Candidates& candidates, std::vector<double>& places, ConstReals normals, bool& any);
  [[nodiscard]] Ways ways(const Candidates& candidates, ConstReals places, ConstReals normals) const;
  [[nodiscard]] Way way_of(const Candidate& c, ConstReals places, ConstReals normals) const;
  [[nodiscard]] Way way_of(const PlaneCandidate& c, ConstReals places) const;
  /// How far a surface was moved: by so much more than the gap it may overlap another meanwhile.
  [[nodiscard]] double moved(std::int32_t surface) const;
  [[nodiscard]] bool is_soft(const Candidate& c) const;  ///< some side of it
  [[nodiscard]] bool moves(std::int32_t surface) const;
  [[nodiscard]] bool is_loose(std::int32_t surface) const { return loose_.contains(surface); }
  void move(std::int32_t surface, const Vec3& by, std::vector<double>& places);

  const Contact& contact_;
  const State& start_;
  std::map<std::int32_t, Loose> loose_;  ///< by surface
  std::size_t movers_ = 0;               ///< that moved as a whole, at first
  bool has_any_ = false;
};

}  // namespace tissu
