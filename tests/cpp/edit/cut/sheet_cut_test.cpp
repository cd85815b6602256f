/// Sheets of triangles and of quads under random blades, and in closed forms. Every failure prints its seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/edit/cut/anchors.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/material_mesh.h"
#include "tissu/edit/topology.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;

constexpr double kRoundOff = 1e-12;

/// 0.3 x 0.2 m of 6 x 4 quads, or twice as many triangles, inner nodes moved by up to `jitter` of an edge.
Mesh grid(double jitter, Random& random, CellType type = CellType::triangle) {
  constexpr int kX = 6;
  constexpr int kY = 4;
  std::uniform_real_distribution<double> part(-jitter, jitter);
  Mesh mesh;
  for (int j = 0; j <= kY; ++j) {
    for (int i = 0; i <= kX; ++i) {
      const bool inner = i > 0 && i < kX && j > 0 && j < kY;
      const double dx = inner ? part(random) : 0.0;
      const double dy = inner ? part(random) : 0.0;
      mesh.positions.insert(mesh.positions.end(), {0.05 * (i + dx), 0.05 * (j + dy), 0.0});
    }
  }
  CellBlock block{type, {}};
  for (int j = 0; j < kY; ++j) {
    for (int i = 0; i < kX; ++i) {
      const std::int32_t a = j * (kX + 1) + i;
      if (type == CellType::quad) {
        block.nodes.insert(block.nodes.end(), {a, a + 1, a + kX + 2, a + kX + 1});
        continue;
      }
      block.nodes.insert(block.nodes.end(), {a, a + 1, a + kX + 2, a, a + kX + 2, a + kX + 1});
    }
  }
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

struct Sheet {
  explicit Sheet(const Mesh& mesh) : hosts(mesh), x(mesh.positions) {}

  CutPlan cut(const Sweep& sweep) {
    CutPlan plan = plan_cut(hosts, material, x, sweep);
    hosts.apply(plan);
    material.apply(plan);
    for (const BornNode& node : plan.nodes) {
      const Vec3 place = block(ConstReals(x), node.copied);
      x.insert(x.end(), place.begin(), place.end());
    }
    return plan;
  }

  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (const Piece& piece : pieces(hosts, material)) sum += piece.volume;
    return sum;
  }

  /// The first thing that is not as it must be, empty when all is.
  [[nodiscard]] std::string fault(double whole) const {
    if (std::abs(area() - whole) > kRoundOff * whole) return "the area is " + std::to_string(area());
    for (const Rider& rider : material.riders) {
      double sum = 0.0;
      for (std::size_t k = 0; k < at(rider.count); ++k) sum += rider.weight[k];
      if (std::abs(sum - 1.0) > kRoundOff) return "weights sum to " + std::to_string(sum);
    }
    std::map<std::int32_t, double> shares;
    std::map<std::set<std::int32_t>, int> sides;
    for (const std::int32_t cell : hosts.numbers()) {
      shares[hosts.origin(cell)] += hosts.share(cell);
      double own = 0.0;
      for (const MaterialTetra& triangle : material_of(hosts, material, cell)) {
        if (triangle.corners() != 3) return "a triangle has four corners";
        own += rest_volume(hosts, material, cell, triangle);
        for (std::size_t i = 0; i < 3; ++i) {
          if ((triangle.cut >> i & 1U) != 0) continue;
          ++sides[{triangle.vertices[(i + 1) % 3], triangle.vertices[(i + 2) % 3]}];
        }
      }
      const double expected = hosts.share(cell) * first_area(cell);
      if (std::abs(own - expected) > kRoundOff * whole) return "a share differs from its material";
    }
    for (const auto& [origin, sum] : shares) {
      if (std::abs(sum - 1.0) > kRoundOff) return "shares sum to " + std::to_string(sum);
    }
    for (const auto& [side, count] : sides) {
      if (count > 2 || side.size() != 2) return "an edge has " + std::to_string(count) + " triangles";
    }
    return {};
  }

  [[nodiscard]] double first_area(std::int32_t cell) const {
    double sum = 0.0;
    for (const MaterialTetra& whole : whole_material(hosts, cell)) {
      sum += rest_volume(hosts, material, cell, whole);
    }
    return sum;
  }

  Hosts hosts;
  Material material;
  std::vector<double> x;
};

Sweep random_blade(Random& random, const Sheet& sheet) {
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  Vec3 center(0.15 + 0.15 * part(random), 0.1 + 0.1 * part(random), 0.01 * part(random));
  if (random() % 3 == 0) center = block(ConstReals(sheet.x), static_cast<std::int32_t>(random() % 35));
  Vec3 normal(part(random), part(random), 0.5 * part(random));
  if (random() % 3 == 0) normal = Vec3::Unit(static_cast<int>(random() % 2));
  if (random() % 4 == 0) return plane_sweep(center, normal, Vec3(0, 0, -0.1), Vec3(0.3, 0.2, 0.1));
  return disc_sweep(center, normal, 0.02 + 0.1 * std::abs(part(random)));
}

TEST(SheetCutTest, RandomBladesKeepEveryInvariant) {
  constexpr double kArea = 0.06;
  int cuts = 0;
  for (std::uint64_t seed = 1; cuts < 500; ++seed) {
    Random random(seed);
    Sheet sheet(grid(seed % 3 == 0 ? 0.0 : 0.2, random, seed % 5 < 2 ? CellType::quad : CellType::triangle));
    for (std::int32_t node = 0; seed % 2 == 0 && node < sheet.hosts.node_count(); ++node) {
      Vec3 place = block(ConstReals(sheet.x), node);
      place.z() = 0.2 * place.x() * place.x() - 0.1 * place.y();
      block(Reals(sheet.x), node) = place;
    }
    for (int i = 0; i < 10; ++i, ++cuts) {
      sheet.cut(random_blade(random, sheet));
      ASSERT_EQ(sheet.fault(kArea), "") << "seed " << seed << ", cut " << i;
    }
  }
}

TEST(SheetCutTest, APlanePartsItAtItsPlace) {
  Random random(7);
  Sheet sheet(grid(0.2, random));
  const CutPlan plan = sheet.cut(plane_sweep({0.13, 0, 0}, {1, 0, 0}, {0, 0, -0.1}, {0.3, 0.2, 0.1}));
  const std::vector<Piece> found = pieces(sheet.hosts, sheet.material);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(std::min(found[0].volume, found[1].volume), 0.13 * 0.2, kRoundOff);
  EXPECT_NEAR(plan.area, 0.2, kRoundOff);  // of a sheet of thickness 1
}

TEST(SheetCutTest, AQuadIsCutAtItsLowestNode) {
  Random random(7);
  const Sheet sheet(grid(0.0, random, CellType::quad));
  const std::vector<MaterialTetra> halves = whole_material(sheet.hosts, 0);
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_EQ(halves[0].vertices, (std::array<std::int32_t, 4>{0, 1, 8, kNoVertex}));
  EXPECT_EQ(halves[1].vertices, (std::array<std::int32_t, 4>{0, 8, 7, kNoVertex}));
}

TEST(SheetCutTest, TheMaterialComesBackFromItsLists) {
  Random random(3);
  Sheet sheet(grid(0.2, random));
  for (int i = 0; i < 5; ++i) sheet.cut(random_blade(random, sheet));
  const PackedMaterial packed = pack(sheet.material);
  const Material again = unpack(packed, sheet.hosts.node_count());
  ASSERT_FALSE(again.cells.empty());
  EXPECT_EQ(pack(again).vertices, packed.vertices);
  PackedMaterial wrong = packed;
  wrong.vertices[0] = kNoVertex;
  EXPECT_THROW((void)unpack(wrong, sheet.hosts.node_count()), ParameterError);
}

TEST(SheetCutTest, APointNearASheetKeepsItsOffset) {
  Random random(3);
  const Sheet sheet(grid(0.0, random));
  const std::vector<double> points{0.11, 0.07, 0.01, 0.11, 0.07, 0.2};
  const std::vector<Anchor> found = anchors(sheet.hosts, sheet.material, sheet.x, points);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].inside);
  EXPECT_LT((found[0].offset - Vec3(0, 0, 0.01)).norm(), kRoundOff);
  EXPECT_LT((found[0].rider.at(sheet.x) - Vec3(0.11, 0.07, 0)).norm(), kRoundOff);
  EXPECT_FALSE(found[1].inside);
}

}  // namespace
}  // namespace tissu
