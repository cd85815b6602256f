#include "tissu/step/static_equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../base/differences.h"
#include "../world/sample_worlds.h"
#include "tissu/mesh/topology.h"

/// Bars under an end load, against the homogeneous states that laws give in closed form.
namespace tissu {
namespace {

constexpr double kYoung = 200.0;
constexpr double kLength = 3.0;

struct BarCase {
  Split split;
  bool direct;
};

void PrintTo(const BarCase& c, std::ostream* out) {
  *out << (c.split == Split::none ? "hexahedron_" : "tetra_")
       << (c.direct ? "cholesky" : "conjugate_gradient");
}

class Bar : public testing::TestWithParam<BarCase> {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(kLength, 1, 1), {6, 2, 3}, GetParam().split);

  /// Dead traction t on the face x = L, shared out as the faces' shape functions do; sides free to contract.
  WorldDescription bar(const std::string& law, double poisson, double traction) const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {law, kYoung, poisson, 1.0})};
    world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0), 1),
                   test::fixed(test::nodes_at(mesh_, 1, 0.0), 2),
                   test::fixed(test::nodes_at(mesh_, 2, 0.0), 4)};
    LoadDescription load{"end", "body", {}, {}, {}};
    const auto share = [&](std::span<const std::int32_t> face, double area) {
      for (const std::int32_t node : face) {
        if (mesh_.node(node).x() < kLength - 1e-9) return;
      }
      for (const std::int32_t node : face) {
        load.nodes.push_back(node);
        load.forces.insert(load.forces.end(), {traction * area / static_cast<double>(face.size()), 0.0, 0.0});
      }
    };
    const Surface surface = boundary_surface(mesh_);
    for (const auto& t : surface.triangles) share(t, 1.0 / 12.0);
    for (const auto& q : surface.quads) share(q, 1.0 / 6.0);
    world.loads = {load};
    return world;
  }
  static Simulation statics(WorldDescription world, int load_steps = 1, int iterations = 50, int total = 0) {
    StaticEquilibrium::Settings settings;
    settings.newton = {iterations, 1e-12};
    settings.load_steps = load_steps;
    settings.total_iterations = total;
    auto solver = GetParam().direct ? std::make_unique<Cholesky>() : test::conjugate_gradient(1e-10);
    return test::simulate(std::move(world), std::make_unique<StaticEquilibrium>(settings), std::move(solver));
  }
  /// Largest distance of a node from x = (F X, G Y, G Z).
  double distance(const Simulation& simulation, double F, double G) const {
    double worst = 0.0;
    for (std::int32_t i = 0; i < mesh_.node_count(); ++i) {
      const Vec3 expected = mesh_.node(i).cwiseProduct(Vec3(F, G, G));
      worst = std::max(worst, (block(ConstReals(simulation.state().positions), i) - expected).norm());
    }
    return worst;
  }
};

// Newton's tolerance of 1e-12 of the load, times the slope of stretch over load: of size 1.
constexpr double kTolerance = 1e-9;

/// P = E/2 F (F^2 - 1), the section keeps its size.
TEST_P(Bar, UniaxialStVKWithoutPoisson) {
  for (const double F : {0.7, 0.9, 1.0001, 1.3, 2.0}) {
    for (const int load_steps : {1, 5}) {
      Simulation simulation = statics(bar("stvk", 0.0, kYoung / 2.0 * F * (F * F - 1.0)), load_steps);
      const StepReport report = simulation.step(1.0);
      EXPECT_TRUE(report.converged) << report.message;
      EXPECT_LT(distance(simulation, F, 1.0), kTolerance)
          << "F = " << F << ", " << load_steps << " load steps";
      EXPECT_LE(report.residual, 1e-10);  // 1e-12, or what round-off leaves beside a small load
      EXPECT_EQ(test::view(simulation.state().velocities).norm(), 0.0);
      EXPECT_EQ(simulation.state().load_factor, 1.0);
    }
  }
}

/// The same P; the section shrinks by G with G^2 = 1 - nu (F^2 - 1).
TEST_P(Bar, UniaxialStVKWithPoisson) {
  for (const double F : {0.85, 1.4}) {
    Simulation simulation = statics(bar("stvk", 0.3, kYoung / 2.0 * F * (F * F - 1.0)), 2);
    EXPECT_TRUE(simulation.step(1.0).converged);
    EXPECT_LT(distance(simulation, F, std::sqrt(1.0 - 0.3 * (F * F - 1.0))), kTolerance) << F;
  }
}

/// sigma = E eps, lateral strain -nu eps; one Newton step is the whole answer.
TEST_P(Bar, UniaxialHooke) {
  Simulation simulation = statics(bar("hooke", 0.45, 0.1 * kYoung));
  const StepReport report = simulation.step(1.0);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(distance(simulation, 1.1, 1.0 - 0.045), kTolerance);
  if (GetParam().direct) {
    EXPECT_LE(report.newton_iterations, 2);
  }
}

TEST_P(Bar, StaysInEquilibrium) {
  Simulation simulation = statics(bar("stvk", 0.3, 20.0), 3);
  ASSERT_TRUE(simulation.step(1.0).converged);
  const std::vector<double> first = simulation.state().positions;
  const StepReport again = simulation.step(1.0);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.newton_iterations, 0);
  EXPECT_EQ(simulation.state().positions, first);
  EXPECT_EQ(simulation.state().time, 2.0);
}

/// StVK resists with at most E / (3 sqrt 3) = 0.19245 E: beyond, there is nothing to find, and it says so.
TEST_P(Bar, SaysWhenThereIsNoEquilibrium) {
  Simulation simulation = statics(bar("stvk", 0.0, -0.25 * kYoung), 4, 30);
  try {
    const StepReport report = simulation.step(1.0);
    EXPECT_TRUE(test::view(simulation.state().positions).allFinite());
    // A bar that has turned inside out resists again: an equilibrium too, if it is one.
    if (!report.converged) {
      EXPECT_FALSE(report.message.empty());
      EXPECT_EQ(simulation.state().load_factor, 1.0);
    }
  } catch (const Diverged& error) {
    EXPECT_EQ(error.body(), "body");
    EXPECT_EQ(simulation.state().positions, mesh_.positions);
  }
}

TEST_P(Bar, SaysWhenIterationsAreTooFew) {
  Simulation simulation = statics(bar("stvk", 0.3, 300.0), 1, 1, 3);
  const StepReport report = simulation.step(1.0);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find(" % of the load: all 3 iterations of Newton's method were used"),
            std::string::npos)
      << report.message;
  EXPECT_TRUE(test::view(simulation.state().positions).allFinite());
}

/// Led to twice its length: the same state as under the load that stretches it so.
TEST_P(Bar, LedByItsEnd) {
  WorldDescription world = bar("stvk", 0.3, 0.0);
  world.loads.clear();
  const double F = 1.5;
  FixedNodes led = test::fixed(test::nodes_at(mesh_, 0, kLength), 1);
  led.motion.times = {0.0, 1.0};
  led.motion.displacements = {Vec3::Zero(), Vec3((F - 1.0) * kLength, 0, 0)};
  led.motion.angles = {0.0, 0.0};
  world.fixed.push_back(led);
  for (const int load_steps : {1, 4}) {
    Simulation simulation = statics(world, load_steps);
    const StepReport report = simulation.step(1.0);
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_LT(distance(simulation, F, std::sqrt(1.0 - 0.3 * (F * F - 1.0))), 1e-8) << load_steps;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Bar,
                         testing::Values(BarCase{Split::none, true}, BarCase{Split::six, true},
                                         BarCase{Split::six, false}),
                         testing::PrintToStringParamName());

TEST(StaticEquilibrium, RefusesSettingsWithoutSense) {
  EXPECT_THROW(StaticEquilibrium({{0, 1e-9}, 1}), ParameterError);
  EXPECT_THROW(StaticEquilibrium({{10, 0.0}, 1}), ParameterError);
  EXPECT_THROW(StaticEquilibrium({{10, 1e-9}, 0}), ParameterError);
}

}  // namespace
}  // namespace tissu
