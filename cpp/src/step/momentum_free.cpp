#include "tissu/step/momentum_free.h"

#include <Eigen/Cholesky>

namespace tissu {

void MomentumFree::prepare(const World& world, std::span<const ConnectedPart> parts) {
  world_ = &world;
  free_.clear();
  for (const ConnectedPart& part : parts) {
    if (!part.is_held) free_.push_back(part.nodes);
  }
}

void MomentumFree::project(ConstReals places, Reals way) const {
  for (const std::vector<std::int32_t>& nodes : free_) project(nodes, places, way);
}

void MomentumFree::project(std::span<const std::int32_t> nodes, ConstReals places, Reals way) const {
  const std::vector<double>& mass = world_->mass().nodal();
  double total = 0.0;
  Vec3 centre = Vec3::Zero();
  Vec3 shift = Vec3::Zero();
  const auto each = [&](auto&& f) {
    for (const std::int32_t i : nodes) f(i, mass[static_cast<std::size_t>(i)]);
  };
  each([&](std::int32_t i, double m) {
    total += m;
    centre += m * block(places, i);
    shift += m * block(ConstReals(way), i);
  });
  centre /= total;
  shift /= total;
  Mat3 inertia = Mat3::Zero();
  Vec3 spin = Vec3::Zero();
  each([&](std::int32_t i, double m) {
    const Vec3 r = block(places, i) - centre;
    inertia += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    spin += m * r.cross(block(ConstReals(way), i) - shift);
  });
  // A line has no inertia about itself, and a point none at all: their shares of the spin are zero too.
  const Mat3 eased = inertia + 1e-14 * inertia.trace() * Mat3::Identity();
  const Vec3 turn = inertia.trace() > 0.0 ? Vec3(eased.ldlt().solve(spin)) : Vec3::Zero();
  each([&](std::int32_t i, double /*m*/) { block(way, i) -= shift + turn.cross(block(places, i) - centre); });
}

}  // namespace tissu
