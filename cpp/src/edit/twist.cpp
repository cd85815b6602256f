#include "tissu/edit/twist.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <iterator>
#include <vector>

namespace tissu {
namespace {

/// Of the least moment of inertia over the largest: below it the rows lie in one line.
constexpr double kLine = 1e-9;

}  // namespace

void add_twist(const World& world, std::span<const std::int32_t> rows, const Vec3& momentum,
               const Vec3& angular, ConstReals positions, Reals velocities) {
  const std::vector<double>& nodal = world.mass().nodal();
  const auto m = [&](std::int32_t row) { return nodal[static_cast<std::size_t>(row)]; };
  std::vector<std::int32_t> free;
  std::ranges::copy_if(rows, std::back_inserter(free), [&](std::int32_t row) {
    return m(row) > 0.0 && world.fixed().masks()[static_cast<std::size_t>(row)] == 0;
  });
  double mass = 0.0;
  Vec3 center = Vec3::Zero();
  for (const std::int32_t row : free) {
    mass += m(row);
    center += m(row) * block(positions, row);
  }
  if (!(mass > 0.0)) return;
  center /= mass;
  Mat3 inertia = Mat3::Zero();
  for (const std::int32_t row : free) {
    const Vec3 r = block(positions, row) - center;
    inertia += m(row) * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
  Vec3 omega = Vec3::Zero();
  if (axes.eigenvalues()[0] > kLine * axes.eigenvalues()[2]) {
    const Vec3 own = angular - center.cross(momentum);
    omega = axes.eigenvectors() *
            (axes.eigenvectors().transpose() * own).cwiseQuotient(axes.eigenvalues()).eval();
  }
  for (const std::int32_t row : free) {
    const Vec3 r = block(positions, row) - center;
    block(velocities, row) += momentum / mass + omega.cross(r);
  }
}

}  // namespace tissu
