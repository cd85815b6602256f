#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string_view>

#include "../assembly/dense.h"
#include "../base/dense_solution.h"
#include "../base/differences.h"
#include "../world/sample_worlds.h"
#include "solver_cases.h"
#include "tissu/step/system.h"

/// Every solver on the systems of real worlds, deformed, against a dense factor; and products without a
/// matrix against the matrix.
namespace tissu {
namespace {

using test::dense;
using test::view;

/// A bar that stands on one end, its other end led along two axes, with links and frames or without.
WorldDescription bar(Split split, bool linked, int threads = 1, std::array<int, 3> cells = {6, 3, 2}) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 0.8), cells, split);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.young = 500.0, .poisson = 0.4})};
  world.bodies[0].rayleigh = {0.1, 0.01};
  world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0)), test::fixed(test::nodes_at(mesh, 0, 3.0), 5)};
  world.links = linked;
  world.threads = threads;
  if (linked) {
    FrameDescription frame;
    frame.mass = 2.0;
    frame.inertia = Vec3(1.0, 2.0, 3.0).asDiagonal();
    frame.position = Vec3(4, 0, 0);
    world.frames = {frame};
  }
  return world;
}

void link(const World& world, State& state) {
  if (world.memory().count() == 0) return;
  const std::int32_t frame = world.frames()[0].block;
  test::links(world, state).add({3, -1, Vec3::Zero()}, {world.blocks() / 2, -1, Vec3::Zero()}, 70.0);
  test::links(world, state)
      .add({frame, 0, Vec3(0.1, 0.2, 0.3)}, {world.blocks() / 2 + 1, -1, Vec3::Zero()}, 300.0);
}

State deformed(const World& world) {
  State state = world.rest_state();
  test::Random random(5);
  for (double& x : state.positions) x = 1.05 * x + random.number(0.01);
  return state;
}

struct Kind {
  const char* name;
  Split split;
  bool linked;
  double mass;
  StiffnessScale scale;
};
constexpr double kStep = 0.02;
const Kind kKinds[] = {
    {"tetra_step", Split::six, false, 1.0, {-kStep * kStep, -kStep}},
    {"tetra_static", Split::six, false, 0.0, {-1.0, 0.0}},
    {"hexahedra_static", Split::none, false, 0.0, {-1.0, 0.0}},
    {"linked_frame_step", Split::six, true, 1.0, {-kStep * kStep, -kStep}},
};

class WorldSystems : public testing::TestWithParam<std::tuple<test::SolverCase, Kind>> {};

TEST_P(WorldSystems, AreSolved) {
  const auto& [solver_case, kind] = GetParam();
  const World world(bar(kind.split, kind.linked));
  State state = deformed(world);
  link(world, state);
  Profile profile;
  System assembled(world, nullptr, profile);
  assembled.assemble(state, kind.mass, kind.scale);
  const Eigen::MatrixXd A = dense(assembled.matrix());
  const auto solver = solver_case.make(1e-10);
  System system(world, solver.get(), profile);
  system.assemble(state, kind.mass, kind.scale);
  test::Random random(6);
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> b = random.numbers(state.positions.size());
    std::vector<double> x(b.size(), 0.0);
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (system.system_matrix().is_given(static_cast<std::int32_t>(k / 3), static_cast<int>(k % 3)))
        x[k] = b[k];
    }
    const SolveReport report = system.solve(b, x, 0.0);
    EXPECT_TRUE(report.converged);
    EXPECT_TRUE(report.positive_definite);
    const double residual = (view(b) - A * view(x)).norm() / view(b).norm();
    EXPECT_LE(residual, 1e-10);
    EXPECT_NEAR(report.residual, residual, 1e-13);  // what it says is what there is
    // The condition number is below 1e5.
    const Eigen::VectorXd expected = test::dense_solution(A, view(b));
    EXPECT_LT((view(x) - expected).norm(), 1e-5 * expected.norm());
  }
  EXPECT_EQ(profile.solves().solves, 2);
  EXPECT_GE(profile.solves().iterations, 2);
  EXPECT_EQ(profile.solves().failures, 0);
  EXPECT_EQ(profile.solves().preparations, 1);
  EXPECT_GT(solver->bytes(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Solvers, WorldSystems,
                         testing::Combine(testing::ValuesIn(test::all_solver_cases()),
                                          testing::ValuesIn(kKinds)),
                         [](const auto& info) {
                           return std::get<0>(info.param).name + "_" + std::get<1>(info.param).name;
                         });

class FreeProduct : public testing::TestWithParam<bool> {};

TEST_P(FreeProduct, EqualsTheMatrix) {
  const World world(bar(Split::six, GetParam()));
  State state = deformed(world);
  Profile profile;
  System assembled(world, nullptr, profile);
  FreeOperator free(world);
  for (int i = 0; i < 2; ++i) {  // without links, and with
    assembled.assemble(state, 1.0, {-4e-4, -0.02});
    free.set(state, 1.0, {-4e-4, -0.02});
    const BlockMatrix& matrix = assembled.matrix();
    test::Random random(8);
    const std::vector<double> p = random.numbers(state.positions.size());
    std::vector<double> expected(p.size());
    std::vector<double> found(p.size());
    matrix.multiply(p, expected);
    free.multiply(p, found);
    EXPECT_LT((view(found) - view(expected)).norm(), 1e-14 * view(expected).norm());
    std::vector<double> blocks(3 * p.size());
    std::vector<double> free_blocks(3 * p.size());
    matrix.diagonal_blocks(blocks);
    free.diagonal_blocks(free_blocks);
    EXPECT_LT((view(free_blocks) - view(blocks)).cwiseAbs().maxCoeff(),
              1e-13 * view(blocks).cwiseAbs().maxCoeff());
    EXPECT_NEAR(free.round_off(p), matrix.round_off(p), 1e-12 * matrix.round_off(p));
    EXPECT_LE(free.diagonal_cost(), 3.0 * 16);  // colours: no more than a node has neighbours
    link(world, state);
  }
}

INSTANTIATE_TEST_SUITE_P(Links, FreeProduct, testing::Bool());

/// The whole step without a matrix ends where the one with a matrix does.
TEST(FreeProduct, StepsTheSame) {
  const auto run = [](Product product) {
    auto solver = std::make_unique<ConjugateGradient>(
        ConjugateGradient::Settings{1e-12, 5000, Preconditioning::block_jacobi, Precision::full, product});
    Simulation simulation = test::simulate(bar(Split::six, false), test::implicit_euler(), std::move(solver));
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(simulation.step(0.02).converged);
    return simulation.state().positions;
  };
  const std::vector<double> with = run(Product::assembled);
  const std::vector<double> without = run(Product::free);
  EXPECT_LT((view(with) - view(without)).norm(), 1e-9 * view(with).norm());
}

class SolverBits : public testing::TestWithParam<test::SolverCase> {
 protected:
  /// A mesh of several pieces and, for triangular solves, of many groups.
  static std::array<int, 3> cells() {
#if defined(__SANITIZE_THREAD__)
    // A factor is a hundred times slower where every access is recorded, and is made on one thread.
    const std::string_view name = GetParam().name;
    if (name == "cholesky" || name.starts_with("stale_cholesky")) return {10, 6, 4};
#endif
    return {20, 12, 8};
  }
  /// Three steps.
  static std::vector<double> run(int threads) {
    WorldDescription description = bar(Split::six, false, threads, cells());
    description.gravity = Vec3(0.0, 0.0, -9.81);
    Simulation simulation =
        test::simulate(std::move(description), test::implicit_euler(), GetParam().make(1e-6));
    for (int i = 0; i < 3; ++i) simulation.step(0.02);
    return simulation.state().positions;
  }
};

TEST_P(SolverBits, DoNotDependOnThreads) {
  const std::vector<double> one = run(1);
  for (const int threads : {1, 2, 3, 4}) {
    const std::vector<double> several = run(threads);
    EXPECT_EQ(std::memcmp(one.data(), several.data(), one.size() * sizeof(double)), 0) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, SolverBits, testing::ValuesIn(test::all_solver_cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace tissu
