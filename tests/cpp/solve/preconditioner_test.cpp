#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "../assembly/dense.h"
#include "../base/differences.h"
#include "../world/sample_worlds.h"
#include "solve/renewal.h"
#include "solver_cases.h"
#include "tissu/step/system.h"

/// What preconditioners are for, when they are made again, and what single precision cannot hide.
namespace tissu {
namespace {

using test::dense;
using test::view;
using P = Preconditioning;

/// The stiffness of a bar of thin slices that lies across the axes, so that directions are coupled and
/// neighbours unequal, held at one end.
class Stretched : public testing::Test {
 protected:
  Stretched() : world_(description()), system_(world_, nullptr, profile_) { assemble(world_.rest_state()); }
  static WorldDescription description() {
    Mesh mesh = box_mesh(Vec3::Zero(), Vec3(1, 2, 10), {7, 7, 7}, Split::six);
    const std::vector<std::int32_t> held = test::nodes_at(mesh, 2, 0.0);
    const Quaternion turn = Quaternion(0.8, 0.3, -0.5, 0.4).normalized();
    for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
      block(Reals(mesh.positions), i) = turn * Vec3(block(ConstReals(mesh.positions), i));
    }
    WorldDescription world;
    world.bodies = {test::body_of(mesh, {.young = 1e3, .poisson = 0.4})};
    world.fixed = {test::fixed(held)};
    return world;
  }
  void assemble(const State& state, double mass = 0.0) { system_.assemble(state, mass, {-1.0, 0.0}); }
  /// The shape under a field that is `size` large.
  [[nodiscard]] State bent(double size) const {
    State state = world_.rest_state();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      state.positions[i] += size * std::sin(0.3 * static_cast<double>(i / 3) + static_cast<double>(i % 3));
    }
    return state;
  }
  SolveReport solve(LinearSolver& solver, unsigned seed = 9) {
    test::Random random(seed);
    std::vector<double> b = random.numbers(static_cast<std::size_t>(3 * world_.blocks()));
    world_.fixed().clear(b);
    x_.assign(b.size(), 0.0);
    const SolveReport report = system_.system_matrix().matrix() == nullptr
                                   ? SolveReport{}
                                   : solver.solve(system_.system_matrix(), b, x_, 0.0);
    std::vector<double> product(b.size());
    system_.system_matrix().multiply(x_, product);
    own_residual_ = (view(b) - view(product)).norm() / view(b).norm();
    return report;
  }
  static std::unique_ptr<LinearSolver> gradient(P kind, Precision precision = Precision::full,
                                                double tolerance = 1e-8) {
    return test::gradient_case("", kind, precision).make(tolerance);
  }
  World world_;
  Profile profile_;
  System system_;
  std::vector<double> x_;
  double own_residual_ = 0.0;
};

TEST_F(Stretched, BetterPreconditionersTakeFewerIterations) {
  std::map<P, int> iterations;
  for (const P kind : {P::jacobi, P::block_jacobi, P::incomplete_cholesky, P::stale_cholesky, P::multigrid}) {
    const auto solver = gradient(kind);
    const SolveReport report = solve(*solver);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(own_residual_, 1e-8);
    iterations[kind] = report.iterations;
  }
  EXPECT_LT(iterations[P::block_jacobi], iterations[P::jacobi]);
  EXPECT_LT(2 * iterations[P::incomplete_cholesky], iterations[P::block_jacobi]);
  EXPECT_LT(iterations[P::multigrid], iterations[P::block_jacobi]);
  EXPECT_LE(iterations[P::stale_cholesky], 2);  // its own factor: one, and one for round-off
}

TEST_F(Stretched, SinglePrecisionIsCorrectedToTheTolerance) {
  for (const P kind : {P::jacobi, P::block_jacobi, P::incomplete_cholesky, P::stale_cholesky, P::multigrid}) {
    const auto solver = gradient(kind, Precision::single, 1e-10);
    const SolveReport report = solve(*solver);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(own_residual_, 1e-10);  // 6e-8 is what single precision has
    // The rounds start anew, which costs iterations, but not several times as many.
    const SolveReport full = solve(*gradient(kind, Precision::full, 1e-10));
    // This matrix is as hard as single precision can take: it may use half of the 5000 before double does.
    EXPECT_LE(report.iterations, 2500 + full.iterations);
  }
}

/// A core that is 1e7 times stiffer: single precision cannot tell the matrix from a singular one.
TEST(SinglePrecision, GivesWayWhereItFails) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {9, 9, 9}, Split::six);
  WorldDescription description;
  description.bodies = {test::body_of(mesh)};
  ElasticBlock& elastic = description.bodies[0].elastic[0];
  const std::size_t cells = elastic.cells.size() / 4;
  elastic.parameters["poisson"].assign(cells, 0.3);
  elastic.parameters["young"].assign(cells, 1e3);
  for (std::size_t e = 0; e < cells; ++e) {
    const std::size_t grid = e / 6;
    const bool core = grid % 9 / 3 == 1 && grid / 9 % 9 / 3 == 1 && grid / 81 / 3 == 1;
    if (core) elastic.parameters["young"][e] = 1e10;
  }
  description.fixed = {test::fixed(test::nodes_at(mesh, 2, 0.0))};
  const World world(description);
  Profile profile;
  System system(world, nullptr, profile);
  system.assemble(world.rest_state(), 0.0, {-1.0, 0.0});
  std::vector<double> b(static_cast<std::size_t>(3 * world.blocks()), 1.0);
  world.fixed().clear(b);
  for (const P kind : {P::block_jacobi, P::incomplete_cholesky, P::stale_cholesky, P::multigrid}) {
    for (const Precision precision : {Precision::full, Precision::single}) {
      const auto solver = test::gradient_case("", kind, precision).make(1e-6);
      std::vector<double> x(b.size(), 0.0);
      std::vector<double> product(b.size());
      const SolveReport report = solver->solve(system.system_matrix(), b, x, 0.0);
      system.system_matrix().multiply(x, product);
      const double residual = (view(b) - view(product)).norm() / view(b).norm();
      EXPECT_NEAR(report.residual, residual, 1e-6 * residual);
      EXPECT_TRUE(report.converged);
      EXPECT_LE(residual, 1e-6);
    }
  }
}

TEST_F(Stretched, AStaleFactorServesWhileItPays) {
  for (const double size : {1e-12, 1e-5}) {  // the strain of each change is some hundred times as much
    const auto solver = gradient(P::stale_cholesky);
    int made = 0;
    int most = 0;
    for (int k = 0; k < 20; ++k) {
      assemble(bent(size * k));
      const SolveReport report = solve(*solver);
      EXPECT_TRUE(report.converged);
      EXPECT_LE(own_residual_, 1e-8);
      made += report.preparations;
      most = std::max(most, report.iterations);
    }
    // Some iterations more each time are cheaper than a factor, for a while.
    EXPECT_GE(made, 1);
    EXPECT_LE(made, size == 1e-12 ? 1 : 4);
    EXPECT_LE(most, size == 1e-12 ? 2 : 8);
  }
}

TEST_F(Stretched, AFactorThatDoesNotPayIsMadeAgain) {
  const auto solver = gradient(P::stale_cholesky);
  EXPECT_EQ(solve(*solver).preparations, 1);
  EXPECT_EQ(solve(*solver).preparations, 0);
  int made = 0;
  // Another matrix every time, until the price of a factor is reached: that of Eigen's is high.
  for (int k = 0; k < (made < 2 ? 80 : 10); ++k) {
    assemble(bent(0.001 * (k % 10 + 1)), 1e3 * (k % 2));
    const SolveReport report = solve(*solver);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(own_residual_, 1e-8);
    made += report.preparations;
  }
  EXPECT_GE(made, 2);
  EXPECT_LE(made, 10);
}

/// Solves after `forget` give the bits of a new solver.
TEST_F(Stretched, ForgetsWhatItKept) {
  for (const test::SolverCase& c : test::solver_cases()) {
    const auto kept = c.make(1e-8);
    assemble(bent(0.0));
    solve(*kept);
    assemble(bent(0.01));
    solve(*kept);
    kept->forget();
    const auto made = c.make(1e-8);
    for (const double size : {0.02, 0.021}) {
      assemble(bent(size));
      const SolveReport first = solve(*kept);
      const std::vector<double> x = x_;
      const SolveReport second = solve(*made);
      EXPECT_EQ(std::memcmp(x.data(), x_.data(), x.size() * sizeof(double)), 0) << c.name;
      EXPECT_EQ(first.iterations, second.iterations) << c.name;
    }
  }
}

/// A matrix that is not symmetric is no one's to solve here; an answer that is not one is never called so.
TEST_F(Stretched, AMatrixThatIsNotSymmetricIsNotSilentlyMissolved) {
  BlockMatrix matrix(world_.sparsity(), world_.isa(), Threads(1));
  test::Random random(12);
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    for (auto s = world_.sparsity().row_begin[static_cast<std::size_t>(row)];
         s < world_.sparsity().row_begin[static_cast<std::size_t>(row) + 1]; ++s) {
      matrix.add(row, world_.sparsity().column[static_cast<std::size_t>(s)], random.matrix());
    }
    matrix.add_diagonal(row, 12.0);
  }
  const std::vector<double> b = random.numbers(static_cast<std::size_t>(3 * matrix.rows()));
  for (const test::SolverCase& c : test::solver_cases()) {
    std::vector<double> x(b.size(), 0.0);
    std::vector<double> product(b.size());
    const SolveReport report = c.make(1e-8)->solve(matrix, b, x, 0.0);
    matrix.multiply(x, product);
    const double residual = (view(b) - view(product)).norm() / view(b).norm();
    EXPECT_NEAR(report.residual, residual, 1e-12 + 1e-6 * residual) << c.name;
    EXPECT_EQ(report.converged, residual <= (c.name == "cholesky" ? 1e-6 : 1e-8)) << c.name;
  }
}

/// No node is held and nothing has mass: the kernel holds six motions. A load that turns the body has no
/// answer, and none is given.
TEST_F(Stretched, ASingularSystemHasNoAnswer) {
  WorldDescription loose = description();
  loose.fixed.clear();
  const World world(loose);
  Profile profile;
  System system(world, nullptr, profile);
  system.assemble(world.rest_state(), 0.0, {-1.0, 0.0});
  const std::vector<double> b(static_cast<std::size_t>(3 * world.blocks()), 1.0);
  for (const test::SolverCase& c : test::solver_cases()) {
    std::vector<double> x(b.size(), 0.0);
    const SolveReport report = c.make(1e-8)->solve(system.system_matrix(), b, x, 0.0);
    EXPECT_FALSE(report.converged) << c.name;
    EXPECT_TRUE(view(x).allFinite()) << c.name;
  }
}

TEST(Renewal, PaysAtMostTwice) {
  Renewal renewal;
  EXPECT_TRUE(renewal.due());  // nothing there yet
  renewal.made(10.0);
  EXPECT_FALSE(renewal.due());
  EXPECT_EQ(renewal.left(), Renewal::kUnlimited);
  renewal.used(3);                  // what it takes when new
  EXPECT_EQ(renewal.left(), 16.0);  // twice those, and the price
  renewal.used(7);
  EXPECT_FALSE(renewal.due());
  EXPECT_EQ(renewal.left(), 12.0);
  renewal.used(9);
  EXPECT_TRUE(renewal.due());  // 4 + 6 beyond the first three
  renewal.made(10.0);
  EXPECT_FALSE(renewal.due());
  renewal.made(0.0);  // costs nothing: always anew
  EXPECT_TRUE(renewal.due());
}

}  // namespace
}  // namespace tissu
