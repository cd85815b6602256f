#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../base/differences.h"
#include "../base/random.h"
#include "tissu/element/generated/hexahedron.h"
#include "tissu/element/generated/tetra.h"

namespace tissu {
namespace {

using Point = std::array<double, 3>;

std::array<Point, 4> corners(Tetra4 /*element*/) { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

/// VTK: the bottom quadrangle, anticlockwise seen from the top, then the top one.
std::array<Point, 8> corners(Hexahedron8 /*element*/) {
  return {
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
}

template <class Element>
class ElementTest : public testing::Test {
 protected:
  Point any_point() { return {random_.number(), random_.number(), random_.number()}; }
  test::Random random_{5};
};

using Elements = testing::Types<Tetra4, Hexahedron8>;
TYPED_TEST_SUITE(ElementTest, Elements);

// Sums of eight products of numbers below 8: 1e-15; one digit more.
TYPED_TEST(ElementTest, IsPartitionOfUnity) {
  for (int i = 0; i < 20; ++i) {
    const Point xi = this->any_point();
    double sum = 0.0;
    Vec3 gradient = Vec3::Zero();
    const auto dN = TypeParam::gradients(xi);
    for (const double N : TypeParam::values(xi)) sum += N;
    for (const auto& d : dN) gradient += Eigen::Map<const Vec3>(d.data());
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_LT(gradient.norm(), 1e-14);
  }
}

TYPED_TEST(ElementTest, IsOneAtItsNodeAndZeroAtTheOthers) {
  const auto nodes = corners(TypeParam{});
  ASSERT_EQ(nodes.size(), static_cast<std::size_t>(TypeParam::kNodes));
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    const auto N = TypeParam::values(nodes[b]);
    for (std::size_t a = 0; a < N.size(); ++a) EXPECT_EQ(N[a], a == b ? 1.0 : 0.0) << a << " at " << b;
  }
}

TYPED_TEST(ElementTest, ReproducesPositions) {
  const auto nodes = corners(TypeParam{});
  const Point xi = this->any_point();
  Vec3 x = Vec3::Zero();
  const auto N = TypeParam::values(xi);
  for (std::size_t a = 0; a < nodes.size(); ++a) x += N[a] * Eigen::Map<const Vec3>(nodes[a].data());
  EXPECT_LT((x - Eigen::Map<const Vec3>(xi.data())).norm(), 1e-14);
}

// The values are linear along each axis, so the differences are exact but for round-off: 1e-16 / 1e-2.
TYPED_TEST(ElementTest, GradientsAreDerivativesOfValues) {
  for (int i = 0; i < 20; ++i) {
    const Point xi = this->any_point();
    const auto dN = TypeParam::gradients(xi);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t a = 0; a < dN.size(); ++a) {
        const auto value = [&](double t) {
          Point moved = xi;
          moved[axis] += t;
          return TypeParam::values(moved)[a];
        };
        EXPECT_NEAR(dN[a][axis], test::derivative(value, 1e-2), 1e-12);
      }
    }
  }
}

TYPED_TEST(ElementTest, IsRightHanded) {
  const auto nodes = corners(TypeParam{});
  Mat3 J = Mat3::Zero();
  const auto dN = TypeParam::gradients({0.25, 0.25, 0.25});
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    J += Eigen::Map<const Vec3>(nodes[a].data()) * Eigen::Map<const Eigen::RowVector3d>(dN[a].data());
  }
  EXPECT_LT((J - Mat3::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace tissu
