#include "tissu/step/arc_length.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../world/sample_worlds.h"

/// The truss of von Mises: two bars from (-a, 0) and (a, 0) to a top at height h that moves up and down only.
/// With Green's strain the load that keeps the top at the height z is P = E A z (h^2 - z^2) / L^3, downwards,
/// L^2 = a^2 + h^2: it is largest at z = h / sqrt(3).
namespace tissu {
namespace {

constexpr double kHalf = 1.0;
constexpr double kHeight = 0.3;
constexpr double kYoung = 2e5;
constexpr double kArea = 0.01;

double load_at(double z) {
  return kYoung * kArea * z * (kHeight * kHeight - z * z) / std::pow(std::hypot(kHalf, kHeight), 3);
}
double largest_load() { return load_at(kHeight / std::sqrt(3.0)); }

WorldDescription truss(double load) {
  BodyDescription body;
  body.name = "body";
  body.positions = {-kHalf, 0, 0, kHalf, 0, 0, 0, kHeight, 0};
  ElasticBlock bars;
  bars.body = "body";
  bars.element = "line";
  bars.law = "stvk";
  bars.cells = {0, 2, 2, 1};
  bars.parameters["young"] = {kYoung};
  bars.parameters["poisson"] = {0.0};
  bars.density = {1.0};
  bars.cross_section = {kArea};
  body.elastic = {bars};
  WorldDescription world;
  world.bodies = {body};
  world.fixed = {test::fixed({0, 1}), test::fixed({2}, 5)};
  world.loads = {{"top", "body", {2}, {0.0, -load, 0.0}, {}}};
  return world;
}

double height(const State& state) { return state.positions[7]; }

// Stopped after more and more iterations, it stands on the curve each time, behind the limit point too.
TEST(ArcLength, FollowsTheTrussThroughItsLimitPoints) {
  const double load = 1.2 * largest_load();
  const World world(truss(load));
  Cholesky solver;
  Profile profile;
  const NewtonSettings newton{50, 1e-10};
  double largest = 0.0;
  double least = 1.0;
  double share = 0.0;
  for (int total = 5; share < 1.0 && total < 400; total += 5) {
    Equilibrium equilibrium(world, &solver, profile, newton);
    State state = world.rest_state();
    const LoadPath path(world, world.rest_state(), 1.0, false);
    equilibrium.begin(path, state);
    share = 0.0;
    StepReport report;
    ArcLength(equilibrium, newton).follow(path, share, 0.25, total, state, report);
    EXPECT_NEAR(share * load, load_at(height(state)), 1e-8 * load) << total;  // 1e-10, times the slope
    largest = std::max(largest, share < 1.0 ? share : 0.0);
    least = std::min(least, share);
  }
  EXPECT_EQ(share, 1.0);
  // It went up to the limit, down to the opposite one, and up again.
  EXPECT_GT(largest, 0.6 / 1.2);
  EXPECT_LT(least, -0.6 / 1.2);
}

class Truss : public testing::TestWithParam<bool> {};

// More than it can carry: the top snaps through, to where the curve has that load again.
TEST_P(Truss, SnapsThroughToTheOtherSide) {
  for (const double times : {0.5, 0.99, 1.01, 1.5, 3.0}) {
    const double load = times * largest_load();
    StaticEquilibrium::Settings settings;
    settings.newton = {50, 1e-10};
    settings.arc_length = GetParam();
    Simulation simulation = test::simulate(truss(load), std::make_unique<StaticEquilibrium>(settings),
                                           std::make_unique<Cholesky>());
    const StepReport report = simulation.step(1.0);
    ASSERT_TRUE(report.converged) << report.message;
    const double z = height(simulation.state());
    EXPECT_NEAR(load_at(z), load, 1e-8 * load) << times;
    EXPECT_EQ(z < -kHeight, times > 1.0) << times << ", z = " << z;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Truss, testing::Bool(), [](const auto& info) {
  return info.param ? "by_arc_length" : "by_parts_of_the_load";
});

}  // namespace
}  // namespace tissu
