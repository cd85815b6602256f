#include "tissu/step/rigid_correction.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace tissu {
namespace {

using Twist = Eigen::Matrix<double, 6, 1>;  ///< a velocity, and an angular velocity times a length
using Six = Eigen::Matrix<double, 6, 6>;
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;
using Amounts = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;  ///< of each motion
using Masses = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

constexpr double kLeast = 1e-5;    ///< of what moves or acts: less is not corrected
constexpr double kFarthest = 0.1;  ///< [rad] or of the size: what is left of far turns is not of second order
constexpr double kAllowed = 1e-10;  ///< of the largest eigenvalue: motions of less are those supports allow
constexpr double kThin = 1e-9;      ///< of the mass: the inertia of a line about itself

/// Rigid motions of a part about its mass centre, with rotations times `length`.
class Rigid {
 public:
  Rigid(const World& world, const ConnectedPart& part, const State& at)
      : world_(world), part_(part), at_(at) {
    const std::vector<double>& mass = world.mass().nodal();
    for (const std::int32_t node : part.nodes) {
      center_ += mass[static_cast<std::size_t>(node)] * block(ConstReals(at.positions), node);
    }
    center_ /= part.mass;
    Mat3 inertia = Mat3::Zero();
    for (const std::int32_t node : part.nodes) {
      const Vec3 r = arm(node);
      inertia += mass[static_cast<std::size_t>(node)] *
                 (r.squaredNorm() * Mat3::Identity() - Mat3(r * r.transpose()));
    }
    for (const std::int32_t k : part.frames) inertia += spatial_inertia(frame(k), rotation(k));
    length_ = std::sqrt(inertia.trace() / part.mass);
    if (!(length_ > 0.0)) length_ = 1.0;  // a point
    mass_.setZero();
    mass_.topLeftCorner<3, 3>() = part.mass * Mat3::Identity();
    mass_.bottomRightCorner<3, 3>() = inertia / (length_ * length_) + kThin * part.mass * Mat3::Identity();
    allow();
  }

  [[nodiscard]] Eigen::Index count() const { return allowed_.cols(); }

  /// Impulses at rows as those on the motions that are allowed.
  [[nodiscard]] Amounts on_motions(ConstReals impulses) const {
    Twist sum = Twist::Zero();
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

  /// The momenta of velocities on the motions that are allowed.
  [[nodiscard]] Amounts momenta(ConstReals v) const {
    const std::vector<double>& mass = world_.mass().nodal();
    Twist sum = Twist::Zero();
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

  [[nodiscard]] Masses mass() const { return allowed_.transpose() * mass_ * allowed_; }

  /// Momenta in the norm of the energy [kg^1/2 m/s].
  [[nodiscard]] double size(const Amounts& momenta) const {
    return std::sqrt(std::max(momenta.dot(mass().ldlt().solve(momenta)), 0.0));
  }

  /// - scale times the stiffness of what holds the part from outside. The vectors are scratch.
  [[nodiscard]] Masses held(double scale, Scratch& scratch, std::vector<double>& motion,
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

  /// The largest of these velocities, as a share of the size [1/s].
  [[nodiscard]] double rate(const Amounts& velocities) const {
    const Twist twist = allowed_ * velocities;
    return std::max(twist.head<3>().norm(), twist.tail<3>().norm()) / length_;
  }

  /// v += those velocities.
  void add(const Amounts& velocities, Reals v) const {
    const Twist twist = allowed_ * velocities;
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

 private:
  [[nodiscard]] Vec3 arm(std::int32_t node) const { return block(ConstReals(at_.positions), node) - center_; }
  [[nodiscard]] const Frame& frame(std::int32_t k) const {
    return world_.frames()[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] const Quaternion& rotation(std::int32_t k) const {
    return at_.rotations[static_cast<std::size_t>(k)];
  }

  void allow() {
    if (!part_.is_held) {
      allowed_ = Six::Identity().rightCols<3>();
      return;
    }
    const std::vector<std::uint8_t>& masks = world_.fixed().masks();
    Six held = Six::Zero();
    const auto hold = [&](std::int32_t row, const Mat3& by_velocity, const Mat3& by_spin) {
      for (int axis = 0; axis < 3; ++axis) {
        if (((masks[static_cast<std::size_t>(row)] >> axis) & 1) == 0) continue;
        Twist one;
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

  const World& world_;
  const ConnectedPart& part_;
  const State& at_;
  Vec3 center_ = Vec3::Zero();
  double length_ = 1.0;
  Six mass_;
  Motions allowed_;
};

}  // namespace

void RigidCorrection::prepare(const World& world, const PartBalance& balance) {
  world_ = &world;
  balance_ = &balance;
  corrected_.clear();
  moving_.clear();
  for (std::size_t k = 0; k < balance.parts().size(); ++k) {
    const ConnectedPart& part = balance.parts()[k];
    if (!part.is_held || Rigid(world, part, world.rest_state()).count() > 0) moving_.push_back(k);
  }
  const std::size_t size = moving_.empty() ? 0 : static_cast<std::size_t>(3 * world.blocks());
  motion_.resize(size);
  product_.resize(size);
}

bool RigidCorrection::correct(const State& at, double push, double move, ConstReals residual,
                              ConstReals momentum_change, Reals v) {
  corrected_.clear();
  for (const std::size_t k : moving_) {
    const ConnectedPart& part = balance_->parts()[k];
    const Rigid rigid(*world_, part, at);
    if (rigid.count() == 0) continue;
    const Amounts left = rigid.on_motions(residual);
    const double size = rigid.size(left);
    const double acts = balance_->acting(k, momentum_change);
    if (!(size > kLeast * (rigid.size(rigid.momenta(v)) + acts / std::sqrt(part.mass)))) continue;
    const Eigen::LDLT<Masses> matrix(rigid.mass() + rigid.held(push * move, scratch_, motion_, product_));
    if (!matrix.isPositive()) continue;
    const Amounts velocities = matrix.solve(left);
    if (!(move * rigid.rate(velocities) <= kFarthest)) continue;
    rigid.add(velocities, v);
    corrected_.push_back({&part, size});
  }
  return !corrected_.empty();
}

int RigidCorrection::take_back(const State& at, ConstReals residual, ConstReals before, Reals v) const {
  int count = 0;
  for (const Corrected& one : corrected_) {
    const Rigid rigid(*world_, *one.part, at);
    if (rigid.size(rigid.on_motions(residual)) < one.left) continue;
    for (const std::int32_t node : one.part->nodes) block(v, node) = block(before, node);
    for (const std::int32_t k : one.part->frames) {
      const std::int32_t row = world_->frames()[static_cast<std::size_t>(k)].rotation;
      block(v, row) = block(before, row);
    }
    ++count;
  }
  return count;
}

}  // namespace tissu
