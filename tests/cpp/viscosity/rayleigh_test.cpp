#include "tissu/viscosity/rayleigh.h"

#include <gtest/gtest.h>

#include "../force/room.h"
#include "../force/verbs.h"
#include "../world/sample_worlds.h"
#include "tissu/model/fem/elastic.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::product_of;
using test::relative_difference;
using test::view;

constexpr double kAlpha = 0.7;
constexpr double kBeta = 0.3;

class RayleighTest : public testing::TestWithParam<const char*> {
 protected:
  RayleighTest() {
    elastic_.add_masses(masses_);
    std::vector<std::unique_ptr<ForceModel>> models;
    models.push_back(std::make_unique<Elastic>(block_, mesh_.positions, Isa::baseline, Threads(1)));
    rayleigh_ = std::make_unique<Rayleigh>(std::move(models), masses_, kAlpha, kBeta);
    pattern_ = test::bind_alone(*rayleigh_, mesh_.node_count());
    elastic_.bind(pattern_);
    state_.positions = mesh_.positions;
    for (double& x : state_.positions) x += random_.number(0.1);
    state_.velocities = random_.numbers(mesh_.positions.size());
  }
  /// M v, three numbers for each node
  Eigen::VectorXd momentum(ConstReals v) const {
    Eigen::VectorXd result = view(v);
    for (std::size_t i = 0; i < masses_.size(); ++i)
      result.segment<3>(3 * static_cast<std::int32_t>(i)) *= masses_[i];
    return result;
  }
  State faster(ConstReals p, double t) const {
    State state = state_;
    for (std::size_t i = 0; i < p.size(); ++i) state.velocities[i] += t * p[i];
    return state;
  }

  test::Random random_{31};
  Mesh mesh_ = test::distorted_box({2, 2, 1}, Split::six, 0.1);
  ElasticBlock block_ = test::elastic_block(mesh_.blocks[0], {.law = GetParam()});
  Elastic elastic_{block_, mesh_.positions, Isa::baseline, Threads(1)};
  std::vector<double> masses_ = std::vector<double>(static_cast<std::size_t>(mesh_.node_count()), 0.0);
  std::unique_ptr<Rayleigh> rayleigh_;
  Sparsity pattern_;
  State state_;
};

// Sums of the same numbers in another order: 1e-14 relative.
constexpr double kRoundOff = 1e-13;

TEST_P(RayleighTest, ForceIsElasticAndViscous) {
  const Eigen::VectorXd Kv = product_of(elastic_, state_, {1.0, 0.0}, state_.velocities);
  const Eigen::VectorXd expected =
      force_of(elastic_, state_) - kAlpha * momentum(state_.velocities) + kBeta * Kv;
  EXPECT_LT(relative_difference(force_of(*rayleigh_, state_), expected), kRoundOff);
  EXPECT_NEAR(rayleigh_->energy(state_, test::scratch()), elastic_.energy(state_, test::scratch()), 1e-14);
  EXPECT_EQ(rayleigh_->has_constant_stiffness(), std::string(GetParam()) == "hooke");
}

// The force is linear in v: differences are exact but for round-off, 1e-16 / 0.1.
TEST_P(RayleighTest, VelocityProductIsDerivativeInVelocity) {
  const std::vector<double> p = random_.numbers(mesh_.positions.size());
  const Eigen::VectorXd slope = derivative([&](double t) { return force_of(*rayleigh_, faster(p, t)); }, 0.1);
  const Eigen::VectorXd product = product_of(*rayleigh_, state_, {0.0, 1.0}, p);
  EXPECT_LT(relative_difference(product, slope), kRoundOff);
  const Eigen::VectorXd Kp = product_of(elastic_, state_, {1.0, 0.0}, p);
  EXPECT_LT(relative_difference(product, kBeta * Kp - kAlpha * momentum(p)), kRoundOff);
}

TEST_P(RayleighTest, PositionProductIsElastic) {
  const std::vector<double> p = random_.numbers(mesh_.positions.size());
  EXPECT_LT(relative_difference(product_of(*rayleigh_, state_, {1.0, 0.0}, p),
                                product_of(elastic_, state_, {1.0, 0.0}, p)),
            kRoundOff);
}

TEST_P(RayleighTest, MatrixTimesVectorIsProduct) {
  const std::vector<double> p = random_.numbers(mesh_.positions.size());
  for (const StiffnessScale scale : {StiffnessScale{1.0, 0.0}, {0.0, 1.0}, {-0.2, -0.5}}) {
    const Eigen::MatrixXd A = test::stiffness_of(*rayleigh_, state_, scale, pattern_);
    EXPECT_LT(relative_difference(A * view(p), product_of(*rayleigh_, state_, scale, p)), 1e-12);
    EXPECT_LT(relative_difference(A, A.transpose()), 1e-14);
  }
}

TEST_P(RayleighTest, DissipatesAtRest) {
  State state = state_;
  state.positions = mesh_.positions;
  EXPECT_LT(force_of(*rayleigh_, state).dot(view(state.velocities)), -0.1);
}

INSTANTIATE_TEST_SUITE_P(Laws, RayleighTest, testing::Values("hooke", "stvk"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tissu
