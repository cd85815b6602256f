#include "tissu/element/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tissu/element/generated/hexahedron.h"
#include "tissu/element/generated/tetra.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

template <class Rule>
double integral(int i, int j, int k) {
  double sum = 0.0;
  for (const QuadraturePoint& p : Rule::points) {
    sum += p.weight * std::pow(p.xi[0], i) * std::pow(p.xi[1], j) * std::pow(p.xi[2], k);
  }
  return sum;
}

/// of x^i y^j z^k over (-1, 1)^3
double cube_integral(int i, int j, int k) {
  const auto along = [](int n) { return n % 2 == 0 ? 2.0 / (n + 1) : 0.0; };
  return along(i) * along(j) * along(k);
}

/// of x^i y^j z^k over the reference tetrahedron: i! j! k! / (i + j + k + 3)!
double tetra_integral(int i, int j, int k) {
  return std::tgamma(i + 1) * std::tgamma(j + 1) * std::tgamma(k + 1) / std::tgamma(i + j + k + 4);
}

/// Largest error of a cube rule over the monomials up to `degree` in each direction.
template <int N>
double cube_error(int degree) {
  double worst = 0.0;
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; j <= degree; ++j) {
      for (int k = 0; k <= degree; ++k) {
        worst = std::max(worst, std::abs(integral<CubeGauss<N>>(i, j, k) - cube_integral(i, j, k)));
      }
    }
  }
  return worst;
}

// Sums of at most 27 terms whose total is at most 8: 27 x 8 x 1e-16.
constexpr double kRoundOff = 3e-14;

TEST(Quadrature, CubeIsExactToItsDegree) {
  EXPECT_LT(cube_error<2>(3), kRoundOff);
  EXPECT_LT(cube_error<3>(5), kRoundOff);
}

TEST(Quadrature, CubeIsNotExactBeyond) {
  EXPECT_GT(cube_error<2>(4), 0.1);
  EXPECT_GT(cube_error<3>(6), 0.01);
}

TEST(Quadrature, TetraIsExactToDegreeOne) {
  EXPECT_NEAR(integral<TetraCentroid>(0, 0, 0), 1.0 / 6.0, 1e-16);
  EXPECT_NEAR(integral<TetraCentroid>(1, 0, 0), tetra_integral(1, 0, 0), 1e-16);
  EXPECT_NEAR(integral<TetraCentroid>(0, 1, 0), tetra_integral(0, 1, 0), 1e-16);
  EXPECT_NEAR(integral<TetraCentroid>(0, 0, 1), tetra_integral(0, 0, 1), 1e-16);
  EXPECT_GT(std::abs(integral<TetraCentroid>(2, 0, 0) - tetra_integral(2, 0, 0)), 1e-3);
}

template <class Element, class Rule>
void expect_tables_of(const char* element, const char* quadrature) {
  const ReferenceCell cell = reference_cell(element, quadrature);
  EXPECT_EQ(cell.element, element);
  EXPECT_EQ(cell.nodes, Element::kNodes);
  ASSERT_EQ(cell.points.size(), static_cast<std::size_t>(Rule::kPoints)) << element << " " << quadrature;
  for (std::size_t g = 0; g < cell.points.size(); ++g) {
    const QuadraturePoint& point = Rule::points[g];
    const auto N = Element::values(point.xi);
    const auto dN = Element::gradients(point.xi);
    EXPECT_EQ(cell.points[g].weight, point.weight);
    EXPECT_EQ(cell.points[g].values, std::vector<double>(N.begin(), N.end()));
    EXPECT_EQ(cell.points[g].gradients, (std::vector<std::array<double, 3>>(dN.begin(), dN.end())));
  }
}

TEST(ReferenceCell, HoldsElementAndRule) {
  expect_tables_of<Tetra4, TetraCentroid>("tetra", "full");
  expect_tables_of<Tetra4, TetraCentroid>("tetra", "over");
  expect_tables_of<Hexahedron8, CubeGauss<2>>("hexahedron", "full");
  expect_tables_of<Hexahedron8, CubeGauss<3>>("hexahedron", "over");
}

TEST(ReferenceCell, IsEmptyForWhatIsNotThere) {
  EXPECT_TRUE(reference_cell("prism", "full").points.empty());
  EXPECT_TRUE(reference_cell("tetra", "").points.empty());
  EXPECT_TRUE(reference_cell("", "full").points.empty());
}

}  // namespace
}  // namespace tissu
