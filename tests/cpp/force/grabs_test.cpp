#include "tissu/force/grabs.h"

#include <gtest/gtest.h>

#include "../world/sample_worlds.h"
#include "room.h"
#include "verbs.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::product_of;
using test::view;

/// Three nodes (0, 1, 2) and a frame (blocks 3 and 4).
class GrabsTest : public testing::Test {
 protected:
  GrabsTest() {
    state_.positions = random_.numbers(15);
    std::fill(state_.positions.begin() + 12, state_.positions.end(), 0.0);
    state_.velocities.assign(15, 0.0);
    state_.rotations = {random_.rotation()};
    MemoryPlaces places;
    grabs_.claim_memory(places);
    state_.memory = places.at_rest();
  }
  State moved_by(ConstReals p, double t) const {
    State to = state_;
    move(state_, frames_, p, t, to);
    return to;
  }
  GrabTable table() { return GrabTable(state_.memory[0]); }
  void grab_all() {
    table().add(1, {{{1, 1.0}}}, Vec3(1, 2, 3), 5.0);
    table().add(2, {{{0, 0.2}, {1, 0.5}, {2, 0.3}}}, Vec3(-1, 0, 1), 3.0);
    table().add(3, on_frame_, Vec3(0, 1, 0), 2.0);
  }
  [[nodiscard]] Vec3 on_frame() const {
    return block(ConstReals(state_.positions), 3) + state_.rotations[0] * on_frame_.place;
  }

  test::Random random_{43};
  GrabPoint on_frame_{{{3, 1.0}}, 0, 4, Vec3(0.3, -0.2, 0.5)};
  std::vector<Frame> frames_ = {{3, 4, 1.0, Mat3::Identity()}};
  Grabs grabs_;
  State state_;
};

TEST_F(GrabsTest, PullsToItsTarget) {
  grab_all();
  EXPECT_EQ(table().size(), 3U);
  table().release(1);
  table().release(3);
  const ConstReals x(state_.positions);
  const Vec3 force = 3.0 * (Vec3(-1, 0, 1) - 0.2 * block(x, 0) - 0.5 * block(x, 1) - 0.3 * block(x, 2));
  const Eigen::VectorXd f = force_of(grabs_, state_);
  EXPECT_LT((f.segment<3>(0) - 0.2 * force).norm(), 1e-15);
  EXPECT_LT((f.segment<3>(3) - 0.5 * force).norm(), 1e-15);
  EXPECT_LT((f.segment<3>(6) - 0.3 * force).norm(), 1e-15);
  EXPECT_EQ(f.tail(6).norm(), 0.0);
  EXPECT_NEAR(grabs_.energy(state_, test::scratch()), 0.5 * force.squaredNorm() / 3.0, 1e-13);
  state_.load_factor = 0.25;
  EXPECT_LT((force_of(grabs_, state_) - 0.25 * f).norm(), 1e-15);
}

// As for links: the differences err by 1e-12 and by round-off of an energy of some 50 J over h = 1e-3.
TEST_F(GrabsTest, ForceIsMinusGradientOfEnergy) {
  grab_all();
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> p = random_.numbers(15);
    const double slope =
        derivative([&](double t) { return grabs_.energy(moved_by(p, t), test::scratch()); }, 1e-3);
    EXPECT_NEAR(force_of(grabs_, state_).dot(view(p)), -slope, 1e-9);
  }
}

/// Stiffnesses of rotations are symmetric: of the moment's derivative half of theta x moment is left out,
/// which is all that is.
TEST_F(GrabsTest, ProductIsTheSymmetricDerivative) {
  grab_all();
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> p = random_.numbers(15);
    Eigen::VectorXd slope = derivative([&](double t) { return force_of(grabs_, moved_by(p, t)); }, 1e-3);
    const Vec3 moment = force_of(grabs_, state_).segment<3>(12);
    EXPECT_GT(moment.norm(), 0.1);
    slope.segment<3>(12) -= 0.5 * block(ConstReals(p), 4).cross(moment);
    EXPECT_LT((product_of(grabs_, state_, {1.0, 0.0}, p) - slope).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(GrabsTest, CouplingsAreTheProductAsFarAsItIsDefinite) {
  grab_all();
  state_.load_factor = 0.75;
  const Eigen::MatrixXd K = test::stiffness_of(grabs_, state_, {1.0, 0.0}, SparsityBuilder(5).build());
  EXPECT_LT((K - K.transpose()).norm(), 1e-14);
  Eigen::MatrixXd product = test::products_of(grabs_, state_, {1.0, 0.0});
  const Vec3 arm = state_.rotations[0] * on_frame_.place;
  product.bottomRightCorner<3, 3>() -= test::driven(arm, 0.75 * 2.0 * (Vec3(0, 1, 0) - on_frame()));
  EXPECT_LT((K - product).norm(), 1e-13);
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> p = random_.numbers(15);
    EXPECT_LE(view(p).dot(K * view(p)), 1e-14);
  }
}

TEST_F(GrabsTest, RefusesWhatThereIsNot) {
  grab_all();
  EXPECT_THROW(table().add(1, {{{0, 1.0}}}, Vec3::Zero(), 1.0), ParameterError);
  EXPECT_THROW(table().add(4, {{{0, 1.0}}}, Vec3::Zero(), 0.0), ParameterError);
  EXPECT_THROW(table().move(7, Vec3::Zero()), ParameterError);
  table().release(2);
  EXPECT_THROW(table().release(2), ParameterError);
  EXPECT_NO_THROW(grabs_.check_memory(state_));
}

TEST_F(GrabsTest, RefusesAMemoryThatItCannotRead) {
  grab_all();
  const std::vector<double> good = state_.memory[0];
  const auto refuses = [&](std::size_t number, double value) {
    state_.memory[0] = good;
    state_.memory[0][number] = value;
    EXPECT_THROW(grabs_.check_memory(state_), ParameterError) << number << " " << value;
  };
  refuses(1, 0.0);
  refuses(5, 1.0);   // there is one frame, number 0
  refuses(6, 2.0);   // a rotation without a frame
  refuses(10, 0.0);  // no parts
  refuses(10, 1e6);  // more parts than numbers
  refuses(11, 5.0);  // there are blocks 0 to 4
  refuses(11, 0.5);
  state_.memory[0] = good;
  state_.memory[0].pop_back();
  EXPECT_THROW(grabs_.check_memory(state_), ParameterError);
}

}  // namespace
}  // namespace tissu
