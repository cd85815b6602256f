/// Single operations of a repair: collapses, flips and moves.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "../cut/cut_body.h"
#include "edit/repair/collapse.h"
#include "edit/repair/flips.h"
#include "edit/repair/links.h"
#include "edit/repair/repair_mesh.h"
#include "edit/repair/shape.h"
#include "edit/repair/shift.h"
#include "tissu/mesh/box.h"

namespace tissu {
namespace {

using Tetra = std::array<std::int32_t, 4>;

Mesh mesh_of(const std::vector<Vec3>& places, const std::vector<Tetra>& cells) {
  Mesh mesh;
  for (const Vec3& place : places)
    mesh.positions.insert(mesh.positions.end(), place.data(), place.data() + 3);
  CellBlock block;
  block.type = CellType::tetra;
  for (const Tetra& cell : cells) block.nodes.insert(block.nodes.end(), cell.begin(), cell.end());
  mesh.blocks.push_back(block);
  return mesh;
}

std::set<std::set<std::int32_t>> cells_of(const RepairMesh& mesh) {
  std::set<std::set<std::int32_t>> cells;
  for (const std::int32_t number : mesh.numbers()) {
    const auto nodes = mesh.cell(number).nodes;
    cells.insert({nodes.begin(), nodes.end()});
  }
  return cells;
}

double volume_of(const RepairMesh& mesh) {
  double sum = 0.0;
  for (const std::int32_t number : mesh.numbers()) {
    const double volume = tetra_volume(rest_corners(mesh, mesh.cell(number)));
    EXPECT_GT(volume, 0.0);
    sum += volume;
  }
  return sum;
}

/// Two tetrahedra with the face 0 1 2, whose tops are 3 and 4.
Mesh double_tetra() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}},
                 {{0, 1, 2, 3}, {0, 2, 1, 4}});
}

TEST(RepairOperationsTest, AFlipOfAFaceAndThatOfItsEdgeAreInverse) {
  const Mesh first = double_tetra();
  const Hosts hosts(first);
  const Material material;
  RepairMesh mesh(hosts, material, first.positions);
  const auto before = cells_of(mesh);
  const double volume = volume_of(mesh);
  const KeptNodes kept(5, 0);
  const auto flips = flips_of(mesh, 0, kept);
  ASSERT_EQ(flips.size(), 1U);
  ASSERT_EQ(flips.front().after.size(), 3U);
  const std::vector<std::int32_t> made = mesh.apply(flips.front());
  EXPECT_EQ(made, (std::vector<std::int32_t>{2, 3, 4}));
  EXPECT_NEAR(volume_of(mesh), volume, 1e-15);
  const auto back = flips_of(mesh, 3, kept);
  const auto edge = std::ranges::find_if(back, [](const Operation& one) { return one.after.size() == 2; });
  ASSERT_NE(edge, back.end());
  mesh.apply(*edge);
  EXPECT_EQ(cells_of(mesh), before);
  EXPECT_NEAR(volume_of(mesh), volume, 1e-15);
  EXPECT_EQ(mesh.plan().gone, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(mesh.plan().born.front().number, 2);
}

TEST(RepairOperationsTest, FourCellsAroundAnEdgeHaveTwoOtherWays) {
  const Mesh first = mesh_of({{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                             {{2, 3, 1, 0}, {3, 4, 1, 0}, {4, 5, 1, 0}, {5, 2, 1, 0}});
  const Hosts hosts(first);
  const Material material;
  std::set<std::set<std::set<std::int32_t>>> ways;
  for (const std::size_t way : {0U, 1U}) {
    RepairMesh mesh(hosts, material, first.positions);
    std::vector<Operation> flips = flips_of(mesh, 0, KeptNodes(6, 0));
    std::erase_if(flips, [](const Operation& one) { return one.patch.size() != 4; });
    ASSERT_EQ(flips.size(), 2U);
    mesh.apply(flips[way]);
    EXPECT_NEAR(volume_of(mesh), 4.0 / 3.0, 1e-15);
    ways.insert(cells_of(mesh));
  }
  EXPECT_EQ(ways.size(), 2U);
  for (const auto& way : ways) {
    EXPECT_TRUE(
        std::ranges::none_of(way, [](const auto& cell) { return cell.contains(0) && cell.contains(1); }));
  }
}

/// The face between the two cells goes only if one of its nodes is not kept, and no cut has opened it.
TEST(RepairOperationsTest, KeptAndOpenedFacesStay) {
  const Mesh first = double_tetra();
  const Hosts hosts(first);
  Material material;
  const RepairMesh whole(hosts, material, first.positions);
  EXPECT_TRUE(flips_of(whole, 0, KeptNodes{1, 1, 1, 0, 0}).empty());
  EXPECT_EQ(flips_of(whole, 0, KeptNodes{1, 1, 0, 1, 1}).size(), 1U);
  material.cells[0] = {{{0, 1, 2, 3}, 0b1000}};
  material.cells[1] = {{{0, 2, 1, 4}, 0b1000}};
  const RepairMesh opened(hosts, material, first.positions);
  EXPECT_TRUE(flips_of(opened, 0, KeptNodes(5, 0)).empty());
}

/// Faces that a cut opened are opened faces of the new cells.
TEST(RepairOperationsTest, NewCellsHaveTheOpenedFacesOfTheOld) {
  const Mesh first = double_tetra();
  const Hosts hosts(first);
  Material material;
  material.cells[0] = {{{0, 1, 2, 3}, 0b0001}};  // 1 2 3
  material.cells[1] = {{{0, 2, 1, 4}, 0b0100}};  // 0 2 4
  RepairMesh mesh(hosts, material, first.positions);
  mesh.apply(flips_of(mesh, 0, KeptNodes(5, 0)).front());
  std::set<std::set<std::int32_t>> opened;
  for (const std::int32_t number : mesh.numbers()) {
    const RepairCell cell = mesh.cell(number);
    for (std::size_t f = 0; f < 4; ++f) {
      std::set<std::int32_t> face(cell.nodes.begin(), cell.nodes.end());
      face.erase(cell.nodes[f]);
      if (cell.is_cut(f)) opened.insert(face);
    }
  }
  EXPECT_EQ(opened, (std::set<std::set<std::int32_t>>{{1, 2, 3}, {0, 2, 4}}));
}

class Box {
 public:
  explicit Box(std::array<int, 3> cells)
      : first_(test::typed_box(CellType::tetra, Vec3(1, 1, 1), cells, 0.0, 1)),
        hosts_(first_),
        mesh_(hosts_, material_, first_.positions) {}

  RepairMesh& mesh() { return mesh_; }
  [[nodiscard]] std::int32_t at(const Vec3& place) const {
    for (std::int32_t node = 0; node < hosts_.node_count(); ++node) {
      if ((mesh_.rest(node) - place).norm() < 1e-12) return node;
    }
    return -1;
  }

 private:
  Mesh first_;
  Hosts hosts_;
  Material material_;
  RepairMesh mesh_;
};

TEST(RepairOperationsTest, NodesOfTheSurfaceGoInItsPlanesAlone) {
  Box box({4, 4, 4});
  const std::int32_t inside = box.at(Vec3(0.5, 0.5, 0.5));
  const std::int32_t face = box.at(Vec3(0.5, 0.5, 1.0));
  const std::int32_t next = box.at(Vec3(0.75, 0.5, 1.0));
  const std::int32_t edge = box.at(Vec3(0.5, 0.0, 1.0));
  const std::int32_t along = box.at(Vec3(0.75, 0.0, 1.0));
  const std::int32_t corner = box.at(Vec3(1.0, 0.0, 1.0));
  EXPECT_TRUE(collapse(box.mesh(), inside, box.at(Vec3(0.75, 0.5, 0.5))));
  EXPECT_TRUE(collapse(box.mesh(), face, next));
  EXPECT_FALSE(collapse(box.mesh(), face, box.at(Vec3(0.5, 0.5, 0.75))));
  EXPECT_TRUE(collapse(box.mesh(), edge, along));
  EXPECT_FALSE(collapse(box.mesh(), edge, box.at(Vec3(0.5, 0.25, 1.0))));
  EXPECT_FALSE(collapse(box.mesh(), corner, along));
  box.mesh().apply(*collapse(box.mesh(), face, next));
  double volume = 0.0;
  for (const std::int32_t number : box.mesh().numbers())
    volume += tetra_volume(rest_corners(box.mesh(), box.mesh().cell(number)));
  EXPECT_NEAR(volume, 1.0, 1e-14);
  EXPECT_TRUE(box.mesh().cells_at(face).empty());
}

/// In a body one cell thick an edge inside joins two sides of the surface: without it they would be one.
TEST(RepairOperationsTest, AnEdgeThatJoinsTwoSidesStays) {
  Box box({1, 1, 1});
  int joined = 0;
  for (std::int32_t u = 0; u < 8; ++u) {
    for (std::int32_t v = 0; v < 8; ++v) {
      if (u == v || box.mesh().cells_with(std::array{u, v}).empty()) continue;
      joined += may_contract(box.mesh(), u, v) ? 0 : 1;
    }
  }
  EXPECT_GT(joined, 0);
}

/// A node near a face of its cell goes away from it, and x is read from the cell in which it then lies.
TEST(RepairOperationsTest, ANodeInsideGoesWhereItsCellsAreBetter) {
  Mesh first = test::typed_box(CellType::tetra, Vec3(1, 1, 1), {4, 4, 4}, 0.0, 1);
  std::int32_t node = 0;
  while ((block(ConstReals(first.positions), node) - Vec3(0.5, 0.5, 0.5)).norm() > 1e-12) ++node;
  block(Reals(first.positions), node) += Vec3(0.2, 0.02, -0.03);
  const Hosts hosts(first);
  const Material material;
  std::vector<double> x = first.positions;
  for (double& place : x) place *= 1.25;
  RepairMesh mesh(hosts, material, x);
  const std::int32_t cell = mesh.cells_at(node).front();
  const auto moves = shifts_of(mesh, cell, std::vector<char>(x.size() / 3, 1));
  const auto own = std::ranges::find_if(moves, [&](const Operation& one) { return one.move->node == node; });
  ASSERT_NE(own, moves.end());
  mesh.apply(*own);
  EXPECT_LT((mesh.rest(node) - Vec3(0.5, 0.5, 0.5)).norm(), 0.15);
  EXPECT_LT((mesh.now(node) - 1.25 * mesh.rest(node)).norm(), 1e-14);
  EXPECT_TRUE(shifts_of(mesh, cell, std::vector<char>(x.size() / 3, 0)).empty());
}

}  // namespace
}  // namespace tissu
