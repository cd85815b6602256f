#pragma once

/// Every method that moves bodies through time, for tests that all of them pass.

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "../world/sample_worlds.h"
#include "tissu/law/law.h"
#include "tissu/step/bdf2.h"
#include "tissu/step/explicit_euler.h"
#include "tissu/step/fixed_point.h"
#include "tissu/step/implicit_midpoint.h"
#include "tissu/step/newmark.h"
#include "tissu/step/runge_kutta.h"

namespace tissu::test {

struct Method {
  std::string name;
  int order;
  bool implicit;
  std::function<std::unique_ptr<Integrator>()> make;
};

/// Explicit Euler is held to steps of 0.02 / omega^2.
inline int finer(const Method& method) { return method.name == "explicit_euler" ? 50 : 1; }

inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

/// Newton's equation is solved to the last bits, so that only the error of the method is left.
inline std::vector<Method> all_methods(int newton = 30) {
  const NewtonSettings exact{newton, 1e-13};
  return {
      {"explicit_euler", 1, false, [] { return std::make_unique<ExplicitEuler>(); }},
      {"symplectic_euler", 1, false, [] { return std::make_unique<SymplecticEuler>(); }},
      {"rk2", 2, false, [] { return std::make_unique<RungeKutta>(2); }},
      {"rk4", 4, false, [] { return std::make_unique<RungeKutta>(4); }},
      {"implicit_euler", 1, true, [=] { return std::make_unique<ImplicitEuler>(exact); }},
      {"implicit_midpoint", 2, true, [=] { return std::make_unique<ImplicitMidpoint>(exact); }},
      {"bdf2", 2, true, [=] { return std::make_unique<Bdf2>(exact); }},
      {"newmark", 2, true, [=] { return std::make_unique<Newmark>(Newmark::Settings{0.25, 0.5, exact}); }},
      {"newmark_damped", 1, true,
       [=] { return std::make_unique<Newmark>(Newmark::Settings{0.36, 0.7, exact}); }},
      {"fixed_point", 2, false,
       [] { return std::make_unique<Bdf2FixedPoint>(Bdf2FixedPoint::Settings{200, 1e-13, 0}); }},
      {"fixed_point_anderson", 2, false,
       [] { return std::make_unique<Bdf2FixedPoint>(Bdf2FixedPoint::Settings{200, 1e-13, 5}); }}};
}

inline Method method_named(const std::string& name) {
  for (Method& method : all_methods()) {
    if (method.name == name) return method;
  }
  throw Error("no method is named " + name);
}

/// The unit tetrahedron whose node 1 moves along x: one degree of freedom u, W = V (lambda + 2 mu) eps^2 / 2,
/// eps = u (Hooke) or u + u^2 / 2 (StVK).
struct Oscillator {
  static constexpr double kYoung = 50.0;
  static constexpr double kPoisson = 0.3;
  static constexpr double kDensity = 2.0;
  static constexpr double kMass = kDensity / 6.0 / 4.0;

  static WorldDescription world(const std::string& law = "hooke") {
    Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{CellType::tetra, {0, 1, 2, 3}}}};
    WorldDescription world;
    world.bodies = {body_of(mesh, {law, kYoung, kPoisson, kDensity})};
    world.fixed = {fixed({0, 2, 3}), fixed({1}, 6)};
    return world;
  }
  static double stiffness() {
    const Lame c = lame(kYoung, kPoisson);
    return (c.lambda + 2.0 * c.mu) / 6.0;
  }
  static double omega() { return std::sqrt(stiffness() / kMass); }
  static void start(Simulation& simulation, double u, double v) {
    simulation.state().positions[3] = 1.0 + u;
    simulation.state().velocities[3] = v;
  }
  static double u(const Simulation& simulation) { return simulation.state().positions[3] - 1.0; }
  static double v(const Simulation& simulation) { return simulation.state().velocities[3]; }
};

}  // namespace tissu::test
