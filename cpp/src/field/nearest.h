#pragma once

/// The nearest of a list of positions, by a k-d tree.

#include <compare>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

class Nearest {
 public:
  struct Found {
    double squared;       ///< distance [m2]
    std::int32_t number;  ///< in the list
    auto operator<=>(const Found&) const = default;
  };

  explicit Nearest(ConstReals positions);

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(points_.size()); }

  /// The `count` nearest to x, or all where there are fewer, nearest first; of two as near, the lower number
  /// first, whatever the tree.
  void find(const Vec3& x, int count, std::vector<Found>& found) const;

 private:
  struct Point {
    Vec3 position;
    std::int32_t number;
    int axis;  ///< that a point in the middle of its range splits
  };
  struct Query {
    Vec3 x;
    std::size_t count;
    std::vector<Found>* found;
    void offer(const Point& point) const;
    [[nodiscard]] bool reaches(double distance) const;
  };
  void split(std::size_t begin, std::size_t end);
  void visit(const Query& query, std::size_t begin, std::size_t end) const;

  std::vector<Point> points_;  ///< the middle of each range splits it
};

}  // namespace tissu
