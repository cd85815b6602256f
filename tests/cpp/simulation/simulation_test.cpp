#include "tissu/simulation/simulation.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "../world/sample_worlds.h"

namespace tissu {
namespace {

class SimulationTest : public testing::Test {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {4, 2, 2}, Split::six);

  WorldDescription plain() const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.young = 100.0})};
    return world;
  }
  static std::set<std::string> effects(Simulation& simulation) {
    std::set<std::string> names;
    for (const Profile::Row& row : simulation.profile().rows()) names.insert(row.effect);
    return names;
  }
};

TEST_F(SimulationTest, RefusesStepsWithoutSense) {
  Simulation simulation = test::simulate(plain(), test::implicit_euler());
  for (const double h :
       {0.0, -0.01, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(simulation.step(h), ParameterError) << h;
  }
  EXPECT_EQ(simulation.state().time, 0.0);
}

/// What the scene does not ask for has no row.
TEST_F(SimulationTest, AbsentEffectsHaveNoRow) {
  Simulation simulation = test::simulate(plain(), test::implicit_euler());
  simulation.step(0.01);
  EXPECT_EQ(effects(simulation), (std::set<std::string>{"elasticity", "inertia", "linear solver"}));
}

TEST_F(SimulationTest, PresentEffectsHaveTheirRows) {
  WorldDescription world = plain();
  world.bodies[0].rayleigh = {0.1, 0.1};
  world.gravity = Vec3(0, 0, -1);
  world.links = true;
  world.loads = {{"hand", "body", {3}, {0.1, 0.0, 0.0}, {}}};
  world.pressures = {{"blood", "body", {{"triangle", {0, 1, 2}}}, 1.0, {}}};
  Simulation simulation = test::simulate(world, test::implicit_euler());
  for (int i = 0; i < 3; ++i) simulation.step(0.01);
  EXPECT_EQ(effects(simulation),
            (std::set<std::string>{"elasticity with Rayleigh damping", "inertia", "linear solver", "gravity",
                                   "links", "hand", "blood"}));
  for (const Profile::Row& row : simulation.profile().rows()) {
    EXPECT_GE(row.seconds, 0.0);
    if (row.stage == "solve") {
      EXPECT_EQ(row.calls, 3);
    }
  }
  EXPECT_EQ(simulation.profile().steps(), 3);
  EXPECT_EQ(simulation.profile().step_seconds().size(), 3U);
  simulation.profile().clear();
  simulation.step(0.01);
  EXPECT_EQ(simulation.profile().steps(), 1);
}

/// Free fall: the energies are those of a point mass.
TEST_F(SimulationTest, EnergiesOfFreeFall) {
  WorldDescription world = plain();
  world.gravity = Vec3(0, 0, -10.0);
  Simulation simulation = test::simulate(world, test::implicit_euler());
  const double m = simulation.world().mass().total();
  EXPECT_NEAR(m, 4.0, 1e-14);  // 2 m3 of 2 kg/m3
  EXPECT_NEAR(simulation.energy().potential, m * 10.0 * 0.5, 1e-12);
  EXPECT_EQ(simulation.energy().kinetic, 0.0);
  for (int i = 0; i < 10; ++i) simulation.step(0.01);
  const Energy energy = simulation.energy();
  EXPECT_NEAR(energy.kinetic, 0.5 * m * 1.0, 1e-11);
  EXPECT_NEAR(energy.potential, m * 10.0 * (0.5 - 0.1 * 0.01 * 55), 1e-11);  // h^2 g (1 + ... + 10)
  EXPECT_NEAR(energy.elastic, 0.0, 1e-20);
  EXPECT_EQ(energy.total(), energy.kinetic + energy.elastic + energy.potential);
}

/// Two simulations of one world, turn about, give what each gives alone.
TEST_F(SimulationTest, HasNoStateOutsideItself) {
  WorldDescription world = plain();
  world.gravity = Vec3(0, 0, -10.0);
  world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
  const auto shared = std::make_shared<const World>(world);
  Simulation a(shared, test::implicit_euler(), std::make_unique<Cholesky>());
  Simulation b(shared, test::implicit_euler(), test::conjugate_gradient(1e-8));
  Simulation alone(std::make_shared<const World>(world), test::implicit_euler(),
                   std::make_unique<Cholesky>());
  for (int i = 0; i < 10; ++i) {
    a.step(0.01);
    b.step(0.013);
  }
  for (int i = 0; i < 10; ++i) alone.step(0.01);
  EXPECT_EQ(a.state().positions, alone.state().positions);
}

/// A linear world keeps its matrix while the step does; another step is another matrix.
TEST_F(SimulationTest, ChangesItsStep) {
  WorldDescription world;
  world.bodies = {test::body_of(mesh_, {.law = "hooke", .young = 100.0})};
  world.gravity = Vec3(0, 0, -10.0);
  world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
  Simulation direct = test::simulate(world, test::implicit_euler(), std::make_unique<Cholesky>());
  Simulation iterative = test::simulate(world, test::implicit_euler(), test::conjugate_gradient(1e-13));
  for (const double h : {0.01, 0.01, 0.1, 0.01, 0.001, 0.001}) {
    direct.step(h);
    iterative.step(h);
    double worst = 0.0;
    for (std::size_t i = 0; i < direct.state().positions.size(); ++i) {
      worst = std::max(worst, std::abs(direct.state().positions[i] - iterative.state().positions[i]));
    }
    EXPECT_LT(worst, 1e-11) << h;  // the iteration's 1e-13 times the condition of the matrix
  }
}

TEST_F(SimulationTest, RefusesAWorldOfOtherUnknowns) {
  Simulation simulation = test::simulate(plain(), test::implicit_euler());
  WorldDescription other = plain();
  other.frames.emplace_back();
  EXPECT_THROW(simulation.replace_world(std::make_shared<const World>(other)), ParameterError);
  EXPECT_NO_THROW(simulation.step(0.01));
}

}  // namespace
}  // namespace tissu
