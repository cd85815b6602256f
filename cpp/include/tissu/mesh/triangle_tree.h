#pragma once

/// The point of a set of triangles that is nearest to a point, by a tree of boxes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// The nearest point of triangle `corners` (three 3-vectors) to p; a triangle without area is its edges.
Vec3 closest_on_triangle(const Vec3& p, const double* corners);

/// Boxes in boxes around triangles, four triangles at most in the smallest ones.
class TriangleTree {
 public:
  /// What is nearest to a point.
  struct Nearest {
    Vec3 place;         ///< [m]
    double square;      ///< of the distance [m2]; infinite when nothing is within reach
    std::int32_t leaf;  ///< place of the triangle in the tree's own order; -1: none
  };

  /// `corners`: nine numbers for each of one or more triangles [m].
  explicit TriangleTree(std::span<const double> corners);

  /// The nearest point within `reach` [m]; of triangles equally near, that of the lowest number. `hint` is
  /// a leaf where to look first, -1: none; it changes the time, never the answer.
  [[nodiscard]] Nearest nearest(const Vec3& p, double reach, std::int32_t hint = -1) const;

 private:
  struct Box {
    Vec3 low;
    Vec3 high;
    std::int32_t first;  ///< of a leaf, its first triangle; else the left child, whose right one follows
    std::int32_t count;  ///< of a leaf, how many; else 0
  };
  void split(std::int32_t box, std::int32_t first, std::int32_t count, const std::vector<Vec3>& centres);
  void take(const Vec3& p, std::int32_t leaf, Nearest& best) const;

  std::vector<std::array<double, 9>> corners_;  ///< in the order of the leaves
  std::vector<std::int32_t> number_;            ///< of each in the order given
  std::vector<Box> boxes_;
};

}  // namespace tissu
