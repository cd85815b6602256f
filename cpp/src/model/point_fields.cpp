#include "tissu/model/point_fields.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "tissu/model/body_model.h"

namespace tissu {

void PointFields::resize(std::size_t points) {
  positions.assign(3 * points, 0.0);
  volumes.assign(points, 0.0);
  F.assign(9 * points, 0.0);
  P.assign(9 * points, 0.0);
  W.assign(points, 0.0);
}

Mat3 cauchy_stress(const Mat3& F, const Mat3& P) {
  const Mat3 tau = P * F.transpose();
  return 0.5 / F.determinant() * (tau + tau.transpose());
}

double von_mises(const Mat3& sigma) {
  return std::sqrt(1.5) * (sigma - sigma.trace() / 3.0 * Mat3::Identity()).norm();
}

double least(ConstReals ratios) {
  double found = std::numeric_limits<double>::infinity();
  for (const double ratio : ratios) {
    if (ratio < found) found = ratio;  // not a number either
  }
  return found;
}

CellFields cell_means(const PointFields& points) {
  CellFields fields;
  const auto of_cell = static_cast<std::size_t>(points.points_per_cell);
  for (std::size_t first = 0; first < points.volumes.size(); first += of_cell) {
    double volume = 0.0;
    double energy = 0.0;
    double ratio = 0.0;
    Mat3 sigma = Mat3::Zero();
    for (std::size_t i = first; i < first + of_cell; ++i) {
      const double w = points.volumes[i];
      volume += w;
      energy += w * points.W[i];
      ratio += w * points.gradient_at(i).determinant();
      sigma += w * cauchy_stress(points.gradient_at(i), points.stress_at(i));
    }
    fields.von_mises.push_back(von_mises(sigma / volume));
    fields.energy_density.push_back(energy / volume);
    fields.volume_ratio.push_back(ratio / volume);
  }
  return fields;
}

double BodyModel::least_volume_ratio(const State& state, Scratch& /*scratch*/) const {
  return least(fields(state).volume_ratio);
}

PointFields BodyModel::point_fields(const PointQuery& /*query*/) const { return {}; }

}  // namespace tissu
