#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "edit/cut/patch.h"

namespace tissu {
namespace {

constexpr std::array<std::array<std::int32_t, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A tetrahedron, of nodes 0 to 3, and one behind each of its faces.
Mesh star() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.6, 0.7, 0.8, -1, 0.3, 0.4, 0.2, -1, 0.3, 0.3, 0.4, -1},
          {{CellType::tetra, {0, 1, 2, 3, 4, 2, 1, 3, 5, 0, 2, 3, 6, 1, 0, 3, 7, 0, 1, 2}}}};
}

double area(const Patch& patch, const std::array<std::int32_t, 3>& face) {
  const Vec3& a = patch.vertex(face[0]).rest;
  return 0.5 * (patch.vertex(face[1]).rest - a).cross(patch.vertex(face[2]).rest - a).norm();
}

/// Faces by their vertices: how many tetrahedra have each.
std::map<std::array<std::int32_t, 3>, int> faces_of(const Patch& patch) {
  std::map<std::array<std::int32_t, 3>, int> faces;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    for (const auto& [i, j, k] : kOpposite) {
      std::array<std::int32_t, 3> key{tetra.vertices[i], tetra.vertices[j], tetra.vertices[k]};
      std::ranges::sort(key);
      ++faces[key];
    }
  }
  return faces;
}

double border_area(const Patch& patch) {
  double sum = 0.0;
  for (const auto& [face, count] : faces_of(patch)) sum += count == 1 ? area(patch, face) : 0.0;
  return sum;
}

/// Divides edges of the middle tetrahedron in an order, and looks at what is left of it and its neighbours.
/// Returns into how many the middle one was divided.
int divide_all(const Hosts& hosts, const std::vector<int>& order, const std::array<double, 6>& shares) {
  const tissu::Material material;
  Patch patch(hosts, material, hosts.rest(), hosts.numbers());
  double volume = 0.0;
  for (const Patch::Tetra& tetra : patch.tetrahedra) volume += patch.rest_volume(tetra);
  const double border = border_area(patch);
  for (const int e : order) {
    const auto edge = static_cast<std::size_t>(e);
    patch.divide(patch.place_of(kEdges[edge][0]), patch.place_of(kEdges[edge][1]), shares[edge]);
  }
  double divided = 0.0;
  int children = 0;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    EXPECT_GT(patch.rest_volume(tetra), 0.0);
    divided += patch.rest_volume(tetra);
    children += tetra.cell == patch.cell_of(0) ? 1 : 0;
  }
  EXPECT_NEAR(divided, volume, 1e-14);  // round-off of some fifty tetrahedra of volumes below 1
  for (const auto& [face, count] : faces_of(patch)) EXPECT_LE(count, 2);
  EXPECT_NEAR(border_area(patch), border, 1e-13);  // else a face would lack its neighbour
  for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
    for (const std::int32_t t : patch.tetrahedra_at(static_cast<std::int32_t>(v))) {
      EXPECT_TRUE(std::ranges::count(patch.tetra(t).vertices, static_cast<std::int32_t>(v)) == 1);
    }
  }
  return children;
}

TEST(BisectTest, EveryPatternInEveryOrderIsConforming) {
  const Hosts hosts(star());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0.02, 0.98);
  int orders = 0;
  for (unsigned pattern = 0; pattern < 64; ++pattern) {
    std::vector<int> order;
    for (int e = 0; e < 6; ++e) {
      if ((pattern >> e & 1U) != 0) order.push_back(e);
    }
    do {
      std::array<double, 6> shares{};
      for (double& t : shares) t = share(random);
      const int children = divide_all(hosts, order, shares);
      EXPECT_GE(children, static_cast<int>(order.size()) + (order.size() > 2 ? 0 : 1));
      EXPECT_LE(children, order.size() == 6 ? 8 : order.size() == 5 ? 7 : 6);
      ++orders;
    } while (std::ranges::next_permutation(order).found);
  }
  EXPECT_EQ(orders, 1 + 6 + 30 + 120 + 360 + 720 + 720);
}

/// Of two edges of a face one child has both ends of the other: three children, whatever the order; of two
/// that are opposite, four.
TEST(BisectTest, CountsOfChildrenAreThoseOfTheTable) {
  const Hosts hosts(star());
  const std::array<double, 6> halves{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  const std::array<double, 6> thirds{0.3, 0.4, 0.35, 0.3, 0.4, 0.3};
  const std::map<std::vector<int>, int> expected{
      {{}, 1},        {{0}, 2},       {{0, 1}, 3},       {{0, 5}, 4},  // one face; opposite
      {{0, 1, 2}, 4}, {{0, 1, 3}, 4}, {{1, 2, 3, 4}, 6},               // of one node; of a face; a cycle
  };
  for (const auto& [edges, children] : expected) {
    std::vector<int> order = edges;
    do {
      EXPECT_EQ(divide_all(hosts, order, halves), children);
      EXPECT_EQ(divide_all(hosts, order, thirds), children);
    } while (std::ranges::next_permutation(order).found);
  }
}

TEST(BisectTest, AnOpenedFaceStaysOpenWhenItIsDivided) {
  const Hosts hosts(star());
  const tissu::Material material;
  Patch patch(hosts, material, hosts.rest(), {0});
  patch.tetrahedra[0].cut = 0b1000;  // the face 0 1 2
  patch.divide(patch.place_of(0), patch.place_of(1), 0.25);
  double open = 0.0;
  for (const Patch::Tetra& tetra : patch.tetrahedra) {
    for (std::size_t f = 0; f < 4; ++f) {
      if ((tetra.cut >> f & 1U) == 0) continue;
      const auto& [i, j, k] = kOpposite[f];
      open += area(patch, {tetra.vertices[i], tetra.vertices[j], tetra.vertices[k]});
      for (const std::size_t c : {i, j, k}) EXPECT_EQ(patch.vertex(tetra.vertices[c]).rest[2], 0.0);
    }
  }
  EXPECT_NEAR(open, 0.5, 1e-15);
}

}  // namespace
}  // namespace tissu
