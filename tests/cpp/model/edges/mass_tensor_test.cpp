#include "tissu/model/edges/mass_tensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "../../force/room.h"
#include "../../force/verbs.h"
#include "../../world/sample_worlds.h"
#include "tissu/edit/remove_cells.h"
#include "tissu/model/models.h"

/// What is the mass-tensor model's own: how many constants there are and where, and edits that change only
/// those of the cells that go. What it shares with other models is in tetra_models_test.cpp.
namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

class MassTensorTest : public testing::TestWithParam<const char*> {
 protected:
  Mesh mesh_ = test::distorted_box({6, 5, 4}, Split::six, 0.1);
  bool is_linear() const { return std::string_view(GetParam()) == "hooke"; }

  ElasticBlock block() const {
    ElasticBlock block = test::elastic_block(mesh_.blocks[0], {.law = GetParam()});
    block.model = MassTensorOptions{};
    block.parameters["young"].clear();  // differs from cell to cell: the right ones have to stay
    for (std::int32_t i = 0; i < mesh_.cell_count(); ++i) {
      block.parameters["young"].push_back(3.0 + 0.01 * i);
      block.cell_numbers.push_back(i);
    }
    return block;
  }
  MassTensor made(ElasticBlock block) const {
    return {std::move(block), mesh_.positions, choose_isa(), Threads(1)};
  }
  static ElasticBlock left_of(const ElasticBlock& block, const Numbers& removed) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < block.cells.size() / 4; ++i) {
      if (!std::ranges::binary_search(removed, static_cast<std::int32_t>(i))) kept.push_back(i);
    }
    return part_of(block, kept);
  }
  State moved() const {
    State state;
    state.positions = mesh_.positions;
    test::Random random(9);
    for (double& x : state.positions) x += random.number(0.2);
    state.velocities.assign(state.positions.size(), 0.0);
    return state;
  }
  /// Nodes, edges, faces and cells that some cells have, each counted once.
  static std::array<std::set<Numbers>, 4> parts(const ElasticBlock& block, const Numbers& cells) {
    std::array<std::set<Numbers>, 4> result;
    for (const std::int32_t cell : cells) {
      for (unsigned chosen = 1; chosen < 16; ++chosen) {
        Numbers nodes;
        for (std::size_t a = 0; a < 4; ++a) {
          if ((chosen >> a & 1U) != 0) nodes.push_back(block.cells[4 * static_cast<std::size_t>(cell) + a]);
        }
        std::ranges::sort(nodes);
        result[nodes.size() - 1].insert(nodes);
      }
    }
    return result;
  }
  /// Constants on them.
  std::size_t constants_on(const std::array<std::size_t, 4>& parts) const {
    const std::array<std::size_t, 4> reals =
        is_linear() ? std::array<std::size_t, 4>{9, 9, 0, 0} : std::array<std::size_t, 4>{13, 26, 18, 6};
    std::size_t sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += reals[k] * parts[k];
    return sum;
  }
  Numbers all_cells() const {
    Numbers all(static_cast<std::size_t>(mesh_.cell_count()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
    return all;
  }
};

/// Picinbono's 280, and six of the tetrahedron itself.
TEST_P(MassTensorTest, ATetrahedronAloneHasTheNumbersThatThePaperCounts) {
  ElasticBlock one = block();
  one.cells.resize(4);
  one.parameters["young"].resize(1);
  one.cell_numbers.resize(1);
  const MassTensor model = made(one);
  EXPECT_EQ(model.reals_per_cell(), is_linear() ? 4U * 9U + 6U * 9U : 280U + 6U);
  EXPECT_EQ(model.constants(), model.reals_per_cell());
}

TEST_P(MassTensorTest, AMeshSharesThem) {
  const MassTensor model = made(block());
  const auto all = parts(block(), all_cells());
  EXPECT_EQ(model.constants(), constants_on({all[0].size(), all[1].size(), all[2].size(), all[3].size()}));
  EXPECT_EQ(model.computed_constants(), model.constants());
  const auto cells = static_cast<std::size_t>(mesh_.cell_count());
  EXPECT_LT(3 * model.constants(), cells * model.reals_per_cell());
}

// The same constants to the last bit, met in another order: some hundred sums of 1e-16.
constexpr double kOtherOrder = 1e-14;

/// The edited model is the one that never had the cells, and only constants on the nodes, edges and faces of
/// removed cells that others still have were summed up again.
TEST_P(MassTensorTest, EditedIsRebuiltAndTouchesOnlyWhatTheCellsHad) {
  const ElasticBlock before = block();
  const MassTensor whole = made(before);
  const State state = moved();
  const std::vector<double> p = test::Random(4).numbers(state.positions.size());
  for (const Numbers& removed : {Numbers{100}, Numbers{0, 101, 400}, Numbers{200, 201, 202, 203, 204, 205}}) {
    const ElasticBlock left = left_of(before, removed);
    const auto edited = whole.without(left, removed);
    ASSERT_NE(edited, nullptr);
    MassTensor rebuilt = made(left);
    using test::relative_difference;
    EXPECT_LT(relative_difference(test::force_of(*edited, state), test::force_of(rebuilt, state)),
              kOtherOrder);
    EXPECT_LT(relative_difference(test::product_of(*edited, state, {1, 0}, p),
                                  test::product_of(rebuilt, state, {1, 0}, p)),
              kOtherOrder);
    const Sparsity pattern = test::bind_alone(rebuilt, mesh_.node_count());
    test::bind_alone(*edited, mesh_.node_count());
    EXPECT_LT(relative_difference(test::stiffness_of(*edited, state, {1, 0}, pattern),
                                  test::stiffness_of(rebuilt, state, {1, 0}, pattern)),
              kOtherOrder);
    EXPECT_NEAR(edited->energy(state, test::scratch()), rebuilt.energy(state, test::scratch()),
                1e-12 * rebuilt.energy(state, test::scratch()));
    std::vector<double> masses(static_cast<std::size_t>(mesh_.node_count()));
    std::vector<double> expected = masses;
    edited->add_masses(masses);
    rebuilt.add_masses(expected);
    EXPECT_EQ(masses, expected);
    EXPECT_EQ(edited->volumes(), rebuilt.volumes());

    const auto gone = parts(before, removed);
    Numbers kept = all_cells();
    std::erase_if(kept, [&](std::int32_t cell) { return std::ranges::binary_search(removed, cell); });
    const auto still = parts(before, kept);
    std::array<std::size_t, 4> touched = {};
    for (std::size_t k = 0; k < 4; ++k) {
      touched[k] = static_cast<std::size_t>(
          std::ranges::count_if(gone[k], [&](const Numbers& part) { return still[k].contains(part); }));
    }
    const auto& as_tensor = dynamic_cast<const MassTensor&>(*edited);
    EXPECT_EQ(as_tensor.computed_constants(), constants_on(touched));
    EXPECT_LE(as_tensor.computed_constants(), removed.size() * whole.reals_per_cell());
    EXPECT_EQ(as_tensor.constants(), rebuilt.constants());
  }
}

/// Edit after edit, down to one cell, leaves no residue.
TEST_P(MassTensorTest, ManyEditsLeaveNoResidue) {
  mesh_ = test::distorted_box({2, 1, 1}, Split::six, 0.1);
  std::unique_ptr<BodyModel> model =
      std::make_unique<MassTensor>(made(block()).block(), mesh_.positions, choose_isa(), Threads(1));
  const State state = moved();
  while (model->cell_count() > 1) {
    const Numbers removed = {model->cell_count() / 2};
    const ElasticBlock left = left_of(model->block(), removed);
    model = model->without(left, removed);
    const Eigen::VectorXd f = test::force_of(made(left), state);
    EXPECT_LT(test::relative_difference(test::force_of(*model, state), f), kOtherOrder);
    // Nodes that no cell has any more feel nothing at all.
    std::set<std::int32_t> used(left.cells.begin(), left.cells.end());
    for (std::int32_t node = 0; node < mesh_.node_count(); ++node) {
      if (used.contains(node)) continue;
      EXPECT_EQ(test::force_of(*model, state).segment<3>(3 * node).norm(), 0.0);
    }
  }
  EXPECT_EQ(dynamic_cast<MassTensor&>(*model).constants(), model->reals_per_cell());
}

/// The simulation's own way to remove cells goes through it.
TEST_P(MassTensorTest, RemoveCellsTakesTheConstantsOver) {
  WorldDescription world;
  world.bodies = {test::body_of(mesh_, {.law = GetParam(), .young = 300.0})};
  ElasticBlock second = test::elastic_block(mesh_.blocks[0], {.law = GetParam()});
  // Two blocks of one body: the numbers of the second follow those of the first.
  const std::size_t half = second.cells.size() / 8 * 4;
  world.bodies[0].elastic[0].cells.resize(half);
  second.cells.erase(second.cells.begin(), second.cells.begin() + static_cast<std::ptrdiff_t>(half));
  world.bodies[0].elastic.push_back(second);
  for (ElasticBlock& block : world.bodies[0].elastic) block.model = MassTensorOptions{};
  world.fixed = {test::fixed(test::nodes_where(mesh_, [](const Vec3& x) { return x.x() < 0.6; }))};
  world.gravity = Vec3(0.0, 0.0, -1.0);
  world.editable = true;
  Simulation simulation = test::simulate(std::move(world), test::implicit_euler());
  const auto tensor = [&](std::size_t i) -> const MassTensor& {
    return dynamic_cast<const MassTensor&>(*simulation.world().body("body").models[i]);
  };
  const std::size_t all = tensor(0).constants() + tensor(1).constants();
  EXPECT_EQ(tensor(0).computed_constants() + tensor(1).computed_constants(), all);
  const auto last = mesh_.cell_count() - 1;
  for (const Numbers& cells : {Numbers{3}, Numbers{last}}) {
    simulation.step(0.01);
    simulation.replace_world(remove_cells(simulation.world(), simulation.state(), "body", cells));
    const std::size_t touched = tensor(0).computed_constants() + tensor(1).computed_constants();
    EXPECT_GT(touched, 0U);
    EXPECT_LE(touched, tensor(0).reals_per_cell());
    EXPECT_EQ(tensor(cells[0] == 3 ? 1 : 0).computed_constants(), 0U);  // the other block is as it was
  }
  Numbers expected = all_cells();
  std::erase(expected, 3);
  std::erase(expected, last);
  EXPECT_EQ(remaining_cells(simulation.world(), "body"), expected);
  simulation.step(0.01);
}

/// Models without constants to take over are made anew.
TEST_P(MassTensorTest, OnlyItTakesOver) {
  ElasticBlock fem = block();
  fem.model = FemOptions{};
  const auto model = make_model(fem, mesh_.positions, choose_isa(), Threads(1));
  EXPECT_EQ(edited_model({model.get()}, left_of(fem, {5})), nullptr);
  const MassTensor tensor = made(block());
  EXPECT_NE(edited_model({model.get(), &tensor}, left_of(block(), {5})), nullptr);
  ElasticBlock foreign = block();
  foreign.cell_numbers.back() = 9999;  // it has never had such a cell
  EXPECT_EQ(edited_model({&tensor}, foreign), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Laws, MassTensorTest, testing::Values("stvk", "hooke"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tissu
