#include "bind.h"
#include "specs.h"
#include "tissu/step/bdf2.h"
#include "tissu/step/energy_momentum.h"
#include "tissu/step/explicit_euler.h"
#include "tissu/step/fixed_point.h"
#include "tissu/step/implicit_euler.h"
#include "tissu/step/implicit_midpoint.h"
#include "tissu/step/newmark.h"
#include "tissu/step/runge_kutta.h"
#include "tissu/step/static_equilibrium.h"

namespace tissu::bind {
namespace {

using py::arg;

/// How to make a method with these settings.
template <class Method, class... Settings>
IntegratorSpec spec(Settings... settings) {
  return {[=]() -> std::unique_ptr<Integrator> { return std::make_unique<Method>(settings...); }};
}

NewtonSettings to_newton(int iterations, double tolerance, const std::string& indefinite) {
  for (const auto& [word, value] : {std::pair{"project", Indefinite::project},
                                    {"regularise", Indefinite::regularise},
                                    {"refuse", Indefinite::refuse}}) {
    if (indefinite == word) return {iterations, tolerance, value};
  }
  throw ParameterError("indefinite is \"" + indefinite + "\"; project, regularise or refuse is accepted.");
}

template <class Method>
void bind_implicit(py::module_& m, const char* name) {
  m.def(
      name,
      [](int iterations, double tolerance, const std::string& indefinite) {
        return spec<Method>(to_newton(iterations, tolerance, indefinite));
      },
      py::kw_only(), arg("newton_iterations"), arg("newton_tolerance"), arg("indefinite"));
}

void bind_report(py::module_& m) {
  py::class_<StepReport>(m, "StepReport")
      .def_readonly("time", &StepReport::time)
      .def_readonly("newton_iterations", &StepReport::newton_iterations)
      .def_readonly("solver_iterations", &StepReport::solver_iterations)
      .def_readonly("residual", &StepReport::residual)
      .def_readonly("indefinite", &StepReport::indefinite)
      .def_readonly("converged", &StepReport::converged)
      .def_readonly("contacts", &StepReport::contacts)
      .def_readonly("held_back", &StepReport::held_back)
      .def_readonly("least_gap", &StepReport::least_gap)
      .def_readonly("milliseconds", &StepReport::milliseconds)
      .def_readonly("message", &StepReport::message);
}

void bind_others(py::module_& m) {
  m.def(
      "Newmark",
      [](double beta, double gamma, int iterations, double tolerance, const std::string& indefinite) {
        return spec<Newmark>(Newmark::Settings{beta, gamma, to_newton(iterations, tolerance, indefinite)});
      },
      py::kw_only(), arg("beta"), arg("gamma"), arg("newton_iterations"), arg("newton_tolerance"),
      arg("indefinite"));
  m.def(
      "BDF2FixedPoint",
      [](int iterations, double tolerance, int anderson) {
        return spec<Bdf2FixedPoint>(Bdf2FixedPoint::Settings{iterations, tolerance, anderson});
      },
      py::kw_only(), arg("iterations"), arg("tolerance"), arg("anderson"));
  m.def(
      "Static",
      [](int load_steps, int iterations, double tolerance, int total, bool arc_length) {
        return spec<StaticEquilibrium>(StaticEquilibrium::Settings{NewtonSettings{iterations, tolerance},
                                                                   load_steps, total, arc_length});
      },
      py::kw_only(), arg("load_steps"), arg("newton_iterations"), arg("newton_tolerance"),
      arg("total_iterations"), arg("arc_length"));
  m.def(
      "EnergyMomentum",
      [](int iterations, double tolerance) {
        return spec<EnergyMomentum>(NewtonSettings{iterations, tolerance});
      },
      py::kw_only(), arg("iterations"), arg("tolerance"));
}

}  // namespace

/// Each method by the name of its class in a scene; the defaults are there.
void bind_step(py::module_& m) {
  bind_report(m);
  py::class_<IntegratorSpec>(m, "Integrator");
  m.def("ExplicitEuler", &spec<ExplicitEuler>);
  m.def("SymplecticEuler", &spec<SymplecticEuler>);
  m.def("RK2", [] { return spec<RungeKutta>(2); });
  m.def("RK4", [] { return spec<RungeKutta>(4); });
  bind_implicit<ImplicitEuler>(m, "ImplicitEuler");
  bind_implicit<ImplicitMidpoint>(m, "ImplicitMidpoint");
  bind_implicit<Bdf2>(m, "BDF2");
  bind_others(m);
}

}  // namespace tissu::bind
