#pragma once

/// Where a blade crosses the edges of the material.

#include <cstdint>
#include <limits>
#include <vector>

#include "edit/cut/near.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/sweep.h"

namespace tissu {

/// What is known of a vertex: whether it is on the cut, and the place where the blade met it or the edge that
/// ends at it; how many crossed edges see it above the blade, less those that see it below.
struct OnCut {
  /// A triangle of the blade that a vertex has to do with: it lies on it, or an edge that ends at it crosses
  /// it.
  struct Meeting {
    std::int32_t triangle;
    bool on;
    Vec3 place;             ///< where the blade met the vertex or the edge
    int vote;               ///< 1: the edge sees the vertex above the triangle; -1: below
    std::int32_t previous;  ///< of the same vertex, -1: none
  };
  struct Vertex {
    bool on = false;
    bool before = false;  ///< an earlier sweep of the incision put it there, and its front is there
    bool wall = false;    ///< an earlier sweep of the incision parted the material there
    bool beside = false;  ///< of a wall, so near to the blade that faces of the cut may end there
    double away = std::numeric_limits<double>::infinity();  ///< of the crossing [m]
    Vec3 met = Vec3::Zero();
    int votes = 0;
    std::int32_t last = -1;  ///< of its meetings
  };
  std::vector<Vertex> vertices;
  std::vector<Meeting> meetings;

  explicit OnCut(std::size_t count) : vertices(count) {}
  [[nodiscard]] bool on(std::int32_t v) const { return (*this)[v].on; }
  /// Whether a face of the cut may end there.
  [[nodiscard]] bool may_end(std::int32_t v) const { return (*this)[v].on || (*this)[v].beside; }
  [[nodiscard]] const Vertex& operator[](std::int32_t v) const {
    return vertices[static_cast<std::size_t>(v)];
  }
  /// The blade's triangle met the vertex at `met`; of several places the nearest counts. -1: an earlier
  /// blade.
  void put_on(std::int32_t v, const Vec3& place, const Vec3& met, std::int32_t triangle);
  /// An edge that ends at the vertex crosses a triangle.
  void vote(std::int32_t v, const Vec3& place, int direction, std::int32_t triangle);
  template <class Visit>
  void each_meeting(std::int32_t v, const Visit& visit) const {
    for (std::int32_t i = (*this)[v].last; i >= 0;) {
      const Meeting& meeting = meetings[static_cast<std::size_t>(i)];
      visit(meeting);
      i = meeting.previous;
    }
  }
};

/// A crossing at the share t of the way along an edge; direction 1: the edge's first end is above the blade.
struct BladeCrossing {
  double t;
  int direction;
  std::int32_t triangle;
};
struct CrossedEdge {
  std::int32_t p;
  std::int32_t q;
  std::vector<BladeCrossing> crossings;  ///< ascending t, one for each time the blade is passed
};

/// Crossings nearer than t0 to one another in a row are one where they go the same way, none where they go to
/// and fro: seams of the blade, and its ridges.
void settle(std::vector<BladeCrossing>& crossings, double t0);

/// The ends of a crossed edge see the blade from the side of their nearest crossing.
void cast_votes(const Patch& patch, const CrossedEdge& edge, OnCut& known);

/// The edges of the near cells that the blade crosses inside, and their votes. Vertices that the blade meets
/// exactly are put on the cut; edges that end at a vertex on the cut are not crossed. Crossings that undo
/// each other within the share `t0` of an edge are none.
std::vector<CrossedEdge> crossed_edges(const Patch& patch, const SweepPart& part, const NearCells& near,
                                       double t0, OnCut& known);

}  // namespace tissu
