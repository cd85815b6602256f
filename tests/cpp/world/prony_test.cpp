#include <gtest/gtest.h>

#include <cmath>

#include "../base/differences.h"
#include "../force/room.h"
#include "sample_worlds.h"
#include "tissu/edit/remove_cells.h"

/// Bodies that remember, beside the standard linear solid: a spring E and a branch g E, tau.
namespace tissu {
namespace {

constexpr double kYoung = 50.0;
constexpr double kShare = 0.6;
constexpr double kTime = 0.7;

/// A bar of 2 m x 0.25 m2 along x that does not get thinner: nu = 0. One end is held, the other led or free.
struct Bar {
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2.0, 0.5, 0.5), {4, 1, 1}, Split::six);
  std::vector<std::int32_t> end = test::nodes_at(mesh, 0, 2.0);
  WorldDescription world;
  Bar() {
    world.bodies = {test::body_of(mesh, {"stvk", kYoung, 0.0, 2.0})};
    world.bodies[0].viscosity.prony = {{kShare, kTime}};
    world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  }
  /// Leads the end by `length` in the first `ramp` seconds.
  void lead(double length, double ramp) {
    world.fixed.push_back(test::fixed(end));
    world.fixed[1].motion.times = {0.0, ramp};
    world.fixed[1].motion.displacements = {Vec3::Zero(), Vec3(length, 0, 0)};
    world.fixed[1].motion.angles = {0.0, 0.0};
  }
  void pull(double force) {
    const auto shares = test::nodes_at(mesh, 0, 2.0);
    std::vector<double> forces(3 * end.size(), 0.0);
    // Each corner of the two triangles of the end: a node in both has twice the share.
    std::vector<double> areas(end.size(), 0.0);
    for (std::size_t e = 0; e < mesh.blocks[0].nodes.size(); e += 4) {
      std::vector<std::size_t> in_end;
      for (std::size_t a = 0; a < 4; ++a) {
        const auto at = std::ranges::find(end, mesh.blocks[0].nodes[e + a]);
        if (at != end.end()) in_end.push_back(static_cast<std::size_t>(at - end.begin()));
      }
      if (in_end.size() == 3) {
        for (const std::size_t i : in_end) areas[i] += 1.0 / 6.0;
      }
    }
    for (std::size_t i = 0; i < end.size(); ++i) forces[3 * i] = areas[i] * force;
    world.loads = {{"hand", "body", end, forces, {{0.0}, {1.0}}}};
  }
};

std::unique_ptr<Integrator> statics() {
  return std::make_unique<StaticEquilibrium>(StaticEquilibrium::Settings{NewtonSettings{30, 1e-13}, 1});
}

/// The force with which the led end pulls [N].
double reaction(const Simulation& simulation, const std::vector<std::int32_t>& end) {
  std::vector<double> f(simulation.state().positions.size(), 0.0);
  for (const auto& model : simulation.world().forces())
    model->add_force(simulation.state(), test::scratch(), f);
  double sum = 0.0;
  for (const std::int32_t node : end) sum -= f[static_cast<std::size_t>(3 * node)];
  return sum;
}

/// Strain E reached evenly in a time r, then held: S = E_Y (E + g q), q = (tau / r) (1 - exp(-r / tau)) E at
/// the end of the ramp, exp(-t / tau) of that later. Exact for any strain: P = F S.
TEST(PronyBar, RelaxesAsTheStandardLinearSolid) {
  for (const double length : {2e-6, 0.5}) {
    Bar bar;
    const double ramp = 0.05;
    bar.lead(length, ramp);
    Simulation simulation = test::simulate(bar.world, statics());
    ASSERT_TRUE(simulation.step(ramp).converged);
    const double F = 1.0 + length / 2.0;
    const double E = 0.5 * (F * F - 1.0);
    for (int i = 0; i <= 40; ++i) {
      const double t = simulation.state().time - ramp;
      const double q = kTime / ramp * (1.0 - std::exp(-ramp / kTime)) * std::exp(-t / kTime) * E;
      const double expected = 0.25 * F * kYoung * (E + kShare * q);
      ASSERT_NEAR(reaction(simulation, bar.end) / expected, 1.0, 1e-9) << "t = " << t;
      ASSERT_TRUE(simulation.step(i % 2 == 0 ? 0.1 : 0.03).converged);
    }
  }
}

/// A load from t = 0 on: strain = sigma / E (1 - g / (1 + g) exp(-t / ((1 + g) tau))). The load comes within
/// a millionth of tau; then E does not go evenly through a step, an error of the second order.
TEST(PronyBar, CreepsAsTheStandardLinearSolid) {
  const auto error = [](int steps) {
    Bar bar;
    const double stress = 1e-6 * kYoung;
    bar.pull(0.25 * stress);
    Simulation simulation = test::simulate(bar.world, statics());
    simulation.step(1e-6 * kTime);
    const double h = 2.0 / steps;
    double worst = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double strain =
          0.5 * (simulation.state().positions[static_cast<std::size_t>(3 * bar.end[0])] - 2.0);
      const double t = simulation.state().time;
      const double expected =
          stress / kYoung * (1.0 - kShare / (1.0 + kShare) * std::exp(-t / (1.0 + kShare) / kTime));
      worst = std::max(worst, std::abs(strain / expected - 1.0));
      simulation.step(h);
    }
    return worst;
  };
  const double coarse = error(20);
  const double fine = error(40);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

/// Moved at will, a free body that remembers never gains energy.
TEST(PronyBody, NeverGainsEnergy) {
  const Mesh mesh = test::distorted_box({2, 2, 2}, Split::none, 0.1);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {"stvk", 200.0, 0.3, 2.0})};
  world.bodies[0].viscosity.prony = {{kShare, 0.02}, {0.3, 1.0}};
  Simulation simulation = test::simulate(world, test::implicit_euler(12, 1e-12));
  test::Random random(4);
  simulation.state().velocities = random.numbers(mesh.positions.size());
  double before = simulation.energy().total();
  const double start = before;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(simulation.step(0.002).converged);
    const double now = simulation.energy().total();
    ASSERT_LT(now, before * (1.0 + 1e-12));
    before = now;
  }
  EXPECT_LT(before, 0.9 * start);
}

TEST(PronyBody, AFailedStepLeavesTheMemory) {
  Bar bar;
  bar.lead(0.2, 0.1);
  Simulation simulation = test::simulate(bar.world, test::implicit_euler(8, 1e-10));
  for (int i = 0; i < 5; ++i) simulation.step(0.03);
  const State before = simulation.state();
  EXPECT_EQ(before.memory_time, before.time);
  EXPECT_GT(test::view(before.memory.at(0)).norm(), 0.01);
  simulation.state().velocities[3] = std::nan("");
  EXPECT_THROW(simulation.step(0.03), Diverged);
  EXPECT_EQ(simulation.state().memory, before.memory);
  EXPECT_EQ(simulation.state().memory_time, before.memory_time);
}

/// A state kept and put back goes the same way again: the state holds everything.
TEST(PronyBody, AStatePutBackGoesTheSameWay) {
  Bar bar;
  bar.lead(0.2, 0.1);
  Simulation simulation = test::simulate(bar.world, test::implicit_euler(8, 1e-10));
  for (int i = 0; i < 5; ++i) simulation.step(0.03);
  const State kept = simulation.state();
  for (int i = 0; i < 5; ++i) simulation.step(0.02);
  const std::vector<double> first = simulation.state().positions;
  simulation.state() = kept;
  for (int i = 0; i < 5; ++i) simulation.step(0.02);
  EXPECT_EQ(simulation.state().positions, first);
}

/// Of two bars that do not touch, one loses a cell; the other remembers as if nothing had happened.
TEST(PronyBody, TheMemoryOutlivesAnEdit) {
  const auto run = [](bool edit) {
    Bar bar;
    bar.lead(0.3, 0.1);
    BodyDescription body = bar.world.bodies[0];
    Mesh other = bar.mesh;  // in the same body, so that its block is laid anew
    for (std::size_t i = 1; i < other.positions.size(); i += 3) other.positions[i] += 5.0;
    const std::int32_t nodes = bar.mesh.node_count();
    ElasticBlock& block = body.elastic[0];
    const std::size_t count = block.cells.size();
    for (std::size_t i = 0; i < count; ++i) block.cells.push_back(block.cells[i] + nodes);
    std::rotate(block.cells.begin(), block.cells.begin() + static_cast<std::ptrdiff_t>(count),
                block.cells.end());  // the second bar's cells stand first
    body.positions.insert(body.positions.end(), other.positions.begin(), other.positions.end());
    bar.world.bodies[0] = body;
    std::vector<std::int32_t> base;
    for (const std::int32_t node : bar.world.fixed[0].nodes) base.push_back(node + nodes);
    bar.world.fixed.push_back(test::fixed(base));
    bar.world.editable = true;
    Simulation simulation = test::simulate(bar.world, test::implicit_euler(8, 1e-12));
    for (int i = 0; i < 10; ++i) simulation.step(0.03);
    if (edit) {
      const std::vector<std::int32_t> gone = {0, 7};
      simulation.replace_world(remove_cells(simulation.world(), simulation.state(), "body", gone));
    }
    for (int i = 0; i < 10; ++i) simulation.step(0.03);
    return reaction(simulation, bar.end);
  };
  const double whole = run(false);
  EXPECT_NEAR(run(true) / whole, 1.0, 1e-12);
  EXPECT_GT(whole, 0.0);
}

TEST(PronyBody, NothingIsRememberedWhereNobodyAsks) {
  Bar bar;
  bar.world.bodies[0].viscosity = {.shear = 1.0, .centroid = 1.0};
  Simulation simulation = test::simulate(bar.world, test::implicit_euler());
  simulation.step(0.1);
  EXPECT_TRUE(simulation.state().memory.empty());
  EXPECT_EQ(simulation.state().memory_time, 0.0);
}

}  // namespace
}  // namespace tissu
