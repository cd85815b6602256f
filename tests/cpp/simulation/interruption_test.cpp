#include "tissu/base/interruption.h"

#include <gtest/gtest.h>

#include "../step/methods.h"
#include "tissu/step/static_equilibrium.h"

/// A step that is asked to stop does so between two iterations, and leaves the state of the step before.
namespace tissu {
namespace {

WorldDescription bar() {
  const Mesh mesh = test::distorted_box({4, 2, 2}, Split::six, 0.05);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 300.0})};
  world.gravity = Vec3(0.0, 0.0, -2.0);
  world.fixed = {test::fixed(test::nodes_where(mesh, [](const Vec3& x) { return x.x() < 0.4; }))};
  return world;
}

class Stops : public testing::TestWithParam<test::Method> {};

TEST_P(Stops, AtTheStateOfTheStepBefore) {
  Simulation simulation = test::simulate(bar(), GetParam().make(), test::conjugate_gradient(1e-8));
  const double h = GetParam().name == "static" ? 1.0 : std::min(0.004, 0.5 * simulation.stable_step());
  simulation.step(h);
  const State before = simulation.state();
  std::atomic<bool> asked = true;
  {
    const Interruptible interruptible(asked);
    EXPECT_THROW(simulation.step(h), Interrupted);
  }
  EXPECT_EQ(simulation.state().time, before.time);
  EXPECT_EQ(simulation.state().positions, before.positions);
  EXPECT_EQ(simulation.state().velocities, before.velocities);
  // Outside it nobody is asked, and the step is one that was never interrupted, to the solver's tolerance.
  Simulation other = test::simulate(bar(), GetParam().make(), test::conjugate_gradient(1e-8));
  other.step(h);
  other.step(h);
  simulation.step(h);
  for (std::size_t i = 0; i < before.positions.size(); ++i) {
    EXPECT_NEAR(simulation.state().positions[i], other.state().positions[i], 1e-6);
  }
}

std::vector<test::Method> iterated() {
  std::vector<test::Method> methods;
  for (const test::Method& method : test::all_methods()) {
    if (method.implicit || method.name.starts_with("fixed_point")) methods.push_back(method);
  }
  methods.push_back({"static", 0, true, [] {
                       return std::make_unique<StaticEquilibrium>(StaticEquilibrium::Settings{{20, 1e-9}, 1});
                     }});
  return methods;
}

INSTANTIATE_TEST_SUITE_P(Methods, Stops, testing::ValuesIn(iterated()), testing::PrintToStringParamName());

TEST(Interruptible, EndsWithItsScope) {
  std::atomic<bool> asked = true;
  std::atomic<bool> never = false;
  EXPECT_NO_THROW(stop_if_asked());
  {
    const Interruptible outer(asked);
    EXPECT_THROW(stop_if_asked(), Interrupted);
    {
      const Interruptible inner(never);
      EXPECT_NO_THROW(stop_if_asked());
    }
    EXPECT_THROW(stop_if_asked(), Interrupted);
  }
  EXPECT_NO_THROW(stop_if_asked());
}

}  // namespace
}  // namespace tissu
