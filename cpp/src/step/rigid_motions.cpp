#include "rigid_motions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

using Six = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< a velocity, and an angular velocity times the length

constexpr double kAllowed = 1e-10;  ///< of the largest eigenvalue: motions of less are those supports allow
constexpr double kThin = 1e-9;      ///< of the mass: the inertia of a line about itself

}  // namespace

RigidMotions::RigidMotions(const World& world, const ConnectedPart& part, const State& at)
    : world_(world), part_(part), at_(at) {
  const std::vector<double>& mass = world.mass().nodal();
  for (const std::int32_t node : part.nodes) {
    center_ += mass[static_cast<std::size_t>(node)] * block(ConstReals(at.positions), node);
  }
  center_ /= part.mass;
  Mat3 inertia = Mat3::Zero();
  for (const std::int32_t node : part.nodes) {
    const Vec3 r = arm(node);
    inertia +=
        mass[static_cast<std::size_t>(node)] * (r.squaredNorm() * Mat3::Identity() - Mat3(r * r.transpose()));
  }
  for (const std::int32_t k : part.frames) inertia += spatial_inertia(frame(k), rotation(k));
  length_ = std::sqrt(inertia.trace() / part.mass);
  if (!(length_ > 0.0)) length_ = 1.0;  // a point
  mass_.setZero();
  mass_.topLeftCorner<3, 3>() = part.mass * Mat3::Identity();
  mass_.bottomRightCorner<3, 3>() = inertia / (length_ * length_) + kThin * part.mass * Mat3::Identity();
  allow();
}

RigidMotions::Amounts RigidMotions::on_motions(ConstReals impulses) const {
  Vec6 sum = Vec6::Zero();
  for (const std::int32_t node : part_.nodes) {
    const Vec3 one = block(impulses, node);
    sum.head<3>() += one;
    sum.tail<3>() += arm(node).cross(one) / length_;
  }
  for (const std::int32_t k : part_.frames) {
    sum.tail<3>() += block(impulses, frame(k).rotation) / length_;
  }
  return allowed_.transpose() * sum;
}

RigidMotions::Amounts RigidMotions::momenta(ConstReals v) const {
  const std::vector<double>& mass = world_.mass().nodal();
  Vec6 sum = Vec6::Zero();
  for (const std::int32_t node : part_.nodes) {
    const Vec3 one = mass[static_cast<std::size_t>(node)] * block(v, node);
    sum.head<3>() += one;
    sum.tail<3>() += arm(node).cross(one) / length_;
  }
  for (const std::int32_t k : part_.frames) {
    sum.tail<3>() += spatial_inertia(frame(k), rotation(k)) * block(v, frame(k).rotation) / length_;
  }
  return allowed_.transpose() * sum;
}

double RigidMotions::size(const Amounts& momenta) const {
  return std::sqrt(std::max(momenta.dot(mass().ldlt().solve(momenta)), 0.0));
}

RigidMotions::Masses RigidMotions::held(double scale, Scratch& scratch, std::vector<double>& motion,
                                        std::vector<double>& product) const {
  Masses sum = Masses::Zero(count(), count());
  std::ranges::fill(motion, 0.0);
  for (Eigen::Index j = 0; j < count(); ++j) {
    for (const std::int32_t node : part_.nodes) block(Reals(motion), node).setZero();
    for (const std::int32_t k : part_.frames) block(Reals(motion), frame(k).rotation).setZero();
    add(Amounts::Unit(count(), j), motion);
    std::ranges::fill(product, 0.0);
    for (const auto& model : world_.forces()) {
      if (!model->has_stiffness()) continue;
      if (model->kind() == ForceKind::elastic && !model->run_time().couples) continue;
      model->add_product(at_, scratch, {-scale, 0.0}, motion, product);
    }
    sum.col(j) = on_motions(product);
  }
  return 0.5 * (sum + sum.transpose());
}

double RigidMotions::rate(const Amounts& velocities) const {
  const Vec6 twist = allowed_ * velocities;
  return std::max(twist.head<3>().norm(), twist.tail<3>().norm()) / length_;
}

void RigidMotions::add(const Amounts& velocities, Reals v) const {
  const Vec6 twist = allowed_ * velocities;
  const Vec3 spin = twist.tail<3>() / length_;
  const auto add_to = [&](std::int32_t row, const Vec3& velocity) {
    const std::uint8_t mask = world_.fixed().masks()[static_cast<std::size_t>(row)];
    for (int axis = 0; axis < 3; ++axis) {
      if (((mask >> axis) & 1) == 0) v[static_cast<std::size_t>(3 * row + axis)] += velocity[axis];
    }
  };
  for (const std::int32_t node : part_.nodes) add_to(node, twist.head<3>() + spin.cross(arm(node)));
  for (const std::int32_t k : part_.frames) add_to(frame(k).rotation, spin);
}

void RigidMotions::allow() {
  if (!part_.is_held) {
    allowed_ = Six::Identity().rightCols<3>();
    return;
  }
  const std::vector<std::uint8_t>& masks = world_.fixed().masks();
  Six held = Six::Zero();
  const auto hold = [&](std::int32_t row, const Mat3& by_velocity, const Mat3& by_spin) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((masks[static_cast<std::size_t>(row)] >> axis) & 1) == 0) continue;
      Vec6 one;
      one << by_velocity.row(axis).transpose(), by_spin.row(axis).transpose();
      held += one * one.transpose();
    }
  };
  for (const std::int32_t node : part_.nodes) {
    const Vec3 r = arm(node) / length_;
    Mat3 by_spin;  // spin x r
    by_spin << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
    hold(node, Mat3::Identity(), by_spin);
  }
  for (const std::int32_t k : part_.frames) hold(frame(k).rotation, Mat3::Zero(), Mat3::Identity());
  // Nothing is left of what moves the part as a whole along axes that no support holds.
  const Eigen::SelfAdjointEigenSolver<Mat3> ways(Mat3(held.topLeftCorner<3, 3>()));
  for (int k = 0; k < 3; ++k) {
    if (ways.eigenvalues()[k] > kAllowed * held.trace()) continue;
    const Vec3 way = ways.eigenvectors().col(k);
    held.topLeftCorner<3, 3>() += held.trace() * way * way.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Six> found(held);
  const double most = kAllowed * found.eigenvalues()[5];
  Eigen::Index count = 0;
  while (count < 6 && found.eigenvalues()[count] <= most) ++count;
  allowed_ = found.eigenvectors().leftCols(count);
}

RigidMotions::Twist RigidMotions::twist(ConstReals v, const Vec3& carried) const {
  const Amounts with = allowed_.topRows<3>().transpose() * (part_.mass * carried);
  const Vec6 twist = allowed_ * mass().ldlt().solve(momenta(v) - with);
  Vec3 velocity = twist.head<3>();
  if (!part_.is_held) {
    const std::vector<double>& mass = world_.mass().nodal();
    for (const std::int32_t node : part_.nodes) {
      velocity += mass[static_cast<std::size_t>(node)] * block(v, node);
    }
    velocity /= part_.mass;
  }
  return {velocity, twist.tail<3>() / length_};
}

}  // namespace tissu
