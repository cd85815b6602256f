#include "tissu/model/shell/shell_element.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../base/differences.h"
#include "../../base/eigenvalues.h"
#include "shell_sample.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

using test::any_change;
using test::any_pose;
using test::any_triangle;
using test::Corners;
using test::moved;
using test::Random;

constexpr ShellSection kSection = {0.2, 10.0, 0.3};

class ShellElementTest : public testing::Test {
 protected:
  Random random_{5};
  Corners X_ = any_triangle(random_);
  ShellElement element_{X_, kSection};
};

// Round-off of 1 in d^2 and in d, K of order E t.
TEST_F(ShellElementTest, RigidMotionsCostNothing) {
  for (int trial = 0; trial < 50; ++trial) {
    const ShellPose pose = any_pose(X_, 0.0, random_);
    EXPECT_LT(element_.energy(pose), 1e-28);
    EXPECT_LT(element_.force(pose).norm(), 1e-13);
  }
}

// Differences of fourth order with h = 1e-3: h^4 / 30 of the fifth derivative, which is of order K |p|^5,
// some hundreds, leaves 1e-11, round-off 1e-16 / h.
TEST_F(ShellElementTest, ForceIsMinusTheGradientOfTheEnergy) {
  for (const double size : {1e-3, 0.1, 0.4}) {
    for (int trial = 0; trial < 20; ++trial) {
      const ShellPose pose = any_pose(X_, size, random_);
      const Vec18 p = any_change(random_);
      const double slope =
          test::derivative([&](double t) { return element_.energy(moved(pose, p, t)); }, 1e-3);
      EXPECT_NEAR(element_.force(pose).dot(p), -slope, 1e-10) << size;
    }
  }
}

TEST_F(ShellElementTest, StiffnessIsTheSymmetricDerivativeOfTheForce) {
  for (const double size : {1e-3, 0.1, 0.4}) {
    for (int trial = 0; trial < 20; ++trial) {
      const ShellPose pose = any_pose(X_, size, random_);
      const Mat18 K = element_.stiffness(pose);
      EXPECT_EQ(K, K.transpose());
      const Vec18 p = any_change(random_);
      const Vec18 f = element_.force(pose);
      Vec18 Kp = K * p;
      EXPECT_LT((element_.product(pose, p) - Kp).norm(), 1e-13 * K.norm() * p.norm());
      for (int a = 3; a < 18; a += 6) {
        Kp.segment<3>(a) += 0.5 * test::cross_matrix(f.segment<3>(a)) * p.segment<3>(a);
      }
      const Vec18 change =
          test::derivative([&](double t) { return element_.force(moved(pose, p, t)); }, 1e-3);
      EXPECT_LT((change + Kp).norm(), 1e-8 * Kp.norm()) << size;
    }
  }
}

/// A node turned by an angle beside the others, a little deformed besides.
ShellPose turned_by(const Corners& X, double angle, Random& random) {
  ShellPose pose = any_pose(X, 0.1, random);
  const Vec3 axis = random.vector().normalized();
  pose.rotations[1] = test::turn(angle * axis) * pose.rotations[1];
  return pose;
}

// As above; beyond a third of a turn the fifth derivative is some thousand times as large.
TEST_F(ShellElementTest, ForcesAndStiffnessesAreDerivativesForNodesTurnedByAnyAngle) {
  for (const double angle : {1.9, 2.3, 2.7, 3.1, 3.2, 4.0, 5.0}) {
    for (int trial = 0; trial < 10; ++trial) {
      const ShellPose pose = turned_by(X_, angle, random_);
      const Vec18 p = any_change(random_);
      const Vec18 f = element_.force(pose);
      const double slope =
          test::derivative([&](double t) { return element_.energy(moved(pose, p, t)); }, 3e-4);
      EXPECT_NEAR(f.dot(p), -slope, 1e-7 * (1.0 + std::abs(slope))) << angle;
      const Mat18 K = element_.stiffness(pose);
      Vec18 Kp = K * p;
      EXPECT_LT((element_.product(pose, p) - Kp).norm(), 1e-12 * K.norm() * p.norm()) << angle;
      for (int a = 3; a < 18; a += 6) {
        Kp.segment<3>(a) += 0.5 * test::cross_matrix(f.segment<3>(a)) * p.segment<3>(a);
      }
      const Vec18 change =
          test::derivative([&](double t) { return element_.force(moved(pose, p, t)); }, 3e-4);
      EXPECT_LT((change + Kp).norm(), 1e-6 * K.norm() * p.norm()) << angle;
    }
  }
}

// A full turn of a node comes back to the energy that it left, and none of its 2,000 steps jumps.
TEST_F(ShellElementTest, NodesTurnRoundWithoutAJumpOfTheEnergy) {
  constexpr int kSteps = 2000;
  for (int trial = 0; trial < 20; ++trial) {
    const ShellPose pose = any_pose(X_, 0.3, random_);
    const Vec3 axis = random_.vector().normalized();
    Vec18 p = Vec18::Zero();
    p.segment<3>(9) = axis;
    const double first = element_.energy(pose);
    double before = first;
    double most = 0.0;
    double largest = 0.0;
    for (int k = 1; k <= kSteps; ++k) {
      const double energy = element_.energy(moved(pose, p, 2.0 * std::numbers::pi * k / kSteps));
      most = std::max(most, std::abs(energy - before));
      largest = std::max(largest, energy);
      before = energy;
    }
    EXPECT_NEAR(before, first, 1e-12 * largest);
    // phi changes by five times what theta does at most, and by all of its size in a tenth of the turn.
    EXPECT_LT(most, 20.0 / kSteps * largest);
  }
}

TEST_F(ShellElementTest, ForcesAndMomentsAreInBalance) {
  for (int trial = 0; trial < 20; ++trial) {
    const ShellPose pose = any_pose(X_, 0.4, random_);
    const Vec18 f = element_.force(pose);
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (int a = 0; a < 3; ++a) {
      force += f.segment<3>(6 * a);
      moment += f.segment<3>(6 * a + 3) +
                pose.positions[static_cast<std::size_t>(a)].cross(Vec3(f.segment<3>(6 * a)));
    }
    EXPECT_LT(force.norm(), 1e-13 * f.norm());
    EXPECT_LT(moment.norm(), 1e-13 * f.norm() * 10.0);  // of arms up to 10
  }
}

// What it is must not depend on which node comes first, nor on the side that the normal is on.
TEST_F(ShellElementTest, DoesNotDependOnTheOrderOfItsNodes) {
  const ShellPose pose = any_pose(X_, 0.3, random_);
  const Vec18 f = element_.force(pose);
  for (const std::array<int, 3> order : {std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{1, 0, 2}}) {
    Corners X;
    ShellPose other;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto from = static_cast<std::size_t>(order[a]);
      X[a] = X_[from];
      other.positions[a] = pose.positions[from];
      other.rotations[a] = pose.rotations[from];
    }
    const Vec18 g = ShellElement(X, kSection).force(other);
    for (int a = 0; a < 3; ++a) {
      EXPECT_LT((g.segment<6>(6 * a) - f.segment<6>(6 * order[static_cast<std::size_t>(a)])).norm(),
                1e-13 * f.norm());
    }
  }
}

TEST_F(ShellElementTest, MaterialStiffnessIsSemidefiniteInEveryState) {
  for (const double size : {0.0, 0.3, 3.0}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Mat18 K = element_.material_stiffness(any_pose(X_, size, random_));
      const Vec18 values = test::eigenvalues(K);
      EXPECT_EQ(K, K.transpose());
      EXPECT_GT(values[0], -1e-14 * values[17]);
      EXPECT_GT(values[6], 1e-6 * values[17]);  // six rigid motions and no mechanism
    }
  }
  const ShellPose rest = any_pose(X_, 0.0, random_);
  EXPECT_LT((element_.material_stiffness(rest) - element_.stiffness(rest)).norm(), 1e-12);
}

TEST_F(ShellElementTest, StaysFiniteWhereItIsALineOrAPoint) {
  for (const double width : {1e-3, 1e-8, 0.0}) {
    for (const double length : {1.0, 0.0}) {
      ShellPose pose = any_pose(X_, 0.1, random_);
      for (Vec3& x : pose.positions) x = Vec3(length * x[0], length * x[0] + width * x[1], width * x[2]);
      EXPECT_TRUE(std::isfinite(element_.energy(pose)));
      EXPECT_TRUE(element_.force(pose).allFinite());
      EXPECT_TRUE(element_.stiffness(pose).allFinite());
      EXPECT_TRUE(element_.material_stiffness(pose).allFinite());
    }
  }
}

TEST_F(ShellElementTest, RefusesWhatIsNoShell) {
  EXPECT_THROW(ShellElement({X_[0], X_[1], Vec3(0.3 * X_[0] + 0.7 * X_[1])}, kSection), MeshError);
  EXPECT_THROW(ShellElement({X_[0], X_[0], X_[0]}, kSection), MeshError);
  for (const ShellSection& wrong :
       {ShellSection{0.0, 1.0, 0.3}, ShellSection{0.1, -1.0, 0.3}, ShellSection{0.1, 1.0, 0.51},
        ShellSection{0.1, 1.0, -1.0}, ShellSection{std::nan(""), 1.0, 0.3}}) {
    EXPECT_THROW(ShellElement(X_, wrong), ParameterError);
  }
}

TEST_F(ShellElementTest, HasTheMassOfItsVolume) {
  const double area = 0.5 * (X_[1] - X_[0]).cross(X_[2] - X_[0]).norm();
  EXPECT_NEAR(element_.area(), area, 1e-15);
  EXPECT_NEAR(3.0 * element_.nodal_mass(7.0), 7.0 * 0.2 * area, 1e-15);
  EXPECT_NEAR(element_.nodal_inertia(7.0), element_.nodal_mass(7.0) * area / 8.0, 1e-15);
  const ShellElement thick(X_, {5.0, 1.0, 0.3});
  EXPECT_NEAR(thick.nodal_inertia(7.0), thick.nodal_mass(7.0) * 25.0 / 12.0, 1e-13);
}

// Rotations must not shorten an explicit step. The fastest vibration with and without them.
TEST_F(ShellElementTest, RotationsVibrateNoFasterThanTranslations) {
  for (const double t : {0.01, 0.2, 2.0}) {
    const ShellElement element(X_, {t, 10.0, 0.3});
    ShellPose rest{X_, {Mat3::Identity(), Mat3::Identity(), Mat3::Identity()}};
    Mat18 K = element.stiffness(rest);
    Vec18 m;
    for (int k = 0; k < 6; ++k) {
      m.segment<3>(3 * k).setConstant(k % 2 == 0 ? element.nodal_mass(1.0) : element.nodal_inertia(1.0));
    }
    const Vec18 scale = m.cwiseSqrt().cwiseInverse();
    K = scale.asDiagonal() * K * scale.asDiagonal();
    const double both = test::eigenvalues(K)[17];
    Eigen::Matrix<double, 9, 9> translations;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) translations.block<3, 3>(3 * a, 3 * b) = K.block<3, 3>(6 * a, 6 * b);
    }
    const double alone = test::eigenvalues(translations)[8];
    RecordProperty("ratio", std::to_string(both / alone));
    EXPECT_LT(both, 3.0 * alone) << t;
  }
}

// A sheet pulled by 1e-6 (round-off 1e-10 of it), and one bent to a radius of 1e6.
TEST_F(ShellElementTest, KnowsItsStress) {
  const Mat3& axes = element_.axes();
  constexpr double kStrain = 1e-6;
  const double E = kSection.young / (1.0 - kSection.poisson * kSection.poisson);
  ShellPose pose{X_, {Mat3::Identity(), Mat3::Identity(), Mat3::Identity()}};
  const Mat3 F = Mat3::Identity() + kStrain * axes.col(0) * axes.col(0).transpose();
  for (Vec3& x : pose.positions) x = F * x;
  const double sx = E * kStrain;
  const double sy = kSection.poisson * sx;
  const double pulled = std::sqrt(sx * sx - sx * sy + sy * sy);
  EXPECT_NEAR(element_.stress(pose).middle, pulled, 1e-8 * pulled);
  EXPECT_NEAR(element_.stress(pose).top, pulled, 1e-8 * pulled);
  EXPECT_NEAR(element_.volume_ratio(pose) - 1.0, kStrain * (1.0 - 0.3 / 0.7), 1e-11);

  ShellPose bent{X_, {Mat3::Identity(), Mat3::Identity(), Mat3::Identity()}};
  for (std::size_t a = 0; a < 3; ++a) {
    const double along = element_.nodes()(0, static_cast<Eigen::Index>(a));
    bent.positions[a] += -0.5 * kStrain * along * along * axes.col(2);  // w = -kappa x^2 / 2
    bent.rotations[a] = test::turn(kStrain * along * axes.col(1));      // theta_y = -dw/dx
  }
  const double face = 0.5 * kSection.thickness * pulled;
  EXPECT_NEAR(element_.stress(bent).top, face, 1e-5 * face);
  EXPECT_NEAR(element_.stress(bent).bottom, face, 1e-5 * face);
  EXPECT_LT(element_.stress(bent).middle, 1e-5 * face);
}

}  // namespace
}  // namespace tissu
