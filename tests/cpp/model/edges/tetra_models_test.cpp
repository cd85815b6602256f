#include <cstring>
#include <limits>

#include "../../force/room.h"
#include "tetra_models_sample.h"
#include "tissu/edit/remove_cells.h"

/// The models that are other forms of linear tetrahedra: force, tangent, energy and fields of each against
/// those of the continuum element with the same law, and what they owe to themselves.
namespace tissu {
namespace {

using test::derivative;
using test::force_of;
using test::kEqual;
using test::moved;
using test::product_of;
using test::relative_difference;
using test::stiffness_of;
using test::view;

class TetraModels : public test::TetraModelsTest {};

TEST_P(TetraModels, EqualTheContinuumElement) {
  const auto model = made();
  const auto element = continuum();
  const Sparsity pattern = test::bind_alone(*model, mesh_.node_count());
  test::bind_alone(*element, mesh_.node_count());
  for (int i = 0; i < 10; ++i) {
    const State state = any_state();
    const std::vector<double> p = random_.numbers(state.positions.size());
    const Eigen::VectorXd f = force_of(*element, state);
    ASSERT_TRUE(f.allFinite());
    ASSERT_GT(f.norm(), 0.5);
    EXPECT_LT(relative_difference(force_of(*model, state), f), kEqual);
    EXPECT_LT(relative_difference(product_of(*model, state, {-0.7, 0.0}, p),
                                  product_of(*element, state, {-0.7, 0.0}, p)),
              kEqual);
    EXPECT_LT(relative_difference(stiffness_of(*model, state, {1.3, 2.0}, pattern, GetParam().isa),
                                  stiffness_of(*element, state, {1.3, 2.0}, pattern, GetParam().isa)),
              kEqual);
    EXPECT_NEAR(model->energy(state, test::scratch()), element->energy(state, test::scratch()),
                kEqual * element->energy(state, test::scratch()));
  }
}

TEST_P(TetraModels, FieldsEqualThoseOfTheContinuumElement) {
  const auto model = made();
  const State state = any_state();
  const CellFields mine = model->fields(state);
  const CellFields theirs = continuum()->fields(state);
  EXPECT_LT(relative_difference(view(mine.von_mises), view(theirs.von_mises)), kEqual);
  EXPECT_LT(relative_difference(view(mine.energy_density), view(theirs.energy_density)), kEqual);
  EXPECT_LT(relative_difference(view(mine.volume_ratio), view(theirs.volume_ratio)), kEqual);
  double sum = 0.0;
  for (std::size_t i = 0; i < mine.energy_density.size(); ++i) {
    sum += mine.energy_density[i] * model->volumes()[i];
  }
  EXPECT_NEAR(sum, model->energy(state, test::scratch()), kEqual * sum);
}

TEST_P(TetraModels, MassesAndVolumesEqualThoseOfTheContinuumElement) {
  const auto model = made();
  const auto element = continuum();
  constexpr double kLastBits = 1e-15;  // J^-1 whole or as a triangle
  EXPECT_LT(relative_difference(view(model->volumes()), view(element->volumes())), kLastBits);
  std::vector<double> mine(static_cast<std::size_t>(mesh_.node_count()));
  std::vector<double> theirs = mine;
  model->add_masses(mine);
  element->add_masses(theirs);
  EXPECT_LT(relative_difference(view(mine), view(theirs)), kLastBits);
  model->add_weights(mine);
  element->add_weights(theirs);
  EXPECT_LT(relative_difference(view(mine), view(theirs)), kLastBits);
}

// Polynomials of degree four: exact but for round-off, 1e-16 x energy (10 J) / h (1e-2), and two digits for
// the sums, a third for terms of the expanded one that cancel. Neo-Hooke is none: h^4 (1e-10 at h = 3e-3)
// times its fifth derivative, some hundred.
TEST_P(TetraModels, ForceIsMinusGradientOfEnergyAndProductItsDerivative) {
  const auto model = made();
  const double h = is_polynomial() ? 1e-2 : 3e-3;
  const double tolerance = !is_polynomial() ? 1e-7 : is_tensor() ? 1e-10 : 1e-11;
  for (int i = 0; i < 5; ++i) {
    const State state = any_state();
    const std::vector<double> p = random_.numbers(state.positions.size());
    const double slope =
        derivative([&](double t) { return model->energy(moved(state, p, t), test::scratch()); }, h);
    EXPECT_NEAR(force_of(*model, state).dot(view(p)), -slope, tolerance * (1.0 + std::abs(slope)));
    const Eigen::VectorXd change =
        derivative([&](double t) { return force_of(*model, moved(state, p, t)); }, h);
    EXPECT_LT(relative_difference(product_of(*model, state, {1.0, 0.0}, p), change), tolerance);
  }
}

TEST_P(TetraModels, MatrixTimesVectorIsProductAndIsSymmetric) {
  const auto model = made();
  const Sparsity pattern = test::bind_alone(*model, mesh_.node_count());
  const State state = any_state();
  const std::vector<double> p = random_.numbers(state.positions.size());
  const Eigen::MatrixXd K = stiffness_of(*model, state, {1.0, 0.0}, pattern, GetParam().isa);
  EXPECT_LT(relative_difference(K, K.transpose()), 1e-14);
  EXPECT_LT(relative_difference(K * view(p), product_of(*model, state, {1.0, 0.0}, p)), kEqual);
  EXPECT_EQ(product_of(*model, state, {0.0, 3.0}, p).norm(), 0.0);  // no part in v
  std::vector<double> f = random_.numbers(p.size());                // adds to what is there
  const Eigen::VectorXd expected = view(f) + force_of(*model, state);
  model->add_force(state, test::scratch(), f);
  EXPECT_LT(relative_difference(view(f), expected), 1e-14);
}

// Stresses of 1 Pa on areas of 1 m2, hundred sums: 1e-13. The expanded polynomial multiplies displacements of
// 8 m with each other where the body turns: terms of 8^3 Pa and, in the energy, 8^4 that cancel.
TEST_P(TetraModels, RigidMotionsGiveNoForce) {
  const auto model = made();
  const double round_off = is_tensor() ? 1e-10 : 1e-13;
  EXPECT_LT(force_of(*model, rest()).cwiseAbs().maxCoeff(), 1e-13);
  const State shifted = affine(Mat3::Identity(), Vec3(1.5, -2.0, 0.25));
  EXPECT_LT(force_of(*model, shifted).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(std::abs(model->energy(shifted, test::scratch())), 1e-13);
  const State turned = affine(Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()).toRotationMatrix());
  if (is_linear()) {
    EXPECT_GT(force_of(*model, turned).cwiseAbs().maxCoeff(), 0.1);
  } else {
    EXPECT_LT(force_of(*model, turned).cwiseAbs().maxCoeff(), round_off);
    EXPECT_LT(std::abs(model->energy(turned, test::scratch())), round_off);
  }
}

TEST_P(TetraModels, ForcesBalance) {
  const auto model = made();
  const State state = any_state();
  const Eigen::VectorXd f = force_of(*model, state);
  Vec3 sum = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
    sum += f.segment<3>(3 * i);
    moment += tissu::block(ConstReals(state.positions), i).cross(Vec3(f.segment<3>(3 * i)));
  }
  EXPECT_LT(sum.norm(), 1e-12);
  if (!is_linear()) {
    EXPECT_LT(moment.norm(), 1e-11);  // arms of up to 6 m
  }
}

TEST_P(TetraModels, StiffnessIsConstantForHookeOnly) {
  const auto model = made();
  EXPECT_EQ(model->has_constant_stiffness(), is_linear());
  const Sparsity pattern = test::bind_alone(*model, mesh_.node_count());
  const Eigen::MatrixXd at_rest = stiffness_of(*model, rest(), {1.0, 0.0}, pattern);
  const Eigen::MatrixXd K = stiffness_of(*model, any_state(), {1.0, 0.0}, pattern);
  EXPECT_EQ(relative_difference(K, at_rest) < 0.01, is_linear());
}

TEST_P(TetraModels, OneParameterForAllIsThatOfEach) {
  ElasticBlock one = block(GetParam().model);
  for (auto* values : {&one.parameters["young"], &one.parameters["poisson"], &one.density}) {
    values->resize(1);
  }
  ElasticBlock each = one;
  const auto cells = static_cast<std::size_t>(mesh_.cell_count());
  each.parameters["young"].assign(cells, one.parameters["young"][0]);
  each.parameters["poisson"].assign(cells, one.parameters["poisson"][0]);
  const State state = any_state();
  const auto force = [&](const ElasticBlock& block) {
    return force_of(*make_model(block, mesh_.positions, GetParam().isa, Threads(1)), state);
  };
  EXPECT_EQ(force(one), force(each));
}

TEST_P(TetraModels, AgreesWithTheBaseline) {
  const auto here = made();
  const auto base = make_model(block(GetParam().model), mesh_.positions, Isa::baseline, Threads(1));
  const State state = any_state();
  EXPECT_LT(relative_difference(force_of(*here, state), force_of(*base, state)), kEqual);
  EXPECT_NEAR(here->energy(state, test::scratch()), base->energy(state, test::scratch()),
              kEqual * base->energy(state, test::scratch()));
}

/// Many chunks and colours: force, product, matrix and energy have the same bits whatever the threads.
TEST_P(TetraModels, SameBitsOnOneToFourThreads) {
  mesh_ = test::distorted_box({9, 8, 7}, Split::six, 0.1);
  const State state = any_state();
  const std::vector<double> p = random_.numbers(state.positions.size());
  const auto all = [&](int threads) {
    const auto model = made(GetParam().model, threads);
    const Sparsity pattern = test::bind_alone(*model, mesh_.node_count());
    BlockMatrix matrix(pattern, GetParam().isa, Threads(threads));
    matrix.clear();
    model->add_stiffness(state, test::scratch(), {1.0, 0.0}, matrix);
    std::vector<double> numbers(p.size());
    model->add_force(state, test::scratch(), numbers);
    std::vector<double> product(p.size());
    model->add_product(state, test::scratch(), {1.0, 0.0}, p, product);
    numbers.insert(numbers.end(), product.begin(), product.end());
    const double* values = std::as_const(matrix).values();
    numbers.insert(numbers.end(), values, values + 9 * pattern.blocks());
    numbers.push_back(model->energy(state, test::scratch()));
    return numbers;
  };
  const std::vector<double> one = all(1);
  for (const int threads : {2, 3, 4}) {
    const std::vector<double> several = all(threads);
    ASSERT_EQ(one.size(), several.size());
    EXPECT_EQ(std::memcmp(one.data(), several.data(), one.size() * sizeof(double)), 0) << threads;
  }
}

/// One step of a whole world after another, beside the continuum element, and cells removed on the way.
TEST_P(TetraModels, StepsAsTheContinuumElementDoes) {
  const auto world = [&](const char* model) {
    WorldDescription description;
    description.bodies = {test::body_of(mesh_, {.law = GetParam().law, .young = 300.0})};
    description.bodies[0].elastic[0].model = options_named(model);
    description.bodies[0].rayleigh = {0.1, 0.001};
    description.gravity = Vec3(0.0, 0.0, -2.0);
    description.fixed = {test::fixed(test::nodes_where(mesh_, [](const Vec3& x) { return x.x() < 0.6; }))};
    description.editable = true;
    description.isa = GetParam().isa;
    return test::simulate(std::move(description), test::implicit_euler());
  };
  Simulation mine = world(GetParam().model);
  Simulation theirs = world("fem");
  for (int i = 0; i < 20; ++i) {
    for (Simulation* simulation : {&mine, &theirs}) {
      simulation->step(0.01);
      if (i != 10) continue;
      const std::vector<std::int32_t> cells = {70, 31, 32};
      simulation->replace_world(remove_cells(simulation->world(), simulation->state(), "body", cells));
    }
    // 1e-12 in the forces grows by the condition of each solve.
    EXPECT_LT((view(mine.state().positions) - view(theirs.state().positions)).norm(), 1e-10) << i;
  }
  EXPECT_GT((view(mine.state().positions) - view(mesh_.positions)).norm(), 1e-2);
}

TEST_P(TetraModels, RefusesWhatItDoesNotTake) {
  const auto message = [&](ElasticBlock block) -> std::string {
    try {
      make_model(std::move(block), mesh_.positions, GetParam().isa, Threads(1));
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "nothing was refused";
  };
  const auto expect = [&](const ElasticBlock& block, std::string_view part) {
    EXPECT_NE(message(block).find(part), std::string::npos) << message(block);
    EXPECT_NE(message(block).find(GetParam().model), std::string::npos) << message(block);
  };
  const ElasticBlock good = block(GetParam().model);
  ElasticBlock bad = good;
  bad.law = "yeoh";
  expect(bad, "takes " + std::string(find_model(GetParam().model)->laws.front()));
  bad = good;
  bad.element = "hexahedron";
  expect(bad, "takes tetra");
  bad = good;
  bad.reinforcements = {{"fibre", {}}};
  expect(bad, "only the models fem and mean-dilatation take them");
  bad = good;
  bad.parameters["young"] = {-1.0};
  EXPECT_NE(message(bad).find("young"), std::string::npos) << message(bad);
  bad = good;
  bad.parameters.erase("poisson");
  EXPECT_NE(message(bad).find("lacks its parameter poisson"), std::string::npos) << message(bad);
  mesh_.positions[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_model(good, mesh_.positions, GetParam().isa, Threads(1)), MeshError);
}

INSTANTIATE_TEST_SUITE_P(All, TetraModels, testing::ValuesIn(test::tetra_models()),
                         [](const auto& info) { return test::text(info.param); });

}  // namespace
}  // namespace tissu
