/// Places that go with the material.

#include "tissu/edit/cut/anchors.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "cut_body.h"
#include "tissu/mesh/box.h"

namespace tissu {
namespace {

constexpr std::array kCells{8, 4, 4};
const Vec3 kSize(2, 1, 1);

std::vector<double> random_points(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> share(0.01, 0.99);
  std::vector<double> points;
  for (int i = 0; i < count; ++i) {
    for (const Eigen::Index k : {0, 1, 2}) points.push_back(share(random) * kSize[k]);
  }
  return points;
}

/// An affine map of everything takes points in the material along exactly, whatever cuts left of the cells.
TEST(AnchorsTest, PointsInTheMaterialGoWithIt) {
  std::mt19937_64 random(5);
  for (const CellType type : {CellType::tetra, CellType::hexahedron, CellType::wedge}) {
    test::CutBody body(test::typed_box(type, kSize, kCells, 0.1, 7));
    const auto check = [&] {
      const std::vector<double> points = random_points(random, 50);
      const std::vector<Anchor> found = anchors(body.hosts, body.material, body.x, points);
      Mat3 A;
      A << 1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.2;
      const Vec3 b(3, -1, 2);
      std::vector<double> moved(body.x.size());
      for (std::int32_t i = 0; i < body.hosts.node_count(); ++i)
        block(Reals(moved), i) = A * block(ConstReals(body.x), i) + b;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Vec3 p = block(ConstReals(points), static_cast<std::int32_t>(i));
        const auto& weights = found[i].rider.weight;
        ASSERT_TRUE(found[i].inside);
        EXPECT_EQ(found[i].offset, Vec3::Zero());
        EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-14);
        EXPECT_LT((found[i].rider.at(body.x) - p).norm(), 1e-13);
        EXPECT_LT((found[i].rider.at(moved) - (A * p + b)).norm(), 1e-12);
      }
    };
    check();
    body.cut(body.plane(Vec3(1.01, 0, 0), Vec3(1, 0.2, 0.1)));
    body.cut(disc_sweep(Vec3(0.5, 0.5, 0.5), Vec3(0.1, 0.2, 1), 0.4));
    check();
  }
}

/// Points beside the material keep their offset from the nearest node, by brute force.
TEST(AnchorsTest, PointsBesideKeepTheirOffset) {
  const test::CutBody body(test::typed_box(CellType::tetra, kSize, kCells, 0.1, 7));
  const std::vector<double> points{-0.3, 0.5, 0.5, 1.0, 1.2, 0.3, 40, 2, 2};
  const std::vector<Anchor> found = anchors(body.hosts, body.material, body.x, points);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 p = block(ConstReals(points), static_cast<std::int32_t>(i));
    double least = 1e9;
    for (std::int32_t node = 0; node < body.hosts.node_count(); ++node)
      least = std::min(least, (block(ConstReals(body.x), node) - p).norm());
    EXPECT_FALSE(found[i].inside);
    EXPECT_EQ(found[i].rider.count, 1);
    EXPECT_NEAR(found[i].offset.norm(), least, 1e-14);
    EXPECT_LT((found[i].rider.at(body.x) + found[i].offset - p).norm(), 1e-14);
  }
}

/// Of the tetrahedra that share a face the result does not depend on the order of points.
TEST(AnchorsTest, TheOrderOfPointsDoesNotMatter) {
  const test::CutBody body(box_mesh(Vec3::Zero(), kSize, {4, 2, 2}, Split::six));
  const std::vector<double> points{0.5, 0.5, 0.5, 0.75, 0.25, 0.25, 1.0, 0.3, 0.1};
  std::vector<double> turned(points.rbegin(), points.rend());
  for (std::size_t i = 0; i < turned.size(); i += 3) std::swap(turned[i], turned[i + 2]);
  const auto one = anchors(body.hosts, body.material, body.x, points);
  const auto other = anchors(body.hosts, body.material, body.x, turned);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].rider.node, other[one.size() - 1 - i].rider.node);
    EXPECT_EQ(one[i].rider.weight, other[one.size() - 1 - i].rider.weight);
  }
}

}  // namespace
}  // namespace tissu
