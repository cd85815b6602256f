#include "tissu/force/links.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../world/sample_worlds.h"
#include "room.h"
#include "verbs.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::product_of;
using test::view;

/// Two nodes (0, 1) and two frames (blocks 2, 3 and 4, 5).
class LinksTest : public testing::Test {
 protected:
  LinksTest() {
    frames_ = {{2, 3, 1.0, Mat3::Identity()}, {4, 5, 1.0, Mat3::Identity()}};
    state_.positions = random_.numbers(18);
    for (const std::size_t rotation : {9U, 15U}) {
      for (std::size_t k = 0; k < 3; ++k) state_.positions[rotation + k] = 0.0;
    }
    state_.velocities.assign(18, 0.0);
    state_.rotations = {random_.rotation(), random_.rotation()};
    MemoryPlaces places;
    links_.claim_memory(places);
    state_.memory = places.at_rest();
  }
  Vec3 position(const LinkPoint& p) const {
    const Vec3 origin = block(ConstReals(state_.positions), p.block);
    if (p.frame < 0) return origin;
    return origin + state_.rotations[static_cast<std::size_t>(p.frame)] * p.place;
  }
  State moved_by(ConstReals p, double t) const {
    State to = state_;
    move(state_, frames_, p, t, to);
    return to;
  }
  LinkTable table() { return LinkTable(state_.memory[0]); }
  Eigen::MatrixXd stiffness(const Links& links) const {
    return test::stiffness_of(links, state_, {1.0, 0.0}, SparsityBuilder(6).build());
  }
  static LinkPoint on_frame(std::int32_t frame, const Vec3& place) { return {2 + 2 * frame, frame, place}; }

  test::Random random_{41};
  Links links_;
  std::vector<Frame> frames_;
  State state_;
};

TEST_F(LinksTest, PullsNodesTogether) {
  EXPECT_EQ(table().add({0}, {1}, 5.0), 0);
  EXPECT_EQ(table().size(), 1U);
  const Vec3 expected = 5.0 * (position({1}) - position({0}));
  const Eigen::VectorXd f = force_of(links_, state_);
  EXPECT_LT((f.segment<3>(0) - expected).norm(), 1e-15);
  EXPECT_LT((f.segment<3>(3) + expected).norm(), 1e-15);
  EXPECT_EQ(f.tail(12).norm(), 0.0);
  EXPECT_NEAR(links_.energy(state_, test::scratch()), 0.5 * expected.squaredNorm() / 5.0, 1e-14);
}

// Rotations are not polynomials: the differences err by h^4 / 30 of the fifth derivative (of size 30 here),
// 1e-12 at h = 1e-3, and by round-off, 1e-16 x energy (20) / h.
TEST_F(LinksTest, ForceIsMinusGradientOfEnergy) {
  table().add(on_frame(0, {0.3, -0.2, 0.5}), on_frame(1, {0.1, 0.4, -0.6}), 3.0);
  table().add({0}, on_frame(1, {-0.5, 0.2, 0.1}), 2.0);
  table().add(on_frame(0, {0.2, 0.2, 0.2}), {1}, 4.0);
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> p = random_.numbers(18);
    const double slope =
        derivative([&](double t) { return links_.energy(moved_by(p, t), test::scratch()); }, 1e-3);
    EXPECT_NEAR(force_of(links_, state_).dot(view(p)), -slope, 1e-10);
  }
}

/// As for grabs: symmetric, so without half of theta x moment.
TEST_F(LinksTest, ProductIsTheSymmetricDerivative) {
  table().add(on_frame(0, {0.3, -0.2, 0.5}), on_frame(1, {0.1, 0.4, -0.6}), 3.0);
  table().add({1}, on_frame(0, {-0.5, 0.2, 0.1}), 2.0);
  table().add(on_frame(1, {0.2, 0.2, 0.2}), {1}, 4.0);
  const Eigen::VectorXd f = force_of(links_, state_);
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> p = random_.numbers(18);
    Eigen::VectorXd slope = derivative([&](double t) { return force_of(links_, moved_by(p, t)); }, 1e-3);
    for (const std::int32_t rotation : {3, 5}) {
      const Vec3 moment = f.segment<3>(3 * rotation);
      EXPECT_GT(moment.norm(), 0.1);
      slope.segment<3>(3 * rotation) -= 0.5 * block(ConstReals(p), rotation).cross(moment);
    }
    EXPECT_LT((product_of(links_, state_, {1.0, 0.0}, p) - slope).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(LinksTest, ProductIsDerivativeBetweenNodesAtAnyLength) {
  table().add({0}, {1}, 5.0);
  const std::vector<double> p = random_.numbers(18);
  const Eigen::VectorXd slope = derivative([&](double t) { return force_of(links_, moved_by(p, t)); }, 0.1);
  EXPECT_LT((product_of(links_, state_, {1.0, 0.0}, p) - slope).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_F(LinksTest, MatrixIsTheProductAsFarAsItIsDefinite) {
  const LinkPoint a = on_frame(0, {0.3, -0.2, 0.5});
  const LinkPoint b = on_frame(1, {0.1, 0.4, -0.6});
  table().add(a, b, 3.0);
  const Vec3 force = 3.0 * (position(b) - position(a));
  table().add({0}, {1}, 2.0);
  const Eigen::MatrixXd K = stiffness(links_);
  Eigen::MatrixXd product = test::products_of(links_, state_, {1.0, 0.0});
  product.block<3, 3>(9, 9) -= test::driven(state_.rotations[0] * a.place, force);
  product.block<3, 3>(15, 15) -= test::driven(state_.rotations[1] * b.place, -force);
  EXPECT_LT((K - product).norm(), 1e-13);
  EXPECT_LT((K - K.transpose()).norm(), 1e-14);
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> q = random_.numbers(18);
    EXPECT_LE(view(q).dot(K * view(q)), 1e-14);
  }
}

/// A link inside the body feels no rigid motion of both ends together: no force on the sum, no moment.
TEST_F(LinksTest, ForcesBalance) {
  table().add(on_frame(0, {0.3, -0.2, 0.5}), on_frame(1, {0.1, 0.4, -0.6}), 3.0);
  table().add({0}, on_frame(1, {-0.5, 0.2, 0.1}), 2.0);
  const Eigen::VectorXd f = force_of(links_, state_);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = f.segment<3>(9) + f.segment<3>(15);
  for (const std::int32_t i : {0, 1, 2, 4}) {
    sum += f.segment<3>(3 * i);
    moment += block(ConstReals(state_.positions), i).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
  EXPECT_GT(f.norm(), 0.1);
}

TEST_F(LinksTest, MayBeCleared) {
  table().add({0}, {1}, 5.0);
  table().clear();
  EXPECT_EQ(table().size(), 0U);
  EXPECT_EQ(force_of(links_, state_).norm(), 0.0);
}

TEST_F(LinksTest, RefusesStiffnessThatIsNotPositive) {
  EXPECT_THROW(table().add({0}, {1}, 0.0), ParameterError);
  EXPECT_THROW(table().add({0}, {1}, -1.0), ParameterError);
  EXPECT_THROW(table().add({0}, {1}, std::numeric_limits<double>::quiet_NaN()), ParameterError);
}

}  // namespace
}  // namespace tissu
