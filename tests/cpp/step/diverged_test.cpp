#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "../world/sample_worlds.h"

/// A step that yields what is not finite throws, says where, and leaves the state as it was.
namespace tissu {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Way {
  const char* name;
  std::unique_ptr<Integrator> (*integrator)();
  std::unique_ptr<LinearSolver> (*solver)();
};

void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

std::unique_ptr<LinearSolver> direct() { return std::make_unique<Cholesky>(); }
std::unique_ptr<LinearSolver> iterative() { return test::conjugate_gradient(1e-8); }

class DivergedTest : public testing::TestWithParam<Way> {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {4, 2, 2}, Split::six);

  WorldDescription world() const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.young = 100.0})};
    world.gravity = Vec3(0.0, 0.0, -1.0);
    world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
    return world;
  }
  static Simulation run(WorldDescription world) {
    return test::simulate(std::move(world), GetParam().integrator(), GetParam().solver());
  }
  /// Steps, expects Diverged with the state as it was, and hands the error on.
  static Diverged expect_rolled_back(Simulation& simulation) {
    const State before = simulation.state();
    try {
      simulation.step(0.01);
    } catch (const Diverged& error) {
      const State& after = simulation.state();
      EXPECT_EQ(std::memcmp(before.positions.data(), after.positions.data(), 8 * before.positions.size()), 0);
      EXPECT_EQ(std::memcmp(before.velocities.data(), after.velocities.data(), 8 * before.velocities.size()),
                0);
      EXPECT_EQ(before.time, after.time);
      EXPECT_EQ(before.load_factor, after.load_factor);
      EXPECT_EQ(error.time(), before.time);
      return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return {"", "", -1, kNaN};
  }
};

TEST_P(DivergedTest, AbsurdVelocity) {
  for (const double velocity :
       {1e300, -1e300, 1e160, 1e30, 1e8, kNaN, std::numeric_limits<double>::infinity()}) {
    Simulation simulation = run(world());
    for (int i = 0; i < 3; ++i) simulation.step(0.01);
    const double good = simulation.state().velocities[50];
    simulation.state().velocities[50] = velocity;
    const Diverged error = expect_rolled_back(simulation);
    EXPECT_EQ(error.body(), "body") << velocity;
    EXPECT_GE(error.element(), 0);
    EXPECT_LT(error.element(), mesh_.cell_count());
    EXPECT_NEAR(error.time(), 0.03, 1e-15);
    EXPECT_NE(std::string(error.what()).find("body"), std::string::npos);
    // The remedy was to set it right: it goes on.
    simulation.state().velocities[50] = good;
    EXPECT_NO_THROW(simulation.step(0.01)) << velocity;
    EXPECT_NEAR(simulation.state().time, 0.04, 1e-15);
  }
}

/// After the rollback a step gives the bits that it gives without the accident.
TEST_P(DivergedTest, LeavesNoTrace) {
  Simulation simulation = run(world());
  Simulation undisturbed = run(world());
  for (int i = 0; i < 3; ++i) {
    simulation.step(0.01);
    undisturbed.step(0.01);
  }
  const double good = simulation.state().velocities[50];
  simulation.state().velocities[50] = kNaN;
  EXPECT_THROW(simulation.step(0.01), Diverged);
  simulation.state().velocities[50] = good;
  simulation.step(0.01);
  undisturbed.step(0.01);
  EXPECT_EQ(simulation.state().positions, undisturbed.state().positions);
}

TEST_P(DivergedTest, NamesTheBodyAtFault) {
  WorldDescription two = world();
  two.bodies.push_back(test::body_of(mesh_, {.young = 100.0}, "second"));
  Simulation simulation = run(two);
  simulation.step(0.01);
  simulation.state().velocities[static_cast<std::size_t>(3 * (mesh_.node_count() + 20))] = kNaN;
  EXPECT_EQ(expect_rolled_back(simulation).body(), "second");
}

TEST_P(DivergedTest, NamesACellAtFault) {
  Simulation simulation = run(world());
  simulation.step(0.01);
  const std::int32_t node = 16;  // free: what is written on a held one is not taken
  simulation.state().velocities[static_cast<std::size_t>(3 * node)] = kNaN;
  const Diverged error = expect_rolled_back(simulation);
  ASSERT_GE(error.element(), 0);
  const auto cell = mesh_.blocks[0].cell(error.element());
  EXPECT_NE(std::ranges::find(cell, node), cell.end()) << "cell " << error.element();
}

TEST_P(DivergedTest, PositionsThatAreNotNumbers) {
  Simulation simulation = run(world());
  simulation.step(0.01);
  simulation.state().positions[50] = kNaN;
  EXPECT_EQ(expect_rolled_back(simulation).body(), "body");
}

/// Statics puts the clock forward first: that is taken back too.
TEST_P(DivergedTest, InStatics) {
  Simulation simulation = test::simulate(
      world(), std::make_unique<StaticEquilibrium>(StaticEquilibrium::Settings{}), GetParam().solver());
  simulation.state().positions[50] = kNaN;
  EXPECT_EQ(expect_rolled_back(simulation).body(), "body");
}

/// A solver that gives up in Newton's second round, when the state has already been moved on trial.
class GivesUp final : public LinearSolver {
 public:
  [[nodiscard]] std::string_view name() const override { return "gives up"; }
  [[nodiscard]] std::string_view preparation() const override { return direct_.preparation(); }
  SolveReport solve(const LinearOperator& A, ConstReals b, Reals x, double floor) override {
    if (++calls_ > 1) throw Error("it is out of memory.");
    return direct_.solve(A, b, x, floor);
  }
  void forget() override { direct_.forget(); }
  [[nodiscard]] std::size_t bytes() const override { return direct_.bytes(); }

 private:
  int calls_ = 0;
  Cholesky direct_;
};

TEST(Simulation, IsAsBeforeWhenASolverThrows) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {4, 2, 2}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.young = 100.0})};
  world.gravity = Vec3(0.0, 0.0, -1.0);
  world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  Simulation simulation = test::simulate(world, test::implicit_euler(5, 1e-12), std::make_unique<GivesUp>());
  const State before = simulation.state();
  EXPECT_THROW(simulation.step(0.1), Error);
  EXPECT_EQ(simulation.state().positions, before.positions);
  EXPECT_EQ(simulation.state().velocities, before.velocities);
  EXPECT_EQ(simulation.state().time, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Ways, DivergedTest,
    testing::Values(Way{"once_cholesky", [] { return test::implicit_euler(); }, direct},
                    Way{"once_conjugate_gradient", [] { return test::implicit_euler(); }, iterative},
                    Way{"newton_cholesky", [] { return test::implicit_euler(5, 1e-8); }, direct},
                    Way{"newton_conjugate_gradient", [] { return test::implicit_euler(5, 1e-8); },
                        iterative}),
    testing::PrintToStringParamName());

}  // namespace
}  // namespace tissu
