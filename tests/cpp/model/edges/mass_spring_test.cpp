#include "tissu/model/edges/mass_spring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "../../force/room.h"
#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/model/models.h"
#include "tissu/viscosity/spring_dampers.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::moved;
using test::product_of;
using test::relative_difference;
using test::view;

constexpr double kYoung = 3.0;
constexpr double kRoundOff = 1e-12;  // some ten products of numbers of size 1 at each of 36 nodes

/// A distorted box with parameters that differ from cell to cell.
class MassSpringTest : public testing::TestWithParam<Isa> {
 protected:
  MassSpringTest() {
    pattern_ = test::bind_alone(springs_, mesh_.node_count());
    state_.positions = mesh_.positions;
    for (double& x : state_.positions) x += random_.number(0.15);
    state_.velocities = random_.numbers(state_.positions.size());
  }
  static ElasticBlock varied(ElasticBlock block) {
    test::Random random(12);
    const std::size_t cells = block.cells.size() / 4;
    block.parameters["young"].resize(cells);
    block.density.resize(cells);
    for (std::size_t i = 0; i < cells; ++i) {
      block.parameters["young"][i] = kYoung + random.number();
      block.density[i] = 2.0 + random.number();
    }
    return block;
  }
  MassSpring made(Isa isa, int threads) const { return {block_, mesh_.positions, isa, Threads(threads)}; }

  test::Random random_{9};
  Mesh mesh_ = test::distorted_box({3, 2, 2}, Split::six, 0.12);
  ElasticBlock block_ = varied(test::elastic_block(mesh_.blocks[0], {.young = kYoung}));
  MassSpring springs_{block_, mesh_.positions, GetParam(), Threads(1)};
  Sparsity pattern_;
  State state_;
};

// Differences of fourth order of a function that is smooth at a step of 0.002: 1e-10 and round-off.
TEST_P(MassSpringTest, ForceIsMinusGradientOfEnergy) {
  const std::vector<double> p = random_.numbers(state_.positions.size());
  const double slope =
      derivative([&](double t) { return springs_.energy(moved(state_, p, t), test::scratch()); }, 0.002);
  EXPECT_NEAR(force_of(springs_, state_).dot(view(p)), -slope, 1e-8);
  EXPECT_GT(std::abs(slope), 0.1);
}

TEST_P(MassSpringTest, ProductAndMatrixAreDerivativeOfForce) {
  const std::vector<double> p = random_.numbers(state_.positions.size());
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(springs_, moved(state_, p, t)); }, 0.002);
  const Eigen::VectorXd product = product_of(springs_, state_, {1.0, 5.0}, p);
  EXPECT_LT(relative_difference(product, slope), 1e-8);
  const Eigen::MatrixXd K = test::stiffness_of(springs_, state_, {-0.5, 5.0}, pattern_, GetParam());
  EXPECT_LT(relative_difference(K * view(p), -0.5 * product), kRoundOff);
  EXPECT_LT(relative_difference(K, K.transpose()), 1e-14);
}

TEST_P(MassSpringTest, RestAndMotionsOfTheWholeAreFree) {
  State rest = state_;
  rest.positions = mesh_.positions;
  EXPECT_LT(force_of(springs_, rest).norm(), 1e-13);
  EXPECT_LT(springs_.energy(rest, test::scratch()), 1e-28);
  const Mat3 R = random_.rotation().toRotationMatrix();
  for (std::int32_t i = 0; i < rest.blocks(); ++i) {
    block(Reals(rest.positions), i) = R * mesh_.node(i) + Vec3(4, -7, 2);
  }
  EXPECT_LT(force_of(springs_, rest).norm(), kRoundOff);
}

TEST_P(MassSpringTest, ForcesHaveNoSumAndNoMoment) {
  const Eigen::VectorXd f = force_of(springs_, state_);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < state_.blocks(); ++i) {
    sum += f.segment<3>(3 * i);
    moment += Vec3(block(ConstReals(state_.positions), i)).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_GT(f.norm(), 0.1);
  EXPECT_LT(sum.norm(), kRoundOff);
  EXPECT_LT(moment.norm(), kRoundOff);
}

TEST_P(MassSpringTest, EveryInstructionSetAndNumberOfThreadsAgrees) {
  const Eigen::VectorXd f = force_of(springs_, state_);
  EXPECT_LT(relative_difference(force_of(made(Isa::baseline, 1), state_), f), kRoundOff);
  for (const int threads : {2, 3, 4}) EXPECT_EQ(force_of(made(GetParam(), threads), state_), f);
}

TEST_P(MassSpringTest, CellsShareTheEnergy) {
  const CellFields fields = springs_.fields(state_);
  EXPECT_TRUE(fields.von_mises.empty());
  double sum = 0.0;
  double volume = 0.0;
  for (std::size_t e = 0; e < springs_.volumes().size(); ++e) {
    sum += fields.energy_density[e] * springs_.volumes()[e];
    volume += fields.volume_ratio[e] * springs_.volumes()[e];
  }
  EXPECT_NEAR(sum, springs_.energy(state_, test::scratch()), 1e-13);
  State doubled = state_;
  for (double& x : doubled.positions) x *= 2.0;
  double larger = 0.0;
  for (std::size_t e = 0; e < springs_.volumes().size(); ++e) {
    larger += springs_.fields(doubled).volume_ratio[e] * springs_.volumes()[e];
  }
  EXPECT_NEAR(larger, 8.0 * volume, 1e-11);
}

/// Dampers: a product with the velocities along the springs only.
TEST_P(MassSpringTest, DampersTakeEnergyAndLetTheBodyTurn) {
  SpringDampers dampers(springs_, {0.7, 0.4});
  const Eigen::VectorXd f = force_of(dampers, state_);
  EXPECT_LT(f.dot(view(state_.velocities)), -0.1);
  const Eigen::MatrixXd D = test::stiffness_of(dampers, state_, {3.0, 1.0}, pattern_, GetParam());
  EXPECT_LT(relative_difference(D * view(state_.velocities), f), kRoundOff);
  EXPECT_LT(relative_difference(D, D.transpose()), 1e-14);
  const std::vector<double> p = random_.numbers(state_.positions.size());
  EXPECT_LT(relative_difference(product_of(dampers, state_, {3.0, 1.0}, p), D * view(p)), kRoundOff);
  State turning = state_;
  for (std::int32_t i = 0; i < state_.blocks(); ++i) {
    block(Reals(turning.velocities), i) =
        Vec3(1, 2, 3) + Vec3(30, -50, 80).cross(Vec3(block(ConstReals(state_.positions), i)));
  }
  EXPECT_LT(force_of(dampers, turning).norm(), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Sets, MassSpringTest, testing::ValuesIn(test::available_isas()),
                         [](const auto& info) { return std::string(name(info.param)); });

/// One tetrahedron by hand: edges of 1 have k = E V, those of sqrt 2 half of it; a pull along x of node 1.
TEST(MassSpring, OneTetrahedronByHand) {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
  const MassSpring springs(test::elastic_block(mesh.blocks[0], {.young = kYoung, .density = 6.0}),
                           mesh.positions, choose_isa(), Threads(1));
  State state;
  state.positions = mesh.positions;
  const double u = 0.1;
  state.positions[3] += u;
  const double V = 1.0 / 6.0;
  const double slanted = std::sqrt(1.0 + (1.0 + u) * (1.0 + u));
  const double pull = kYoung * V / 2.0 * (1.0 - std::numbers::sqrt2 / slanted) * (1.0 + u);
  const Eigen::VectorXd f = force_of(springs, state);
  EXPECT_NEAR(f[3], -kYoung * V * u - 2.0 * pull, 1e-15);
  EXPECT_NEAR(f[0], kYoung * V * u, 1e-15);
  EXPECT_NEAR(f[4], kYoung * V / 2.0 * (1.0 - std::numbers::sqrt2 / slanted), 1e-15);
  EXPECT_EQ(springs.spring_count(), 6);
  std::vector<double> masses(4, 0.0);
  springs.add_masses(masses);
  for (const double m : masses) EXPECT_NEAR(m, 0.25, 1e-15);
}

/// Edges in all directions alike: the mean over many turned copies of a cell. In a strain e along x with free
/// sides the energy is E e^2 / 2 and the sides shrink by e / 4: lambda = mu = 2 E / 5.
TEST(MassSpring, EdgesInAllDirectionsMakePoissonAQuarter) {
  const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
  test::Random random(2);
  Mat3 strain = Vec3(1.0, -0.25, -0.25).asDiagonal();
  const double small = 1e-4;
  double density = 0.0;
  double across = 0.0;  // change of the energy when the sides shrink more
  const int copies = 20000;
  for (int i = 0; i < copies; ++i) {
    // Rotations evenly spread over all: four numbers of a normal distribution.
    Quaternion q;
    for (int k = 0; k < 4; ++k) {
      double sum = 0.0;
      for (int n = 0; n < 12; ++n) sum += random.number();
      q.coeffs()[k] = sum;
    }
    const Mat3 R = q.normalized().toRotationMatrix();
    for (const auto& [a, b] :
         std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}) {
      const Vec3 n = (R * (mesh.node(b) - mesh.node(a))).normalized();
      const double along = n.dot(strain * n);
      density += 0.5 * along * along / copies;
      across += along * (n.y() * n.y() + n.z() * n.z()) / copies;
    }
  }
  // 20000 copies of 6 edges: the mean of numbers of size 1 is right to 1 / sqrt(120000) = 0.003.
  EXPECT_NEAR(density, 0.5, 0.01);
  EXPECT_NEAR(across, 0.0, 0.01);
  // And the model's energy of a small strain is that sum.
  const MassSpring springs(test::elastic_block(mesh.blocks[0], {.young = kYoung}), mesh.positions,
                           choose_isa(), Threads(1));
  State state;
  state.positions = mesh.positions;
  double by_hand = 0.0;
  for (std::int32_t i = 0; i < 4; ++i) {
    block(Reals(state.positions), i) = (Mat3::Identity() + small * strain) * mesh.node(i);
    for (std::int32_t j = 0; j < i; ++j) {
      const Vec3 n = (mesh.node(i) - mesh.node(j)).normalized();
      by_hand += 0.5 * kYoung / 6.0 * std::pow(small * n.dot(strain * n), 2);
    }
  }
  EXPECT_NEAR(springs.energy(state, test::scratch()) / by_hand, 1.0, 10.0 * small);
}

TEST(MassSpring, EqualMassesHaveTheSameTotal) {
  const Mesh mesh = test::distorted_box({3, 2, 2}, Split::six, 0.12);
  ElasticBlock block = test::elastic_block(mesh.blocks[0], {});
  const auto masses = [&] {
    const MassSpring springs(block, mesh.positions, choose_isa(), Threads(1));
    std::vector<double> nodal(static_cast<std::size_t>(mesh.node_count()) + 3, 0.0);  // three of others
    springs.add_masses(nodal);
    EXPECT_EQ(nodal.back(), 0.0);
    return nodal;
  };
  const std::vector<double> by_volume = masses();
  block.model = MassSpringOptions{.equal_masses = true};
  const std::vector<double> equal = masses();
  const double total = std::accumulate(by_volume.begin(), by_volume.end(), 0.0);
  EXPECT_NEAR(std::accumulate(equal.begin(), equal.end(), 0.0), total, 1e-13);
  EXPECT_NEAR(equal[0], total / mesh.node_count(), 1e-14);
  EXPECT_EQ(equal[0], equal[5]);
  EXPECT_GT(*std::ranges::max_element(by_volume) / by_volume[0], 2.0);
}

/// A spring of no length pulls with no more than k l0, and its matrix is finite.
TEST(MassSpring, AllNodesInOnePoint) {
  const Mesh mesh = test::distorted_box({2, 2, 2}, Split::six, 0.1);
  MassSpring springs(test::elastic_block(mesh.blocks[0], {}), mesh.positions, choose_isa(), Threads(1));
  const Sparsity pattern = test::bind_alone(springs, mesh.node_count());
  State state;
  state.positions.assign(mesh.positions.size(), 0.7);
  EXPECT_EQ(force_of(springs, state).norm(), 0.0);
  EXPECT_TRUE(test::stiffness_of(springs, state, {1.0, 0.0}, pattern).allFinite());
  EXPECT_GT(springs.energy(state, test::scratch()), 0.1);
}

TEST(MassSpring, RefusesOtherCellsAndLaws) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}, Split::none);
  ElasticBlock block = test::elastic_block(mesh.blocks[0], {});
  block.model = MassSpringOptions{};
  const auto message = [&] {
    try {
      (void)make_model(block, mesh.positions, choose_isa(), Threads(1));
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(
      message(),
      "body \"body\" asks for the model mass-spring with the element hexahedron; this model takes tetra.");
  block.element = "tetra";
  block.law = "neo_hooke";
  EXPECT_EQ(
      message(),
      "body \"body\" asks for the model mass-spring with the law neo_hooke; this model takes hooke, stvk.");
  block.law = "stvk";
  block.parameters["young"] = {-1.0};
  EXPECT_NE(message().find("young"), std::string::npos);
}

}  // namespace
}  // namespace tissu
