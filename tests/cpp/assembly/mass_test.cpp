#include "tissu/assembly/mass.h"

#include <gtest/gtest.h>

#include "../base/differences.h"
#include "../base/random.h"
#include "dense.h"

namespace tissu {
namespace {

/// One node of 2 kg and one frame of 3 kg.
class MassTest : public testing::Test {
 protected:
  MassTest() {
    Frame frame{1, 2, 3.0, Mat3::Zero()};
    frame.inertia << 2.0, 0.1, 0.2, 0.1, 3.0, 0.3, 0.2, 0.3, 4.0;
    mass_ = Mass({2.0, 3.0, 0.0}, {frame});
    state_.positions = random_.numbers(9);
    state_.velocities = random_.numbers(9);
    state_.rotations = {random_.rotation()};
    const Mat3 R = state_.rotations[0].toRotationMatrix();
    spatial_ = R * frame.inertia * R.transpose();
  }
  Eigen::VectorXd expected(ConstReals v) const {
    Eigen::VectorXd Mv = test::view(v);
    Mv.segment<3>(0) *= 2.0;
    Mv.segment<3>(3) *= 3.0;
    Mv.segment<3>(6) = (spatial_ * Mv.segment<3>(6)).eval();
    return Mv;
  }
  test::Random random_{61};
  Mass mass_;
  State state_;
  Mat3 spatial_;
};

constexpr double kRoundOff = 1e-14;  // of numbers of size 1 to 10

TEST_F(MassTest, SumsNodesAndFrames) { EXPECT_DOUBLE_EQ(mass_.total(), 5.0); }

TEST_F(MassTest, ProductTurnsTheInertiaIntoSpace) {
  const std::vector<double> v = random_.numbers(9);
  std::vector<double> out(9, 1.0);
  mass_.add_product(state_, -2.0, v, out);
  EXPECT_LT((test::view(out) - (Eigen::VectorXd::Ones(9) - 2.0 * expected(v))).norm(), kRoundOff);
}

TEST_F(MassTest, MatrixIsProduct) {
  const Sparsity pattern = SparsityBuilder(3).build();
  BlockMatrix matrix(pattern, Isa::baseline, Threads(1));
  matrix.clear();
  mass_.add_to(matrix, state_, 0.5);
  mass_.add_to(matrix, state_, 0.5);
  const std::vector<double> v = random_.numbers(9);
  EXPECT_LT((test::dense(matrix) * test::view(v) - expected(v)).norm(), kRoundOff);
}

TEST_F(MassTest, KineticEnergy) {
  EXPECT_NEAR(mass_.kinetic_energy(state_),
              0.5 * test::view(state_.velocities).dot(expected(state_.velocities)), kRoundOff);
}

}  // namespace
}  // namespace tissu
