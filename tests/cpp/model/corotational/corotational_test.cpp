#include "../../base/eigenvalues.h"
#include "../../force/room.h"
#include "corotational_sample.h"
#include "tissu/law/law.h"

/// What the corotational model computes, for every element, rotation, tangent and instruction set.
namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::moved;
using test::product_of;
using test::relative_difference;
using test::stiffness_of;
using test::view;

/// Of differences over h: h^4 times fifth derivatives, and round-off / h.
constexpr double kStep = 1e-3;
constexpr double kDifferences = 1e-9;

class CorotationalModel : public test::CorotationalTest {
 protected:
  Vec3 sum_of(const Eigen::VectorXd& f) const {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t i = 0; i < nodes(); ++i) sum += f.segment<3>(3 * i);
    return sum;
  }
  Vec3 moment_of(const Eigen::VectorXd& f, const State& state) const {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t i = 0; i < nodes(); ++i) {
      const Vec3 x = tissu::block(ConstReals(state.positions), i);
      sum += x.cross(Vec3(f.segment<3>(3 * i)));
    }
    return sum;
  }
};

class CorotationalApproximate : public CorotationalModel {};
class CorotationalTurning : public CorotationalModel {};
class CorotationalSmall : public CorotationalModel {};

TEST_P(CorotationalModel, ForceIsMinusGradientOfEnergyWhereItIsSaidToBe) {
  const Corotational model = made(varied_block());
  for (int i = 0; i < 5; ++i) {
    const State state = any_state();
    const std::vector<double> p = random_.numbers(state.positions.size());
    const double slope =
        derivative([&](double t) { return model.energy(moved(state, p, t), test::scratch()); }, kStep);
    const double found = -force_of(model, state).dot(view(p));
    if (conserves()) {
      EXPECT_NEAR(found, slope, kDifferences * std::abs(slope) + 1e-10);
    } else {
      // R K (R^T x - X) of a frame lacks what is of second order in the strain, 0.3 here.
      EXPECT_NEAR(found, slope, 0.3 * model.energy(state, test::scratch()) * view(p).norm());
    }
  }
}

TEST_P(CorotationalModel, ExactProductIsDerivativeOfForce) {
  const Corotational model = made(varied_block());
  for (int i = 0; i < 5; ++i) {
    const State state = any_state();
    const std::vector<double> p = random_.numbers(state.positions.size());
    const Eigen::VectorXd slope =
        derivative([&](double t) { return force_of(model, moved(state, p, t)); }, kStep);
    const double off = relative_difference(product_of(model, state, {1.0, 0.0}, p), slope);
    if (has("exact") || has("small")) {
      EXPECT_LT(off, kDifferences);
    } else {
      EXPECT_LT(off, 0.6);  // the strain, and more than round-off:
      EXPECT_GT(off, 1e-6);
    }
  }
}

TEST_P(CorotationalModel, BothTangentsAreTheDerivativeAtRest) {
  const Corotational model = made(varied_block());
  const State state = has("small") ? rest() : affine(turn_, Vec3(0.1, 2.0, -0.3));
  const std::vector<double> p = random_.numbers(state.positions.size());
  const Eigen::VectorXd slope =
      derivative([&](double t) { return force_of(model, moved(state, p, t)); }, kStep);
  EXPECT_LT(relative_difference(product_of(model, state, {1.0, 0.0}, p), slope), kDifferences);
}

TEST_P(CorotationalModel, MatrixIsThatOfTheProductAndSymmetric) {
  Corotational model = made(varied_block());
  const Sparsity pattern = test::bind_alone(model, nodes());
  const State state = any_state();
  BlockMatrix matrix(pattern, GetParam().isa, Threads(1));
  matrix.clear();
  model.add_stiffness(state, test::scratch(), {-1.5, 4.0}, matrix);
  model.add_stiffness(state, test::scratch(), {2.5, 0.0}, matrix);  // adds to what is there
  const Eigen::MatrixXd K = test::dense(matrix);
  EXPECT_LT(relative_difference(K, K.transpose()), 1e-13);
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> p = random_.numbers(state.positions.size());
    EXPECT_LT(relative_difference(K * view(p), product_of(model, state, {1.0, 0.0}, p)), 1e-12);
  }
  EXPECT_EQ(model.has_constant_stiffness(), has("small"));
}

/// Nodes anywhere: half of the cells are inside out.
TEST_P(CorotationalApproximate, TangentHasNoNegativeEigenvalueInAnyState) {
  Corotational model = made(block());
  const Sparsity pattern = test::bind_alone(model, nodes());
  for (int i = 0; i < 3; ++i) {
    State state = rest();
    state.positions = random_.numbers(state.positions.size(), 2.0);
    const Eigen::MatrixXd K = -stiffness_of(model, state, {1.0, 0.0}, pattern, GetParam().isa);
    const Eigen::VectorXd values = test::eigenvalues(K);
    const double largest = values.maxCoeff();
    EXPECT_GT(values.minCoeff(), -1e-14 * largest * static_cast<double>(K.rows()));
    EXPECT_GT(largest, 0.1);
  }
}

TEST_P(CorotationalTurning, RigidMotionsHaveNoForce) {
  const Corotational model = made(varied_block());
  for (int i = 0; i < 20; ++i) {
    const Mat3 R = i == 0 ? Mat3(Vec3(-1, -1, 1).asDiagonal()) : random_.rotation().toRotationMatrix();
    const State state = affine(R, random_.vector(3.0));
    EXPECT_LT(force_of(model, state).cwiseAbs().maxCoeff(), 1e-14 * 3.0 * 10.0);  // E h x a few cells
    EXPECT_LT(model.energy(state, test::scratch()), 1e-27);
  }
}

TEST_P(CorotationalSmall, IsElasticHooke) {
  ElasticBlock same = varied_block();
  Corotational model = made(same);
  same.model = {};
  const Elastic elastic(same, box_.positions, GetParam().isa, Threads(1));
  const State state = any_state(0.3);
  const std::vector<double> p = random_.numbers(state.positions.size());
  EXPECT_LT(relative_difference(force_of(model, state), force_of(elastic, state)), 1e-13);
  EXPECT_LT(relative_difference(product_of(model, state, {1, 0}, p), product_of(elastic, state, {1, 0}, p)),
            1e-13);
  EXPECT_NEAR(model.energy(state, test::scratch()), elastic.energy(state, test::scratch()),
              1e-13 * elastic.energy(state, test::scratch()));
}

/// Displacements of size s, then the body turned: Hooke's forces turned, but for terms in s^2.
TEST_P(CorotationalTurning, IsHookeTurnedAtSmallStrain) {
  ElasticBlock same = varied_block();
  const Corotational model = made(same);
  same.model = {};
  const Elastic elastic(same, box_.positions, GetParam().isa, Threads(1));
  const std::vector<double> u = random_.numbers(box_.positions.size());
  double off[2] = {};
  for (int i = 0; i < 2; ++i) {
    const double s = i == 0 ? 1e-4 : 1e-5;
    const State small = moved(rest(), u, s);
    State turned = small;
    Eigen::VectorXd expected = force_of(elastic, small);
    for (std::int32_t a = 0; a < nodes(); ++a) {
      tissu::block(Reals(turned.positions), a) = turn_ * tissu::block(ConstReals(small.positions), a);
      expected.segment<3>(3 * a) = turn_ * expected.segment<3>(3 * a);
    }
    off[i] = relative_difference(force_of(model, turned), expected);
  }
  EXPECT_LT(off[0], 30 * 1e-4);
  EXPECT_NEAR(off[0] / off[1], 10.0, 0.1);
}

TEST_P(CorotationalModel, ForcesAndMomentsAreInBalanceWhereTheyAreSaidToBe) {
  const Corotational model = made(varied_block());
  const State state = any_state();
  const Eigen::VectorXd f = force_of(model, state);
  EXPECT_LT(sum_of(f).norm(), 1e-13 * f.norm());
  if (has("small")) return;
  const double moment = moment_of(f, state).norm();
  if (conserves()) {
    EXPECT_LT(moment, 1e-13 * f.norm() * 4.0);
  } else {
    EXPECT_GT(moment, 1e-6 * f.norm());
  }
}

TEST_P(CorotationalModel, IsTheSumOfItsCells) {
  const ElasticBlock whole = varied_block();
  const Corotational model = made(whole);
  const State state = any_state();
  const auto count = static_cast<std::size_t>(model.nodes_per_cell());
  Eigen::VectorXd f = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(state.positions.size()));
  double energy = 0.0;
  for (std::size_t i = 0; i < cells(); ++i) {
    const Corotational cell = made(part_of(whole, {i}));
    ASSERT_EQ(static_cast<std::size_t>(cell.block().cells.size()), count);
    f += force_of(cell, state);
    energy += cell.energy(state, test::scratch());
  }
  EXPECT_LT(relative_difference(force_of(model, state), f), 1e-13);
  EXPECT_NEAR(model.energy(state, test::scratch()), energy, 1e-13 * energy);
}

TEST_P(CorotationalModel, AgreesWithTheBaseline) {
  Corotational here = made(varied_block());
  Corotational base(varied_block(), box_.positions, Isa::baseline, Threads(1));
  const Sparsity pattern = test::bind_alone(here, nodes());
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
}

/// A stretch e along one axis of a body that is turned: sigma = lambda e I + 2 mu e x (x) x.
TEST_P(CorotationalModel, FieldsOfATurnedStretch) {
  constexpr double e = 0.2;
  const Corotational model = made(block());
  const Mat3 R = has("small") ? Mat3(Mat3::Identity()) : turn_;
  Mat3 F = Mat3::Identity();
  F(0, 0) += e;
  const CellFields fields = model.fields(affine(R * F));
  const Lame law = lame(3.0, 0.3);
  for (std::size_t i = 0; i < cells(); ++i) {
    if (!has("frame")) {  // whose axes shear along, unless an edge lies along the stretch
      EXPECT_NEAR(fields.von_mises[i], 2.0 * law.mu * e, 1e-12);
      EXPECT_NEAR(fields.energy_density[i], (0.5 * law.lambda + law.mu) * e * e, 1e-12);
    }
    EXPECT_NEAR(fields.volume_ratio[i], 1.0 + e, 1e-12);
  }
}

TEST_P(CorotationalModel, SameBitsOnAnyNumberOfThreads) {
  const test::CellBox big = test::cell_box(GetParam().element, {11, 9, 8}, GetParam().distorted);
  std::vector<double> x = big.positions;
  for (double& v : x) v += random_.number(0.2);
  State state;
  state.positions = x;
  ElasticBlock same = test::corotational_block(big, GetParam().element);
  same.model = block().model;
  Eigen::VectorXd f;
  Eigen::VectorXd df;
  for (const int threads : {1, 2, 3, 4}) {
    const Corotational model(same, big.positions, GetParam().isa, Threads(threads));
    if (threads == 1) {
      f = force_of(model, state);
      df = product_of(model, state, {1.0, 0.0}, x);
    }
    EXPECT_EQ(f, force_of(model, state)) << threads;
    EXPECT_EQ(df, product_of(model, state, {1.0, 0.0}, x)) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CorotationalModel, testing::ValuesIn(test::corotational_cases()),
                         test::case_name);
INSTANTIATE_TEST_SUITE_P(All, CorotationalApproximate,
                         testing::ValuesIn(test::corotational_cases("approximate", true)), test::case_name);
INSTANTIATE_TEST_SUITE_P(All, CorotationalTurning,
                         testing::ValuesIn(test::corotational_cases("small", false)), test::case_name);
INSTANTIATE_TEST_SUITE_P(All, CorotationalSmall, testing::ValuesIn(test::corotational_cases("small", true)),
                         test::case_name);

}  // namespace
}  // namespace tissu
