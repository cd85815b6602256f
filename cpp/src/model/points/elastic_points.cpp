#include "tissu/model/points/elastic_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "tissu/model/points/cell_points.h"
#include "tissu/model/points/listed_material.h"

namespace tissu {
namespace {

constexpr double kGone = 1e-6;  ///< a stretch below it leaves no material

/// What a block of sheets or lines asks of its points.
struct Thin {
  int m;
  bool small_strain;  ///< the law sees the symmetric part of F alone
  Plane plane;

  /// F in the axes of the piece, unstrained across: there the fibres of a sheet stay normal to it, those of a
  /// line turn with it. A flat body keeps its sides, so that a mirrored cell has det F < 0. A law of small
  /// strain sees no shear between along and across.
  [[nodiscard]] Mat3 unstrained_across(const CellPoint& at) const {
    Mat3 F = at.Q.transpose() * at.dx;
    if (small_strain) {
      for (int j = m; j < 3; ++j) {
        for (int k = 0; k < m; ++k) F(k, j) = -F(j, k);
        F(j, j) = 1.0;
      }
    } else if (m == 2) {
      F.col(2) = F.col(0).cross(F.col(1)).normalized();
      if (plane != Plane::free && F(2, 2) < 0.0) F.col(2) = -F.col(2);
    } else {
      const Mat3 R = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), F.col(0)).toRotationMatrix();
      F.rightCols<2>() = R.rightCols<2>();
    }
    return F;
  }
  /// F stretched across; `free` is the stretched F that the law saw.
  [[nodiscard]] Mat3 stretched(Mat3 F, const Mat3& free) const {
    for (int j = m; j < 3; ++j) {
      if (small_strain) {
        F(j, j) = free(j, j);
      } else if (free.col(j).norm() > kGone) {
        F.col(j) = free.col(j);
      } else {
        F.setConstant(std::numeric_limits<double>::quiet_NaN());
      }
    }
    return F;
  }
};

Mat3 symmetric_part(const Mat3& F) { return 0.5 * (F + F.transpose()); }

/// F of each point in the axes of its piece.
void fill_across(const Thin& thin, const PlacedCells& placed, const ListedMaterial& material,
                 PointFields& points) {
  const auto count = static_cast<std::size_t>(points.points_per_cell);
  for (std::size_t i = 0; i < points.volumes.size(); ++i) {
    points.set_gradient(i, thin.unstrained_across(placed.point(i / count, i % count)));
  }
  if (thin.plane == Plane::strain) return;
  PointFields free = points;
  for (std::size_t i = 0; thin.small_strain && i < points.volumes.size(); ++i) {
    free.set_gradient(i, symmetric_part(points.gradient_at(i)));
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
  if (m < 3) {
    const bool sees_rotations = !law_info(block, laws_of(block).front()).frame_invariant;
    fill_across({m, sees_rotations, block.plane}, placed, material, points);
  }
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
