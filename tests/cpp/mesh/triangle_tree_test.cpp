#include "tissu/mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<double> random_triangles(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::vector<double> corners;
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 at(place(random), place(random), place(random));
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) corners.push_back(at[axis] + 0.2 * place(random));
    }
  }
  return corners;
}

/// The nearest point by trying a triangle's points on a fine net, refined around the best one.
double searched(const Vec3& p, const double* corners) {
  const Eigen::Map<const Mat3> abc(corners);
  double u0 = 0.5;
  double v0 = 0.5;
  double best = kFar;
  for (double width = 0.5; width > 1e-9; width *= 0.5) {
    double u_best = u0;
    double v_best = v0;
    for (int i = -4; i <= 4; ++i) {
      for (int j = -4; j <= 4; ++j) {
        const double u = std::clamp(u0 + 0.25 * i * width, 0.0, 1.0);
        const double v = std::clamp(v0 + 0.25 * j * width, 0.0, 1.0 - u);
        const Vec3 place = abc.col(0) + u * (abc.col(1) - abc.col(0)) + v * (abc.col(2) - abc.col(0));
        const double square = (place - p).squaredNorm();
        if (square < best) {
          best = square;
          u_best = u;
          v_best = v;
        }
      }
    }
    u0 = u_best;
    v0 = v_best;
  }
  return std::sqrt(best);
}

TEST(TriangleTreeTest, ThePlaceOnOneTriangleIsTheNearestOfAll) {
  std::mt19937 random(1);
  const std::vector<double> corners = random_triangles(200, random);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (std::size_t t = 0; t < 200; ++t) {
    const Vec3 p(place(random), place(random), place(random));
    const double found = (closest_on_triangle(p, &corners[9 * t]) - p).norm();
    const double other = searched(p, &corners[9 * t]);
    // The search ends on a net of 1e-9, and is never nearer than the nearest.
    EXPECT_LE(found, other + 1e-15);
    EXPECT_NEAR(found, other, 1e-8);
  }
}

TEST(TriangleTreeTest, OfATriangleWithoutAreaItIsTheEdges) {
  const std::vector<double> line = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  EXPECT_EQ(closest_on_triangle(Vec3(1.5, 2, 0), line.data()), Vec3(1.5, 0, 0));
  const std::vector<double> point = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(closest_on_triangle(Vec3(3, 1, 1), point.data()), Vec3(1, 1, 1));
}

TEST(TriangleTreeTest, NoTriangleIsNearerThanTheOneFound) {
  std::mt19937 random(2);
  for (const std::size_t count : {1U, 4U, 5U, 333U}) {
    const std::vector<double> corners = random_triangles(count, random);
    const TriangleTree tree(corners);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    std::int32_t last = -1;
    for (int i = 0; i < 500; ++i) {
      const Vec3 p(place(random), place(random), place(random));
      double least = kFar;
      for (std::size_t t = 0; t < count; ++t) {
        least = std::min(least, (closest_on_triangle(p, &corners[9 * t]) - p).squaredNorm());
      }
      const TriangleTree::Nearest found = tree.nearest(p, kFar, last);
      EXPECT_EQ(found.square, least);
      EXPECT_EQ(found.place, tree.nearest(p, kFar).place);  // the hint changes no answer
      last = found.leaf;
    }
  }
}

TEST(TriangleTreeTest, OfTrianglesEquallyNearTheFirstIsTaken) {
  // The same triangle ten times to the left and ten times to the right of the points x = 0.
  std::vector<double> corners;
  for (int copy = 0; copy < 20; ++copy) {
    const double x = copy % 2 == 0 ? 1.0 : -1.0;
    for (const double number : {x, 0.0, 0.0, x, 1.0, 0.0, x, 0.0, 1.0}) corners.push_back(number);
  }
  const TriangleTree tree(corners);
  for (const std::int32_t hint : {-1, 0, 7, 19}) {
    EXPECT_EQ(tree.nearest(Vec3(0.0, 0.25, 0.25), kFar, hint).place, Vec3(1.0, 0.25, 0.25));
  }
}

TEST(TriangleTreeTest, BeyondTheReachThereIsNothing) {
  const std::vector<double> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const TriangleTree tree(corners);
  EXPECT_EQ(tree.nearest(Vec3(0.25, 0.25, 2.0), 2.0).square, 4.0);
  const TriangleTree::Nearest none = tree.nearest(Vec3(0.25, 0.25, 2.0), 1.999);
  EXPECT_EQ(none.leaf, -1);
  EXPECT_EQ(none.square, kFar);
  EXPECT_TRUE(none.place.hasNaN());
}

TEST(TriangleTreeTest, WithoutTrianglesItIsRefused) {
  EXPECT_THROW(TriangleTree(std::vector<double>{}), MeshError);
  EXPECT_THROW(TriangleTree(std::vector<double>(8, 0.0)), MeshError);
}

}  // namespace
}  // namespace tissu
