#pragma once

/// The least volume ratio among the cells of sheets or lines, asked again and again.

#include <array>

#include "tissu/model/points/point_material.h"
#include "tissu/model/points/thin_points.h"

namespace tissu {

class ThinRatios {
 public:
  /// Refuses what the laws refuse.
  ThinRatios(const ElasticBlock& block, Isa isa);

  /// The least of the cells' mean det F, as CellFields have it, infinite where it is a number of none.
  /// `block` is the one that it was made of; its nodes stand at X at rest and at x now. It takes no memory.
  [[nodiscard]] double least(const ElasticBlock& block, ConstReals X, ConstReals x) const;

 private:
  struct Point {
    Mat3 F;
    double volume;
  };
  using Group = std::array<Point, PointMaterial::kLanes>;
  /// Stretches F of the first points of a group across.
  void stretch(std::int32_t group, std::size_t points, Group& of) const;

  ReferenceCell reference_;
  ThinPoints thin_;
  PointMaterial material_;
};

}  // namespace tissu
