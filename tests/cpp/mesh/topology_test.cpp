#include "tissu/mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "sample_meshes.h"
#include "tissu/mesh/cell_shape.h"

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

void expect_sphere(const std::vector<Loop>& faces) {
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

class TopologyTest : public testing::TestWithParam<Split> {};

TEST_P(TopologyTest, SurfaceEnclosesTheVolume) {
  const Mesh mesh = test::sample_box(GetParam());
  EXPECT_NEAR(enclosed_volume(mesh, loops(boundary_surface(mesh))), 6.0, 1e-13);
}

TEST_P(TopologyTest, SurfaceIsAClosedOrientedSphere) {
  expect_sphere(loops(boundary_surface(test::sample_box(GetParam()))));
}

INSTANTIATE_TEST_SUITE_P(EverySplit, TopologyTest, testing::ValuesIn(test::kSplits));

class CellFacesTest : public testing::TestWithParam<CellType> {};

TEST_P(CellFacesTest, LookOutwardsAndEncloseTheCell) {
  const Mesh mesh = test::one_cell(GetParam());
  const std::vector<Loop> faces = loops(boundary_surface(mesh));
  EXPECT_NEAR(enclosed_volume(mesh, faces), test::reference_volume(GetParam()), 1e-13);
  expect_sphere(faces);
}

TEST_P(CellFacesTest, EveryNodeIsOnTheSurfaceOfItsCell) {
  std::set<std::int32_t> nodes;
  for (const Loop& face : loops(boundary_surface(test::one_cell(GetParam()))))
    nodes.insert(face.begin(), face.end());
  const int inside = GetParam() == CellType::hexahedron27 ? 1 : 0;
  EXPECT_EQ(static_cast<int>(nodes.size()), info(GetParam()).nodes - inside);
}

TEST_P(CellFacesTest, EveryEdgeIsOnTwoFaces) {
  for (const auto& [a, b] : edges(GetParam())) {
    int count = 0;
    for (const LocalFace& face : faces(GetParam())) {
      const auto corners = std::span(face.node).first(static_cast<std::size_t>(face.corners));
      count += std::ranges::count(corners, a) == 1 && std::ranges::count(corners, b) == 1 ? 1 : 0;
    }
    EXPECT_EQ(count, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryType, CellFacesTest, testing::ValuesIn(test::kTypes), test::type_name);

/// A cube [0, 1]^3 and on its top, the nodes 4 5 7 6, two tetrahedra cut along one diagonal or the other.
Mesh cube_and_tetrahedra(bool other_diagonal) {
  Mesh mesh = test::unit_hexahedron();
  for (const double x : {0.5, 0.5, 2.0}) mesh.positions.push_back(x);
  if (other_diagonal)
    mesh.blocks.push_back({CellType::tetra, {4, 5, 6, 8, 5, 7, 6, 8}});
  else
    mesh.blocks.push_back({CellType::tetra, {4, 5, 7, 8, 4, 7, 6, 8}});
  return mesh;
}

TEST(Nonconforming, QuadAgainstTriangles) {
  for (const bool other_diagonal : {false, true}) {
    const NonconformingFaces found = nonconforming_faces(cube_and_tetrahedra(other_diagonal));
    EXPECT_EQ(found.count, 1);
    EXPECT_EQ(found.cells, (std::vector<std::int32_t>{0, 1, 2}));
  }
}

TEST(Nonconforming, DiagonalsThatCross) {
  Mesh mesh = cube_and_tetrahedra(false);
  mesh.blocks[0] = {CellType::tetra, {5, 4, 6, 0, 5, 6, 7, 0}};
  EXPECT_EQ(nonconforming_faces(mesh).count, 1);
  mesh.blocks[0].nodes = {5, 4, 7, 0, 7, 4, 6, 0};
  EXPECT_EQ(nonconforming_faces(mesh).count, 0);
}

TEST(Nonconforming, OneCellAloneMatches) {
  for (const CellType type : test::kTypes) EXPECT_EQ(nonconforming_faces(test::one_cell(type)).count, 0);
}

TEST(Nonconforming, MiddlesOnOneSideOnly) {
  Mesh mesh = test::one_cell(CellType::tetra10);
  for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back(1.0);
  mesh.blocks.push_back({CellType::tetra, {1, 2, 3, 10}});
  const NonconformingFaces found = nonconforming_faces(mesh);
  EXPECT_EQ(found.count, 1);
  EXPECT_EQ(found.cells, (std::vector<std::int32_t>{0, 1}));
}

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
