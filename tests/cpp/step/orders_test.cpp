#include <gtest/gtest.h>

#include <cmath>

#include "methods.h"

/// The order of every method, measured: on the linear oscillator against its closed form, and on a bar of
/// StVK against a solution of fourth order with far smaller steps.
namespace tissu {
namespace {

using test::Method;
using test::Oscillator;

class Orders : public testing::TestWithParam<Method> {};

/// Slope of log(error) between two numbers of steps.
double slope(double coarse, double fine, double ratio) { return std::log(coarse / fine) / std::log(ratio); }

double oscillator_error(const Method& method, int steps) {
  const double u0 = 0.1;
  const double v0 = -0.3;
  const double span = 0.3;
  Simulation simulation = test::simulate(Oscillator::world(), method.make());
  Oscillator::start(simulation, u0, v0);
  for (int i = 0; i < steps; ++i) simulation.step(span / steps);
  const double w = Oscillator::omega();
  const double u = u0 * std::cos(w * span) + v0 / w * std::sin(w * span);
  const double v = -u0 * w * std::sin(w * span) + v0 * std::cos(w * span);
  return std::hypot(Oscillator::u(simulation) - u, (Oscillator::v(simulation) - v) / w);
}

int steps_of(const Method& method) { return method.order == 4 ? 40 : 200 * test::finer(method); }

// The slope differs from the order by the next term of the error, a share h omega / 2 < 0.01 of it per order.
TEST_P(Orders, OfTheLinearOscillator) {
  const Method& method = GetParam();
  const int n = steps_of(method);
  const double coarse = oscillator_error(method, n);
  const double fine = oscillator_error(method, 2 * n);
  EXPECT_NEAR(slope(coarse, fine, 2.0), method.order, 0.1) << coarse << " " << fine;
}

struct Bar {
  static WorldDescription world() {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {3, 1, 1}, Split::none);
    WorldDescription world;
    world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 60.0})};
    world.gravity = Vec3(0.0, 0.0, -1.0);
    world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
    return world;
  }
  static std::vector<double> end(const Method& method, int steps) {
    const double span = 0.5;
    Simulation simulation = test::simulate(world(), method.make());
    for (int i = 0; i < steps; ++i) simulation.step(span / steps);
    return simulation.state().positions;
  }
};

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST_P(Orders, OfAStVKBar) {
  const Method& method = GetParam();
  static const std::vector<double> exact = Bar::end(test::method_named("rk4"), 2000);
  const int n = method.order == 4 ? 60 : 400 * test::finer(method);
  const double coarse = distance(Bar::end(method, n), exact);
  const double fine = distance(Bar::end(method, 2 * n), exact);
  EXPECT_GT(coarse, 1e-11);  // far above the error of the reference
  EXPECT_NEAR(slope(coarse, fine, 2.0), method.order, 0.15) << coarse << " " << fine;
}

INSTANTIATE_TEST_SUITE_P(Methods, Orders, testing::ValuesIn(test::all_methods()),
                         testing::PrintToStringParamName());

/// BDF2 with steps that alternate keeps its order, which constant coefficients would lose.
TEST(VariableSteps, KeepTheOrderOfBdf2) {
  const auto error = [](int pairs) {
    const double span = 0.3;
    const double u0 = 0.1;
    Simulation simulation = test::simulate(Oscillator::world(), test::method_named("bdf2").make());
    Oscillator::start(simulation, u0, 0.0);
    for (int i = 0; i < pairs; ++i) {
      simulation.step(span / pairs * 0.7);
      simulation.step(span / pairs * 0.3);
    }
    return std::abs(Oscillator::u(simulation) - u0 * std::cos(Oscillator::omega() * span));
  };
  EXPECT_NEAR(slope(error(200), error(400), 2.0), 2.0, 0.1);
}

}  // namespace
}  // namespace tissu
