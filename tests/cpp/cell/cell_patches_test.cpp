#include "tissu/cell/cell_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "../force/room.h"
#include "../model/corotational/corotational_sample.h"
#include "tissu/mesh/topology.h"
#include "tissu/model/dilatation/mean_dilatation.h"

/// How cells are put together in patches.
namespace tissu {
namespace {

class CellPatches : public testing::TestWithParam<const char*> {
 protected:
  test::CellBox box_ = test::cell_box(GetParam(), {6, 5, 4}, 0.1);
  std::size_t size_ = static_cast<std::size_t>(find_element(GetParam())->nodes);
  std::vector<std::int32_t> of_cell_ = group_cells(GetParam(), box_.cells, static_cast<int>(size_));

  std::map<std::int32_t, std::vector<std::int32_t>> patches() const {
    std::map<std::int32_t, std::vector<std::int32_t>> result;
    for (std::size_t e = 0; e < of_cell_.size(); ++e) {
      result[of_cell_[e]].push_back(static_cast<std::int32_t>(e));
    }
    return result;
  }
  Mesh mesh_of(const std::vector<std::int32_t>& cells) const {
    Mesh mesh;
    mesh.positions = box_.positions;
    mesh.blocks.resize(1);
    mesh.blocks[0].type = *cell_type(GetParam());
    for (const std::int32_t e : cells) {
      const auto first =
          box_.cells.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(e) * size_);
      mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), first,
                                  first + static_cast<std::ptrdiff_t>(size_));
    }
    return mesh;
  }
};

TEST_P(CellPatches, EveryCellIsInOneAndNumbersHaveNoGaps) {
  ASSERT_EQ(of_cell_.size(), box_.cells.size() / size_);
  std::int32_t next = 0;
  for (const auto& [patch, cells] : patches()) EXPECT_EQ(patch, next++);
  EXPECT_EQ(group_cells(GetParam(), box_.cells, static_cast<int>(size_)), of_cell_);
}

/// 12 tetrahedra, 10 pyramids or wedges, and at most one more that else stood alone.
TEST_P(CellPatches, NoneIsTooLargeAndNoCellStandsAlone) {
  const std::map<std::string, std::size_t> most = {
      {"tetra", 13}, {"pyramid", 11}, {"wedge", 11}, {"hexahedron", 1}};
  std::size_t count = 0;
  for (const auto& [patch, cells] : patches()) {
    EXPECT_LE(cells.size(), most.at(GetParam()));
    EXPECT_GE(cells.size(), std::string(GetParam()) == "hexahedron" ? 1U : 2U);
    std::set<std::int32_t> nodes;
    const Mesh mesh = mesh_of(cells);
    for (const std::int32_t node : mesh.blocks[0].nodes) nodes.insert(node);
    EXPECT_LE(nodes.size(), static_cast<std::size_t>(kMostPatchNodes));
    ++count;
  }
  const double mean = static_cast<double>(of_cell_.size()) / static_cast<double>(count);
  RecordProperty("mean cells", std::to_string(mean));
  EXPECT_GE(mean, 0.5 * static_cast<double>(most.at(GetParam())));
}

/// A part of a surface that is closed is one piece: cells that only touched at an edge or a node would have
/// two.
TEST_P(CellPatches, HangTogetherByFaces) {
  for (const auto& [patch, cells] : patches()) {
    std::vector<std::int32_t> left(cells.begin() + 1, cells.end());
    std::vector<std::int32_t> front = {cells.front()};
    for (std::size_t i = 0; i < front.size(); ++i) {
      std::erase_if(left, [&](std::int32_t e) {
        const Surface both = boundary_surface(mesh_of({front[i], e}));
        const Surface one = boundary_surface(mesh_of({e}));
        const bool share =
            both.triangles.size() + both.quads.size() < 2 * (one.triangles.size() + one.quads.size());
        if (share) front.push_back(e);
        return share;
      });
    }
    EXPECT_TRUE(left.empty()) << "patch " << patch;
  }
}

TEST_P(CellPatches, RemovedCellsLeaveTheOthersWhereTheyAre) {
  ElasticBlock block = test::corotational_block(box_, GetParam());
  block.law = "stvk";
  block.model = MeanDilatationOptions{};
  const MeanDilatation whole(block, box_.positions, choose_isa(), Threads(1));
  EXPECT_EQ(whole.patches(), of_cell_);
  std::vector<std::int32_t> removed;
  std::vector<std::size_t> kept;
  for (std::size_t e = 0; e < of_cell_.size(); ++e) {
    if (e % 7 == 3) {
      removed.push_back(static_cast<std::int32_t>(e));
    } else {
      kept.push_back(e);
    }
  }
  const auto left = whole.without(part_of(block, kept), removed);
  const auto& patches = dynamic_cast<const MeanDilatation&>(*left).patches();
  ASSERT_EQ(patches.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(patches[i], of_cell_[kept[i]]);
  State state;
  state.positions = box_.positions;
  test::Random random(3);
  for (double& x : state.positions) x += random.number(0.05);
  const std::vector<double> p = random.numbers(state.positions.size());
  const double slope = test::derivative(
      [&](double t) { return left->energy(test::moved(state, p, t), test::scratch()); }, 1e-3);
  const Eigen::VectorXd f = test::force_of(*left, state);
  EXPECT_NEAR(-f.dot(test::view(p)), slope, 1e-8 * f.norm() * test::view(p).norm());
}

INSTANTIATE_TEST_SUITE_P(Elements, CellPatches, testing::Values("tetra", "hexahedron", "wedge", "pyramid"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace tissu
