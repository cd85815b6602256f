#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>

#include "../solve/solver_cases.h"
#include "../world/sample_worlds.h"
#include "methods.h"

/// What is made before the first step changes nothing of what steps give, and the first step takes it.
namespace tissu {
namespace {

constexpr double kStep = 0.01;

WorldDescription cube(const char* law = "stvk") {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {6, 6, 6}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = law, .young = 1e4})};
  world.gravity = Vec3(0.0, 0.0, -9.81);
  world.fixed = {test::fixed(test::nodes_at(mesh, 2, 0.0))};
  return world;
}

struct Outcome {
  State state;
  std::int64_t made_before = 0;
  std::int64_t made_by_first_step = 0;
};

/// Some steps, after something that happens between the preparation and the first of them.
Outcome steps(
    const test::SolverCase& solver, const test::Method& method, bool ahead,
    const std::function<void(Simulation&)>& between = [](Simulation&) {}) {
  Simulation simulation = test::simulate(cube(), method.make(), solver.make(1e-6));
  if (ahead) simulation.prepare_ahead(kStep);
  between(simulation);
  Outcome outcome;
  outcome.made_before = simulation.profile().solves().preparations;
  simulation.step(kStep);
  outcome.made_by_first_step = simulation.profile().solves().preparations;
  for (int i = 0; i < 5; ++i) simulation.step(kStep);
  outcome.state = simulation.state();
  return outcome;
}

void expect_same(const Outcome& one, const Outcome& other) {
  EXPECT_EQ(one.state.positions, other.state.positions);
  EXPECT_EQ(one.state.velocities, other.state.velocities);
}

class PreparedAhead : public testing::TestWithParam<test::SolverCase> {};

TEST_P(PreparedAhead, GivesTheSameBits) {
  for (const char* name : {"implicit_euler", "implicit_midpoint", "bdf2", "newmark"}) {
    SCOPED_TRACE(name);
    const test::Method method = test::method_named(name);
    expect_same(steps(GetParam(), method, true), steps(GetParam(), method, false));
  }
}

TEST_P(PreparedAhead, GivesTheSameBitsWhenTheStateChangesBeforeTheFirstStep) {
  const test::Method method = test::method_named("implicit_euler");
  const auto squeeze = [](Simulation& simulation) {
    for (double& x : simulation.state().positions) x *= 0.9;
  };
  expect_same(steps(GetParam(), method, true, squeeze), steps(GetParam(), method, false, squeeze));
  const auto other_length = [](Simulation& simulation) { simulation.step(0.3 * kStep); };
  expect_same(steps(GetParam(), method, true, other_length), steps(GetParam(), method, false, other_length));
  const auto go_back = [](Simulation& simulation) { simulation.rewind(simulation.mark()); };
  expect_same(steps(GetParam(), method, true, go_back), steps(GetParam(), method, false));
}

INSTANTIATE_TEST_SUITE_P(Solvers, PreparedAhead, testing::ValuesIn(test::all_solver_cases()),
                         [](const auto& info) { return info.param.name; });

/// Of the makings in the first step: Jacobi's are made for each of its systems.
TEST(PreparedAhead, SparesTheFirstStepOneMaking) {
  const test::Method method = test::method_named("implicit_euler");
  for (const test::SolverCase& solver : test::solver_cases()) {
    if (solver.name == "cholesky") continue;  // its factor is that of each step's own matrix
    SCOPED_TRACE(solver.name);
    const Outcome ahead = steps(solver, method, true);
    const Outcome without = steps(solver, method, false);
    EXPECT_EQ(ahead.made_before, 1);
    EXPECT_EQ(without.made_before, 0);
    EXPECT_EQ(ahead.made_by_first_step, without.made_by_first_step);
  }
}

/// Places count as the matrix does: a linear body that was moved has the same matrix elsewhere.
TEST(PreparedAhead, KnowsWhereTheRowsAre) {
  const test::SolverCase multigrid = test::gradient_case("multigrid", Preconditioning::multigrid);
  const test::Method method = test::method_named("implicit_euler");
  const auto linear = [&](bool ahead) {
    Simulation simulation = test::simulate(cube("hooke"), method.make(), multigrid.make(1e-6));
    if (ahead) simulation.prepare_ahead(kStep);
    for (double& x : simulation.state().positions) x *= 1.5;
    for (int i = 0; i < 3; ++i) simulation.step(kStep);
    return simulation.state().positions;
  };
  EXPECT_EQ(linear(true), linear(false));
}

}  // namespace
}  // namespace tissu
