#include "tissu/model/points/elastic_points.h"

#include "tissu/model/points/cell_points.h"
#include "tissu/model/points/listed_material.h"
#include "tissu/model/points/thin_points.h"

namespace tissu {
namespace {

/// F of each point in the axes of its piece.
void fill_across(const ThinPoints& thin, const PlacedCells& placed, const ListedMaterial& material,
                 PointFields& points) {
  const auto count = static_cast<std::size_t>(points.points_per_cell);
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    points.set_gradient(i, thin.unstrained_across(placed.point(i / count, i % count)));
  }
  if (!thin.thins()) return;
  PointFields free = points;
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    free.set_gradient(i, thin.seen(points.gradient_at(i)));
  }
  material.stretch_across(thin.m, free.F);
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    points.set_gradient(i, thin.stretched(points.gradient_at(i), free.gradient_at(i)));
  }
}

}  // namespace

std::vector<std::int32_t> cells_of_points(const PointFields& points) {
  std::vector<std::int32_t> cells(points.volumes.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = static_cast<std::int32_t>(i) / points.points_per_cell;
  return cells;
}

PointFields elastic_points(const ElasticBlock& block, const PointQuery& query) {
  const PlacedCells placed(block, block.quadrature, query);
  PointFields points = placed.lay();
  const ListedMaterial material(block, cells_of_points(points), query.isa);
  const int m = placed.reference.dimension;
  if (m < 3) fill_across(ThinPoints(block, m), placed, material, points);
  material.stress_and_energy(points);
  if (m == 3) return points;
  const auto count = static_cast<std::size_t>(points.points_per_cell);
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    const Mat3 Q = placed.point(i / count, i % count).Q;
    points.set_gradient(i, Q * points.gradient_at(i) * Q.transpose());
    points.set_stress(i, Q * points.stress_at(i) * Q.transpose());
  }
  return points;
}

}  // namespace tissu
