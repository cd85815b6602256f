#include "tissu/model/edges/mass_link.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../../force/room.h"
#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/model/edges/tetra_edges.h"
#include "tissu/model/fem/elastic.h"

/// What is the mass-link model's own: its published edge form, its constants, and states where a tetrahedron
/// has lost its volume. What it shares with other models is in tetra_models_test.cpp.
namespace tissu {
namespace {

constexpr double kYoung = 3.0;
constexpr double kPoisson = 0.3;

/// One tetrahedron without any symmetry.
class MassLinkTest : public testing::Test {
 protected:
  std::vector<double> X_ = {0.1, -0.2, 0.05, 1.2, 0.1, -0.1, 0.3, 0.9, 0.2, -0.1, 0.2, 1.1};
  test::Random random_{3};

  ElasticBlock block(const char* law) const {
    ElasticBlock block;
    block.body = "body";
    block.law = law;
    block.cells = {0, 1, 2, 3};
    block.parameters = {{"young", {kYoung}}, {"poisson", {kPoisson}}};
    block.density = {1.0};
    return block;
  }
  MassLink made(const char* law) const { return {block(law), X_, Isa::baseline, Threads(1)}; }
  Elastic continuum(const char* law) const { return {block(law), X_, Isa::baseline, Threads(1)}; }
  State at(const std::vector<double>& x) const {
    State state;
    state.positions = x;
    state.velocities.assign(x.size(), 0.0);
    return state;
  }
  State mapped(const Mat3& F) const {
    State state = at(X_);
    for (std::int32_t a = 0; a < 4; ++a) {
      tissu::block(Reals(state.positions), a) = F * tissu::block(ConstReals(X_), a);
    }
    return state;
  }
  State any_state() { return test::moved(at(X_), random_.numbers(12, 0.2), 1.0); }
  Vec3 edge(const State& state, int e) const {
    return tissu::block(ConstReals(state.positions), kTetraEdges[e][1]) -
           tissu::block(ConstReals(state.positions), kTetraEdges[e][0]);
  }
};

/// C = sum_e C_e l_e^2, by solving for the C_e from six independent F: nothing of the library's own form.
std::array<Mat3, 6> edge_matrices(const std::vector<double>& X) {
  std::array<Mat3, 6> C;
  Eigen::Matrix<double, 6, 6> directions;  // E_k with C = E_k: its squared lengths
  std::array<Mat3, 6> basis;
  for (int k = 0; k < 6; ++k) {
    const int i = k < 3 ? k : (k + 1) % 3;
    const int j = k < 3 ? k : (k + 2) % 3;
    basis[static_cast<std::size_t>(k)] = Mat3::Zero();
    basis[static_cast<std::size_t>(k)](i, j) += 0.5;
    basis[static_cast<std::size_t>(k)](j, i) += 0.5;
    for (int e = 0; e < 6; ++e) {
      const Vec3 d = block(ConstReals(X), kTetraEdges[e][1]) - block(ConstReals(X), kTetraEdges[e][0]);
      directions(e, k) = d.dot(basis[static_cast<std::size_t>(k)] * d);
    }
  }
  const Eigen::Matrix<double, 6, 6> inverse = directions.inverse();
  for (int e = 0; e < 6; ++e) {
    C[static_cast<std::size_t>(e)] = Mat3::Zero();
    for (int k = 0; k < 6; ++k)
      C[static_cast<std::size_t>(e)] += inverse(k, e) * basis[static_cast<std::size_t>(k)];
  }
  return C;
}

/// W = V dL^T MW dL and f_a = 4 V (MW dL)_e (x_b - x_a), as the corrected papers have them.
TEST_F(MassLinkTest, IsThePublishedForm) {
  const MassLink model = made("stvk");
  const std::array<Mat3, 6> C = edge_matrices(X_);
  const Lame k = lame(kYoung, kPoisson);
  const State state = any_state();
  Eigen::Matrix<double, 6, 6> MW;
  Eigen::Matrix<double, 6, 1> dL;
  for (int e = 0; e < 6; ++e) {
    dL[e] = edge(state, e).squaredNorm() - edge(at(X_), e).squaredNorm();
    for (int f = 0; f < 6; ++f) {
      const Mat3& Ce = C[static_cast<std::size_t>(e)];
      const Mat3& Cf = C[static_cast<std::size_t>(f)];
      MW(e, f) = k.lambda / 8.0 * Ce.trace() * Cf.trace() + k.mu / 4.0 * (Ce * Cf).trace();
    }
  }
  const double V = model.volumes()[0];
  EXPECT_NEAR(model.energy(state, test::scratch()), V * dL.dot(MW * dL),
              1e-13 * model.energy(state, test::scratch()));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(12);
  for (int e = 0; e < 6; ++e) {
    const Vec3 pull = 4.0 * V * (MW * dL)[e] * edge(state, e);
    f.segment<3>(3 * kTetraEdges[e][0]) += pull;
    f.segment<3>(3 * kTetraEdges[e][1]) -= pull;
  }
  EXPECT_LT(test::relative_difference(test::force_of(model, state), f), 1e-13);
}

TEST_F(MassLinkTest, KeepsTheNumbersThatThePaperCounts) {
  EXPECT_EQ(made("stvk").reals_per_cell(), 27U);
  EXPECT_EQ(made("neo_hooke").reals_per_cell(), 9U);
  EXPECT_GE(made("stvk").bytes(), 27 * sizeof(double));
}

/// chendeb2007 eq. 3.76: P = E/2 F (F^2 - 1) along an axis, the lateral stretch sqrt(1 + nu (1 - F^2)).
TEST_F(MassLinkTest, UniaxialStretchIsTheClosedForm) {
  const MassLink model = made("stvk");
  for (const double F : {0.61, 0.8, 1.2, 1.6, 2.0}) {
    const double lateral = std::sqrt(1.0 + kPoisson * (1.0 - F * F));
    const CellFields fields = model.fields(mapped(Vec3(lateral, lateral, F).asDiagonal()));
    const double P = kYoung / 2.0 * F * (F * F - 1.0);
    EXPECT_NEAR(fields.von_mises[0], std::abs(P) / (lateral * lateral), 1e-12);  // sigma = P / area ratio
    EXPECT_NEAR(fields.volume_ratio[0], F * lateral * lateral, 1e-14);
  }
}

/// Lengths do not tell a tetrahedron from its mirror image: St-Venant–Kirchhoff is at rest there, as its law
/// is; neo-Hooke is not a number, as its law is, and at no volume neither is finite.
TEST_F(MassLinkTest, TurnedInsideOutItIsWhatTheLawIs) {
  const State mirrored = mapped(Vec3(-1, 1, 1).asDiagonal());
  EXPECT_LT(test::force_of(made("stvk"), mirrored).norm(), 1e-13);
  EXPECT_LT(test::force_of(continuum("stvk"), mirrored).norm(), 1e-13);
  const Mat3 inverted = Vec3(-0.7, 1.1, 0.9).asDiagonal();
  const Mat3 flat = Vec3(0.0, 1.1, 0.9).asDiagonal();
  for (const Mat3& F : {inverted, flat}) {
    const Eigen::VectorXd mine = test::force_of(made("neo_hooke"), mapped(F));
    const Eigen::VectorXd theirs = test::force_of(continuum("neo_hooke"), mapped(F));
    EXPECT_FALSE(mine.allFinite());
    EXPECT_FALSE(theirs.allFinite());
  }
  EXPECT_TRUE(std::isnan(made("neo_hooke").energy(mapped(inverted), test::scratch())));
  EXPECT_TRUE(std::isnan(continuum("neo_hooke").energy(mapped(inverted), test::scratch())));
  // Just above, both are finite and equal. det C is of size 1e-6 here and the lengths are of size 1: six
  // digits of the tensions are gone.
  const State thin = mapped(Vec3(1e-3, 1.1, 0.9).asDiagonal());
  EXPECT_NEAR(made("neo_hooke").energy(thin, test::scratch()),
              continuum("neo_hooke").energy(thin, test::scratch()), 1e-9);
  EXPECT_LT(test::relative_difference(test::force_of(made("neo_hooke"), thin),
                                      test::force_of(continuum("neo_hooke"), thin)),
            1e-9);
}

/// A step that would turn a cell inside out ends as it does with the law on a continuum element: refused,
/// with the simulation at its last good step.
TEST_F(MassLinkTest, NeoHookeInsideOutIsRefusedByTheStep) {
  for (const char* model : {"mass-link", "fem"}) {
    WorldDescription world;
    world.bodies.resize(1);
    world.bodies[0].name = "body";
    world.bodies[0].positions = X_;
    world.bodies[0].elastic = {block("neo_hooke")};
    world.bodies[0].elastic[0].model = options_named(model);
    Simulation simulation = test::simulate(std::move(world), test::implicit_euler());
    const std::vector<double> before = simulation.state().positions;
    tissu::block(Reals(simulation.state().positions), 3) *= -1.0;
    const std::vector<double> inside_out = simulation.state().positions;
    EXPECT_THROW(simulation.step(0.01), Error) << model;
    EXPECT_EQ(simulation.state().positions, inside_out) << model;
  }
}

}  // namespace
}  // namespace tissu
