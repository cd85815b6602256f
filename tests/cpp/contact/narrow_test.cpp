#include "contact/narrow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "../world/sample_worlds.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

constexpr double kGap = 0.01;
constexpr double kReach = 2.0 * kGap;

/// Two boxes of 1 m, the upper one a distance above the lower one and turned about the vertical axis through
/// their middles.
struct TwoBoxes {
  ContactDescription description;
  std::vector<double> positions;
  std::int32_t nodes = 0;

  TwoBoxes(int cells, double distance, double angle) {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(1, 1, 1), {cells, cells, cells}, Split::six);
    nodes = mesh.node_count();
    SurfaceDescription surface{.name = "low", .closed = true};
    surface.triangles = boundary_surface(mesh).triangles;
    description.bodies = {surface, surface};
    description.bodies[1].name = "high";
    description.pairs = {{.a = 0, .b = 1, .gap = kGap}};
    positions = mesh.positions;
    const Vec3 middle(0.5, 0.5, 0.0);
    for (std::int32_t i = 0; i < nodes; ++i) {
      const Vec3 r = mesh.node(i) - middle;
      const Vec3 turned(std::cos(angle) * r.x() - std::sin(angle) * r.y(),
                        std::sin(angle) * r.x() + std::cos(angle) * r.y(), r.z() + 1.0 + distance);
      for (const double x : Vec3(turned + middle)) positions.push_back(x);
    }
  }
  [[nodiscard]] SurfaceSet set() const {
    const std::vector<std::int32_t> first = {0, nodes};
    return {description, first, positions};
  }
  [[nodiscard]] std::vector<Found> contacts(const SurfaceSet& set) const {
    Candidates candidates(description, set);
    candidates.cover(positions, positions);
    std::vector<Found> found;
    for (const Candidate& candidate : candidates.list()) {
      Found one{};
      if (find_contact(set, set.rest(), candidate, kReach, one)) found.push_back(one);
    }
    return found;
  }
};

/// Area of two unit squares on each other, one turned by an angle up to 45 degrees.
double overlap(double angle) {
  if (angle < 1e-9) return 1.0;
  // Four triangles with a hypotenuse along the other square's edges are cut off each of them.
  const double leg = (std::cos(angle) + std::sin(angle) - 1.0) / (std::sin(angle) * std::cos(angle));
  return 1.0 - 0.5 * leg * leg * std::sin(angle) * std::cos(angle) * 4.0;
}

class ParallelFaces : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(ParallelFaces, AreFoundOnceAndUpright) {
  const auto [cells, angle] = GetParam();
  const double distance = 0.015;
  const TwoBoxes boxes(cells, distance, angle);
  const SurfaceSet set = boxes.set();
  const std::vector<Found> found = boxes.contacts(set);
  ASSERT_FALSE(found.empty());
  std::set<std::tuple<int, std::int32_t, std::int32_t>> keys;
  std::set<std::int32_t> of_vertices;
  for (const Found& one : found) {
    EXPECT_TRUE(keys.insert({static_cast<int>(one.kind), one.a, one.b}).second) << "found twice";
    EXPECT_NEAR(one.distance, distance, 1e-12);
    EXPECT_NEAR(std::abs(one.r.z()), distance, 1e-12);
    double sum = 0.0;
    for (const double beta : one.beta) sum += beta;
    EXPECT_NEAR(sum, 0.0, 1e-14);
    EXPECT_GT(one.weight, 0.0);
    EXPECT_LE(one.weight, 1.0);
    // A vertex before a flat face meets one of its parts.
    if (one.kind == PairKind::edge_edge) continue;
    if (one.kind != PairKind::vertex_vertex) {
      EXPECT_TRUE(of_vertices.insert(one.a).second) << "vertex " << one.a << " meets two parts";
    }
  }
}

TEST_P(ParallelFaces, TheContactsOfVerticesHaveTheAreaOfTheOverlap) {
  const auto [cells, angle] = GetParam();
  const TwoBoxes boxes(cells, 0.015, angle);
  const SurfaceSet set = boxes.set();
  double area = 0.0;
  for (const Found& one : boxes.contacts(set)) {
    if (one.kind == PairKind::edge_edge) continue;
    // Of two vertices one finds the other: theirs is the area of both.
    area += one.kind == PairKind::vertex_vertex ? 2.0 * one.area : one.area;
  }
  // Vertices on the rim count the area of their side faces too, and those near the rim of the overlap all
  // or nothing: an edge's width along it.
  const double rim = 4.0 / cells;
  EXPECT_NEAR(area, overlap(angle), rim);
  EXPECT_GT(area, 0.5 * overlap(angle));
}

INSTANTIATE_TEST_SUITE_P(Turned, ParallelFaces,
                         testing::Combine(testing::Values(2, 5),
                                          testing::Values(0.0, 1e-12, 1e-3, 0.25 * std::numbers::pi)));

TEST(NarrowTest, NothingIsFoundFromInside) {
  // The upper box is sunk into the lower one: its bottom lies 1 cm below the other's top.
  const TwoBoxes boxes(2, -0.01, 0.1);
  const SurfaceSet set = boxes.set();
  for (const Found& one : boxes.contacts(set)) {
    EXPECT_NE(one.kind, PairKind::vertex_face) << "a vertex behind a face of a closed surface";
  }
}

}  // namespace
}  // namespace tissu
