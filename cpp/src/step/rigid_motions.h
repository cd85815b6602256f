#pragma once

/// The rigid motions of a connected part.

#include <Eigen/Core>
#include <vector>

#include "tissu/step/parts.h"

namespace tissu {

/// Those that supports allow, of a free part the rotations, as its momentum is what acts on it in any step.
/// They are about the mass centre, with rotations times `length`: momenta and velocities have one unit then.
class RigidMotions {
 public:
  /// So much of each motion that is allowed.
  using Amounts = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
  using Masses = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

  /// All three have to stay where they are.
  RigidMotions(const World& world, const ConnectedPart& part, const State& at);

  [[nodiscard]] Eigen::Index count() const { return allowed_.cols(); }
  /// Impulses at rows as those on the motions that are allowed.
  [[nodiscard]] Amounts on_motions(ConstReals impulses) const;
  /// The momenta of velocities on the motions that are allowed.
  [[nodiscard]] Amounts momenta(ConstReals v) const;
  [[nodiscard]] Masses mass() const { return allowed_.transpose() * mass_ * allowed_; }
  /// Momenta in the norm of the energy [kg^1/2 m/s].
  [[nodiscard]] double size(const Amounts& momenta) const;
  /// - scale times the stiffness of what holds the part from outside. The vectors are scratch.
  [[nodiscard]] Masses held(double scale, Scratch& scratch, std::vector<double>& motion,
                            std::vector<double>& product) const;
  /// The largest of these velocities, as a share of the size [1/s].
  [[nodiscard]] double rate(const Amounts& velocities) const;
  /// v += those velocities, on rows that nothing holds.
  void add(const Amounts& velocities, Reals v) const;
  struct Twist {
    Vec3 velocity = Vec3::Zero();  ///< [m/s] of the mass centre
    Vec3 spin = Vec3::Zero();      ///< [rad/s]
  };
  /// The rigid part of velocities: that of the same momenta on the motions that are allowed, of a free part
  /// on all. `carried` is the velocity of the supports.
  [[nodiscard]] Twist twist(ConstReals v, const Vec3& carried) const;
  [[nodiscard]] const Vec3& center() const { return center_; }

 private:
  using Six = Eigen::Matrix<double, 6, 6>;

  [[nodiscard]] Vec3 arm(std::int32_t node) const { return block(ConstReals(at_.positions), node) - center_; }
  [[nodiscard]] const Frame& frame(std::int32_t k) const {
    return world_.frames()[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] const Quaternion& rotation(std::int32_t k) const {
    return at_.rotations[static_cast<std::size_t>(k)];
  }
  void allow();

  const World& world_;
  const ConnectedPart& part_;
  const State& at_;
  Vec3 center_ = Vec3::Zero();
  double length_ = 1.0;
  Six mass_;
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> allowed_;
};

}  // namespace tissu
