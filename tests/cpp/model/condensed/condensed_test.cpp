#include "tissu/model/condensed/condensed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "../../force/room.h"
#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/edit/remove_cells.h"

/// A condensed region beside the same region with all its nodes.
namespace tissu {
namespace {

constexpr double kGravity = 0.02;

class CondensedTest : public testing::TestWithParam<Split> {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(4, 2, 2), {4, 4, 4}, GetParam());
  std::vector<std::int32_t> left_ = test::nodes_at(mesh_, 0, 0.0);
  std::vector<std::int32_t> right_ = test::nodes_at(mesh_, 0, 4.0);

  std::vector<std::int32_t> surface() const {
    return test::nodes_where(mesh_, [](const Vec3& x) {
      return x[0] == 0 || x[0] == 4 || x[1] == 0 || x[1] == 2 || x[2] == 0 || x[2] == 2;
    });
  }
  std::vector<std::int32_t> touched() const {
    std::vector<std::int32_t> nodes = left_;
    nodes.insert(nodes.end(), right_.begin(), right_.end());
    return nodes;
  }
  /// Held at the left, pulled at the right, under gravity. No kept nodes: all of them.
  WorldDescription world(const std::vector<std::int32_t>& kept) const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {"hooke", 3.0, 0.3, 2.0})};
    if (!kept.empty()) world.bodies[0].elastic[0].model = CondensedOptions{.kept = kept};
    world.fixed = {test::fixed(left_)};
    world.gravity = Vec3(0.3 * kGravity, 0.0, -kGravity);
    world.consistent_weight = true;
    LoadDescription load{"pull", "body", right_, {}, {{0.0, 2.0}, {0.0, 2.0}}};
    for (std::size_t i = 0; i < right_.size(); ++i) load.forces.insert(load.forces.end(), {1e-3, 5e-4, 0.0});
    world.loads = {load};
    return world;
  }
  static Simulation at_rest(WorldDescription description) {
    Simulation simulation = test::simulate(
        std::move(description), std::make_unique<StaticEquilibrium>(StaticEquilibrium::Settings{}));
    simulation.step(1.0);
    simulation.step(0.5);  // a load that has changed
    simulation.settle();
    return simulation;
  }
  static double largest(const std::vector<double>& a, const std::vector<double>& b) {
    double result = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
    return result;
  }
};

// Both solve the same equations; 1e-12 of the displacement leaves room for the condition of the matrix.
TEST_P(CondensedTest, IsTheWholeRegionInEquilibrium) {
  const Simulation whole = at_rest(world({}));
  const double size = largest(whole.state().positions, mesh_.positions);
  ASSERT_GT(size, 0.05);
  for (const auto& kept : {surface(), touched()}) {
    const Simulation condensed = at_rest(world(kept));
    EXPECT_LT(largest(condensed.state().positions, whole.state().positions), 1e-11 * size);
    EXPECT_EQ(condensed.world().body("body").models[0]->eliminated().size(),
              static_cast<std::size_t>(mesh_.node_count()) - kept.size());
  }
}

TEST_P(CondensedTest, KeepsMassAndWeight) {
  const World whole(world({}));
  const World condensed(world(surface()));
  EXPECT_NEAR(condensed.mass().total(), whole.mass().total(), 1e-12 * whole.mass().total());
  std::vector<double> force(condensed.rest_positions().size(), 0.0);
  const State rest = condensed.rest_state();
  for (const auto& model : condensed.forces()) model->add_force(rest, test::scratch(), force);
  double down = 0.0;
  for (std::size_t i = 2; i < force.size(); i += 3) down += force[i];
  const double weight = 2.0 * 16.0 * kGravity;
  EXPECT_NEAR(down, -weight, 1e-12 * weight);
}

TEST_P(CondensedTest, ForceIsTheGradientOfTheEnergyAndProductTheMatrix) {
  WorldDescription description = world(touched());
  const World world(description);
  const BodyModel& model = *world.body("body").models[0];
  test::Random random(5);
  State state = world.rest_state();
  for (double& x : state.positions) x += random.number(0.1);
  const std::vector<double> p = random.numbers(state.positions.size(), 1.0);
  // The energy is quadratic: central differences have no error but round-off, 1e-16 W / h with h = 1e-3.
  const double slope = (model.energy(test::moved(state, p, 1e-3), test::scratch()) -
                        model.energy(test::moved(state, p, -1e-3), test::scratch())) /
                       2e-3;
  const Eigen::VectorXd direction = test::view(p);
  const double work = test::force_of(model, state).dot(direction);
  EXPECT_NEAR(work, -slope, 1e-9 * std::abs(slope));
  const Eigen::MatrixXd K = test::stiffness_of(model, state, {0.7, 0.0}, world.sparsity());
  const Eigen::VectorXd product = test::product_of(model, state, {0.7, 0.0}, p);
  EXPECT_LT((K * direction - product).norm(), 1e-13 * product.norm());
  EXPECT_LT((K - K.transpose()).norm(), 1e-15 * K.norm());
  const Eigen::VectorXd change =
      test::force_of(model, test::moved(state, p, 1.0)) - test::force_of(model, state);
  EXPECT_LT((0.7 * change - product).norm(), 1e-12 * product.norm());
}

// The region as a whole, one half condensed, of which only the common nodes and the held ones are kept.
TEST_P(CondensedTest, MeetsAnotherRegionAndStaysWhenThatIsCut) {
  const auto build = [&](bool condensed) {
    WorldDescription description = world({});
    const ElasticBlock all = description.bodies[0].elastic[0];
    const auto nodes = static_cast<std::size_t>(find_element(all.element)->nodes);
    std::vector<std::size_t> low;
    std::vector<std::size_t> high;
    for (std::size_t cell = 0; cell < all.cells.size() / nodes; ++cell) {
      double x = 0.0;
      for (std::size_t a = 0; a < nodes; ++a) x += mesh_.node(all.cells[cell * nodes + a]).x();
      (x / static_cast<double>(nodes) < 2.0 ? low : high).push_back(cell);
    }
    ElasticBlock first = part_of(all, low);
    if (condensed) {
      std::vector<std::int32_t> kept = left_;
      const auto middle = test::nodes_at(mesh_, 0, 2.0);
      kept.insert(kept.end(), middle.begin(), middle.end());
      first.model = CondensedOptions{.kept = kept};
    }
    description.bodies[0].elastic = {first, part_of(all, high)};
    description.editable = true;
    return description;
  };
  Simulation whole = at_rest(build(false));
  Simulation hybrid = at_rest(build(true));
  const double size = largest(whole.state().positions, mesh_.positions);
  EXPECT_LT(largest(hybrid.state().positions, whole.state().positions), 1e-11 * size);
  const std::vector<double> before = whole.state().positions;
  const std::vector<std::int32_t> cells = {
      static_cast<std::int32_t>(hybrid.world().body("body").models[0]->cell_count()) + 1};
  for (Simulation* simulation : {&whole, &hybrid}) {
    simulation->replace_world(remove_cells(simulation->world(), simulation->state(), "body", cells));
    simulation->step(0.1);
    simulation->settle();
  }
  EXPECT_GT(largest(whole.state().positions, before), 1e-3 * size);  // the cut is felt
  EXPECT_LT(largest(hybrid.state().positions, whole.state().positions), 1e-11 * size);
}

TEST_P(CondensedTest, RefusesWhatItCannotEliminate) {
  const auto message = [](const WorldDescription& description) -> std::string {
    try {
      const World world(description);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(world(right_)).find("is held or led; keep it"), std::string::npos);
  EXPECT_NE(message(world(left_)).find("carries pull; keep it"), std::string::npos);
  WorldDescription none = world(left_);
  none.bodies[0].elastic[0].model = CondensedOptions{};
  EXPECT_NE(message(none).find("keeps no node"), std::string::npos);
  WorldDescription loose = world({left_[0]});
  loose.fixed = {test::fixed({left_[0]})};
  loose.loads.clear();
  EXPECT_NE(message(loose).find("do not hold"), std::string::npos);
  WorldDescription other = world(surface());
  other.bodies[0].elastic[0].law = "stvk";
  EXPECT_NE(message(other).find("this model takes hooke"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Cells, CondensedTest, testing::Values(Split::none, Split::six),
                         [](const auto& info) {
                           return info.param == Split::none ? "hexahedra" : "tetrahedra";
                         });

}  // namespace
}  // namespace tissu
