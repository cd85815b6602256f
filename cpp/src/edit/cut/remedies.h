#pragma once

/// What is done about cells that a cut would divide into parts too flat to be cells.

#include <cstdint>
#include <map>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/hosts.h"

namespace tissu {

/// 6 sqrt(2) V / l_rms^3 of a tetrahedron of corners a to d: 1 regular, 0 flat, negative inside out.
double tetra_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// 4 sqrt(3) A / (sum of l^2) of a triangle: 1 regular, 0 without area.
double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c);

/// A child of a cell has a quality of at least min(0.05, a quarter of the cell's). Where it has not, these
/// are tried in turn, each in a new plan: the edges of the cell are divided in the reverse order; of its
/// crossings the one nearest to an end goes there; all go to the nearer ends, so that the cut runs along its
/// faces; the cell stays whole.
class Remedies {
 public:
  /// The share of an edge from its end within which a crossing goes to the end, in a cell of that number.
  [[nodiscard]] double t0(std::int32_t cell, double otherwise) const;
  [[nodiscard]] bool turned(std::int32_t cell) const { return round(cell) >= 1; }
  [[nodiscard]] bool whole(std::int32_t cell) const { return round(cell) >= 4; }
  [[nodiscard]] bool any() const { return !cells_.empty(); }

  /// Takes out the edges of cells that stay whole, and notes the crossings of the others. Numbers of the
  /// cells that stay whole though the blade crosses them, ascending.
  std::vector<std::int32_t> apply(const Patch& patch, double t0, std::vector<CrossedEdge>& edges);
  /// The next remedy of each cell that is divided too badly; false where none is.
  bool advance(const Hosts& hosts, const Patch& patch);

 private:
  struct Cell {
    int round = 0;
    double t0 = 0.0;
    double nearest = 0.5;  ///< of the crossings of its edges, to their ends
  };
  [[nodiscard]] int round(std::int32_t cell) const;

  std::map<std::int32_t, Cell> cells_;
  int rounds_ = 0;
};

}  // namespace tissu
