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
  struct Vertex {
    bool on = false;
    bool before = false;                                    ///< an earlier sweep of the incision put it there
    double away = std::numeric_limits<double>::infinity();  ///< of the crossing [m]
    Vec3 met = Vec3::Zero();
    int votes = 0;
  };
  std::vector<Vertex> vertices;

  explicit OnCut(std::size_t count) : vertices(count) {}
  [[nodiscard]] bool on(std::int32_t v) const { return (*this)[v].on; }
  [[nodiscard]] const Vertex& operator[](std::int32_t v) const {
    return vertices[static_cast<std::size_t>(v)];
  }
  /// The blade met the vertex at `met`; of several places the nearest counts.
  void put_on(std::int32_t v, const Vec3& place, const Vec3& met);
};

/// A crossing at the share t of the way along an edge; direction 1: the edge's first end is above the blade.
struct Crossing {
  double t;
  int direction;
};
struct CrossedEdge {
  std::int32_t p;
  std::int32_t q;
  std::vector<Crossing> crossings;  ///< ascending t, one for each time the blade is passed
};

/// Crossings nearer than t0 to one another in a row are one where they go the same way, none where they go to
/// and fro: seams of the blade, and its ridges.
void settle(std::vector<Crossing>& crossings, double t0);

/// The edges of the near cells that the blade crosses inside, and their votes. Vertices that the blade meets
/// exactly are put on the cut; edges that end at a vertex on the cut are not crossed. Crossings that undo
/// each other within the share `t0` of an edge are none.
std::vector<CrossedEdge> crossed_edges(const Patch& patch, const SweepPart& part, const NearCells& near,
                                       double t0, OnCut& known);

/// Cells of the patch that the blade enters without crossing an edge or meeting a vertex of the tetrahedron
/// that it enters: places of such tetrahedra, ascending.
std::vector<std::int32_t> pierced_tetrahedra(const Patch& patch, const SweepPart& part, const NearCells& near,
                                             const OnCut& known);

}  // namespace tissu
