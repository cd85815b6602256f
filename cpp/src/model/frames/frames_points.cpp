/// F of a sheet or line of frames is whole but for how it thins; P is the law's there, not P S of
/// point_material.h, so that it is that of a volume.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tissu/model/frames/frames.h"
#include "tissu/model/points/listed_material.h"

namespace tissu {
namespace {

/// The places in the result of the points in the model's own order: cell after cell.
std::vector<std::size_t> places_of(const FramePoints& points, std::size_t cells, std::size_t per_cell) {
  std::vector<std::size_t> places(points.volumes.size());
  if (points.cells.empty()) {
    std::iota(places.begin(), places.end(), 0U);
    return places;
  }
  std::vector<std::size_t> filled(cells, 0);
  for (std::size_t s = 0; s < places.size(); ++s) {
    const auto cell = static_cast<std::size_t>(points.cells[s]);
    places[s] = cell * per_cell + filled[cell]++;
  }
  return places;
}

constexpr std::size_t kLanes = FrameOrder::kLanes;
constexpr std::size_t kNine = FrameMaterial::kNine;

Mat3 tensor_of(const double* values, std::size_t lane) {
  Mat3 F;
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) F(i, c) = values[static_cast<std::size_t>(3 * i + c) * kLanes + lane];
  }
  return F;
}

}  // namespace

CellFields Frames::fields(const State& state) const {
  AlignedVector<double> q(motion_size());
  std::vector<double> of_lanes(lane_volumes_.size(), 0.0);
  gather(state, q.data());
  energies(q.data(), of_lanes.data());
  CellFields fields;
  for (auto* values : {&fields.von_mises, &fields.energy_density, &fields.volume_ratio})
    values->assign(volumes_.size(), 0.0);
  std::array<double, kNine> F;
  std::array<double, kNine> P;
  std::array<double, kNine> whole;
  for (std::int32_t g = 0; g < order_.groups(); ++g) {
    kernels_->gradient(view(), g, g + 1, q.data(), F.data());
    material_.law().stress(g, F.data(), P.data());
    material_.law().stretch(g, F.data(), whole.data());
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = static_cast<std::size_t>(g) * kLanes + lane;
      if (order_.real[i] == 0) continue;
      const auto point = static_cast<std::size_t>(order_.point[i]);
      const std::size_t cell = points_.cells.empty() ? point : static_cast<std::size_t>(points_.cells[point]);
      const double share = points_.volumes[point] / volumes_[cell];
      const double J = tensor_of(whole.data(), lane).determinant();
      const Mat3 sigma = tensor_of(P.data(), lane) * tensor_of(F.data(), lane).transpose() / J;
      const Mat3 deviator = sigma - sigma.trace() / 3.0 * Mat3::Identity();
      fields.von_mises[cell] += share * std::sqrt(1.5) * deviator.norm();
      fields.energy_density[cell] += share * of_lanes[i];
      fields.volume_ratio[cell] += share * J;
    }
  }
  return fields;
}

double Frames::least_volume_ratio(const State& state, Scratch& scratch) const {
  const Reals work = scratch.reals(motion_size() + volumes_.size());
  const Reals ratios = work.subspan(motion_size());
  std::ranges::fill(ratios, 0.0);
  gather(state, work.data());
  std::array<double, kNine> F;
  std::array<double, kNine> whole;
  for (std::int32_t g = 0; g < order_.groups(); ++g) {
    kernels_->gradient(view(), g, g + 1, work.data(), F.data());
    material_.law().stretch(g, F.data(), whole.data());
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = static_cast<std::size_t>(g) * kLanes + lane;
      if (order_.real[i] == 0) continue;
      const auto point = static_cast<std::size_t>(order_.point[i]);
      const std::size_t cell = points_.cells.empty() ? point : static_cast<std::size_t>(points_.cells[point]);
      ratios[cell] += points_.volumes[point] / volumes_[cell] * tensor_of(whole.data(), lane).determinant();
    }
  }
  return least(ratios);
}

PointFields Frames::point_fields(const PointQuery& query) const {
  AlignedVector<double> q(motion_size());
  gather(query.state, q.data());
  PointFields points;
  const std::size_t per_cell = points_.volumes.size() / volumes_.size();
  points.points_per_cell = static_cast<int>(per_cell);
  points.through_thickness = points_.dimension < 3 && options_.section == "whole";
  points.resize(points_.volumes.size());
  const std::vector<std::size_t> places = places_of(points_, volumes_.size(), per_cell);
  std::vector<std::int32_t> cells(places.size());
  for (std::size_t s = 0; s < places.size(); ++s) {
    cells[places[s]] = static_cast<std::int32_t>(places[s] / per_cell);
    points.volumes[places[s]] = points_.volumes[s];
    for (std::size_t c = 0; c < 3; ++c) points.positions[3 * places[s] + c] = points_.positions[3 * s + c];
  }
  std::array<double, FrameMaterial::kNine> F;
  std::array<double, FrameMaterial::kNine> whole;
  for (std::int32_t g = 0; g < order_.groups(); ++g) {
    kernels_->gradient(view(), g, g + 1, q.data(), F.data());
    material_.law().stretch(g, F.data(), whole.data());
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = static_cast<std::size_t>(g) * kLanes + lane;
      if (order_.real[i] == 0) continue;
      double* to = points.F.data() + 9 * places[static_cast<std::size_t>(order_.point[i])];
      for (std::size_t k = 0; k < 9; ++k) to[k] = whole[k * kLanes + lane];
    }
  }
  ListedMaterial(block_, cells, query.isa).stress_and_energy(points);
  return points;
}

}  // namespace tissu
