#include "tissu/viscosity/centroid_damping.h"

#include <numeric>

#include "tissu/model/fem/elastic.h"
#include "viscous_sample.h"

namespace tissu {
namespace {

using test::derivative;
using test::faster;
using test::force_of;
using test::product_of;
using test::relative_difference;
using test::view;

constexpr double kCoefficient = 3.0;  // [N s/m4]
constexpr double kRoundOff = 1e-13;   // some ten sums of numbers of size 1

class CentroidTest : public testing::TestWithParam<std::string> {
 protected:
  CentroidTest() { pattern_ = test::bind_alone(damping_, state_.blocks()); }

  test::Random random_{5};
  test::ViscousSample sample_ = test::viscous_sample(GetParam());
  const State& state_ = sample_.state;
  Elastic elastic_{sample_.block, sample_.positions, choose_isa(), Threads(1)};
  CentroidDamping damping_{{&elastic_}, kCoefficient, Threads(1)};
  Sparsity pattern_;
};

/// The paper's sentence: each node against the centroid, in proportion to the volume.
TEST_P(CentroidTest, IsTheFormula) {
  const auto n = static_cast<Eigen::Index>(state_.blocks());
  const Eigen::Map<const Eigen::Matrix3Xd> v(state_.velocities.data(), 3, n);
  const Eigen::Matrix3Xd expected =
      -kCoefficient * elastic_.volumes()[0] * (v.colwise() - v.rowwise().mean());
  const Eigen::VectorXd f = force_of(damping_, state_);
  EXPECT_LT(relative_difference(f, Eigen::Map<const Eigen::VectorXd>(expected.data(), 3 * n)), kRoundOff);
}

TEST_P(CentroidTest, ProductAndMatrixAreDerivativeInVelocity) {
  const std::vector<double> p = random_.numbers(sample_.positions.size());
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(damping_, faster(state_, p, t)); }, 0.1);
  const Eigen::VectorXd product = product_of(damping_, state_, {7.0, 1.0}, p);
  EXPECT_LT(relative_difference(product, slope), kRoundOff);
  const Eigen::MatrixXd D = test::stiffness_of(damping_, state_, {7.0, -2.0}, pattern_);
  EXPECT_LT(relative_difference(D * view(p), -2.0 * product), kRoundOff);
  EXPECT_EQ(D, D.transpose());
  EXPECT_TRUE(damping_.has_constant_stiffness());
}

TEST_P(CentroidTest, KeepsMomentumAndLetsTheBodyDrift) {
  const Eigen::VectorXd f = force_of(damping_, state_);
  EXPECT_LT(f.dot(view(state_.velocities)), -0.01);
  Vec3 sum = Vec3::Zero();
  for (std::int32_t i = 0; i < state_.blocks(); ++i) sum += f.segment<3>(3 * i);
  EXPECT_LT(sum.norm(), kRoundOff);
  EXPECT_EQ(force_of(damping_, test::rigidly_moving(state_, Vec3(1, 2, 3), Vec3::Zero())).norm(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Elements, CentroidTest, testing::ValuesIn(test::element_names(false)),
                         [](const auto& info) { return info.param; });

/// A turning body is braked, as chendeb2007's form has it: of a cell that turns with omega about its centroid
/// the power is -c V sum |omega x (x_a - mean)|^2.
TEST(Centroid, BrakesRotation) {
  const test::ViscousSample sample = test::viscous_sample("tetra");
  const Elastic elastic(sample.block, sample.positions, choose_isa(), Threads(1));
  const CentroidDamping damping({&elastic}, kCoefficient, Threads(1));
  const Vec3 spin(0.3, -0.5, 0.8);
  const State turning = test::rigidly_moving(sample.state, Vec3::Zero(), spin);
  const Eigen::Map<const Eigen::Matrix3Xd> x(sample.state.positions.data(), 3, 4);
  const Eigen::Matrix3Xd arms = x.colwise() - x.rowwise().mean();
  double squares = 0.0;
  for (int a = 0; a < 4; ++a) squares += spin.cross(Vec3(arms.col(a))).squaredNorm();
  const double power = force_of(damping, turning).dot(view(turning.velocities));
  EXPECT_NEAR(power, -kCoefficient * elastic.volumes()[0] * squares, 1e-14);
  EXPECT_LT(power, -0.1);
}

/// Two bodies' blocks in one array of nodes: the second begins where the first ends.
TEST(Centroid, KnowsItsOwnNodesOnly) {
  const Mesh mesh = test::distorted_box({2, 2, 1}, Split::six, 0.1);
  ElasticBlock block = test::elastic_block(mesh.blocks[0], {});
  std::vector<double> positions(30, 0.0);  // ten nodes of somebody else
  positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (std::int32_t& node : block.cells) node += 10;
  const Elastic elastic(block, positions, choose_isa(), Threads(1));
  CentroidDamping damping({&elastic}, kCoefficient, Threads(2));
  const auto rows = static_cast<std::int32_t>(positions.size() / 3);
  const Sparsity pattern = test::bind_alone(damping, rows);
  test::Random random(3);
  State state;
  state.positions = positions;
  state.velocities = random.numbers(positions.size());
  const Eigen::VectorXd f = force_of(damping, state);
  EXPECT_EQ(f.head(30).norm(), 0.0);
  const Eigen::MatrixXd D = test::stiffness_of(damping, state, {0.0, 1.0}, pattern);
  EXPECT_LT(relative_difference(D * view(state.velocities), f), kRoundOff);
}

}  // namespace
}  // namespace tissu
