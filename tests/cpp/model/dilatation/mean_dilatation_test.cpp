#include "tissu/model/dilatation/mean_dilatation.h"

#include <cmath>
#include <set>

#include "../../base/eigenvalues.h"
#include "../../force/room.h"
#include "mean_dilatation_sample.h"

/// One volume ratio for each patch: derivatives, constant states, motions, crushed cells.
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
constexpr double kStep = 3e-4;
constexpr double kDifferences = 2e-8;

class MeanDilatationModel : public test::DilatationTest {
 protected:
  /// Largest difference of the derivatives from those by differences, at one state.
  void check_derivatives(const MeanDilatation& model, const State& state, double step = kStep,
                         double tolerance = kDifferences) {
    const std::vector<double> p = random_.numbers(state.positions.size());
    const double energy =
        derivative([&](double t) { return model.energy(moved(state, p, t), test::scratch()); }, step);
    const Eigen::VectorXd f = force_of(model, state);
    EXPECT_NEAR(-f.dot(view(p)), energy, tolerance * f.norm() * view(p).norm());
    const Eigen::VectorXd slope =
        derivative([&](double t) { return force_of(model, moved(state, p, t)); }, step);
    EXPECT_LT(relative_difference(product_of(model, state, {1.0, 0.0}, p), slope), tolerance);
  }
};

TEST_P(MeanDilatationModel, ForceAndProductAreDerivatives) {
  const MeanDilatation model = made(block());
  for (int i = 0; i < 4; ++i) check_derivatives(model, any_state());
}

TEST_P(MeanDilatationModel, MatrixIsThatOfTheProductAndSymmetric) {
  MeanDilatation model = made(block());
  const Sparsity pattern = test::bind_alone(model, nodes());
  for (int i = 0; i < 2; ++i) {
    const State state = any_state();
    BlockMatrix matrix(pattern, GetParam().isa, Threads(1));
    matrix.clear();
    model.add_stiffness(state, test::scratch(), {-1.5, 4.0}, matrix);
    model.add_stiffness(state, test::scratch(), {2.5, 0.0}, matrix);  // adds to what is there
    const Eigen::MatrixXd K = test::dense(matrix);
    EXPECT_LT(relative_difference(K, K.transpose()), 1e-13);
    const std::vector<double> p = random_.numbers(state.positions.size());
    EXPECT_LT(relative_difference(K * view(p), product_of(model, state, {1.0, 0.0}, p)), 1e-12);
  }
  EXPECT_FALSE(model.has_constant_stiffness());
}

/// theta = J where F is the same everywhere: then, in one material, nothing differs from continuum elements.
TEST_P(MeanDilatationModel, IsTheContinuumElementWhereFIsTheSameEverywhere) {
  const MeanDilatation model = made(block(false));
  const Elastic elastic = continuum(block(false));
  for (int i = 0; i < 4; ++i) {
    const Mat3 turn = is_linear() ? Mat3(Mat3::Identity()) : random_.rotation().toRotationMatrix();
    const State state = affine(turn * (Mat3::Identity() + random_.matrix(0.2)), random_.vector());
    EXPECT_LT(relative_difference(force_of(model, state), force_of(elastic, state)), 1e-12);
    EXPECT_NEAR(model.energy(state, test::scratch()), elastic.energy(state, test::scratch()),
                1e-12 * elastic.energy(state, test::scratch()));
    const CellFields found = model.fields(state);
    const CellFields expected = elastic.fields(state);
    for (std::size_t e = 0; e < cells(); ++e) {
      EXPECT_NEAR(found.von_mises[e], expected.von_mises[e], 1e-11 * expected.von_mises[e]);
      EXPECT_NEAR(found.energy_density[e], expected.energy_density[e], 1e-11 * expected.energy_density[e]);
      EXPECT_NEAR(found.volume_ratio[e], expected.volume_ratio[e], 1e-13);
    }
  }
}

/// Moments of Hooke's law are those of the force at X; the others balance about any point.
TEST_P(MeanDilatationModel, ForcesBalanceAndRigidMotionsHaveNone) {
  const MeanDilatation model = made(block());
  const State state = any_state();
  const Eigen::VectorXd f = force_of(model, state);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < nodes(); ++i) {
    sum += f.segment<3>(3 * i);
    moment += tissu::block(ConstReals(state.positions), i).cross(Vec3(f.segment<3>(3 * i)));
  }
  const double scale = f.cwiseAbs().maxCoeff();
  EXPECT_LT(sum.norm(), 1e-12 * scale);
  if (!is_linear()) {
    EXPECT_LT(moment.norm(), 1e-11 * scale);
  }
  const Mat3 R = is_linear() ? Mat3(Mat3::Identity()) : random_.rotation().toRotationMatrix();
  EXPECT_LT(force_of(model, affine(R, random_.vector(3.0))).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

/// Only the volume ratio is shared out: what each patch has of it is kept, whatever its cells have.
TEST_P(MeanDilatationModel, VolumeIsOfThePatchAndShapeOfTheCell) {
  const MeanDilatation model = made(block(false));
  const Elastic elastic = continuum(block(false));
  const State state = any_state(0.1);
  EXPECT_GT(std::abs(model.energy(state, test::scratch()) - elastic.energy(state, test::scratch())),
            1e-3 * elastic.energy(state, test::scratch()));
  const std::vector<double> ratios = model.fields(state).volume_ratio;
  const std::vector<double> expected = elastic.fields(state).volume_ratio;
  for (std::size_t e = 0; e < cells(); ++e) EXPECT_NEAR(ratios[e], expected[e], 1e-13);
}

INSTANTIATE_TEST_SUITE_P(All, MeanDilatationModel, testing::ValuesIn(test::dilatation_cases()),
                         test::dilatation_name);

/// Laws that take inverted cells.
class MeanDilatationCrushed : public MeanDilatationModel {
 protected:
  /// Of the third derivative of rho, which jumps at both ends of its bend, a tenth wide: (10 h / 0.1)^2.
  static constexpr double kSmallStep = 1e-6;
  static constexpr double kRough = 1e-7;
};

TEST_P(MeanDilatationCrushed, DerivativesHoldAndAllIsFiniteWhereCellsAreFlatOrInsideOut) {
  const MeanDilatation model = made(block());
  for (const double height : {0.15, 0.08, 0.03, 0.0, -0.04, -0.5}) {  // det F, crushed along an axis
    const Mat3 F = random_.rotation() * Vec3(1.0, height, 1.0).asDiagonal();
    const State state = moved(affine(F), random_.numbers(box_.positions.size(), 0.02), 1.0);
    EXPECT_TRUE(std::isfinite(model.energy(state, test::scratch())));
    EXPECT_TRUE(force_of(model, state).allFinite());
    check_derivatives(model, state, kSmallStep, kRough);
  }
  State random_nodes = affine(Mat3::Identity());
  random_nodes.positions = random_.numbers(box_.positions.size(), 2.0);
  check_derivatives(model, random_nodes, kSmallStep, kRough);
}

TEST_P(MeanDilatationCrushed, DefiniteMatrixHasNoNegativeEigenvalueInAnyState) {
  MeanDilatation model = made(block());
  const Sparsity pattern = test::bind_alone(model, nodes());
  for (int i = 0; i < 3; ++i) {
    State state = affine(Mat3::Identity());
    state.positions = random_.numbers(box_.positions.size(), 2.0);
    const StiffnessScale definite{-1.0, 0.0, true};
    const Eigen::MatrixXd exact = stiffness_of(model, state, {-1.0, 0.0}, pattern, GetParam().isa);
    const Eigen::MatrixXd K = stiffness_of(model, state, definite, pattern, GetParam().isa);
    const Eigen::VectorXd after = test::eigenvalues(K);
    const double largest = after.maxCoeff();
    EXPECT_LT(test::eigenvalues(exact).minCoeff(), -1e-3 * largest);
    EXPECT_GT(after.minCoeff(), -1e-11 * largest);
    EXPECT_LT(relative_difference(K, K.transpose()), 1e-13);
    // What is added is positive semi-definite too: nothing that was there is lost.
    EXPECT_GT(test::eigenvalues(K - exact).minCoeff(), -1e-11 * largest);
  }
}

TEST_P(MeanDilatationCrushed, DefiniteMatrixIsTheExactOneWhereThatIsDefinite) {
  MeanDilatation model = made(block());
  const Sparsity pattern = test::bind_alone(model, nodes());
  const State state = affine(1.1 * random_.rotation().toRotationMatrix());  // stretched to all sides
  const Eigen::MatrixXd exact = stiffness_of(model, state, {-1.0, 0.0}, pattern, GetParam().isa);
  const Eigen::MatrixXd K = stiffness_of(model, state, {-1.0, 0.0, true}, pattern, GetParam().isa);
  EXPECT_LT(relative_difference(K, exact), 1e-11);
}

std::vector<test::DilatationCase> safe_cases() {
  std::vector<test::DilatationCase> cases = test::dilatation_cases();
  std::erase_if(cases, [](const auto& c) { return c.law != "stable_neo_hooke" && c.law != "stvk"; });
  return cases;
}
INSTANTIATE_TEST_SUITE_P(All, MeanDilatationCrushed, testing::ValuesIn(safe_cases()), test::dilatation_name);

/// Neo-Hooke's energy has no value inside out, and the step is told so as with continuum elements.
TEST(MeanDilatation, LawsThatRefuseInvertedCellsStillDo) {
  const test::CellBox box = test::cell_box("tetra", {2, 2, 2}, 0.05);
  ElasticBlock block = test::corotational_block(box, "tetra");
  block.law = "neo_hooke";
  const MeanDilatation model(block, box.positions, choose_isa(), Threads(1));
  State state;
  state.positions = box.positions;
  for (std::size_t i = 0; i < state.positions.size(); i += 3) state.positions[i] *= -1.0;
  EXPECT_FALSE(std::isfinite(model.energy(state, test::scratch())));
}

}  // namespace
}  // namespace tissu
