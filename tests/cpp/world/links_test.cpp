#include "tissu/force/links.h"

#include <gtest/gtest.h>

#include "../assembly/dense.h"
#include "../base/differences.h"
#include "sample_worlds.h"
#include "tissu/step/system.h"

/// Stiffness between any two nodes, chosen while the simulation runs: the shape that contact will have.
namespace tissu {
namespace {

class RunTimeLinks : public testing::TestWithParam<bool> {
 protected:
  RunTimeLinks() {
    world_.bodies = {test::body_of(mesh_, {.young = 500.0})};
    world_.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
    world_.gravity = Vec3(0.0, 0.0, -1.0);
    world_.links = true;
  }
  static Simulation run(const WorldDescription& world, bool direct = GetParam()) {
    auto solver = direct ? std::make_unique<Cholesky>() : test::conjugate_gradient(1e-13);
    return test::simulate(world, test::implicit_euler(), std::move(solver));
  }
  static double distance(const State& state, std::int32_t a, std::int32_t b) {
    return (block(ConstReals(state.positions), a) - block(ConstReals(state.positions), b)).norm();
  }
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {6, 2, 2}, Split::six);
  std::int32_t near_ = 3;                      // half-way along the first edge of the bar
  std::int32_t far_ = mesh_.node_count() - 1;  // its last corner
  WorldDescription world_;
};

TEST_P(RunTimeLinks, PullFarNodesTogether) {
  Simulation simulation = run(world_);
  EXPECT_EQ(simulation.world().sparsity().slot(near_, far_), -1);
  for (int i = 0; i < 5; ++i) simulation.step(0.01);
  const double before = distance(simulation.state(), near_, far_);
  // 3 E I / L^3 = 4.6 N/m against bending: the pull bends the bar without turning its cells inside out.
  test::links(simulation).add({near_}, {far_}, 5.0);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(simulation.step(0.01).converged);
  EXPECT_LT(distance(simulation.state(), near_, far_), 0.95 * before);
  test::links(simulation).clear();
  for (int i = 0; i < 300; ++i) EXPECT_TRUE(simulation.step(0.01).converged);
  EXPECT_NEAR(distance(simulation.state(), near_, far_), before, 0.02 * before);  // let go, it goes back
}

TEST_P(RunTimeLinks, BringCouplingsThatGoAgain) {
  const World world(world_);
  Profile profile;
  System system(world, nullptr, profile);
  State state = world.rest_state();
  system.assemble(state, 1.0, {-1e-4, -1e-2});
  EXPECT_EQ(system.matrix().couplings(), nullptr);
  const Eigen::MatrixXd before = test::dense(system.matrix());
  test::links(world, state).add({near_}, {far_}, 50.0);
  system.assemble(state, 1.0, {-1e-4, -1e-2});
  ASSERT_NE(system.matrix().couplings(), nullptr);
  EXPECT_EQ(system.matrix().couplings()->size(), 1U);
  Eigen::MatrixXd expected = before;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = 3 * near_ + axis;
    const int b = 3 * far_ + axis;
    expected(a, a) += 50e-4;
    expected(b, b) += 50e-4;
    expected(a, b) -= 50e-4;
    expected(b, a) -= 50e-4;
  }
  EXPECT_LT((test::dense(system.matrix()) - expected).cwiseAbs().maxCoeff(), 1e-15);
  test::links(world, state).clear();
  system.assemble(state, 1.0, {-1e-4, -1e-2});
  EXPECT_EQ(system.matrix().couplings(), nullptr);
  EXPECT_EQ(test::dense(system.matrix()), before);
}

TEST_P(RunTimeLinks, HoldALinearWorldToo) {
  world_.bodies[0].elastic[0].law = "hooke";
  Simulation simulation = run(world_);
  for (int i = 0; i < 3; ++i) simulation.step(0.01);
  test::links(simulation).add({near_}, {far_}, 50.0);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(simulation.step(0.01).converged);
  EXPECT_LT(distance(simulation.state(), near_, far_), 1.6);  // 2.06 m at rest
}

/// Linked to a fixed node: its rows stay those of the identity.
TEST_P(RunTimeLinks, LeaveFixedNodesWhereTheyAre) {
  Simulation simulation = run(world_);
  test::links(simulation).add({0}, {far_}, 50.0);
  for (int i = 0; i < 20; ++i) simulation.step(0.01);
  EXPECT_EQ(block(ConstReals(simulation.state().positions), 0), mesh_.node(0));
}

TEST_P(RunTimeLinks, SolversAgree) {
  Simulation one = run(world_);
  Simulation other = run(world_, !GetParam());
  for (int i = 0; i < 20; ++i) {
    for (Simulation* simulation : {&one, &other}) {
      if (i == 3) test::links(*simulation).add({near_}, {far_}, 50.0);
      if (i == 6) test::links(*simulation).add({5}, {far_ - 1}, 20.0);
      if (i == 12) test::links(*simulation).clear();
      if (i == 12) test::links(*simulation).add({1}, {far_}, 10.0);
      simulation->step(0.01);
    }
    const double difference =
        (test::view(one.state().positions) - test::view(other.state().positions)).norm();
    ASSERT_LT(difference, 1e-10) << "step " << i;  // the iteration's 1e-13 times the condition of the matrix
  }
}

/// The links are the state's: two simulations of one world have their own, and a state put back brings them
/// back.
TEST_P(RunTimeLinks, StandInTheState) {
  const auto world = std::make_shared<const World>(world_);
  Simulation linked(world, test::implicit_euler(), std::make_unique<Cholesky>());
  Simulation free(world, test::implicit_euler(), std::make_unique<Cholesky>());
  test::links(linked).add({near_}, {far_}, 50.0);
  EXPECT_EQ(test::links(linked).size(), 1U);
  EXPECT_EQ(test::links(free).size(), 0U);
  for (int i = 0; i < 3; ++i) linked.step(0.01);
  const State kept = linked.state();
  for (int i = 0; i < 3; ++i) linked.step(0.01);
  const std::vector<double> first = linked.state().positions;
  test::links(linked).clear();
  linked.step(0.01);
  linked.state() = kept;
  EXPECT_EQ(test::links(linked).size(), 1U);
  for (int i = 0; i < 3; ++i) linked.step(0.01);
  EXPECT_EQ(linked.state().positions, first);
  for (int i = 0; i < 6; ++i) free.step(0.01);
  EXPECT_NE(free.state().positions, first);
}

TEST_P(RunTimeLinks, AreRefusedWhereNobodyAskedForThem) {
  world_.links = false;
  Simulation simulation = run(world_);
  EXPECT_THROW((void)simulation.memory(Links::kMemory), ParameterError);
}

INSTANTIATE_TEST_SUITE_P(Solvers, RunTimeLinks, testing::Bool(),
                         [](const auto& info) { return info.param ? "cholesky" : "conjugate_gradient"; });

}  // namespace
}  // namespace tissu
