#include "tissu/element/reference_part.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace tissu {
namespace {

/// The integral of sum N_a q_a^m over the points of a rule.
double integral(const ReferenceCell& cell, const std::vector<double>& q, int m) {
  double sum = 0.0;
  for (const ReferenceCell::Point& point : cell.points) {
    double value = 0.0;
    for (std::size_t a = 0; a < q.size(); ++a) value += point.values[a] * q[a];
    sum += point.weight * std::pow(value, m);
  }
  return sum;
}

// The integral of (x + 2 y)^m over the triangle (0, 0), (1, 0), (0, 1): with u its values 0, 1, 2 at the
// corners, 2 A m! / (m + 2)! h_m(u), and h_m(0, 1, 2) = 2^(m + 1) - 1.
TEST(ReferencePart, IsExactUpToDegreeEight) {
  const std::vector<ReferencePoint> whole = reference_nodes("triangle");
  const ReferenceCell cell = reference_part("triangle", whole);
  for (int m = 0; m <= 8; ++m) {
    const double exact = (std::pow(2.0, m + 1) - 1.0) / ((m + 1.0) * (m + 2.0));
    EXPECT_NEAR(integral(cell, {0.0, 1.0, 2.0}, m), exact, 1e-14 * exact) << m;
  }
}

TEST(ReferencePart, PartsOfAQuadrangleMakeTheWhole) {
  const std::vector<ReferencePoint> nodes = reference_nodes("quad9");
  const std::vector<double> q{0.3, -0.2, 0.7, 0.1, 1.1, -0.4, 0.2, 0.9, 0.5};
  const ReferencePoint inside{0.3, -0.6, 0.0};
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::vector<ReferencePoint> part{nodes[c], nodes[(c + 1) % 4], inside};
    area += reference_measure(part);
    sum += integral(reference_part("quad9", part), q, 2);
  }
  EXPECT_NEAR(area, 4.0, 1e-15);
  EXPECT_NEAR(sum, integral(reference_cell("quad9", "over"), q, 2), 1e-14);
}

TEST(ReferencePart, PartsOfALineMakeTheWhole) {
  const std::vector<double> q{0.3, -0.2, 0.7};
  double sum = 0.0;
  for (const auto& [a, b] : {std::pair{-1.0, 0.2}, std::pair{0.2, 1.0}}) {
    const std::vector<ReferencePoint> part{{a, 0.0, 0.0}, {b, 0.0, 0.0}};
    EXPECT_NEAR(reference_measure(part), b - a, 1e-15);
    sum += integral(reference_part("line3", part), q, 2);
  }
  EXPECT_NEAR(sum, integral(reference_cell("line3", "over"), q, 2), 1e-15);
}

}  // namespace
}  // namespace tissu
