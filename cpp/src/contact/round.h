#pragma once

/// Round things (spheres, capsules, ends of lines) before faces. The nearest point of a face jumps about in
/// the dent that a round thing presses, and its contacts come and go. Points of the body that stay the same
/// meet it instead: the corners of faces, and points between them. These are so close together that the arc
/// between two of them rises above their chord by at most the gap. Where a face is stretched at the beginning
/// of a way, there are twice, four or eight times as many along its edges; those that were there stay.

#include <cstdint>

#include "narrow.h"

namespace tissu {

/// Into how many parts the edges of the face, or the edge, of a candidate are cut before something round:
/// 1 where its corners are enough. 0 where the candidate has nothing round, or only something so thin that
/// no dent follows it, and before what is rigid, which has no dents: the narrow phase finds its nearest
/// points.
int parts_before_round(const SurfaceSet& surfaces, const Candidate& candidate);

/// Contacts of the points inside a face, inside those of its edges that it is the first face of, or inside
/// an edge. Corners are candidates of their own.
class RoundPoints {
 public:
  /// `places`: of all vertices now; `begin`: where the way began.
  RoundPoints(const SurfaceSet& surfaces, ConstReals places, ConstReals begin, const Candidate& candidate,
              int parts);
  /// The next one nearer than `reach`; false: no more.
  bool next(double reach, Found& found);
  /// Number of the one found last, from 1 on, which stays that of the same point of the body.
  [[nodiscard]] std::int32_t number() const;

 private:
  /// An edge, or all edges of a face, in so many parts, and these in so many again.
  struct Division {
    std::int32_t parts;
    std::int32_t finer;
    [[nodiscard]] std::int32_t all() const { return parts * finer; }
  };
  [[nodiscard]] Division divided(std::int32_t parts, double chord, double length) const;
  [[nodiscard]] double length_at_begin(std::int32_t edge) const;
  /// Chord whose arc rises by the gap.
  [[nodiscard]] double chord(double radius, double other) const;
  void begin_rim();
  bool advance();
  bool face_point(Found& found) const;
  bool rim_point(Found& found) const;
  bool edge_point(Found& found) const;
  [[nodiscard]] Vec3 place(std::int32_t v) const { return block(places_, v); }
  /// The contact of vertex 0 and a point with these weights of the others.
  bool meet(const std::array<std::int32_t, 4>& vertex, const std::array<double, 4>& beta, double area,
            Found& found) const;

  const SurfaceSet& surfaces_;
  ConstReals places_;
  ConstReals begin_;
  const Candidate& candidate_;
  Division division_{};   ///< of the face or edge, or of the rim that is walked along
  std::int32_t rim_ = 0;  ///< edge of the face that is walked along; -1: its inside
  std::int32_t i_ = 1;    ///< of the latest point, counted in parts of the division
  std::int32_t j_ = 0;
};

}  // namespace tissu
