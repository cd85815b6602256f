#include <gtest/gtest.h>

#include <cmath>

#include "methods.h"

/// A million steps at rest: nothing drifts.
namespace tissu {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kMillion = 10'000;  // a sanitizer has seen all that there is in the first few
#else
constexpr int kMillion = 1'000'000;
#endif

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

WorldDescription hexahedron() {
  const Mesh mesh = box_mesh(Vec3(0.3, -0.2, 0.1), Vec3(1, 1, 1), {1, 1, 1}, Split::none);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 100.0})};
  world.bodies[0].rayleigh = {2.0, 0.0};
  world.fixed = {test::fixed({0, 1, 2, 3})};
  return world;
}

class Rest : public testing::TestWithParam<std::string> {
 protected:
  static Simulation simulate(WorldDescription world) {
    // Linearised once, as scenes are.
    for (const test::Method& method : test::all_methods(1)) {
      if (method.name == GetParam()) return test::simulate(std::move(world), method.make());
    }
    throw Error("no such method");
  }
};

TEST_P(Rest, WithoutLoadsNothingMoves) {
  Simulation simulation = simulate(hexahedron());
  const double h = GetParam() == "symplectic_euler" ? 0.02 : 0.1;
  for (int i = 0; i < kMillion / 10; ++i) simulation.step(h);
  // The force of the rest shape is a few roundings of 100 Pa; with a stiffness of 100 N/m that moves 1e-16 m.
  EXPECT_LT(largest_change(simulation.state().positions, simulation.world().rest_positions()), 1e-14);
}

TEST_P(Rest, AMillionStepsInEquilibrium) {
  WorldDescription world = hexahedron();
  world.gravity = Vec3(0.0, 0.0, -1.0);
  Simulation simulation = simulate(world);
  const double h = GetParam() == "symplectic_euler" ? 0.02 : 0.1;
  for (int i = 0; i < 5000; ++i) simulation.step(h);  // e^(-1 * 100 s) of the first swing
  const State before = simulation.state();
  const int steps = GetParam() == "bdf2" ? kMillion / 10 : kMillion;
  for (int i = 0; i < steps; ++i) simulation.step(h);
  EXPECT_LT(largest_change(simulation.state().positions, before.positions), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Methods, Rest, testing::Values("implicit_euler", "symplectic_euler", "bdf2"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace tissu
