#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sample_worlds.h"
#include "tissu/law/law.h"

/// Bodies that move with Kelvin–Voigt's viscosity and with that of the centroid, beside closed forms.
namespace tissu {
namespace {

constexpr double kYoung = 50.0;
constexpr double kPoisson = 0.3;
constexpr double kDensity = 2.0;
constexpr double kShear = 0.4;
constexpr double kBulk = 0.3;

/// A bar of hexahedra along x, held at x = 0 and aside, so that it moves along x only: uniaxial strain.
struct Bar {
  static constexpr int kCells = 8;
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2.0, 0.5, 0.5), {kCells, 1, 1}, Split::none);
  WorldDescription world;
  Bar() {
    world.bodies = {test::body_of(mesh, {"hooke", kYoung, kPoisson, kDensity})};
    world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0)),
                   test::fixed(test::nodes_where(mesh, [](const Vec3& x) { return x.x() > 0.1; }), 6)};
  }
};

double modulus() {
  const Lame c = lame(kYoung, kPoisson);
  return c.lambda + 2.0 * c.mu;
}

/// The lowest mode of the bar: u_j = sin(phi j), omega^2 = (4 M / (rho dx^2)) sin^2(phi / 2) with the lumped
/// mass, the free end at phi = pi / (2 cells); damping C = K (2 eta + zeta) / M. Backward Euler takes
/// (1 + 2 d h + (omega h)^2) u2 - 2 (1 + d h) u1 + u0 = 0, d = omega^2 (2 eta + zeta) / (2 M), with v in
/// place of the difference. The strain is 1e-6, and so is what it adds to linear theory.
TEST(KelvinVoigtBar, VibratesAndDecaysAtTheRateOfTheory) {
  Bar bar;
  bar.world.bodies[0].viscosity = {.shear = kShear, .bulk = kBulk};
  const double dx = 2.0 / Bar::kCells;
  const double phi = 0.5 * std::numbers::pi / Bar::kCells;
  const double omega = 2.0 / dx * std::sin(0.5 * phi) * std::sqrt(modulus() / kDensity);
  const double damping = 0.5 * omega * omega * (2.0 * kShear + kBulk) / modulus();
  Simulation simulation = test::simulate(bar.world, test::implicit_euler());
  const double amplitude = 1e-6;
  const auto mode = [&](std::int32_t node) { return std::sin(phi * bar.mesh.node(node).x() / dx); };
  for (std::int32_t i = 0; i < bar.mesh.node_count(); ++i) {
    block(Reals(simulation.state().positions), i).x() += amplitude * mode(i);
  }
  const double h = 0.02 / omega;
  double u = 1.0;
  double v = 0.0;
  for (int step = 1; step <= 300; ++step) {
    simulation.step(h);
    v = (v - h * omega * omega * u) / (1.0 + 2.0 * h * damping + h * h * omega * omega);
    u += h * v;
    const auto free = test::nodes_at(bar.mesh, 0, 2.0)[0];
    const double moved = simulation.state().positions[static_cast<std::size_t>(3 * free)] - 2.0;
    ASSERT_NEAR(moved / amplitude, u, 1e-5) << "step " << step;
  }
  // The recurrence itself is the damped vibration exp(-d t) cos(omega_d t) to the order of h: the damping of
  // backward Euler, omega^2 h / 2, included.
  const double t = 300 * h;
  const double d = damping + 0.5 * omega * omega * h;
  const double expected = std::exp(-d * t) * std::cos(std::sqrt(omega * omega - d * d) * t);
  EXPECT_NEAR(u, expected, 0.03);
  EXPECT_LT(std::exp(-damping * t), 0.9);  // there is something to see
}

/// Under a load the bar creeps to the elastic answer: viscosity has no part in equilibrium.
TEST(KelvinVoigtBar, EquilibriumIsElastic) {
  const auto settled = [](Viscosity viscosity) {
    Bar bar;
    bar.world.bodies[0].viscosity = std::move(viscosity);
    const auto end = test::nodes_at(bar.mesh, 0, 2.0);
    std::vector<double> forces(3 * end.size(), 0.0);
    for (std::size_t i = 0; i < end.size(); ++i) forces[3 * i] = 0.01;
    bar.world.loads = {{"hand", "body", end, forces, {{0.0}, {1.0}}}};
    Simulation simulation = test::simulate(bar.world, test::implicit_euler());
    for (int i = 0; i < 400; ++i) simulation.step(0.2);
    return simulation.state().positions;
  };
  const std::vector<double> elastic = settled({});
  for (const Viscosity& viscosity : {Viscosity{.shear = kShear}, Viscosity{.centroid = 3.0}}) {
    const std::vector<double> viscous = settled(viscosity);
    for (std::size_t i = 0; i < elastic.size(); ++i) EXPECT_NEAR(viscous[i], elastic[i], 1e-12);
  }
}

/// What a free body that turns keeps of its spin about z after a second.
double spin_left(const Viscosity& viscosity) {
  const Mesh mesh = box_mesh(Vec3(-0.5, -0.5, -0.5), Vec3(1, 1, 1), {2, 2, 2}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {"stvk", 1e4, kPoisson, kDensity})};
  world.bodies[0].viscosity = viscosity;
  Simulation simulation = test::simulate(world, test::implicit_euler(8, 1e-10));
  const auto momentum = [&] {
    double sum = 0.0;
    for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
      const Vec3 x = block(ConstReals(simulation.state().positions), i);
      const Vec3 v = block(ConstReals(simulation.state().velocities), i);
      sum += simulation.world().mass().nodal()[static_cast<std::size_t>(i)] * x.cross(v).z();
    }
    return sum;
  };
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    block(Reals(simulation.state().velocities), i) = Vec3(0, 0, 0.5).cross(mesh.node(i));
  }
  const double before = momentum();
  for (int i = 0; i < 200; ++i) simulation.step(0.005);
  return momentum() / before;
}

/// Backward Euler itself loses spin, omega^2 h per second to first order: 0.25 x 0.005 = 1e-3.
TEST(ViscousRotation, KelvinVoigtLeavesItCentroidBrakesIt) {
  const double elastic = spin_left({});
  EXPECT_NEAR(elastic, 1.0, 2e-3);
  EXPECT_NEAR(spin_left({.shear = 5.0}), elastic, 1e-6);
  EXPECT_LT(spin_left({.centroid = 5.0}), 0.8);
}

TEST(ViscosityOfAWorld, RefusesWhatHasNoSense) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}, Split::none);
  const auto built = [&](Viscosity viscosity) {
    WorldDescription world;
    world.bodies = {test::body_of(mesh)};
    world.bodies[0].viscosity = std::move(viscosity);
    return World(std::move(world));
  };
  EXPECT_THROW(built({.shear = -1.0}), ParameterError);
  EXPECT_THROW(built({.bulk = -1.0}), ParameterError);
  EXPECT_THROW(built({.centroid = std::nan("")}), ParameterError);
  EXPECT_THROW(built({.prony = {{-0.1, 1.0}}}), ParameterError);
  EXPECT_THROW(built({.prony = {{0.1, 0.0}}}), ParameterError);
  EXPECT_THROW(built({.prony = std::vector<PronyBranch>(17, {0.1, 1.0})}), ParameterError);
  EXPECT_EQ(built({}).forces().size(), 1U);
  EXPECT_EQ(built({.shear = 1.0, .centroid = 1.0, .prony = {{0.1, 1.0}}}).forces().size(), 4U);
}

}  // namespace
}  // namespace tissu
