#include "tissu/viscosity/kelvin_voigt.h"

#include "../base/eigenvalues.h"
#include "../force/room.h"
#include "viscous_sample.h"

namespace tissu {
namespace {

using test::derivative;
using test::faster;
using test::force_of;
using test::product_of;
using test::relative_difference;
using test::view;

constexpr Lame kViscosity{0.7, 0.4};  // zeta and eta [Pa s]
// Some hundred products of numbers of size 1.
constexpr double kRoundOff = 1e-12;

class KelvinVoigtTest : public testing::TestWithParam<std::string> {
 protected:
  KelvinVoigtTest() {
    pattern_ = test::bind_alone(viscous_, static_cast<std::int32_t>(sample_.positions.size() / 3));
  }
  static double size(const Eigen::VectorXd& v) { return v.cwiseAbs().maxCoeff(); }

  test::Random random_{5};
  test::ViscousSample sample_ = test::viscous_sample(GetParam());
  const State& state_ = sample_.state;
  KelvinVoigt viscous_{sample_.block, kViscosity, sample_.positions, choose_isa(), Threads(1)};
  Sparsity pattern_;
};

// The force is linear in v: differences leave round-off only.
TEST_P(KelvinVoigtTest, ProductAndMatrixAreDerivativeInVelocity) {
  const std::vector<double> p = random_.numbers(sample_.positions.size());
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(viscous_, faster(state_, p, t)); }, 0.1);
  const Eigen::VectorXd product = product_of(viscous_, state_, {0.0, 1.0}, p);
  EXPECT_GT(size(product), 0.01);
  EXPECT_LT(relative_difference(product, slope), kRoundOff);
  const Eigen::MatrixXd D = test::stiffness_of(viscous_, state_, {0.0, -0.5}, pattern_);
  EXPECT_LT(relative_difference(D * view(p), -0.5 * product), kRoundOff);
  EXPECT_LT(relative_difference(D, D.transpose()), kRoundOff);
  EXPECT_GT(test::eigenvalues(D).minCoeff(), -kRoundOff);
}

TEST_P(KelvinVoigtTest, HasNoPartInThePositions) {
  const std::vector<double> p = random_.numbers(sample_.positions.size());
  EXPECT_EQ(size(product_of(viscous_, state_, {1.0, 0.0}, p)), 0.0);
  EXPECT_EQ(test::stiffness_of(viscous_, state_, {1.0, 0.0}, pattern_).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(viscous_.energy(state_, test::scratch()), 0.0);
}

TEST_P(KelvinVoigtTest, TakesEnergyAndKeepsMomentum) {
  const Eigen::VectorXd f = force_of(viscous_, state_);
  EXPECT_LT(f.dot(view(state_.velocities)), -0.01);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < state_.blocks(); ++i) {
    sum += f.segment<3>(3 * i);
    moment += Vec3(block(ConstReals(state_.positions), i)).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum.norm(), kRoundOff * size(f) * 30);
  EXPECT_LT(moment.norm(), kRoundOff * size(f) * 30);
}

TEST_P(KelvinVoigtTest, LetsTheWholeBodyTurnAtAnySpin) {
  for (const double spin : {1.0, 1e3}) {
    const State turning = test::rigidly_moving(state_, Vec3(1, 2, 3), spin * Vec3(0.3, -0.5, 0.8));
    EXPECT_LT(size(force_of(viscous_, turning)), 1e-12 * spin);
  }
}

TEST_P(KelvinVoigtTest, EveryInstructionSetAgrees) {
  const Eigen::VectorXd f = force_of(viscous_, state_);
  for (const Isa isa : test::available_isas()) {
    const KelvinVoigt other(sample_.block, kViscosity, sample_.positions, isa, Threads(1));
    EXPECT_LT(relative_difference(force_of(other, state_), f), kRoundOff) << name(isa);
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, KelvinVoigtTest, testing::ValuesIn(test::element_names(false)),
                         [](const auto& info) { return info.param; });

/// x = F X with F = I + gamma e_x (x) e_y: P_xy = gamma' (eta (1 + 2 gamma^2) + zeta gamma^2), by hand.
TEST(KelvinVoigt, ShearFlow) {
  const Mesh mesh = test::distorted_box({3, 3, 3}, Split::six, 0.0);  // 27 m3, y from -0.2 to 2.8
  const KelvinVoigt viscous(test::elastic_block(mesh.blocks[0], {}), kViscosity, mesh.positions, choose_isa(),
                            Threads(1));
  const double rate = 0.9;
  for (const double gamma : {0.0, 0.6}) {
    State state;
    for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
      const Vec3 X = mesh.node(i);
      state.positions.insert(state.positions.end(), {X.x() + gamma * X.y(), X.y(), X.z()});
      state.velocities.insert(state.velocities.end(), {rate * X.y(), 0.0, 0.0});
    }
    const Eigen::VectorXd f = force_of(viscous, state);
    double top = 0.0;
    for (const std::int32_t node : test::nodes_at(mesh, 1, 2.8)) top += f[3 * node];
    const double squared = gamma * gamma;
    const double stress = rate * (kViscosity.mu * (1.0 + 2.0 * squared) + kViscosity.lambda * squared);
    EXPECT_NEAR(top, -9.0 * stress, 1e-12);
    for (const std::int32_t node : test::nodes_where(mesh, [](const Vec3& x) {
           return x.y() > -0.1 && x.y() < 2.7 && x.x() > 0.4 && x.x() < 3.2 && x.z() > 0.2 && x.z() < 3.0;
         })) {
      EXPECT_LT(f.segment<3>(3 * node).norm(), 1e-12);  // inside, the stress is even
    }
  }
}

double work_rate(const ElasticBlock& block, const std::vector<double>& X, const Mat3& rate) {
  const KelvinVoigt viscous(block, kViscosity, X, choose_isa(), Threads(1));
  State state;
  state.positions = X;
  state.velocities.resize(X.size());
  for (std::int32_t i = 0; i < state.blocks(); ++i) {
    tissu::block(Reals(state.velocities), i) = rate * tissu::block(ConstReals(X), i);
  }
  return -force_of(viscous, state).dot(view(state.velocities));
}

/// Along a line the viscosity is that of traction with free sides, in a sheet that of plane stress.
TEST(KelvinVoigt, ThinPiecesAreFreeAcross) {
  const double eta = kViscosity.mu;
  const double zeta = kViscosity.lambda;
  const double traction = eta * (3.0 * zeta + 2.0 * eta) / (zeta + eta);
  ElasticBlock block;
  block.body = "body";
  block.parameters = {{"young", {3.0}}, {"poisson", {0.3}}};
  block.density = {1.0};
  block.element = "line";
  block.cells = {0, 1};
  block.cross_section = {0.2};
  const double e = 0.3;
  EXPECT_NEAR(work_rate(block, {0, 0, 0, 2, 0, 0}, Vec3(e, 7, 7).asDiagonal()), 0.4 * traction * e * e,
              1e-14);
  block.element = "triangle";
  block.cells = {0, 1, 2};
  const std::vector<double> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  // Free in y too: e_y = -nu e with nu = zeta / (2 (zeta + eta)) leaves the traction of a line.
  const double across = -zeta / (2.0 * (zeta + eta)) * e;
  EXPECT_NEAR(work_rate(block, corners, Vec3(e, across, 7).asDiagonal()), 0.1 * traction * e * e, 1e-14);
  block.plane = Plane::strain;
  EXPECT_NEAR(work_rate(block, corners, Vec3(e, 0, 7).asDiagonal()), 0.1 * (2.0 * eta + zeta) * e * e, 1e-14);
}

}  // namespace
}  // namespace tissu
