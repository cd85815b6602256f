#include "tissu/edit/remove_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "../base/differences.h"
#include "../force/room.h"
#include "../world/sample_worlds.h"

/// Cells taken out between two steps, beside a world that never had them.
namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

struct RemovalCase {
  Split split;
  bool direct;
  const char* law;
};

void PrintTo(const RemovalCase& c, std::ostream* out) {
  *out << (c.split == Split::none ? "hexahedron_" : "tetra_") << c.law << (c.direct ? "_cholesky" : "_cg");
}

class RemoveCells : public testing::TestWithParam<RemovalCase> {
 protected:
  RemoveCells() {
    world_.bodies = {test::body_of(mesh_, {.law = GetParam().law, .young = 300.0})};
    ElasticBlock& block = world_.bodies[0].elastic[0];
    block.parameters["young"].clear();  // differs from cell to cell: the right ones have to stay
    block.density.clear();
    for (std::int32_t i = 0; i < mesh_.cell_count(); ++i) {
      block.parameters["young"].push_back(300.0 + i);
      block.density.push_back(2.0 + 0.01 * i);
    }
    world_.bodies[0].rayleigh = {0.1, 0.001};
    world_.gravity = Vec3(0.0, 0.0, -2.0);
    world_.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.3))};
    world_.editable = true;
  }
  static Simulation run(const WorldDescription& world) {
    auto solver = GetParam().direct ? std::make_unique<Cholesky>() : test::conjugate_gradient(1e-10);
    return test::simulate(world, test::implicit_euler(), std::move(solver));
  }
  /// Goes on with the simulation's world without some cells.
  static void remove(Simulation& simulation, const Numbers& cells) {
    simulation.replace_world(remove_cells(simulation.world(), simulation.state(), "body", cells));
  }
  /// The description of a world that never had these cells.
  WorldDescription without(const Numbers& cells) const {
    WorldDescription result = world_;
    const ElasticBlock& all = world_.bodies[0].elastic[0];
    ElasticBlock& left = result.bodies[0].elastic[0];
    left.cells.clear();
    left.parameters["young"].clear();
    left.density.clear();
    for (std::int32_t i = 0; i < mesh_.cell_count(); ++i) {
      if (std::ranges::find(cells, i) != cells.end()) continue;
      const auto cell = mesh_.blocks[0].cell(i);
      left.cells.insert(left.cells.end(), cell.begin(), cell.end());
      left.parameters["young"].push_back(all.parameters.at("young")[static_cast<std::size_t>(i)]);
      left.density.push_back(all.density[static_cast<std::size_t>(i)]);
    }
    return result;
  }
  /// All cells that use a node.
  Numbers around(std::int32_t node) const {
    Numbers cells;
    for (std::int32_t i = 0; i < mesh_.cell_count(); ++i) {
      const auto cell = mesh_.blocks[0].cell(i);
      if (std::ranges::find(cell, node) != cell.end()) cells.push_back(i);
    }
    return cells;
  }
  static std::vector<double> force(const World& world, const State& state) {
    std::vector<double> f(state.positions.size(), 0.0);
    for (const auto& model : world.forces()) model->add_force(state, test::scratch(), f);
    return f;
  }

  Mesh mesh_ = test::distorted_box({4, 2, 2}, GetParam().split, 0.0);
  Numbers some_ = GetParam().split == Split::none ? Numbers{5} : Numbers{70, 31, 32};
  WorldDescription world_;
  std::int32_t last_ = mesh_.node_count() - 1;
};

TEST_P(RemoveCells, IsTheWorldThatNeverHadThem) {
  Simulation simulation = run(world_);
  for (int i = 0; i < 5; ++i) simulation.step(0.01);
  remove(simulation, some_);
  Simulation scratch = run(without(some_));
  scratch.state() = simulation.state();
  const World& edited = simulation.world();
  EXPECT_EQ(edited.mass().nodal(), scratch.world().mass().nodal());
  EXPECT_EQ(edited.sparsity().row_begin, scratch.world().sparsity().row_begin);
  EXPECT_EQ(edited.sparsity().column, scratch.world().sparsity().column);
  EXPECT_EQ(force(edited, simulation.state()), force(scratch.world(), simulation.state()));
  EXPECT_EQ(simulation.energy().total(), scratch.energy().total());
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(simulation.step(0.01).solver_iterations, scratch.step(0.01).solver_iterations);
    EXPECT_EQ(simulation.state().positions, scratch.state().positions) << "step " << i;
    EXPECT_EQ(simulation.state().velocities, scratch.state().velocities) << "step " << i;
  }
}

/// A cut before every step: whatever a solver keeps of the world before must not be used on the one after.
TEST_P(RemoveCells, StepAfterStep) {
  Simulation simulation = run(world_);
  Numbers gone;
  for (const std::int32_t cell :
       GetParam().split == Split::none ? Numbers{5, 10, 1} : Numbers{70, 31, 32, 33, 40, 8}) {
    simulation.step(0.01);
    remove(simulation, {cell});
    gone.push_back(cell);
    Simulation scratch = run(without(gone));
    scratch.state() = simulation.state();
    simulation.step(0.01);
    scratch.step(0.01);
    ASSERT_EQ(simulation.state().positions, scratch.state().positions) << "cell " << cell;
  }
}

TEST_P(RemoveCells, TakesMassAndEnergyOfTheCellsAway) {
  Simulation simulation = run(world_);
  for (int i = 0; i < 5; ++i) simulation.step(0.01);
  const BodyModel& before = *simulation.world().body("body").models[0];
  const CellFields fields = before.fields(simulation.state());
  double mass = simulation.world().mass().total();
  double energy = simulation.energy().elastic;
  for (const std::int32_t cell : some_) {
    const auto i = static_cast<std::size_t>(cell);
    mass -= before.volumes()[i] * (2.0 + 0.01 * cell);
    energy -= before.volumes()[i] * fields.energy_density[i];
  }
  remove(simulation, some_);
  EXPECT_NEAR(simulation.world().mass().total(), mass, 1e-13 * mass);
  EXPECT_NEAR(simulation.energy().elastic, energy, 1e-12 * energy);
}

TEST_P(RemoveCells, KeepsTheNumbersOfTheFirstDay) {
  Simulation simulation = run(world_);
  Numbers expected(static_cast<std::size_t>(mesh_.cell_count()));
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(remaining_cells(simulation.world(), "body"), expected);
  for (const Numbers& cells : {Numbers{3}, Numbers{0, 6}}) {
    remove(simulation, cells);
    for (const std::int32_t cell : cells) std::erase(expected, cell);
    EXPECT_EQ(remaining_cells(simulation.world(), "body"), expected);
    EXPECT_EQ(simulation.world().body("body").models[0]->block().cell_numbers, expected);
  }
}

TEST_P(RemoveCells, RefusesWhatIsNotThere) {
  Simulation simulation = run(world_);
  const auto refuse = [&](const Numbers& cells) {
    EXPECT_THROW(remove_cells(simulation.world(), simulation.state(), "body", cells), ParameterError);
  };
  refuse({mesh_.cell_count()});
  refuse({-1});
  refuse({2, 1000});
  EXPECT_THROW(remove_cells(simulation.world(), simulation.state(), "nobody", Numbers{0}), ParameterError);
  remove(simulation, {3});
  refuse({3});
  refuse({4, 3});
  EXPECT_EQ(remaining_cells(simulation.world(), "body").size(),
            static_cast<std::size_t>(mesh_.cell_count()) - 1);
}

TEST_P(RemoveCells, RefusesAWorldThatWasNotCompiledForIt) {
  world_.editable = false;
  Simulation simulation = run(world_);
  EXPECT_THROW(remove_cells(simulation.world(), simulation.state(), "body", Numbers{0}), ParameterError);
  EXPECT_NO_THROW(simulation.step(0.01));
}

/// A node that has lost its last cell stays where it is, while the body goes on.
TEST_P(RemoveCells, LeavesLooseNodesWhereTheyAre) {
  Simulation simulation = run(world_);
  for (int i = 0; i < 5; ++i) simulation.step(0.01);
  remove(simulation, around(last_));
  const Vec3 left = block(ConstReals(simulation.state().positions), last_);
  EXPECT_GT((left - mesh_.node(last_)).norm(), 1e-6);  // not its place at rest
  const Vec3 tip = block(ConstReals(simulation.state().positions), 4);
  for (int i = 0; i < 20; ++i) simulation.step(0.01);
  EXPECT_LT((block(ConstReals(simulation.state().positions), last_) - left).norm(), 1e-14);
  EXPECT_LT(block(ConstReals(simulation.state().velocities), last_).norm(), 1e-12);
  EXPECT_GT((block(ConstReals(simulation.state().positions), 4) - tip).norm(), 1e-4);
  remove(simulation, {0});  // and an edit after that leaves it there too
  simulation.step(0.01);
  EXPECT_LT((block(ConstReals(simulation.state().positions), last_) - left).norm(), 1e-14);
}

TEST_P(RemoveCells, MayTakeThemAll) {
  Simulation simulation = run(world_);
  simulation.step(0.01);
  const std::vector<double> x = simulation.state().positions;
  Numbers all(static_cast<std::size_t>(mesh_.cell_count()));
  std::iota(all.begin(), all.end(), 0);
  remove(simulation, all);
  EXPECT_TRUE(remaining_cells(simulation.world(), "body").empty());
  for (int i = 0; i < 3; ++i) simulation.step(0.01);
  EXPECT_LT((test::view(simulation.state().positions) - test::view(x)).norm(), 1e-14);
}

/// Loads and led nodes stay; on a node without cells they do nothing.
TEST_P(RemoveCells, KeepsLoadsAndHeldNodes) {
  world_.loads = {{"hand", "body", {last_, 4}, {0, 0, 1, 0, 0, -1}, {}}};
  Simulation simulation = run(world_);
  simulation.step(0.01);
  remove(simulation, around(last_));
  const Vec3 left = block(ConstReals(simulation.state().positions), last_);
  for (int i = 0; i < 5; ++i) simulation.step(0.01);
  EXPECT_LT((block(ConstReals(simulation.state().positions), last_) - left).norm(), 1e-14);
  EXPECT_EQ(block(ConstReals(simulation.state().positions), 0), mesh_.node(0));
}

/// Ties made while it runs are not the cells': an edit keeps them.
TEST_P(RemoveCells, KeepsLinks) {
  world_.links = true;
  Simulation simulation = run(world_);
  simulation.step(0.01);
  test::links(simulation).add({4}, {last_}, 50.0);
  const double before = simulation.energy().elastic;
  EXPECT_GT(before, 1.0);
  remove(simulation, {0});
  EXPECT_EQ(test::links(simulation).size(), 1U);
  EXPECT_GT(simulation.energy().elastic, 0.9 * before);
}

TEST_P(RemoveCells, DivergedNamesTheCellByItsFirstNumber) {
  Simulation simulation = run(world_);
  Numbers first(static_cast<std::size_t>(mesh_.cell_count()) / 2);
  std::iota(first.begin(), first.end(), 0);
  remove(simulation, first);
  simulation.step(0.01);
  simulation.state().velocities[static_cast<std::size_t>(3 * last_)] = 1e300;
  try {
    simulation.step(0.01);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Diverged& error) {
    EXPECT_GE(error.element(), mesh_.cell_count() / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, RemoveCells,
                         testing::Values(RemovalCase{Split::six, true, "stvk"},
                                         RemovalCase{Split::six, false, "stvk"},
                                         RemovalCase{Split::six, true, "hooke"},
                                         RemovalCase{Split::none, true, "stvk"},
                                         RemovalCase{Split::none, false, "hooke"}),
                         testing::PrintToStringParamName());

/// Lines of the sections 1, 2 and 3 m2; the first goes, and the others keep theirs.
TEST(RemoveLines, SectionsStayWithTheirCells) {
  BodyDescription body;
  body.name = "body";
  body.positions = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
  ElasticBlock lines;
  lines.element = "line";
  lines.cells = {0, 1, 1, 2, 2, 3};
  lines.parameters = {{"young", {3.0}}, {"poisson", {0.3}}};
  lines.density = {2.0};
  lines.cross_section = {1.0, 2.0, 3.0};
  body.elastic = {lines};
  WorldDescription world;
  world.bodies = {body};
  world.editable = true;
  Simulation simulation = test::simulate(world, test::implicit_euler(), test::conjugate_gradient());
  simulation.replace_world(remove_cells(simulation.world(), simulation.state(), "body", Numbers{0}));
  EXPECT_EQ(simulation.world().bodies()[0].models[0]->volumes(), (std::vector{2.0, 3.0}));
}

}  // namespace
}  // namespace tissu
