#pragma once

/// The laws of a block, fibres and laws made at run time too, at points in a list.

#include "tissu/model/point_fields.h"
#include "tissu/model/points/point_material.h"

namespace tissu {

class ListedMaterial {
 public:
  /// `cells` holds the cell of each point.
  ListedMaterial(const ElasticBlock& block, const std::vector<std::int32_t>& cells, Isa isa);

  /// P and W of volumes, from F.
  void stress_and_energy(PointFields& points) const;
  /// F of pieces of m dimensions with its last 3 - m columns stretched until no stress is left across. F is
  /// in the axes of the piece, the first m along it.
  void stretch_across(int m, std::vector<double>& F) const;
  /// What stretches the points so, in groups of eight as the list has them; padding repeats the last.
  [[nodiscard]] PointMaterial across(int m) const;

 private:
  const ElasticBlock& block_;
  std::vector<std::int32_t> lanes_;  ///< the point of each lane; padding repeats the last
  FramePoints list_;
  Isa isa_;
};

}  // namespace tissu
