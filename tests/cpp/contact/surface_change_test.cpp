#include "tissu/contact/surface_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tissu/base/index.h"
#include "tissu/mesh/box.h"
#include "tissu/mesh/topology.h"

/// Two boxes of tetrahedra of which cells go: features are matched by their nodes, which are looked up here
/// one by one.
namespace tissu {
namespace {

constexpr double kRoundOff = 1e-15;

struct Boxes {
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 2, 2), {3, 2, 2}, Split::six);
  std::vector<double> positions;

  Boxes() {
    positions = mesh.positions;
    positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
  }
  /// The surfaces where the second box has lost some of its cells.
  [[nodiscard]] SurfaceSet without(const std::set<std::int32_t>& gone) const {
    ContactDescription description;
    Mesh left = mesh;
    left.blocks[0].nodes.clear();
    for (std::int32_t i = 0; i < mesh.cell_count(); ++i) {
      const auto cell = mesh.blocks[0].cell(i);
      if (!gone.contains(i))
        left.blocks[0].nodes.insert(left.blocks[0].nodes.end(), cell.begin(), cell.end());
    }
    SurfaceDescription one{.name = "one", .closed = true};
    one.triangles = boundary_surface(mesh).triangles;
    SurfaceDescription other{.name = "other", .closed = true};
    other.triangles = boundary_surface(left).triangles;
    description.bodies = {one, other};
    const std::vector<std::int32_t> first = {0, mesh.node_count()};
    return {description, first, positions};
  }
};

/// Rows of some vertices: a node of one of the bodies.
template <std::size_t n>
std::set<std::int32_t> rows(const SurfaceSet& set, const std::array<std::int32_t, n>& vertices) {
  std::set<std::int32_t> all;
  for (const std::int32_t v : vertices) all.insert(set.vertices()[at(v)].row);
  return all;
}

/// Each feature before has the one with the same rows afterwards, and none where there is none.
template <class Feature, class Number>
void require_matched(const SurfaceSet& before, const SurfaceSet& after, const std::vector<Feature>& those,
                     const std::vector<Feature>& these, Number&& number) {
  std::size_t gone = 0;
  for (std::size_t i = 0; i < those.size(); ++i) {
    const auto wanted = rows(before, those[i].vertex);
    const auto found = std::ranges::find_if(
        these, [&](const Feature& feature) { return rows(after, feature.vertex) == wanted; });
    const std::int32_t expected =
        found == these.end() ? -1 : static_cast<std::int32_t>(found - these.begin());
    ASSERT_EQ(number(static_cast<std::int32_t>(i)), expected) << i;
    gone += expected < 0 ? 1 : 0;
  }
  EXPECT_GT(gone, 0U);
  EXPECT_LT(gone, those.size());
}

TEST(SurfaceChangeTest, FeaturesAreFoundByTheirNodes) {
  const Boxes boxes;
  const SurfaceSet before = boxes.without({});
  const SurfaceSet after = boxes.without({0, 1, 2, 3, 4, 5, 13, 30, 31, 70});
  const SurfaceChange change(before, after);
  require_matched(before, after, before.edges(), after.edges(),
                  [&](std::int32_t i) { return change.edge(i); });
  require_matched(before, after, before.primitives(), after.primitives(),
                  [&](std::int32_t i) { return change.primitive(i); });
  for (std::size_t v = 0; v < before.vertices().size(); ++v) {
    const std::int32_t now = change.vertex(static_cast<std::int32_t>(v));
    const auto& all = after.vertices();
    if (now >= 0) {
      EXPECT_EQ(all[at(now)].row, before.vertices()[v].row);
    } else {
      EXPECT_EQ(std::ranges::find(all, before.vertices()[v].row, &SurfaceVertex::row), all.end());
    }
  }
}

TEST(SurfaceChangeTest, NothingRemovedChangesNoNumber) {
  const Boxes boxes;
  const SurfaceSet before = boxes.without({});
  const SurfaceChange change(before, before);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(before.edges().size()); ++i) {
    EXPECT_EQ(change.edge(i), i);
  }
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(before.primitives().size()); ++i) {
    EXPECT_EQ(change.primitive(i), i);
  }
}

/// Two cubes that share an edge alone have an edge there each, between the same nodes.
TEST(SurfaceChangeTest, OfTheWedgesAtAnEdgeEachIsFound) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 2, 1), {2, 2, 1}, Split::none);
  Mesh two{mesh.positions, {{CellType::hexahedron, {}}}};
  for (const std::int32_t i : {0, 3}) {
    const auto cell = mesh.blocks[0].cell(i);
    two.blocks[0].nodes.insert(two.blocks[0].nodes.end(), cell.begin(), cell.end());
  }
  ContactDescription description;
  SurfaceDescription surface{.name = "two", .closed = true};
  const Surface outer = boundary_surface(two);
  for (const auto& [a, b, c, d] : outer.quads) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
  description.bodies = {surface};
  const std::vector<std::int32_t> first = {0};
  const SurfaceSet set(description, first, mesh.positions);
  const SurfaceChange change(set, set);
  std::set<std::set<std::int32_t>> ends;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(set.edges().size()); ++i) {
    EXPECT_EQ(change.edge(i), i);
    const auto& [a, b] = set.edges()[at(i)].vertex;
    ends.insert({a, b});
  }
  EXPECT_EQ(ends.size() + 1, set.edges().size());
}

/// A contact between two edges of the second box.
ContactNumbers between_edges(const SurfaceSet& set, std::int32_t a, std::int32_t b) {
  ContactNumbers c;
  c.kind = static_cast<double>(PairKind::edge_edge);
  c.a = a;
  c.b = b;
  const SurfaceEdge& e = set.edges()[at(a)];
  const SurfaceEdge& f = set.edges()[at(b)];
  c.vertex = {static_cast<double>(e.vertex[0]), static_cast<double>(e.vertex[1]),
              static_cast<double>(f.vertex[0]), static_cast<double>(f.vertex[1])};
  c.beta = {0.75, 0.25, -0.5, -0.5};
  c.normal = {0.6, 0.0, 0.8};
  c.push = {3.0, 1.0, 4.0};
  return c;
}

/// sum beta p . n, and the force on every row.
std::vector<double> meaning(const SurfaceSet& set, const ContactNumbers& c,
                            const std::vector<double>& positions) {
  std::vector<double> forces(positions.size(), 0.0);
  Vec3 r = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t row = set.vertices()[static_cast<std::size_t>(c.vertex[k])].row;
    r += c.beta[k] * block(ConstReals(positions), row);
    block(Reals(forces), row) += c.beta[k] * vector_of(c.push);
  }
  forces.push_back(r.dot(vector_of(c.normal)));
  return forces;
}

/// Contacts of two edges of one body turn round where the order of their triangles does: what they mean
/// stays, and the key is the one under which detection looks for them.
TEST(SurfaceChangeTest, EdgesOfOneBodyStandInTheOrderOfTheirTriangles) {
  const Boxes boxes;
  const SurfaceSet before = boxes.without({});
  const SurfaceSet after = boxes.without({0, 1, 2, 3, 4, 5, 13, 30, 31, 70});
  const SurfaceChange change(before, after);
  const auto owner = [](const SurfaceSet& set, std::int32_t e) { return set.edges()[at(e)].face[0]; };
  const std::int32_t first = before.surfaces()[1].first_vertex;
  int turned = 0;
  int kept = 0;
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(before.edges().size()); ++a) {
    if (before.edges()[at(a)].vertex[0] < first) continue;
    for (std::int32_t b = 0; b < static_cast<std::int32_t>(before.edges().size()); ++b) {
      if (before.edges()[at(b)].vertex[0] < first || owner(before, a) >= owner(before, b)) continue;
      ContactNumbers c = between_edges(before, a, b);
      const std::vector<double> then = meaning(before, c, boxes.positions);
      if (!change.carry(c)) {
        EXPECT_TRUE(change.edge(a) < 0 || change.edge(b) < 0);
        continue;
      }
      EXPECT_LE(owner(after, static_cast<std::int32_t>(c.a)), owner(after, static_cast<std::int32_t>(c.b)));
      turned += static_cast<std::int32_t>(c.a) == change.edge(b) ? 1 : 0;
      kept += static_cast<std::int32_t>(c.a) == change.edge(a) ? 1 : 0;
      const std::vector<double> now = meaning(after, c, boxes.positions);
      for (std::size_t i = 0; i < then.size(); ++i) ASSERT_NEAR(then[i], now[i], 10 * kRoundOff);
    }
  }
  EXPECT_GT(turned, 0);
  EXPECT_GT(kept, turned);
}

TEST(SurfaceChangeTest, AContactGoesWithAnyOfItsParts) {
  const Boxes boxes;
  const SurfaceSet before = boxes.without({});
  const SurfaceSet after = boxes.without({0, 1, 2, 3, 4, 5});
  const SurfaceChange change(before, after);
  int gone = 0;
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(before.primitives().size()); ++p) {
    if (before.surface_of_primitive(p) != 1) continue;
    const auto& corners = before.primitives()[at(p)].vertex;
    ContactNumbers c;
    c.kind = static_cast<double>(PairKind::vertex_face);
    c.a = 0.0;
    c.b = p;
    c.vertex = {0.0, static_cast<double>(corners[0]), static_cast<double>(corners[1]),
                static_cast<double>(corners[2])};
    ContactNumbers point = c;
    point.point = 11.0;
    const bool stays = change.primitive(p) >= 0;
    EXPECT_EQ(change.carry(c), stays);
    EXPECT_EQ(change.carry(point), stays);  // its triangle begins with the same corner
    gone += stays ? 0 : 1;
  }
  EXPECT_GT(gone, 4);
}

}  // namespace
}  // namespace tissu
