#include "tissu/cell/element_order.h"

#include <gtest/gtest.h>

#include <set>

#include "../world/sample_worlds.h"

namespace tissu {
namespace {

class Filled : public testing::TestWithParam<double> {
 protected:
  static constexpr int kSize = 4;
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {9, 6, 6}, Split::six);  // 1944 tetrahedra
  const std::vector<std::int32_t>& cells_ = mesh_.blocks[0].nodes;
  ElementOrder order_ = order_elements(cells_, kSize, mesh_.positions, {}, GetParam());
};

TEST_P(Filled, ChunksKeepTheRoomAskedFor) {
  const auto most = static_cast<std::int32_t>(GetParam() * ElementOrder::chunk_size(kSize));
  for (const Chunk& chunk : order_.chunks) {
    EXPECT_LE((chunk.end - chunk.begin) * ElementOrder::kLanes, most);
  }
  std::int32_t full = 0;
  for (const Chunk& chunk : order_.chunks)
    full += (chunk.end - chunk.begin) * ElementOrder::kLanes == most ? 1 : 0;
  EXPECT_GE(full, 1944 / most);  // all but the last
}

TEST_P(Filled, EveryCellStandsInOnePlace) {
  std::multiset<std::int32_t> found;
  for (std::size_t i = 0; i < order_.element.size(); ++i) {
    if (order_.real[i] != 0) found.insert(order_.element[i]);
  }
  ASSERT_EQ(found.size(), 1944U);
  std::int32_t next = 0;
  for (const std::int32_t cell : found) EXPECT_EQ(cell, next++);
}

TEST_P(Filled, ChunksOfOneColourShareNoNode) {
  for (std::int32_t colour = 0; colour < order_.colours(); ++colour) {
    std::set<std::int32_t> seen;
    for (auto c = order_.colour_begin[static_cast<std::size_t>(colour)];
         c < order_.colour_begin[static_cast<std::size_t>(colour) + 1]; ++c) {
      const Chunk& chunk = order_.chunks[static_cast<std::size_t>(c)];
      for (std::int32_t n = 0; n < chunk.node_count; ++n) EXPECT_TRUE(seen.insert(chunk.nodes[n]).second);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shares, Filled, testing::Values(1.0, 0.75, 0.5));

}  // namespace
}  // namespace tissu
