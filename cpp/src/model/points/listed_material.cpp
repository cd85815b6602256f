#include "tissu/model/points/listed_material.h"

#include <array>
#include <numeric>

namespace tissu {
namespace {

constexpr std::size_t kLanes = PointMaterial::kLanes;
using Nine = std::array<double, PointMaterial::kNine>;

/// F of the points of a group, [entry][8].
void gather(const std::vector<double>& from, const std::int32_t* points, Nine& to) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t k = 0; k < 9; ++k)
      to[k * kLanes + lane] = from[9 * static_cast<std::size_t>(points[lane]) + k];
  }
}

void scatter(const Nine& from, const std::int32_t* points, std::vector<double>& to) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t k = 0; k < 9; ++k)
      to[9 * static_cast<std::size_t>(points[lane]) + k] = from[k * kLanes + lane];
  }
}

}  // namespace

ListedMaterial::ListedMaterial(const ElasticBlock& block, const std::vector<std::int32_t>& cells, Isa isa)
    : block_(block), isa_(isa) {
  list_.cells = cells;
  lanes_.resize((cells.size() + kLanes - 1) / kLanes * kLanes, static_cast<std::int32_t>(cells.size()) - 1);
  std::iota(lanes_.begin(), lanes_.begin() + static_cast<std::ptrdiff_t>(cells.size()), 0);
}

void ListedMaterial::stress_and_energy(PointFields& points) const {
  const PointMaterial material(block_, list_, lanes_, isa_);
  Nine F;
  Nine P;
  for (std::size_t i = 0; i < lanes_.size(); i += kLanes) {
    const auto group = static_cast<std::int32_t>(i / kLanes);
    const std::int32_t* at = lanes_.data() + i;
    std::array<double, kLanes> W{};
    gather(points.F, at, F);
    material.stress(group, F.data(), P.data());
    material.energy(group, F.data(), W.data());
    scatter(P, at, points.P);
    for (std::size_t lane = 0; lane < kLanes; ++lane) points.W[static_cast<std::size_t>(at[lane])] = W[lane];
  }
}

PointMaterial ListedMaterial::across(int m) const {
  FramePoints thin = list_;
  thin.dimension = m;
  for (std::size_t i = 0; i < list_.cells.size(); ++i) {
    const Vec3 axis = m == 2 ? Vec3::UnitZ() : Vec3::UnitX();
    thin.axes.insert(thin.axes.end(), axis.begin(), axis.end());
  }
  return {block_, thin, lanes_, isa_};
}

void ListedMaterial::stretch_across(int m, std::vector<double>& F) const {
  const PointMaterial material = across(m);
  Nine from;
  Nine whole;
  for (std::size_t i = 0; i < lanes_.size(); i += kLanes) {
    gather(F, lanes_.data() + i, from);
    material.stretch(static_cast<std::int32_t>(i / kLanes), from.data(), whole.data());
    scatter(whole, lanes_.data() + i, F);
  }
}

}  // namespace tissu
