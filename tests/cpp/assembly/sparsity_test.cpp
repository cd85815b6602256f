#include "tissu/assembly/sparsity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "../world/sample_worlds.h"

namespace tissu {
namespace {

TEST(Sparsity, CouplesTheNodesOfACell) {
  SparsityBuilder builder(6);
  builder.add_cells(std::vector<std::int32_t>{4, 0, 2, 2, 0, 5}, 3);
  builder.add_cells(std::vector<std::int32_t>{1, 4}, 2);
  const Sparsity pattern = builder.build();
  ASSERT_EQ(pattern.rows(), 6);
  const std::vector<std::vector<std::int32_t>> expected = {{0, 2, 4, 5}, {1, 4},       {0, 2, 4, 5},
                                                           {3},          {0, 1, 2, 4}, {0, 2, 5}};
  std::int32_t number = 0;
  for (std::int32_t row = 0; row < 6; ++row) {
    const auto& columns = expected[static_cast<std::size_t>(row)];
    for (std::int32_t column = 0; column < 6; ++column) {
      const bool coupled = std::ranges::binary_search(columns, column);
      EXPECT_EQ(pattern.slot(row, column), coupled ? number++ : -1) << row << ", " << column;
    }
  }
  EXPECT_EQ(pattern.blocks(), number);
}

TEST(Sparsity, KeepsTheDiagonalWithoutAnyCell) {
  const Sparsity pattern = SparsityBuilder(3).build();
  EXPECT_EQ(pattern.blocks(), 3);
  for (std::int32_t row = 0; row < 3; ++row) EXPECT_EQ(pattern.slot(row, row), row);
}

TEST(Sparsity, MayBeEmpty) {
  const Sparsity pattern = SparsityBuilder(0).build();
  EXPECT_EQ(pattern.rows(), 0);
  EXPECT_EQ(pattern.blocks(), 0);
}

/// Rows of an open pattern have the same columns, and room behind them.
TEST(Sparsity, LeavesRoomWhereItIsAskedFor) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {3, 3, 3}, Split::six);
  SparsityBuilder builder(mesh.node_count());
  builder.add_cells(mesh.blocks[0].nodes, 4);
  const Sparsity closed = builder.build();
  const Sparsity open = builder.build(0.25);
  EXPECT_TRUE(closed.open_end.empty());
  EXPECT_EQ(closed.row_end(), closed.row_begin.data() + 1);
  for (std::int32_t row = 0; row < closed.rows(); ++row) {
    const std::int64_t length = closed.end_of(row) - closed.begin_of(row);
    ASSERT_EQ(open.end_of(row) - open.begin_of(row), length);
    const std::int64_t room = open.row_begin[static_cast<std::size_t>(row) + 1] - open.end_of(row);
    EXPECT_EQ(room, (length + 3) / 4);
    for (std::int32_t column = 0; column < closed.rows(); ++column) {
      const std::int32_t slot = closed.slot(row, column);
      const auto expected = slot < 0 ? -1 : slot - closed.begin_of(row) + open.begin_of(row);
      EXPECT_EQ(open.slot(row, column), expected);
    }
  }
}

/// An inner node of a grid of hexahedra has 27 neighbours, a corner 8; of the diagonal split 15 and 5 to 8.
TEST(Sparsity, OfGrids) {
  for (const Split split : {Split::none, Split::six}) {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 2}, split);
    SparsityBuilder builder(mesh.node_count());
    builder.add_cells(mesh.blocks[0].nodes, info(mesh.blocks[0].type).nodes);
    const Sparsity pattern = builder.build();
    EXPECT_EQ(pattern.row_begin[14] - pattern.row_begin[13], split == Split::none ? 27 : 15);
    EXPECT_EQ(pattern.row_begin[1], 8);
  }
}

}  // namespace
}  // namespace tissu
