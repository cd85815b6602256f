#include "tissu/contact/surface_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../world/sample_worlds.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

constexpr double kRoundOff = 1e-12;

/// The boundary of a box of tetrahedra: 2 x 1 x 1 m in 4 x 2 x 2 hexahedra of six.
struct BoxOfTetrahedra {
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {4, 2, 2}, Split::six);
  ContactDescription description;

  BoxOfTetrahedra() {
    SurfaceDescription surface{.name = "box", .closed = true};
    surface.triangles = boundary_surface(mesh).triangles;
    description.bodies = {surface};
    description.pairs = {{.a = 0, .b = 0, .gap = 0.01}};
  }
  [[nodiscard]] SurfaceSet set() const {
    const std::vector<std::int32_t> first = {0};
    return {description, first, mesh.positions};
  }
};

TEST(SurfaceSetTest, TheBoundaryOfABoxIsCountedByEuler) {
  const BoxOfTetrahedra box;
  const SurfaceSet set = box.set();
  // 2 (4 2 + 4 2 + 2 2) quads of two triangles; V - E + F = 2 and 2 E = 3 F.
  EXPECT_EQ(set.primitives().size(), 80U);
  EXPECT_EQ(set.edges().size(), 120U);
  EXPECT_EQ(set.vertices().size(), 42U);
  EXPECT_TRUE(set.surfaces()[0].closed);
  for (const SurfaceEdge& edge : set.edges()) {
    EXPECT_GE(edge.face[0], 0);
    EXPECT_GT(edge.face[1], edge.face[0]);
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& corners = set.primitives()[static_cast<std::size_t>(edge.face[side])].vertex;
      const std::set<std::int32_t> all(corners.begin(), corners.end());
      EXPECT_EQ(all, (std::set{edge.vertex[0], edge.vertex[1], edge.across[side]}));
    }
    const Vec3 a = block(ConstReals(set.rest()), edge.vertex[0]);
    EXPECT_NEAR(edge.length, (block(ConstReals(set.rest()), edge.vertex[1]) - a).norm(), kRoundOff);
  }
}

/// Two cells that share an edge alone, of a box of four.
TEST(SurfaceSetTest, WedgesThatTouchAlongAnEdgeHaveOneEach) {
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 2, 1), {2, 2, 1}, Split::none);
  for (const std::array<std::int32_t, 2> kept : {std::array{0, 3}, std::array{3, 0}, std::array{1, 2}}) {
    Mesh two{mesh.positions, {{CellType::hexahedron, {}}}};
    for (const std::int32_t i : kept) {
      const auto cell = mesh.blocks[0].cell(i);
      two.blocks[0].nodes.insert(two.blocks[0].nodes.end(), cell.begin(), cell.end());
    }
    ContactDescription description;
    SurfaceDescription surface{.name = "two", .closed = true};
    const Surface outer = boundary_surface(two);
    std::vector<std::int32_t> cells;
    for (std::size_t q = 0; q < outer.quads.size(); ++q) {
      const auto& [a, b, c, d] = outer.quads[q];
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
      cells.insert(cells.end(), 2, outer.quad_cell[q]);
    }
    description.bodies = {surface};
    const std::vector<std::int32_t> first = {0};
    const SurfaceSet set(description, first, mesh.positions);
    // Of each cube 12 edges and 6 diagonals; all of both, though they share two nodes.
    EXPECT_EQ(set.edges().size(), 36U);
    EXPECT_EQ(set.vertices().size(), 14U);
    int shared = 0;
    for (const SurfaceEdge& edge : set.edges()) {
      ASSERT_GT(edge.face[1], edge.face[0]);
      EXPECT_EQ(cells[static_cast<std::size_t>(edge.face[0])], cells[static_cast<std::size_t>(edge.face[1])]);
      const Vec3 a = block(ConstReals(set.rest()), edge.vertex[0]);
      const Vec3 b = block(ConstReals(set.rest()), edge.vertex[1]);
      if (a.head<2>() == Eigen::Vector2d(1, 1) && b.head<2>() == a.head<2>()) ++shared;
      for (std::size_t side = 0; side < 2; ++side) {
        const auto& corners = set.primitives()[static_cast<std::size_t>(edge.face[side])].vertex;
        const std::set<std::int32_t> all(corners.begin(), corners.end());
        EXPECT_EQ(all, (std::set{edge.vertex[0], edge.vertex[1], edge.across[side]}));
      }
    }
    EXPECT_EQ(shared, 2);
  }
}

TEST(SurfaceSetTest, TheAreasOfTheVerticesAreThatOfTheSurface) {
  const BoxOfTetrahedra box;
  const SurfaceSet set = box.set();
  double area = 0.0;
  for (const SurfaceVertex& vertex : set.vertices()) {
    EXPECT_GT(vertex.area, 0.0);
    EXPECT_TRUE(vertex.has_faces);
    EXPECT_EQ(vertex.row, vertex.node);
    area += vertex.area;
  }
  EXPECT_NEAR(area, 10.0, kRoundOff);
  // 120 edges: 40 diagonals of half a metre times the root of two, else half a metre.
  EXPECT_NEAR(set.mean_edge(0), (40 * std::sqrt(0.5) + 80 * 0.5) / 120, kRoundOff);
}

TEST(SurfaceSetTest, EveryEdgeAndVertexBelongsToItsLowestPrimitiveOnce) {
  const BoxOfTetrahedra box;
  const SurfaceSet set = box.set();
  std::vector<int> edges(set.edges().size(), 0);
  std::vector<int> vertices(set.vertices().size(), 0);
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(set.primitives().size()); ++p) {
    for (const std::int32_t e : set.edges_of(p)) {
      ++edges[static_cast<std::size_t>(e)];
      EXPECT_EQ(set.edges()[static_cast<std::size_t>(e)].face[0], p);
    }
    for (const std::int32_t v : set.vertices_of(p)) {
      ++vertices[static_cast<std::size_t>(v)];
      EXPECT_EQ(set.owner(v), p);
      for (std::int32_t q = 0; q < p; ++q) {
        const auto& corners = set.primitives()[static_cast<std::size_t>(q)].vertex;
        EXPECT_EQ(std::ranges::count(corners, v), 0) << "vertex " << v << " belongs to " << q;
      }
    }
  }
  EXPECT_EQ(std::ranges::count(edges, 1), std::ssize(edges));
  EXPECT_EQ(std::ranges::count(vertices, 1), std::ssize(vertices));
}

TEST(SurfaceSetTest, NeighboursAreTheOtherEndsOfTheEdges) {
  const BoxOfTetrahedra box;
  const SurfaceSet set = box.set();
  std::size_t ends = 0;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(set.vertices().size()); ++v) {
    std::set<std::int32_t> expected;
    for (const SurfaceEdge& edge : set.edges()) {
      if (edge.vertex[0] == v) expected.insert(edge.vertex[1]);
      if (edge.vertex[1] == v) expected.insert(edge.vertex[0]);
    }
    const auto found = set.neighbours(v);
    EXPECT_EQ(std::set<std::int32_t>(found.begin(), found.end()), expected);
    ends += found.size();
  }
  EXPECT_EQ(ends, 2 * set.edges().size());
}

/// A sheet of two triangles, a line of two pieces and a point of one body; then a capsule.
TEST(SurfaceSetTest, SheetsLinesAndPointsStandBesideEachOther) {
  ContactDescription description;
  SurfaceDescription body{.name = "body"};
  body.triangles = {{0, 1, 2}, {0, 2, 3}};
  body.edges = {{4, 5}, {5, 6}};
  body.points = {7};
  body.radius = {0.1, 0.1, 0.1, 0.1, 0.2, 0.2, 0.2, 0.3};
  description.bodies = {body};
  ObstacleDescription capsule;
  capsule.surface = {.name = "capsule", .vertices = {0, 0, 3, 0, 0, 5}, .edges = {{0, 1}}};
  capsule.surface.radius = {0.5, 0.5};
  description.obstacles = {capsule};
  description.pairs = {{.a = 0, .b = 1, .gap = 0.01}};
  const std::vector<std::int32_t> first = {2};
  const std::vector<double> rest = {9, 9, 9, 9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0,
                                    0, 1, 0, 2, 0, 0, 3, 0, 0, 5, 0, 0, 7, 0, 0};
  const SurfaceSet set(description, first, rest);

  ASSERT_EQ(set.surfaces().size(), 2U);
  ASSERT_EQ(set.vertices().size(), 10U);
  EXPECT_EQ(set.primitives().size(), 6U);
  EXPECT_EQ(set.edges().size(), 8U);
  EXPECT_FALSE(set.surfaces()[0].closed);
  int lone_edges = 0;
  for (const SurfaceEdge& edge : set.edges()) lone_edges += edge.is_lone() ? 1 : 0;
  EXPECT_EQ(lone_edges, 3);
  for (const SurfaceVertex& vertex : set.vertices()) {
    const bool of_capsule = vertex.surface == 1;
    EXPECT_EQ(vertex.row, of_capsule ? -1 : vertex.node + 2);
    const double radius = of_capsule ? 0.5 : vertex.node < 4 ? 0.1 : vertex.node < 7 ? 0.2 : 0.3;
    EXPECT_EQ(vertex.radius, radius);
    EXPECT_EQ(vertex.has_faces, !of_capsule && vertex.node < 4);
    EXPECT_EQ(vertex.is_lone, !of_capsule && vertex.node == 7);
  }
  // The sheet's five edges and the two pieces; the capsule's one.
  EXPECT_NEAR(set.mean_edge(0), (4 + std::sqrt(2.0) + 1 + 2) / 7, kRoundOff);
  EXPECT_NEAR(set.mean_edge(1), 2.0, kRoundOff);
  EXPECT_EQ(set.surface_of_primitive(5), 1);
}

}  // namespace
}  // namespace tissu
