#include "tissu/viscosity/prony.h"

#include <cmath>
#include <numbers>

#include "../force/room.h"
#include "viscous_sample.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::moved;
using test::product_of;
using test::relative_difference;
using test::view;

const std::vector<PronyBranch> kBranches = {{0.8, 0.3}, {0.5, 2.0}};
constexpr double kRoundOff = 1e-12;  // some hundred products of numbers of size 1

Prony made(const test::ViscousSample& sample, Isa isa = choose_isa(), int threads = 1) {
  return {sample.block, kBranches, sample.positions, isa, Threads(threads)};
}

/// The state with a memory of some past.
State with_memory(const Prony& prony, State state) {
  test::Random random(23);
  state.memory.assign(1, std::vector<double>(prony.memory_size()));
  for (double& m : state.memory[0]) m = random.number(0.1);
  return state;
}

class PronyTest : public testing::TestWithParam<std::string> {
 protected:
  PronyTest() {
    pattern_ = test::bind_alone(prony_, state_.blocks());
    state_.time = 0.4;
    state_.memory_time = 0.25;
  }
  test::Random random_{5};
  test::ViscousSample sample_ = test::viscous_sample(GetParam());
  Prony prony_ = made(sample_);
  State state_ = with_memory(prony_, sample_.state);
  Sparsity pattern_;
};

// The energy is a polynomial of degree four in the positions: differences leave round-off, 1e-16 / 0.01.
TEST_P(PronyTest, ForceAtOnceIsMinusGradientOfEnergy) {
  state_.time = state_.memory_time;
  const std::vector<double> p = random_.numbers(sample_.positions.size());
  const double slope =
      derivative([&](double t) { return prony_.energy(moved(state_, p, t), test::scratch()); }, 0.01);
  const double power = force_of(prony_, state_).dot(view(p));
  EXPECT_GT(std::abs(power), 1e-3);
  EXPECT_NEAR(power, -slope, 1e-11);
}

TEST_P(PronyTest, ProductAndMatrixAreDerivativeOfForce) {
  const std::vector<double> p = random_.numbers(sample_.positions.size());
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(prony_, moved(state_, p, t)); }, 0.01);
  const Eigen::VectorXd product = product_of(prony_, state_, {1.0, 3.0}, p);
  EXPECT_LT(relative_difference(product, slope), 1e-11);
  const Eigen::MatrixXd K = test::stiffness_of(prony_, state_, {-0.5, 3.0}, pattern_);
  EXPECT_LT(relative_difference(K * view(p), -0.5 * product), kRoundOff);
  EXPECT_LT(relative_difference(K, K.transpose()), kRoundOff);
}

/// q goes as its equation has it when the step is cut into any parts while E goes evenly.
TEST_P(PronyTest, TheTimeMayBeCutWhileTheStrainStands) {
  State whole = state_;
  whole.time += 0.5;
  prony_.remember(state_);  // E0 = E: from here on E stands
  state_.memory_time = state_.time;
  whole = state_;
  whole.time += 0.5;
  State parts = state_;
  for (int i = 0; i < 5; ++i) {
    parts.time += 0.1;
    prony_.remember(parts);
    parts.memory_time = parts.time;
  }
  const Eigen::VectorXd f = force_of(prony_, whole);
  EXPECT_LT(relative_difference(force_of(prony_, parts), f), kRoundOff);
  EXPECT_NEAR(prony_.energy(parts, test::scratch()), prony_.energy(whole, test::scratch()), 1e-13);
  EXPECT_LT(prony_.energy(whole, test::scratch()), prony_.energy(state_, test::scratch()));
  parts.time += 1000.0;
  EXPECT_LT(force_of(prony_, parts).norm(), 1e-14);  // long times leave nothing
}

TEST_P(PronyTest, ARotationTurnsTheForce) {
  const Mat3 R = random_.rotation().toRotationMatrix();
  State turned = state_;
  Eigen::VectorXd expected = force_of(prony_, state_);
  for (std::int32_t i = 0; i < state_.blocks(); ++i) {
    block(Reals(turned.positions), i) = R * block(ConstReals(state_.positions), i);
    expected.segment<3>(3 * i) = (R * expected.segment<3>(3 * i)).eval();
  }
  EXPECT_LT(relative_difference(force_of(prony_, turned), expected), kRoundOff);
}

TEST_P(PronyTest, EveryInstructionSetAgrees) {
  const Eigen::VectorXd f = force_of(prony_, state_);
  State next = state_;
  prony_.remember(next);
  for (const Isa isa : test::available_isas()) {
    const Prony other = made(sample_, isa);
    EXPECT_LT(relative_difference(force_of(other, state_), f), kRoundOff) << name(isa);
    EXPECT_NEAR(other.energy(state_, test::scratch()), prony_.energy(state_, test::scratch()), 1e-13)
        << name(isa);
    State mine = state_;
    other.remember(mine);
    EXPECT_LT((view(mine.memory[0]) - view(next.memory[0])).cwiseAbs().maxCoeff(), kRoundOff) << name(isa);
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, PronyTest, testing::ValuesIn(test::element_names(true)),
                         [](const auto& info) { return info.param; });

/// Storage and loss modulus of a standard linear solid under an oscillating shear, beside
///     G' = mu g (w tau)^2 / (1 + (w tau)^2),  G'' = mu g w tau / (1 + (w tau)^2).
/// The strain goes evenly between 400 points of a period: an error of (w h)^2 / 12 = 2e-5.
TEST(Prony, FrequencyResponse) {
  const test::ViscousSample sample = test::viscous_sample("hexahedron");
  const double mu = 3.0 / 2.6;
  const double amplitude = 1e-4;
  for (const double product : {0.1, 1.0, 10.0}) {
    const PronyBranch branch{0.8, 0.3};
    const Prony prony(sample.block, {branch}, sample.positions, choose_isa(), Threads(1));
    const double omega = product / branch.time;
    State state = sample.state;
    state.memory.assign(1, std::vector<double>(prony.memory_size(), 0.0));
    const int points = 400;
    const double h = 2.0 * std::numbers::pi / omega / points;
    double storage = 0.0;
    double loss = 0.0;
    const int before = product < 1.0 ? 1 : 8;  // periods until the start is forgotten
    double volume = 0.0;
    for (int i = 1; i <= (before + 1) * points; ++i) {
      state.time = h * i;
      const double phase = omega * state.time;
      Eigen::VectorXd shape(state.positions.size());
      for (std::int32_t n = 0; n < state.blocks(); ++n) {
        const Vec3 X = block(ConstReals(sample.positions), n);
        shape.segment<3>(3 * n) = Vec3(X.y(), 0, 0);
        block(Reals(state.positions), n) = X + amplitude * std::sin(phase) * Vec3(X.y(), 0, 0);
      }
      if (i > before * points) {
        const double stress = -force_of(prony, state).dot(shape);  // V sigma_xy
        storage += 2.0 / points * stress * std::sin(phase) / amplitude;
        loss += 2.0 / points * stress * std::cos(phase) / amplitude;
      }
      prony.remember(state);
      state.memory_time = state.time;
    }
    volume = prony.volumes()[0];
    const double share = branch.weight * product / (1.0 + product * product);
    EXPECT_NEAR(storage, volume * mu * share * product, 1e-4 * volume * mu) << product;
    EXPECT_NEAR(loss, volume * mu * share, 1e-4 * volume * mu) << product;
  }
}

TEST(Prony, SameBitsForAnyNumberOfThreads) {
  const Mesh mesh = test::distorted_box({9, 8, 8}, Split::six, 0.1);
  test::ViscousSample sample;
  sample.block = test::elastic_block(mesh.blocks[0], {});
  for (std::int32_t i = 0; i < mesh.cell_count(); ++i)  // differs from cell to cell
    sample.block.parameters["young"].resize(static_cast<std::size_t>(i) + 1, 3.0 + 0.01 * i);
  sample.positions = mesh.positions;
  test::Random random(3);
  sample.state.positions = mesh.positions;
  for (double& x : sample.state.positions) x += random.number(0.1);
  const Prony one = made(sample);
  const State state = with_memory(one, sample.state);
  for (const int threads : {2, 3, 4}) {
    EXPECT_EQ(force_of(made(sample, choose_isa(), threads), state), force_of(one, state));
  }
}

/// A branch's moduli are those of the law at small strain, whatever the law.
TEST(Prony, MeasuresBranchesByTheLaw) {
  test::ViscousSample sample = test::viscous_sample("hexahedron");
  const Prony stvk = made(sample);
  const State state = with_memory(stvk, sample.state);
  sample.block.law = "neo_hooke";
  EXPECT_EQ(force_of(made(sample), state), force_of(stvk, state));
  sample.block.parameters["young"] = {6.0};
  EXPECT_LT(relative_difference(force_of(made(sample), state), 2.0 * force_of(stvk, state)), kRoundOff);
}

TEST(Prony, RefusesSheets) {
  try {
    (void)made(test::viscous_sample("triangle"));
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(),
                 "body \"body\" asks for a Prony series on cells of type triangle; only cells with a volume "
                 "take it, so take another viscosity.");
  }
}

}  // namespace
}  // namespace tissu
