#include "tissu/assembly/block_matrix.h"

#include <gtest/gtest.h>

#include "../base/differences.h"
#include "../world/sample_worlds.h"
#include "dense.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

using test::dense;
using test::view;

Sparsity grid_pattern(std::array<int, 3> cells) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), cells, Split::six);
  SparsityBuilder builder(mesh.node_count());
  builder.add_cells(mesh.blocks[0].nodes, 4);
  return builder.build();
}

/// A matrix with random blocks, symmetric, in its whole pattern.
void fill(BlockMatrix& matrix, test::Random& random) {
  matrix.clear();
  const Sparsity& pattern = matrix.sparsity();
  for (std::int32_t row = 0; row < matrix.rows(); ++row) {
    for (std::int32_t column = 0; column <= row; ++column) {
      if (pattern.slot(row, column) < 0) continue;
      const Mat3 block = random.matrix();
      matrix.add(row, column, block);
      matrix.add(column, row, block.transpose());
    }
  }
}

class BlockMatrixTest : public testing::TestWithParam<Isa> {
 protected:
  test::Random random_{51};
  // 180 rows: with as many pieces of unlike length as a row of the grid has neighbours.
  Sparsity pattern_ = grid_pattern({4, 5, 5});
  BlockMatrix matrix_{pattern_, GetParam(), Threads(1)};
};

// A sum of 45 products of numbers below 1: 1e-15 of their sum of magnitudes.
constexpr double kRoundOff = 1e-13;

TEST_P(BlockMatrixTest, MultipliesAsADenseMatrix) {
  fill(matrix_, random_);
  const std::vector<double> p = random_.numbers(static_cast<std::size_t>(3 * matrix_.rows()));
  std::vector<double> out = random_.numbers(p.size());  // what was there must not matter
  matrix_.multiply(p, out);
  EXPECT_LT((view(out) - dense(matrix_) * view(p)).cwiseAbs().maxCoeff(), kRoundOff);
}

TEST_P(BlockMatrixTest, RefusesBlocksOutsideThePattern) {
  EXPECT_THROW(matrix_.add(0, matrix_.rows() - 1, Mat3::Identity()), Error);
}

TEST_P(BlockMatrixTest, MultipliesTheSameOnAnyNumberOfThreads) {
  const Sparsity large = grid_pattern({9, 11, 9});  // 1200 rows, three pieces
  std::vector<double> first;
  for (const int threads : {1, 2, 3, 4}) {
    test::Random random(52);
    BlockMatrix matrix(large, GetParam(), Threads(threads));
    fill(matrix, random);
    const std::vector<double> p = random.numbers(static_cast<std::size_t>(3 * matrix.rows()));
    std::vector<double> out(p.size());
    matrix.multiply(p, out);
    if (threads == 1) first = out;
    EXPECT_EQ(out, first);
    EXPECT_LT((view(out) - dense(matrix) * view(p)).cwiseAbs().maxCoeff(), kRoundOff);
  }
}

TEST_P(BlockMatrixTest, ConstrainedIsTheIdentityThere) {
  fill(matrix_, random_);
  const std::int32_t last = matrix_.rows() - 1;
  std::vector<std::uint8_t> masks(static_cast<std::size_t>(matrix_.rows()), 0);
  const std::vector<std::int32_t> rows = {1, 7, 90, last};
  masks[1] = 7;
  masks[7] = 5;
  masks[90] = 2;
  masks[static_cast<std::size_t>(last)] = 4;
  Eigen::MatrixXd expected = dense(matrix_);
  for (const std::int32_t row : rows) {
    for (int axis = 0; axis < 3; ++axis) {
      if (((masks[static_cast<std::size_t>(row)] >> axis) & 1) == 0) continue;
      expected.row(3 * row + axis).setZero();
      expected.col(3 * row + axis).setZero();
      expected(3 * row + axis, 3 * row + axis) = 1.0;
    }
  }
  matrix_.constrain(rows, masks);
  EXPECT_EQ(dense(matrix_), expected);
  const std::vector<double> p = random_.numbers(static_cast<std::size_t>(3 * matrix_.rows()));
  std::vector<double> out(p.size());
  matrix_.multiply(p, out);
  EXPECT_LT((view(out) - expected * view(p)).cwiseAbs().maxCoeff(), kRoundOff);
}

TEST_P(BlockMatrixTest, ClearsEverything) {
  fill(matrix_, random_);
  const auto version = matrix_.version();
  matrix_.clear();
  EXPECT_NE(matrix_.version(), version);
  EXPECT_EQ(matrix_.couplings(), nullptr);
  EXPECT_EQ(dense(matrix_).norm(), 0.0);
}

TEST_P(BlockMatrixTest, AddsToTheDiagonal) {
  fill(matrix_, random_);
  const Eigen::MatrixXd before = dense(matrix_);
  matrix_.add_diagonal(5, 2.5);
  Eigen::MatrixXd expected = before;
  for (int i = 15; i < 18; ++i) expected(i, i) += 2.5;
  EXPECT_EQ(dense(matrix_), expected);
  EXPECT_EQ(matrix_.diagonal_block(5), Mat3(expected.block<3, 3>(15, 15)));
  EXPECT_EQ(Eigen::Map<const Mat3>(matrix_.values() + 9 * matrix_.diagonal_slot(5)),
            matrix_.diagonal_block(5));
}

INSTANTIATE_TEST_SUITE_P(Isas, BlockMatrixTest, testing::ValuesIn(test::available_isas()),
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace tissu
