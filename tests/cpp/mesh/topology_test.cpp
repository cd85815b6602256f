#include "tissu/mesh/topology.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "sample_meshes.h"

namespace tissu {
namespace {

using Loop = std::vector<std::int32_t>;

std::vector<Loop> loops(const Surface& surface) {
  std::vector<Loop> result;
  for (const auto& t : surface.triangles) result.emplace_back(t.begin(), t.end());
  for (const auto& q : surface.quads) result.emplace_back(q.begin(), q.end());
  return result;
}

/// Divergence theorem: volume = 1/3 of the flux of x, each face a fan of triangles.
double enclosed_volume(const Mesh& mesh, const std::vector<Loop>& faces) {
  double volume = 0.0;
  for (const Loop& f : faces)
    for (std::size_t c = 2; c < f.size(); ++c)
      volume += mesh.node(f[0]).dot(mesh.node(f[c - 1]).cross(mesh.node(f[c]))) / 6.0;
  return volume;
}

class TopologyTest : public testing::TestWithParam<Split> {};

TEST_P(TopologyTest, SurfaceEnclosesTheVolume) {
  const Mesh mesh = test::sample_box(GetParam());
  EXPECT_NEAR(enclosed_volume(mesh, loops(boundary_surface(mesh))), 6.0, 1e-13);
}

TEST_P(TopologyTest, SurfaceIsAClosedOrientedSphere) {
  const std::vector<Loop> faces = loops(boundary_surface(test::sample_box(GetParam())));
  std::set<std::int32_t> nodes;
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  for (const Loop& f : faces)
    for (std::size_t c = 0; c < f.size(); ++c) {
      nodes.insert(f[c]);
      ++directed[{f[c], f[(c + 1) % f.size()]}];
    }
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(directed.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(nodes.size() - directed.size() / 2 + faces.size(), 2U);  // Euler characteristic of a sphere
}

INSTANTIATE_TEST_SUITE_P(EverySplit, TopologyTest, testing::ValuesIn(test::kSplits));

TEST(Topology, SurfaceNamesItsCells) {
  Mesh mesh = test::unit_hexahedron();  // and a tetrahedron of its own
  for (const double x : {5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1}) mesh.positions.push_back(x);
  mesh.blocks.push_back({CellType::tetra, {8, 9, 10, 11}});
  const Surface surface = boundary_surface(mesh);
  EXPECT_EQ(surface.quad_cell, std::vector<std::int32_t>(6, 0));
  EXPECT_EQ(surface.triangle_cell, std::vector<std::int32_t>(4, 1));
}

TEST(Topology, PartsAreJoinedByNodes) {
  Mesh mesh = test::unit_hexahedron();
  for (const double x : {5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1}) mesh.positions.push_back(x);
  mesh.blocks.push_back({CellType::tetra, {8, 9, 10, 11, 0, 1, 2, 4}});
  EXPECT_EQ(connected_parts(mesh), (std::vector<std::int32_t>{0, 1, 0}));
}

TEST(Topology, OverlappingCellsAreCounted) {
  Mesh mesh = test::unit_tetra();
  EXPECT_EQ(overfull_face_count(mesh), 0);
  mesh.blocks[0].nodes = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
  EXPECT_EQ(overfull_face_count(mesh), 4);
}

}  // namespace
}  // namespace tissu
