#include <gtest/gtest.h>

#include "../../base/eigenvalues.h"
#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/element/generated/all.h"
#include "tissu/law/law_info.h"
#include "tissu/model/fem/elastic.h"

/// Every law is Hooke's near rest: the tangent of every element, at every quadrature, is that of the Hooke
/// element with the law's own Lamé constants.
namespace tissu {
namespace {

struct Case {
  std::string element;
  std::string quadrature;
  std::string law;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.element << "_" << c.quadrature << "_" << c.law; }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const ElementInfo& element : elements()) {
    if (element.dimension != 3) continue;
    for (const char* quadrature : {"reduced", "full", "over"}) {
      for (const LawInfo& law : all_laws()) {
        if (!law.addition) all.push_back({std::string(element.name), quadrature, std::string(law.name)});
      }
    }
  }
  return all;
}

LawParameters typical(const LawInfo& law) {
  LawParameters parameters;
  for (const LawParameter& p : law.parameters) parameters[std::string(p.name)] = {p.typical};
  return parameters;
}

/// Lamé's constants of a law with its typical parameters.
Lame at_rest(const LawInfo& law) {
  std::vector<double> given;
  for (const LawParameter& p : law.parameters) given.push_back(p.typical);
  std::vector<double> constants(law.constants.size());
  law_constants(law, given, constants);
  return law.small_strain(constants.data());
}

/// The reference cell, every node moved by up to `amount`.
std::vector<double> nodes_of(std::string_view name, double amount) {
  std::vector<double> positions;
  test::Random random(23);
  for_each_element([&](auto element) {
    if constexpr (decltype(element)::kDimension == 3) {
      if (element.kName != name) return;
      for (const auto& node : element.nodes) {
        for (const double x : node) positions.push_back(x + random.number(amount));
      }
    }
  });
  return positions;
}

class SmallStrain : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] static Eigen::MatrixXd stiffness_at_rest(const std::string& law, LawParameters parameters,
                                                         const std::vector<double>& positions) {
    ElasticBlock block;
    block.body = "body";
    block.element = GetParam().element;
    block.quadrature = GetParam().quadrature;
    block.law = law;
    block.parameters = std::move(parameters);
    block.density = {1.0};
    for (std::size_t a = 0; a < positions.size() / 3; ++a) {
      block.cells.push_back(static_cast<std::int32_t>(a));
    }
    Elastic elastic(std::move(block), positions, choose_isa(), Threads(1));
    State rest;
    rest.positions = positions;
    rest.velocities.assign(positions.size(), 0.0);
    const Sparsity pattern = test::bind_alone(elastic, static_cast<std::int32_t>(positions.size() / 3));
    return test::stiffness_of(elastic, rest, {1.0, 0.0}, pattern, choose_isa());
  }
};

/// Tolerance: E and nu made of lambda and mu lose 1 / (1 - 2 nu), at most three digits for the typical
/// parameters, of sums of some hundred products.
TEST_P(SmallStrain, TangentAtRestIsThatOfHooke) {
  const LawInfo& law = *find_law(GetParam().law);
  const Lame c = at_rest(law);
  const double young = c.mu * (3.0 * c.lambda + 2.0 * c.mu) / (c.lambda + c.mu);
  const double poisson = c.lambda / (2.0 * (c.lambda + c.mu));
  const std::vector<double> X = nodes_of(GetParam().element, 0.05);
  const Eigen::MatrixXd K = stiffness_at_rest(GetParam().law, typical(law), X);
  const Eigen::MatrixXd hooke = stiffness_at_rest("hooke", {{"young", {young}}, {"poisson", {poisson}}}, X);
  EXPECT_GT(hooke.cwiseAbs().maxCoeff(), 0.1 * c.mu);
  EXPECT_LT(test::relative_difference(K, hooke), 1e-11);
}

/// Six rigid motions have no stiffness; beyond them as many modes as the table says, and the rest resists. On
/// a distorted cell some of those modes resist too.
TEST_P(SmallStrain, StiffnessHasTheZeroModesOfTheTable) {
  const LawInfo& law = *find_law(GetParam().law);
  const RuleInfo& rule = *find_element(GetParam().element)->rule(GetParam().quadrature);
  for (const double amount : {0.0, 0.05}) {
    const Eigen::MatrixXd K =
        -stiffness_at_rest(GetParam().law, typical(law), nodes_of(GetParam().element, amount));
    const Eigen::VectorXd values = test::eigenvalues(K);
    // Nearly incompressible laws spread their values over three decades, quadrature and shape over three
    // more.
    const double zero = 1e-9 * values[values.size() - 1];
    EXPECT_GT(values[0], -zero);
    const auto modes = static_cast<int>((values.array() < zero).count());
    if (amount == 0.0) {
      EXPECT_EQ(modes, 6 + rule.zero_energy_modes) << values.transpose();
    } else {
      EXPECT_GE(modes, 6) << values.transpose();
      EXPECT_LE(modes, 6 + rule.zero_energy_modes) << values.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, SmallStrain, testing::ValuesIn(cases()), [](const auto& info) {
  return info.param.element + "_" + info.param.quadrature + "_" + info.param.law;
});

}  // namespace
}  // namespace tissu
