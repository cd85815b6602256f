/// Edges of cuts in sheets and ends of cut lines as contact meets them: apart, and nothing crosses.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "edit/cut/riders.h"
#include "edit/cut/thin_drawn_in.h"
#include "tissu/base/crossing.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/material_mesh.h"

namespace tissu {
namespace {

constexpr double kRoundOff = 1e-14;
constexpr double kDepth = 1e-3;

using Random = std::mt19937_64;

/// 0.3 x 0.2 m of 6 x 4 cells; `bend` of 0 leaves it flat, else it lies on a cylinder of that curvature [1/m]
/// along x.
Mesh sheet(CellType type, double bend = 0.0) {
  constexpr int kX = 6;
  constexpr int kY = 4;
  Mesh mesh;
  for (int j = 0; j <= kY; ++j) {
    for (int i = 0; i <= kX; ++i) {
      const double s = 0.05 * i;
      const Vec3 place = bend == 0.0 ? Vec3(s, 0.05 * j, 0.0)
                                     : Vec3(std::sin(bend * s) / bend, 0.05 * j, std::cos(bend * s) / bend);
      mesh.positions.insert(mesh.positions.end(), place.begin(), place.end());
    }
  }
  CellBlock block{type, {}};
  for (int j = 0; j < kY; ++j) {
    for (int i = 0; i < kX; ++i) {
      const std::int32_t a = j * (kX + 1) + i;
      if (type == CellType::quad) {
        block.nodes.insert(block.nodes.end(), {a, a + 1, a + kX + 2, a + kX + 1});
      } else {
        block.nodes.insert(block.nodes.end(), {a, a + 1, a + kX + 2, a, a + kX + 2, a + kX + 1});
      }
    }
  }
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

struct Thin {
  explicit Thin(const Mesh& mesh) : hosts(mesh), x(mesh.positions) {}

  void cut(const Sweep& sweep) {
    const CutPlan plan = plan_cut(hosts, material, x, sweep);
    hosts.apply(plan);
    material.apply(plan);
    for (const BornNode& node : plan.nodes) {
      const Vec3 place = block(ConstReals(x), node.copied);
      x.insert(x.end(), place.begin(), place.end());
    }
  }

  [[nodiscard]] ThinMaterial thin() const {
    ThinMaterial all;
    for (const std::int32_t cell : hosts.numbers()) {
      for (const MaterialTetra& part : material_of(hosts, material, cell)) {
        (part.corners() == 3 ? all.triangles : all.lines).push_back(part);
      }
    }
    return all;
  }

  /// Places of all vertices of the material, those on cuts drawn in by a depth.
  [[nodiscard]] std::map<std::int32_t, Vec3> places(double depth) const {
    std::map<std::int32_t, Vec3> found;
    const ThinMaterial all = thin();
    for (const auto* list : {&all.triangles, &all.lines}) {
      for (const MaterialTetra& part : *list) {
        for (std::size_t i = 0; i < part.corners(); ++i) {
          found[part.vertices[i]] = rider_of(material, part.vertices[i]).at(x);
        }
      }
    }
    if (depth == 0.0) return found;
    for (const auto& [vertex, rider] : drawn_in(hosts, material, all, [&](std::int32_t) { return depth; })) {
      found.at(vertex) = rider.at(x);
    }
    return found;
  }

  /// Edges that go through triangles, or touch them, with which they share no vertex.
  [[nodiscard]] int crossings(double depth) const {
    const auto points = places(depth);
    const ThinMaterial all = thin();
    std::set<std::pair<std::int32_t, std::int32_t>> edges;
    for (const MaterialTetra& t : all.triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t.vertices[i], t.vertices[(i + 1) % 3]));
    }
    int count = 0;
    for (const auto& [a, b] : edges) {
      for (const MaterialTetra& t : all.triangles) {
        const auto& v = t.vertices;
        if (std::ranges::find(v, a) != v.end() || std::ranges::find(v, b) != v.end()) continue;
        if (crosses(points.at(a), points.at(b), {points.at(v[0]), points.at(v[1]), points.at(v[2])})) ++count;
      }
    }
    return count;
  }

  /// Triangles of a flat sheet that are turned over, or have no area.
  [[nodiscard]] int turned(double depth) const {
    const auto points = places(depth);
    int count = 0;
    for (const MaterialTetra& t : thin().triangles) {
      const Vec3 a = points.at(t.vertices[0]);
      const Vec3 normal = (points.at(t.vertices[1]) - a).cross(points.at(t.vertices[2]) - a);
      count += normal.z() > 0.0 ? 0 : 1;
    }
    return count;
  }

  Hosts hosts;
  Material material;
  std::vector<double> x;
};

/// A square of side 2 around a point, across a normal.
Sweep plane(const Vec3& point, const Vec3& normal) {
  const Vec3 n = normal.normalized();
  const Vec3 a = n.cross(std::abs(n.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  const Vec3 b = n.cross(a);
  std::vector<double> corners;
  for (const Vec3& corner :
       {Vec3(point - a - b), Vec3(point + a - b), Vec3(point + a + b), Vec3(point - a + b)}) {
    corners.insert(corners.end(), corner.begin(), corner.end());
  }
  const std::array<std::array<std::int32_t, 3>, 2> triangles = {{{0, 1, 2}, {0, 2, 3}}};
  return triangle_sweep(corners, triangles);
}

TEST(ThinKerfTest, EdgesOfAStraightCutStandTwoDepthsApart) {
  for (const CellType type : {CellType::triangle, CellType::quad}) {
    Thin body(sheet(type));
    body.cut(plane(Vec3(0.13, 0.1, 0), Vec3(1, 0.2, 0)));
    const Vec3 normal = Vec3(1, 0.2, 0).normalized();
    const auto before = body.places(0.0);
    int drawn = 0;
    for (const auto& [vertex, place] : body.places(kDepth)) {
      const Vec3 was = before.at(vertex);
      if (std::abs(normal.dot(was - Vec3(0.13, 0.1, 0))) > 1e-9) {
        EXPECT_EQ((place - was).norm(), 0.0);
        continue;
      }
      ++drawn;
      EXPECT_NEAR(std::abs(normal.dot(place - was)), kDepth, kRoundOff);
      EXPECT_GE(place.y(), -kRoundOff);  // ends stay in the sheet
      EXPECT_LE(place.y(), 0.2 + kRoundOff);
    }
    EXPECT_GE(drawn, 10);
    EXPECT_GT(body.crossings(0.0), 0);  // what touches counts
    EXPECT_EQ(body.crossings(kDepth), 0);
  }
}

/// A blade that ends inside: both edges share the vertices of the front.
TEST(ThinKerfTest, TheFrontOfACutStaysWhereItIs) {
  Thin body(sheet(CellType::triangle));
  body.cut(disc_sweep(Vec3(0.13, 0, 0), Vec3(1, 0, 0), 0.12));
  ASSERT_EQ(pieces(body.hosts, body.material).size(), 1U);
  const auto before = body.places(0.0);
  int front = 0;
  int drawn = 0;
  for (const auto& [vertex, place] : body.places(kDepth)) {
    if (std::abs(before.at(vertex).x() - 0.13) > 1e-9) continue;
    const double way = (place - before.at(vertex)).norm();
    if (way == 0.0) {
      ++front;
    } else {
      ++drawn;
    }
  }
  EXPECT_EQ(front, 1);
  EXPECT_GE(drawn, 4);
  EXPECT_EQ(body.crossings(kDepth), 0);
}

/// Sheets that are bent at rest, cut through at random and then across the first cut.
TEST(ThinKerfTest, NothingCrossesAfterCutsOfBentSheets) {
  int parted = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    std::uniform_real_distribution<double> in(0.2, 0.8);
    std::normal_distribution<double> any;
    Thin body(sheet(seed % 2 == 0 ? CellType::triangle : CellType::quad, seed % 3 == 0 ? 0.0 : 6.0));
    for (int number = 0; number < 3; ++number) {
      const Vec3 point = block(ConstReals(body.x), static_cast<std::int32_t>(35.0 * in(random)));
      const Vec3 normal(any(random), any(random), 0.3 * any(random));
      body.cut(number == 1 ? disc_sweep(point, normal, 0.1 * in(random))
                           : plane(point + 0.01 * normal.normalized(), normal));
      EXPECT_EQ(body.crossings(2.0 * kDepth), 0) << "seed " << seed << ", cut " << number;
    }
    parted += pieces(body.hosts, body.material).size() > 1 ? 1 : 0;
  }
  EXPECT_GT(parted, 150);
}

TEST(ThinKerfTest, EndsOfACutLineStandTwoDepthsApart) {
  Mesh mesh;
  CellBlock lines{CellType::line, {}};
  for (int i = 0; i <= 4; ++i) mesh.positions.insert(mesh.positions.end(), {0.05 * i, 0.0, 0.0});
  for (int i = 0; i < 4; ++i) lines.nodes.insert(lines.nodes.end(), {i, i + 1});
  mesh.blocks.push_back(std::move(lines));
  for (const double at : {0.12, 0.1}) {  // in a piece, and at a node
    Thin body(mesh);
    body.cut(plane(Vec3(at, 0, 0), Vec3(1, 0.3, 0)));
    ASSERT_EQ(pieces(body.hosts, body.material).size(), 2U);
    const auto before = body.places(0.0);
    int ends = 0;
    for (const auto& [vertex, place] : body.places(kDepth)) {
      const double way = (place - before.at(vertex)).norm();
      if (std::abs(before.at(vertex).x() - at) < 1e-9) {
        EXPECT_NEAR(way, kDepth, kRoundOff);
        ++ends;
      } else {
        EXPECT_EQ(way, 0.0);
      }
    }
    EXPECT_EQ(ends, 2);
  }
}

/// A sheet thinner than cells are long has its depth; a strip thinner than the depth keeps its sense.
TEST(ThinKerfTest, AThinStripKeepsItsSense) {
  Thin body(sheet(CellType::triangle));
  body.cut(plane(Vec3(0.13, 0.1, 0), Vec3(1, 0, 0)));
  body.cut(plane(Vec3(0.134, 0.1, 0), Vec3(1, 0, 0)));
  EXPECT_EQ(body.turned(0.05), 0);  // as deep as a cell
  EXPECT_EQ(body.crossings(0.05), 0);
}

/// Beside the point where two cuts meet, cells leave slivers of triangles. One that turned over would lay an
/// edge of the sheet over another triangle of it, in one plane, where no test of signs sees a crossing.
TEST(ThinKerfTest, NothingTurnsOverWhereCutsMeet) {
  int parted = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    Random random(seed);
    std::normal_distribution<double> any;
    Thin body(sheet(seed % 2 == 0 ? CellType::triangle : CellType::quad));
    for (int number = 0; number < 4; ++number) {
      const Vec3 point(0.15 + 0.03 * any(random), 0.1 + 0.02 * any(random), 0.0);
      body.cut(plane(point, Vec3(any(random), any(random), 0.2 * any(random))));
      for (const double depth : {kDepth, 5.0 * kDepth}) {
        EXPECT_EQ(body.turned(depth), 0) << "seed " << seed << ", cut " << number;
      }
    }
    EXPECT_EQ(body.crossings(kDepth), 0) << "seed " << seed;
    parted += pieces(body.hosts, body.material).size() > 4 ? 1 : 0;
  }
  EXPECT_GT(parted, 60);
}

}  // namespace
}  // namespace tissu
