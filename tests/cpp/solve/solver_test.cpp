#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <tuple>

#include "../assembly/dense.h"
#include "../base/dense_solution.h"
#include "../base/differences.h"
#include "../world/sample_worlds.h"
#include "solver_cases.h"

/// Every solver against a dense factor, on the same systems.
namespace tissu {
namespace {

using test::dense;
using test::view;

class SolverTest : public testing::TestWithParam<test::SolverCase> {
 protected:
  static Sparsity grid_pattern(std::array<int, 3> cells) {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), cells, Split::six);
    SparsityBuilder builder(mesh.node_count());
    builder.add_cells(mesh.blocks[0].nodes, 4);
    return builder.build();
  }
  /// Random and symmetric, with eigenvalues between `low` and some tens: strictly dominant off the diagonal.
  void fill(BlockMatrix& matrix, double low = 0.5) {
    matrix.clear();
    std::vector<double> sums(static_cast<std::size_t>(matrix.rows()), low);
    for (std::int32_t row = 0; row < matrix.rows(); ++row) {
      for (std::int32_t column = 0; column < row; ++column) {
        if (matrix.sparsity().slot(row, column) >= 0) couple(matrix, row, column, sums);
      }
    }
    for (std::int32_t row = 0; row < matrix.rows(); ++row) {
      const Mat3 block = random_.matrix(0.3);
      matrix.add(row, row, block * block.transpose());
      matrix.add_diagonal(row, sums[static_cast<std::size_t>(row)]);
    }
  }
  void couple(BlockMatrix& matrix, std::int32_t row, std::int32_t column, std::vector<double>& sums) {
    const Mat3 block = random_.matrix(0.5);
    matrix.add(row, column, block);
    matrix.add(column, row, block.transpose());
    sums[static_cast<std::size_t>(row)] += block.norm();
    sums[static_cast<std::size_t>(column)] += block.norm();
  }
  /// Links of stiffness k between pairs of nodes that the pattern does not couple.
  void link(BlockMatrix& matrix, const std::vector<std::tuple<std::int32_t, std::int32_t, double>>& links) {
    links_.clear();
    for (const auto& [a, b, k] : links) {
      links_.add({{a, b, 0, 0}, {-1.0, 1.0, 0.0, 0.0}, k * Mat3::Identity()});
    }
    links_.close(matrix.rows(), nullptr);
    matrix.set_couplings(&links_);
  }
  std::vector<double> right_hand_side(const BlockMatrix& matrix) {
    return random_.numbers(static_cast<std::size_t>(3 * matrix.rows()));
  }
  // The solvers are asked for 1e-13 of the residual; the matrices' condition number is below 1e3.
  void expect_solves(const BlockMatrix& matrix) {
    const std::vector<double> b = right_hand_side(matrix);
    std::vector<double> x = random_.numbers(b.size());  // any first guess
    const SolveReport report = solver_->solve(matrix, b, x, 0.0);
    EXPECT_TRUE(report.converged);
    EXPECT_TRUE(report.positive_definite);
    EXPECT_LT(report.residual, 1e-12);
    EXPECT_GE(report.iterations, 1);
    const Eigen::VectorXd expected = test::dense_solution(dense(matrix), view(b));
    EXPECT_LT((view(x) - expected).norm(), 1e-9 * expected.norm());
  }

  test::Random random_{71};
  Sparsity pattern_ = grid_pattern({4, 3, 3});
  BlockMatrix matrix_{pattern_, Isa::baseline, Threads(1)};
  Couplings links_;
  std::unique_ptr<LinearSolver> solver_ = GetParam().make(1e-13);
};

TEST_P(SolverTest, AgreesWithADenseFactor) {
  for (int i = 0; i < 3; ++i) {
    fill(matrix_);
    expect_solves(matrix_);  // one solver, new values each time
  }
  expect_solves(matrix_);  // and the same values again
}

TEST_P(SolverTest, SolvesWithCouplings) {
  fill(matrix_);
  expect_solves(matrix_);
  fill(matrix_);
  link(matrix_, {{0, matrix_.rows() - 1, 5.0}, {3, matrix_.rows() - 7, 2.0}});
  expect_solves(matrix_);
  fill(matrix_);
  link(matrix_, {{1, matrix_.rows() - 1, 5.0}, {4, matrix_.rows() - 7, 2.0}});  // as many, at another place
  expect_solves(matrix_);
  fill(matrix_);
  expect_solves(matrix_);  // and gone again
}

TEST_P(SolverTest, ServesAnotherPattern) {
  fill(matrix_);
  expect_solves(matrix_);
  const Sparsity other = grid_pattern({3, 4, 3});  // as many rows
  BlockMatrix second(other, Isa::baseline, Threads(1));
  ASSERT_EQ(second.rows(), matrix_.rows());
  fill(second);
  expect_solves(second);
  const Sparsity larger = grid_pattern({5, 4, 3});
  BlockMatrix third(larger, Isa::baseline, Threads(1));
  fill(third);
  expect_solves(third);
  expect_solves(matrix_);
}

/// An editor makes a new matrix, which may stand at the same address, with the same pattern and count of
/// versions.
TEST_P(SolverTest, KnowsANewMatrixFromTheOldOne) {
  std::optional<BlockMatrix> matrix;
  for (int i = 0; i < 3; ++i) {
    matrix.reset();
    matrix.emplace(pattern_, Isa::baseline, Threads(1));
    fill(*matrix);
    expect_solves(*matrix);
  }
}

TEST_P(SolverTest, ZeroRightHandSideGivesZero) {
  fill(matrix_);
  const std::vector<double> b(static_cast<std::size_t>(3 * matrix_.rows()), 0.0);
  std::vector<double> x = random_.numbers(b.size());
  const SolveReport report = solver_->solve(matrix_, b, x, 0.0);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(view(x).norm(), 1e-14);
  EXPECT_TRUE(std::isfinite(report.residual));
}

/// A right-hand side far below the floor is not worth an iteration, but its answer is no worse than zero.
TEST_P(SolverTest, FloorJudgesSmallRightHandSides) {
  fill(matrix_);
  std::vector<double> b = right_hand_side(matrix_);
  for (double& value : b) value *= 1e-15;
  std::vector<double> x(b.size(), 0.0);
  const SolveReport report = solver_->solve(matrix_, b, x, 1.0);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.residual, 1e-13);
}

TEST_P(SolverTest, ReportsAnIndefiniteMatrix) {
  fill(matrix_);
  matrix_.add(20, 20, -100.0 * Mat3::Identity());
  const std::vector<double> b = right_hand_side(matrix_);
  std::vector<double> x(b.size(), 0.0);
  const SolveReport report = solver_->solve(matrix_, b, x, 0.0);
  EXPECT_FALSE(report.positive_definite);
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(view(x).allFinite());
  EXPECT_TRUE(std::isfinite(report.residual));
  EXPECT_GE(view(x).dot(view(b)), 0.0);  // a descent direction, or no step
  fill(matrix_);
  expect_solves(matrix_);  // and it recovers
}

TEST_P(SolverTest, ReportsANegativeDefiniteMatrix) {
  matrix_.clear();
  for (std::int32_t row = 0; row < matrix_.rows(); ++row) matrix_.add_diagonal(row, -2.0);
  const std::vector<double> b = right_hand_side(matrix_);
  std::vector<double> x(b.size(), 0.0);
  try {
    const SolveReport report = solver_->solve(matrix_, b, x, 0.0);
    EXPECT_FALSE(report.positive_definite);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE(view(x).allFinite());
  } catch (const Error&) {  // refused in words: no answer is not a wrong answer
  }
}

/// No mass and no stiffness in one node: singular.
TEST_P(SolverTest, NeverAnswersASingularMatrixWithNaN) {
  fill(matrix_);
  std::vector<std::uint8_t> masks(static_cast<std::size_t>(matrix_.rows()), 0);
  masks[20] = 7;
  matrix_.constrain({20}, masks);
  matrix_.add_diagonal(20, -1.0);
  const std::vector<double> b = right_hand_side(matrix_);
  std::vector<double> x(b.size(), 0.0);
  try {
    const SolveReport report = solver_->solve(matrix_, b, x, 0.0);
    EXPECT_FALSE(report.converged);
    EXPECT_TRUE(view(x).allFinite());
  } catch (const Error&) {
  }
}

/// Led degrees of freedom, rows of the identity, come out bit for bit; also when the rest is not definite.
TEST_P(SolverTest, KeepsConstrainedValuesExactly) {
  for (const double bad : {0.0, -100.0}) {
    fill(matrix_);
    matrix_.add(20, 20, bad * Mat3::Identity());
    std::vector<std::uint8_t> masks(static_cast<std::size_t>(matrix_.rows()), 0);
    masks[0] = 7;
    masks[33] = 2;
    matrix_.constrain({0, 33}, masks);
    std::vector<double> b = right_hand_side(matrix_);
    std::vector<double> x(b.size(), 0.0);
    for (const std::size_t i : {0U, 1U, 2U, 100U}) x[i] = b[i];  // the first guess that an integrator makes
    const SolveReport report = solver_->solve(matrix_, b, x, 0.0);
    EXPECT_EQ(report.positive_definite, bad == 0.0);
    for (const std::size_t i : {0U, 1U, 2U, 100U}) EXPECT_EQ(x[i], b[i]) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SolverTest, testing::ValuesIn(test::solver_cases()),
                         [](const auto& info) { return info.param.name; });

TEST(ConjugateGradient, StopsAtItsIterations) {
  SparsityBuilder builder(4);
  builder.add_cells(std::vector<std::int32_t>{0, 1, 1, 2, 2, 3}, 2);
  const Sparsity pattern = builder.build();
  BlockMatrix matrix(pattern, Isa::baseline, Threads(1));
  matrix.clear();
  test::Random random(72);
  for (std::int32_t row = 0; row < 4; ++row) matrix.add_diagonal(row, 1.0 + row);
  for (std::int32_t row = 0; row < 3; ++row) {
    matrix.add(row, row + 1, 0.3 * Mat3::Identity());
    matrix.add(row + 1, row, 0.3 * Mat3::Identity());
  }
  const std::vector<double> b = random.numbers(12);
  std::vector<double> x(12, 0.0);
  ConjugateGradient one({1e-13, 1});
  const SolveReport report = one.solve(matrix, b, x, 0.0);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_FALSE(report.converged);
  EXPECT_TRUE(report.positive_definite);
  EXPECT_GT(report.residual, 1e-6);
}

TEST(ConjugateGradient, RefusesSettingsWithoutSense) {
  using Settings = ConjugateGradient::Settings;
  const auto free = [](Preconditioning preconditioning, Precision precision) {
    return Settings{1e-6, 10, preconditioning, precision, Product::free};
  };
  EXPECT_NO_THROW(ConjugateGradient(free(Preconditioning::jacobi, Precision::full)));
  EXPECT_THROW(ConjugateGradient(free(Preconditioning::incomplete_cholesky, Precision::full)),
               ParameterError);
  EXPECT_THROW(ConjugateGradient(free(Preconditioning::stale_cholesky, Precision::full)), ParameterError);
  EXPECT_THROW(ConjugateGradient(free(Preconditioning::jacobi, Precision::single)), ParameterError);
  EXPECT_THROW(ConjugateGradient({0.0, 10}), ParameterError);
  EXPECT_THROW(ConjugateGradient({-1.0, 10}), ParameterError);
  EXPECT_THROW(ConjugateGradient({1e-6, 0}), ParameterError);
}

}  // namespace
}  // namespace tissu
