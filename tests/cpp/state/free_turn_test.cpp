#include "tissu/state/free_turn.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "../base/random.h"

namespace tissu {
namespace {

/// A slender frame: it turns ten times as easily about one axis as about the others.
Frame slender() {
  Mat3 inertia = Vec3(1e-9, 1e-8, 1.2e-8).asDiagonal();
  const Mat3 R = turn_by(Vec3(0.3, -0.7, 1.1)).toRotationMatrix();
  inertia = R * inertia * R.transpose();
  return {0, 1, 1e-3, inertia};
}

double energy(const Frame& frame, const Quaternion& rotation, const Vec3& momentum) {
  return 0.5 * momentum.dot(spatial_inertia(frame, rotation).inverse() * momentum);
}

Vec3 spin_of(const Frame& frame, const Quaternion& rotation, const Vec3& momentum) {
  return spatial_inertia(frame, rotation).inverse() * momentum;
}

TEST(FreeTurn, IsTheSameInTheAxesOfTheFrame) {
  const Frame frame = slender();
  test::Random random(3);
  for (const double angle : {1e-4, 1e-2, 0.3, 3.0}) {
    for (int i = 0; i < 50; ++i) {
      const Quaternion rotation = turn_by(random.vector(2.0));
      const Vec3 omega = angle * random.vector(1.0);
      const Quaternion one = free_turn(frame, rotation, omega, 1.0);
      const Quaternion other = short_free_turn(frame, rotation, omega, 1.0);
      // The iterations end at 1e-14 and at 1e-9 of the turn; coordinates are exact to 1e-16.
      EXPECT_LE((one.coeffs() - other.coeffs()).norm(), 1e-8 * angle + 1e-15);
    }
  }
}

/// The midpoint rule is symmetric, so that a turn is taken back by the turn of the opposite spin.
TEST(FreeTurn, IsTakenBack) {
  const Frame frame = slender();
  test::Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Quaternion rotation = turn_by(random.vector(2.0));
    const Vec3 omega = random.vector(0.02);  // short enough to be one turn, not in halves
    const Quaternion end = short_free_turn(frame, rotation, omega, 1.0);
    const Quaternion back = short_free_turn(frame, end, -spin_after(frame, rotation, omega, end), 1.0);
    EXPECT_LE(back.angularDistance(rotation), 3e-9);
  }
}

/// exp(h omega) instead multiplies the energy by eight in as many steps.
TEST(FreeTurn, BoundsTheEnergy) {
  const Frame frame = slender();
  Quaternion rotation = Quaternion::Identity();
  const Vec3 momentum = spatial_inertia(frame, rotation) * Vec3(20.0, 5.0, 20.0);
  const double start = energy(frame, rotation, momentum);
  for (int n = 0; n < 20000; ++n) {
    rotation = short_free_turn(frame, rotation, spin_of(frame, rotation, momentum), 1e-3);
    // (h omega)^2 is 8e-4, times at most the ratio of the inertias, 12.
    ASSERT_NEAR(energy(frame, rotation, momentum), start, 0.01 * start);
  }
}

TEST(FreeTurn, IsFoundFromWhereItLeads) {
  const Frame frame = slender();
  test::Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Quaternion rotation = turn_by(random.vector(2.0));
    const Vec3 omega = random.vector(0.2);
    const double h = 0.5;
    const Quaternion end = short_free_turn(frame, rotation, omega, h);
    const Vec3 turn = nearest_turn(end * rotation.conjugate(), h * omega);
    // 1e-9 of the turn, times the ratio of the inertias.
    EXPECT_LE((spin_of_free_turn(frame, rotation, turn, h) - omega).norm(), 3e-8 * omega.norm());
  }
}

TEST(FreeTurn, HasTheInertiaOfItsEnd) {
  const Frame frame = slender();
  test::Random random(6);
  for (int i = 0; i < 50; ++i) {
    const Quaternion rotation = turn_by(random.vector(2.0));
    const Vec3 omega = random.vector(0.3);
    const Vec3 w = spin_at_end(frame, rotation, omega, 0.5);
    const Quaternion end = turn_by(0.5 * w) * rotation;
    EXPECT_LE((spin_after(frame, rotation, omega, end) - w).norm(), 1e-9 * omega.norm());
  }
}

}  // namespace
}  // namespace tissu
