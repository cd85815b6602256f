#include "../../force/room.h"
#include "elastic_sample.h"

namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::moved;
using test::product_of;
using test::relative_difference;
using test::stiffness_of;
using test::view;

class ElasticDerivatives : public test::ElasticTest {};

// Energies are polynomials of degree 4 in the positions, so differences are exact but for round-off:
// 1e-16 x energy (10 J) / h (1e-2) = 1e-13; two digits more for sums over cells and points.
TEST_P(ElasticDerivatives, ForceIsMinusGradientOfEnergy) {
  const Elastic elastic = made(varied_block());
  for (int i = 0; i < 5; ++i) {
    const State state = any_state();
    const std::vector<double> p = random_.numbers(state.positions.size());
    const double slope =
        derivative([&](double t) { return elastic.energy(moved(state, p, t), test::scratch()); }, 1e-2);
    EXPECT_NEAR(force_of(elastic, state).dot(view(p)), -slope, 1e-11);
  }
}

TEST_P(ElasticDerivatives, ProductIsDerivativeOfForce) {
  const Elastic elastic = made(varied_block());
  for (int i = 0; i < 5; ++i) {
    const State state = any_state();
    const std::vector<double> p = random_.numbers(state.positions.size());
    const Eigen::VectorXd slope =
        derivative([&](double t) { return force_of(elastic, moved(state, p, t)); }, 1e-2);
    EXPECT_LT(relative_difference(product_of(elastic, state, {1.0, 0.0}, p), slope), 1e-11);
  }
}

TEST_P(ElasticDerivatives, ProductScalesAndAdds) {
  const Elastic elastic = made(varied_block());
  const State state = any_state();
  const std::vector<double> p = random_.numbers(state.positions.size());
  const Eigen::VectorXd once = product_of(elastic, state, {1.0, 0.0}, p);
  std::vector<double> out = random_.numbers(p.size());
  const Eigen::VectorXd before = view(out);
  elastic.add_product(state, test::scratch(), {-2.5, 0.0}, p, out);
  EXPECT_LT(relative_difference(view(out), before - 2.5 * once), 1e-14);
  EXPECT_EQ(product_of(elastic, state, {0.0, 3.0}, p).norm(), 0.0);  // an elastic force has no part in v
}

TEST_P(ElasticDerivatives, ForceAdds) {
  const Elastic elastic = made(varied_block());
  const State state = any_state();
  std::vector<double> f = random_.numbers(state.positions.size());
  const Eigen::VectorXd expected = view(f) + force_of(elastic, state);
  elastic.add_force(state, test::scratch(), f);
  EXPECT_LT(relative_difference(view(f), expected), 1e-14);
}

TEST_P(ElasticDerivatives, MatrixTimesVectorIsProduct) {
  Elastic elastic = made(varied_block());
  const Sparsity pattern = test::bind_alone(elastic, mesh_.node_count());
  const State state = any_state();
  const std::vector<double> p = random_.numbers(state.positions.size());
  BlockMatrix matrix(pattern, GetParam().isa, Threads(1));
  matrix.clear();
  elastic.add_stiffness(state, test::scratch(), {-1.5, 4.0}, matrix);
  elastic.add_stiffness(state, test::scratch(), {2.5, 0.0}, matrix);  // adds to what is there
  std::vector<double> out(p.size());
  matrix.multiply(p, out);
  EXPECT_LT(relative_difference(view(out), product_of(elastic, state, {1.0, 0.0}, p)), 1e-12);
}

TEST_P(ElasticDerivatives, MatrixIsSymmetric) {
  Elastic elastic = made(varied_block());
  const Sparsity pattern = test::bind_alone(elastic, mesh_.node_count());
  const Eigen::MatrixXd K = stiffness_of(elastic, any_state(), {1.0, 0.0}, pattern, GetParam().isa);
  EXPECT_LT(relative_difference(K, K.transpose()), 1e-14);
}

TEST_P(ElasticDerivatives, StiffnessIsConstantForHookeOnly) {
  Elastic elastic = made(varied_block());
  EXPECT_EQ(elastic.has_constant_stiffness(), !is_stvk());
  const Sparsity pattern = test::bind_alone(elastic, mesh_.node_count());
  const Eigen::MatrixXd rest_K = stiffness_of(elastic, rest(), {1.0, 0.0}, pattern, GetParam().isa);
  const Eigen::MatrixXd K = stiffness_of(elastic, any_state(), {1.0, 0.0}, pattern, GetParam().isa);
  if (is_stvk()) {
    EXPECT_GT(relative_difference(K, rest_K), 0.01);
  } else {
    EXPECT_EQ(K, rest_K);
  }
}

/// Cell by cell, in models of one cell each: proves that every lane has its own parameters, rest shape and
/// nodes.
TEST_P(ElasticDerivatives, IsTheSumOfItsCells) {
  const ElasticBlock whole = varied_block();
  const Elastic elastic = made(whole);
  const State state = any_state();
  const auto nodes = static_cast<std::size_t>(elastic.nodes_per_cell());
  Eigen::VectorXd f = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(state.positions.size()));
  double energy = 0.0;
  for (std::size_t i = 0; i < whole.parameters.at("young").size(); ++i) {
    ElasticBlock one = whole;
    const auto first = whole.cells.begin() + static_cast<std::ptrdiff_t>(i * nodes);
    one.cells.assign(first, first + static_cast<std::ptrdiff_t>(nodes));
    one.parameters["young"] = {whole.parameters.at("young")[i]};
    one.parameters["poisson"] = {whole.parameters.at("poisson")[i]};
    one.density = {whole.density[i]};
    const Elastic cell = made(one);
    f += force_of(cell, state);
    energy += cell.energy(state, test::scratch());
  }
  EXPECT_LT(relative_difference(force_of(elastic, state), f), 1e-13);
  EXPECT_NEAR(elastic.energy(state, test::scratch()), energy, 1e-13 * energy);
}

TEST_P(ElasticDerivatives, UniformAndPerCellParametersAgree) {
  const ElasticBlock uniform = block();
  ElasticBlock per_cell = uniform;
  const auto cells = static_cast<std::size_t>(mesh_.cell_count());
  per_cell.parameters["young"].assign(cells, uniform.parameters.at("young")[0]);
  per_cell.parameters["poisson"].assign(cells, uniform.parameters.at("poisson")[0]);
  per_cell.density.assign(cells, uniform.density[0]);
  const State state = any_state();
  EXPECT_EQ(force_of(made(uniform), state), force_of(made(per_cell), state));
  EXPECT_EQ(made(uniform).energy(state, test::scratch()), made(per_cell).energy(state, test::scratch()));
}

/// Every instruction set computes the same, but for the order and fusing of sums.
TEST_P(ElasticDerivatives, AgreesWithTheBaseline) {
  Elastic here = made(varied_block());
  Elastic base = made_for(varied_block(), Isa::baseline);
  const Sparsity pattern = test::bind_alone(here, mesh_.node_count());
  base.bind(pattern);
  const State state = any_state();
  const std::vector<double> p = random_.numbers(state.positions.size());
  EXPECT_LT(relative_difference(force_of(here, state), force_of(base, state)), 1e-12);
  EXPECT_LT(relative_difference(product_of(here, state, {1, 0}, p), product_of(base, state, {1, 0}, p)),
            1e-12);
  EXPECT_LT(relative_difference(stiffness_of(here, state, {1, 0}, pattern, GetParam().isa),
                                stiffness_of(base, state, {1, 0}, pattern)),
            1e-12);
  EXPECT_NEAR(here.energy(state, test::scratch()), base.energy(state, test::scratch()),
              1e-12 * base.energy(state, test::scratch()));
  EXPECT_LT(relative_difference(view(here.fields(state).von_mises), view(base.fields(state).von_mises)),
            1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, ElasticDerivatives, testing::ValuesIn(test::elastic_cases()), test::case_name);

}  // namespace
}  // namespace tissu
