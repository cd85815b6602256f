#include "tissu/model/models.h"

#include <gtest/gtest.h>

#include <numeric>

#include "../force/room.h"
#include "projection_sample.h"

/// What every model of the list must do, so that a new one is in these tests by being in the list.
namespace tissu {
namespace {

class EveryModel : public testing::TestWithParam<std::string> {
 protected:
  Mesh mesh_ = test::distorted_box({2, 2, 2}, Split::six, 0.1);
  const ModelInfo& info_ = *find_model(GetParam());

  ElasticBlock block() const {
    const bool any = info_.laws.empty();
    ElasticBlock block =
        test::elastic_block(mesh_.blocks[0], {any ? "stvk" : std::string(info_.laws.front()), 3.0, 0.3, 2.0});
    block.model = options_named(GetParam());
    if (auto* condensed = std::get_if<CondensedOptions>(&block.model)) {
      for (std::int32_t i = 0; i < mesh_.node_count(); i += 2) condensed->kept.push_back(i);
    }
    return block;
  }
  std::unique_ptr<BodyModel> made() const {
    return make_model(block(), mesh_.positions, Isa::baseline, Threads(1));
  }
  State near_rest() const {
    State state;
    state.positions = mesh_.positions;
    state.velocities.assign(mesh_.positions.size(), 0.0);
    test::Random random(21);
    for (double& x : state.positions) x += random.number(0.03);
    return state;
  }
};

TEST_P(EveryModel, SaysWhatItIs) {
  EXPECT_FALSE(info_.form.empty());
  for (const Ability* ability :
       {&info_.poisson, &info_.rotation, &info_.strain, &info_.inversion, &info_.topology}) {
    EXPECT_FALSE(ability->how.empty());
  }
  EXPECT_FALSE(made()->effect().empty());
  EXPECT_EQ(made()->kind(), ForceKind::elastic);
}

TEST_P(EveryModel, HasTheMassOfItsCells) {
  const auto model = made();
  std::vector<double> masses(mesh_.positions.size() / 3, 0.0);
  model->add_masses(masses);
  const double volume = std::accumulate(model->volumes().begin(), model->volumes().end(), 0.0);
  EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.0), 2.0 * volume, 1e-13 * volume);
  EXPECT_EQ(model->cell_count(), mesh_.cell_count());
  EXPECT_GT(model->bytes(), 0U);
}

// Central differences of the energy with h = 1e-4 of a unit edge: error 1e-8 of the third derivative.
TEST_P(EveryModel, ForceIsMinusTheGradientOfItsEnergy) {
  const auto model = made();
  const State state = near_rest();
  const Eigen::VectorXd f = test::force_of(*model, state);
  test::Random random(4);
  for (int trial = 0; trial < 5; ++trial) {
    const std::vector<double> p = random.numbers(state.positions.size(), 1.0);
    const double slope = test::derivative(
        [&](double t) { return model->energy(test::moved(state, p, t), test::scratch()); }, 1e-3);
    EXPECT_NEAR(f.dot(test::view(p)), -slope, 1e-8 * f.norm() * test::view(p).norm());
  }
}

TEST_P(EveryModel, ProductIsItsMatrix) {
  const auto model = made();
  const Sparsity pattern = test::bind_alone(*model, mesh_.node_count());
  const State state = near_rest();
  test::Random random(5);
  const std::vector<double> p = random.numbers(state.positions.size(), 1.0);
  const Eigen::MatrixXd K = test::stiffness_of(*model, state, {-0.3, 0.0}, pattern);
  const Eigen::VectorXd Kp = test::product_of(*model, state, {-0.3, 0.0}, p);
  EXPECT_LT((K * test::view(p) - Kp).norm(), 1e-12 * Kp.norm());
  EXPECT_LT((K - K.transpose()).norm(), 1e-12 * K.norm());
  EXPECT_EQ(test::product_of(*model, state, {0.0, 1.0}, p).norm(), 0.0);  // elastic: no df/dv
}

// A body of many cells, squeezed and at random, whatever the threads.
TEST_P(EveryModel, HasADefiniteMatrixWhenAskedFor) {
  const auto model = made();
  const Sparsity pattern = test::bind_alone(*model, mesh_.node_count());
  const State near = near_rest();
  for (const std::string& name : test::states()) {
    SCOPED_TRACE(name);
    const State state = test::put(mesh_.positions, name);
    const Eigen::MatrixXd K = test::stiffness_of(*model, state, test::kDefinite, pattern);
    test::expect_definite(K, test::stiffness_of(*model, state, test::kExact, pattern));
    test::expect_near(test::stiffness_of(*model, state, {0.25, 0.0, true}, pattern), -0.25 * K, 1e-15);
    for (const int threads : {2, 3, 4}) {
      const auto other = make_model(block(), mesh_.positions, Isa::baseline, Threads(threads));
      other->bind(pattern);
      EXPECT_EQ(test::stiffness_of(*other, state, test::kDefinite, pattern), K) << threads;
    }
  }
  const State stretched = test::put(mesh_.positions, "stretched");
  test::expect_near(test::stiffness_of(*model, stretched, test::kDefinite, pattern),
                    test::stiffness_of(*model, stretched, test::kExact, pattern), 1e-11);
  // It is asked of the matrix only.
  const std::vector<double> p = test::Random(6).numbers(near.positions.size(), 1.0);
  EXPECT_EQ(test::product_of(*model, near, test::kDefinite, p),
            test::product_of(*model, near, test::kExact, p));
}

TEST_P(EveryModel, RestsAtRestAndPullsNothingAlong) {
  const auto model = made();
  State state = near_rest();
  state.positions = mesh_.positions;
  const double scale = test::force_of(*model, near_rest()).norm();
  EXPECT_LT(test::force_of(*model, state).norm(), 1e-13 * scale);
  EXPECT_NEAR(model->energy(state, test::scratch()), 0.0, 1e-15);
  for (std::size_t i = 0; i < state.positions.size(); i += 3) state.positions[i] += 7.0;
  EXPECT_LT(test::force_of(*model, state).norm(), 1e-12 * scale);
  const Eigen::VectorXd f = test::force_of(*model, near_rest());
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0;
    for (Eigen::Index i = axis; i < f.size(); i += 3) sum += f[i];
    EXPECT_NEAR(sum, 0.0, 1e-13 * scale);
  }
}

TEST_P(EveryModel, RefusesWhatItDoesNotTake) {
  const auto message = [&](const ElasticBlock& block) -> std::string {
    try {
      (void)make_model(block, mesh_.positions, Isa::baseline, Threads(1));
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  ElasticBlock wrong = block();
  wrong.law = "putty";
  EXPECT_NE(message(wrong).find("putty"), std::string::npos);
  if (!info_.elements.empty()) {
    wrong = block();
    wrong.element = "hexahedron27";
    EXPECT_NE(message(wrong).find("this model takes"), std::string::npos);
  }
  wrong = block();
  wrong.density = {-1.0};
  EXPECT_NE(message(wrong).find("density of -1"), std::string::npos);
}

TEST(ModelOptionsTest, NameEveryModelAndNoOther) {
  EXPECT_EQ(all_models().size(), std::variant_size_v<ModelOptions>);
  for (const ModelInfo& info : all_models()) EXPECT_EQ(model_name(options_named(info.name)), info.name);
  try {
    (void)options_named("plasticine");
    ADD_FAILURE() << "nothing was refused";
  } catch (const ParameterError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("no model \"plasticine\"; there are fem, corotational"), std::string::npos) << said;
  }
}

/// Those whose nodes have no rotation; the others are in frames_test.cpp and shell_test.cpp.
std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const ModelInfo& info : all_models()) {
    if (info.name != "shell" && info.name != "frames") result.emplace_back(info.name);
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel, testing::ValuesIn(names()), [](const auto& info) {
  std::string name = info.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace tissu
