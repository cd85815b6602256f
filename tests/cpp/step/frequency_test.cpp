#include "tissu/step/frequency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../assembly/dense.h"
#include "../base/eigenvalues.h"
#include "../world/sample_worlds.h"
#include "tissu/law/law.h"
#include "tissu/step/system.h"

namespace tissu {
namespace {

/// Node 1 of the unit tetrahedron moves along x: k = (lambda + 2 mu) V, V = 1/6, m = rho V / 4.
TEST(LargestFrequency, IsThatOfOneMassOnOneSpring) {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
  WorldDescription description;
  description.bodies = {test::body_of(mesh, {"stvk", 50.0, 0.3, 2.0})};
  description.fixed = {test::fixed({0, 2, 3}), test::fixed({1}, 6)};
  const World world(description);
  const Lame c = lame(50.0, 0.3);
  const double omega = std::sqrt((c.lambda + 2.0 * c.mu) / (2.0 / 4.0));
  EXPECT_NEAR(largest_frequency(world, world.rest_state()), omega, 1e-13 * omega);
}

/// The largest eigenvalue of the dense M^-1/2 K M^-1/2.
double dense_frequency(const World& world, const State& state) {
  Profile profile;
  System system(world, nullptr, profile);
  system.assemble(state, 0.0, {-1.0, 0.0});
  Eigen::MatrixXd K = test::dense(system.matrix());
  for (std::int32_t i = 0; i < world.blocks(); ++i) {
    const double root = std::sqrt(world.mass().nodal()[static_cast<std::size_t>(i)]);
    K.middleRows<3>(3 * i) /= root;
    K.middleCols<3>(3 * i) /= root;
    for (int axis = 0; axis < 3; ++axis) {  // rows of the identity are no stiffness
      if (system.matrix().is_given(i, axis)) K(3 * i + axis, 3 * i + axis) = 0.0;
    }
  }
  return std::sqrt(test::eigenvalues(K).maxCoeff());
}

class OfABox : public testing::TestWithParam<bool> {};

// Lanczos stops when the value changes by less than 1e-6 in a step; the error is then of that size.
TEST_P(OfABox, IsThatOfTheDenseMatrix) {
  const Mesh mesh = test::distorted_box({3, 2, 2}, GetParam() ? Split::six : Split::none, 0.1);
  WorldDescription description;
  description.bodies = {test::body_of(mesh)};
  description.fixed = {test::fixed({0, 1, 2, 3}), test::fixed({5}, 2)};
  const World world(description);
  State state = world.rest_state();
  double expected = dense_frequency(world, state);
  EXPECT_NEAR(largest_frequency(world, state), expected, 1e-5 * expected);
  test::Random random(3);
  for (double& x : state.positions) x += random.number(0.1);
  expected = dense_frequency(world, state);
  EXPECT_NEAR(largest_frequency(world, state), expected, 1e-5 * expected);
}

INSTANTIATE_TEST_SUITE_P(LargestFrequency, OfABox, testing::Bool());

/// A frame on a spring at a lever arm, which does not pull: k (1/m + a^2/I) for the motion across the arm.
TEST(LargestFrequency, KnowsFrames) {
  WorldDescription description;
  FrameDescription frame;
  frame.mass = 2.0;
  frame.inertia = 0.5 * Mat3::Identity();
  FrameDescription other = frame;
  other.mass = 1e12;  // as good as fixed
  other.inertia = 1e12 * Mat3::Identity();
  description.frames = {frame, other};
  description.links = true;
  const World world(description);
  State state = world.rest_state();
  test::links(world, state).add({0, 0, Vec3(0.3, 0.0, 0.0)}, {2, 1, Vec3(0.3, 0.0, 0.0)}, 7.0);
  const double omega = std::sqrt(7.0 * (1.0 / 2.0 + 0.3 * 0.3 / 0.5));
  EXPECT_NEAR(largest_frequency(world, state), omega, 1e-9 * omega);
}

TEST(LargestFrequency, IsZeroWithoutStiffness) {
  WorldDescription description;
  description.frames = {FrameDescription{}};
  const World world(description);
  EXPECT_EQ(largest_frequency(world, world.rest_state()), 0.0);
}

}  // namespace
}  // namespace tissu
