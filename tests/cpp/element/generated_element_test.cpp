#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "../base/differences.h"
#include "../base/random.h"
#include "tissu/element/generated/all.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

/// Calls f for every element of the table, so that a new one is tested as soon as it is made.
template <class Function>
void for_each_traced(Function&& f) {
  for_each_element([&](auto element) {
    SCOPED_TRACE(std::string(decltype(element)::kName));
    f(element);
  });
}
template <class Element, class Function>
void for_each_rule(Element /*element*/, Function&& f) {
  const auto traced = [&](const char* name, auto rule) {
    SCOPED_TRACE(name);
    f(rule);
  };
  traced("reduced", typename Element::Reduced{});
  traced("full", typename Element::Full{});
  traced("over", typename Element::Over{});
}

bool starts_with(std::string_view name, std::string_view start) {
  return name.substr(0, start.size()) == start;
}

/// A mean of the nodes with random positive weights: inside the reference cell.
template <class Element>
typename Element::Point point_inside(test::Random& random) {
  typename Element::Point xi{};
  double sum = 0.0;
  std::array<double, Element::kNodes> weights;
  for (double& w : weights) sum += w = 1.001 + random.number();
  for (std::size_t a = 0; a < weights.size(); ++a) {
    for (std::size_t i = 0; i < xi.size(); ++i) xi[i] += weights[a] / sum * Element::nodes[a][i];
  }
  return xi;
}

/// Exponents of every monomial of the given total degree in m variables.
std::vector<std::array<int, 3>> monomials(int dimension, int degree) {
  std::vector<std::array<int, 3>> result;
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; i + j <= degree; ++j) {
      const int k = degree - i - j;
      if ((dimension < 2 && j > 0) || (dimension < 3 && k > 0)) continue;
      result.push_back({i, j, k});
    }
  }
  return result;
}
template <std::size_t M>
double monomial(const std::array<double, M>& xi, const std::array<int, 3>& power) {
  double value = 1.0;
  for (std::size_t i = 0; i < M; ++i) value *= std::pow(xi[i], power[i]);
  return value;
}

double factorial(int n) { return std::tgamma(n + 1.0); }
double along(int n) { return n % 2 == 0 ? 2.0 / (n + 1) : 0.0; }  // of t^n over (-1, 1)

/// Integral of a monomial over the reference cell of an element.
double integral(std::string_view element, int dimension, const std::array<int, 3>& power) {
  const auto [i, j, k] = power;
  if (starts_with(element, "triangle")) return factorial(i) * factorial(j) / factorial(i + j + 2);
  if (starts_with(element, "tetra")) {
    return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
  }
  if (starts_with(element, "wedge")) return factorial(i) * factorial(j) / factorial(i + j + 2) * along(k);
  if (starts_with(element, "pyramid")) {
    return along(i) * along(j) * factorial(k) * factorial(i + j + 2) / factorial(i + j + k + 3);
  }
  return along(i) * (dimension > 1 ? along(j) : 1.0) * (dimension > 2 ? along(k) : 1.0);
}

/// Smallest distance to the sides of the reference cell, up to a factor: positive inside.
template <std::size_t M>
double depth(std::string_view element, const std::array<double, M>& xi) {
  double low = 1.0;
  if (starts_with(element, "triangle") || starts_with(element, "tetra")) {
    double last = 1.0;
    for (const double c : xi) {
      low = std::min(low, c);
      last -= c;
    }
    return std::min(low, last);
  }
  if constexpr (M == 3) {
    if (starts_with(element, "wedge")) {
      return std::min({xi[0], xi[1], 1.0 - xi[0] - xi[1], 1.0 - std::abs(xi[2])});
    }
    if (starts_with(element, "pyramid")) {
      return std::min({xi[2], 1.0 - xi[2] - std::abs(xi[0]), 1.0 - xi[2] - std::abs(xi[1])});
    }
  }
  for (const double c : xi) low = std::min(low, 1.0 - std::abs(c));
  return low;
}

/// Largest error of a rule over the monomials of a total degree.
template <class Element, class Rule>
double worst_error(int degree) {
  double worst = 0.0;
  for (const auto& power : monomials(Element::kDimension, degree)) {
    double sum = 0.0;
    for (const auto& [xi, weight] : Rule::points) sum += weight * monomial(xi, power);
    worst = std::max(worst, std::abs(sum - integral(Element::kName, Element::kDimension, power)));
  }
  return worst;
}

// Values and gradients of at most 27 nodes below 10: sums below 1e-14; one digit more.
constexpr double kRoundOff = 1e-13;

TEST(GeneratedElement, IsPartitionOfUnity) {
  test::Random random(1);
  for_each_traced([&]<class Element>(Element) {
    for (int trial = 0; trial < 20; ++trial) {
      const auto xi = point_inside<Element>(random);
      double sum = 0.0;
      typename Element::Point change{};
      for (const double N : Element::values(xi)) sum += N;
      for (const auto& dN : Element::gradients(xi)) {
        for (std::size_t i = 0; i < dN.size(); ++i) change[i] += dN[i];
      }
      EXPECT_NEAR(sum, 1.0, kRoundOff);
      for (const double c : change) EXPECT_NEAR(c, 0.0, kRoundOff);
    }
  });
}

// At the nodes every product has few bits, so the values are exact; the apex of a pyramid included.
TEST(GeneratedElement, IsOneAtItsNodeAndZeroAtTheOthers) {
  for_each_traced([]<class Element>(Element) {
    for (std::size_t b = 0; b < Element::nodes.size(); ++b) {
      const auto N = Element::values(Element::nodes[b]);
      for (std::size_t a = 0; a < N.size(); ++a) EXPECT_EQ(N[a], a == b ? 1.0 : 0.0) << a << " at " << b;
    }
  });
}

TEST(GeneratedElement, HoldsEveryPolynomialOfItsOrder) {
  test::Random random(2);
  for_each_traced([&]<class Element>(Element) {
    for (int trial = 0; trial < 20; ++trial) {
      const auto xi = point_inside<Element>(random);
      const auto N = Element::values(xi);
      double expected = 0.0;
      double found = 0.0;
      for (int degree = 0; degree <= Element::kOrder; ++degree) {
        for (const auto& power : monomials(Element::kDimension, degree)) {
          const double c = random.number();
          expected += c * monomial(xi, power);
          for (std::size_t a = 0; a < N.size(); ++a) found += c * N[a] * monomial(Element::nodes[a], power);
        }
      }
      EXPECT_NEAR(found, expected, kRoundOff);
    }
  });
}

/// sum_a X_a (x) dN_a = 1 at the points of every rule and at every node.
template <class Element>
void expect_unit_jacobian(const typename Element::Point& xi) {
  const auto dN = Element::gradients(xi);
  for (std::size_t i = 0; i < xi.size(); ++i) {
    for (std::size_t j = 0; j < xi.size(); ++j) {
      double J = 0.0;
      for (std::size_t a = 0; a < dN.size(); ++a) J += Element::nodes[a][i] * dN[a][j];
      EXPECT_NEAR(J, i == j ? 1.0 : 0.0, kRoundOff);
    }
  }
}
TEST(GeneratedElement, HasTheUnitJacobianOnItsReferenceCell) {
  for_each_traced([]<class Element>(Element element) {
    for (const auto& node : Element::nodes) expect_unit_jacobian<Element>(node);
    for_each_rule(element, []<class Rule>(Rule) {
      for (const auto& point : Rule::points) expect_unit_jacobian<Element>(point.xi);
    });
  });
}

// Five-point differences, h = 1e-3: exact to degree four; the pyramids' quotients leave h^4 N^(5)/30, with
// N^(5) below 5!/(1 - z)^4 at points where 1 - z > 0.3: 5e-10. Round-off 1e-13.
TEST(GeneratedElement, GradientsAreDerivativesOfValues) {
  test::Random random(3);
  for_each_traced([&]<class Element>(Element) {
    for (int trial = 0; trial < 20; ++trial) {
      const auto xi = point_inside<Element>(random);
      const auto dN = Element::gradients(xi);
      for (std::size_t i = 0; i < xi.size(); ++i) {
        for (std::size_t a = 0; a < dN.size(); ++a) {
          const auto value = [&](double t) {
            auto moved = xi;
            moved[i] += t;
            return Element::values(moved)[a];
          };
          EXPECT_NEAR(dN[a][i], test::derivative(value, 1e-3), 1e-9) << a << " along " << i;
        }
      }
    }
  });
}

TEST(GeneratedRule, IsPositiveAndInside) {
  for_each_traced([]<class Element>(Element element) {
    for_each_rule(element, []<class Rule>(Rule) {
      ASSERT_EQ(Rule::points.size(), static_cast<std::size_t>(Rule::kPoints));
      for (const auto& [xi, weight] : Rule::points) {
        EXPECT_GT(weight, 0.0);
        EXPECT_GT(depth(Element::kName, xi), 0.01);
      }
    });
  });
}

// Sums of at most 125 terms whose total is at most 8.
TEST(GeneratedRule, IsExactToItsDegreeAndNotBeyond) {
  for_each_traced([]<class Element>(Element element) {
    for_each_rule(element, []<class Rule>(Rule) {
      for (int degree = 0; degree <= Rule::kDegree; ++degree) {
        EXPECT_LT((worst_error<Element, Rule>(degree)), kRoundOff) << degree;
      }
      EXPECT_GT((worst_error<Element, Rule>(Rule::kDegree + 1)), 1e-6);
    });
  });
}

TEST(GeneratedRule, FullAndOverHaveNoZeroEnergyModes) {
  for (const ElementInfo& element : elements()) {
    SCOPED_TRACE(std::string(element.name));
    EXPECT_EQ(element.rule("full")->zero_energy_modes, 0);
    EXPECT_EQ(element.rule("over")->zero_energy_modes, 0);
    EXPECT_FALSE(element.rule("full")->exact_for.empty());
    EXPECT_LE(element.rule("reduced")->points, element.rule("full")->points);
  }
  EXPECT_EQ(find_element("hexahedron")->rule("reduced")->zero_energy_modes, 12);
  EXPECT_EQ(find_element("hexahedron20")->rule("reduced")->zero_energy_modes, 6);
  EXPECT_EQ(find_element("quad8")->rule("reduced")->zero_energy_modes, 1);
}

// VTK's places for the nodes that other programs number otherwise.
TEST(GeneratedElement, NumbersItsNodesAsVtkDoes) {
  using Point = std::array<double, 3>;
  EXPECT_EQ(Hexahedron20::nodes[9], (Point{1, 0, -1}));
  EXPECT_EQ(Hexahedron20::nodes[15], (Point{-1, 0, 1}));
  EXPECT_EQ(Hexahedron20::nodes[16], (Point{-1, -1, 0}));
  EXPECT_EQ(Hexahedron20::nodes[18], (Point{1, 1, 0}));
  const Point faces[] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0, 0}};
  for (std::size_t f = 0; f < 7; ++f) EXPECT_EQ(Hexahedron27::nodes[20 + f], faces[f]) << f;
  EXPECT_EQ(Tetra10::nodes[8], (Point{0.5, 0, 0.5}));
  EXPECT_EQ(Tetra10::nodes[9], (Point{0, 0.5, 0.5}));
  EXPECT_EQ(Wedge15::nodes[8], (Point{0, 0.5, -1}));
  EXPECT_EQ(Wedge15::nodes[13], (Point{1, 0, 0}));
  EXPECT_EQ(Pyramid13::nodes[8], (Point{-1, 0, 0}));
  EXPECT_EQ(Pyramid13::nodes[10], (Point{0.5, -0.5, 0.5}));
  EXPECT_EQ(Quad9::nodes[8], (std::array<double, 2>{0, 0}));
}

// Towards the apex along a ray, where only products of bounded quotients are left.
TEST(GeneratedElement, PyramidsStayFiniteTowardsTheApex) {
  const auto expect_finite = []<class Element>(Element) {
    for (double s = 1.0; s > 1e-300; s *= 0.1) {
      const std::array<double, 3> xi = {0.7 * s, -0.4 * s, 1.0 - s};
      for (const double N : Element::values(xi)) EXPECT_LT(std::abs(N), 2.0) << s;
      for (const auto& dN : Element::gradients(xi)) {
        for (const double d : dN) EXPECT_LT(std::abs(d), 4.0) << s;
      }
    }
  };
  expect_finite(Pyramid5{});
  expect_finite(Pyramid13{});
}

TEST(Elements, ListsEveryGeneratedElement) {
  std::set<std::string_view> names;
  for_each_traced([&]<class Element>(Element) {
    names.insert(Element::kName);
    const ElementInfo* info = find_element(Element::kName);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(info->nodes, Element::kNodes);
    EXPECT_EQ(info->dimension, Element::kDimension);
    EXPECT_EQ(info->order, Element::kOrder);
    EXPECT_EQ(info->affine, Element::kAffine);
  });
  EXPECT_EQ(names.size(), elements().size());
  EXPECT_EQ(find_element("prism"), nullptr);
  EXPECT_EQ(find_element("tetra")->rule("exact"), nullptr);
}

TEST(Elements, HaveTablesForEveryRule) {
  for_each_traced([]<class Element>(Element) {
    for (const RuleInfo& rule : find_element(Element::kName)->rules) {
      const ReferenceCell cell = reference_cell(Element::kName, rule.name);
      EXPECT_EQ(cell.dimension, Element::kDimension);
      EXPECT_EQ(cell.nodes, Element::kNodes);
      ASSERT_EQ(cell.points.size(), static_cast<std::size_t>(rule.points));
      double volume = 0.0;
      for (const auto& point : cell.points) {
        volume += point.weight;
        EXPECT_EQ(point.values.size(), static_cast<std::size_t>(Element::kNodes));
        EXPECT_EQ(point.gradients.size(), static_cast<std::size_t>(Element::kNodes));
        for (const auto& dN : point.gradients) {
          for (std::size_t i = Element::kDimension; i < 3; ++i) EXPECT_EQ(dN[i], 0.0);
        }
      }
      EXPECT_NEAR(volume, integral(Element::kName, Element::kDimension, {0, 0, 0}), 1e-14);
    }
  });
}

}  // namespace
}  // namespace tissu
