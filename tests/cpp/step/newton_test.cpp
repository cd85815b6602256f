#include <gtest/gtest.h>

#include "../world/sample_worlds.h"
#include "tissu/step/implicit_euler.h"

/// How many iterations Newton's method takes inside a step, and what is kept of one that was stopped early.
namespace tissu {
namespace {

class Newton : public testing::Test {
 protected:
  /// A bar that falls by a good part of its length in one step: a linearised step is far off.
  static StepReport step(int iterations, double tolerance) {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(4, 1, 1), {4, 1, 1}, Split::six);
    WorldDescription world;
    world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 2000.0})};
    world.gravity = Vec3(0.0, 0.0, -1.0);
    world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
    Simulation simulation = test::simulate(std::move(world), test::implicit_euler(iterations, tolerance));
    return simulation.step(1.0);
  }
};

TEST_F(Newton, EndsWhenItsToleranceIsMet) {
  const StepReport report = step(40, 1e-10);
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(report.message.empty());
  EXPECT_GT(report.newton_iterations, 3);
  EXPECT_LE(report.residual, 1e-10);
}

// A cap on the iterations is a cap on their cost: one that was on its way is not begun anew with another
// search.
TEST_F(Newton, TakesNoMoreThanItsCapWhereItIsOnItsWay) {
  const StepReport report = step(4, 1e-14);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.newton_iterations, 4);
  EXPECT_EQ(report.solver_iterations, 4);  // Cholesky: one for each system
  EXPECT_EQ(report.message, "Newton's iteration stopped before its tolerance");
  EXPECT_LT(report.residual, step(3, 1e-14).residual);
}

}  // namespace
}  // namespace tissu
