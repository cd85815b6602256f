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

/// One Python class for each method.
template <class Method>
struct Spec : IntegratorSpec {};

Indefinite to_indefinite(const std::string& word) {
  if (word == "project") return Indefinite::project;
  if (word == "regularise") return Indefinite::regularise;
  if (word == "refuse") return Indefinite::refuse;
  throw ParameterError("indefinite is \"" + word + "\"; project, regularise or refuse is accepted.");
}

template <class Method>
void bind_explicit(py::module_& m, const char* name) {
  py::class_<Spec<Method>, IntegratorSpec>(m, name).def(py::init([] {
    return Spec<Method>{{[]() -> std::unique_ptr<Integrator> { return std::make_unique<Method>(); }}};
  }));
}

template <class Method>
void bind_implicit(py::module_& m, const char* name) {
  py::class_<Spec<Method>, IntegratorSpec>(m, name).def(
      py::init([](int iterations, double tolerance, const std::string& indefinite) {
        const NewtonSettings newton{iterations, tolerance, to_indefinite(indefinite)};
        return Spec<Method>{
            {[=]() -> std::unique_ptr<Integrator> { return std::make_unique<Method>(newton); }}};
      }),
      py::kw_only(), arg("newton_iterations") = 1, arg("newton_tolerance") = 1e-6,
      arg("indefinite") = "project");
}

void bind_report(py::module_& m) {
  py::class_<StepReport>(m, "StepReport")
      .def_readonly("time", &StepReport::time)
      .def_readonly("newton_iterations", &StepReport::newton_iterations)
      .def_readonly("solver_iterations", &StepReport::solver_iterations)
      .def_readonly("residual", &StepReport::residual)
      .def_readonly("indefinite", &StepReport::indefinite)
      .def_readonly("converged", &StepReport::converged)
      .def_readonly("milliseconds", &StepReport::milliseconds)
      .def_readonly("message", &StepReport::message);
}

void bind_others(py::module_& m) {
  py::class_<Spec<RungeKutta>, IntegratorSpec>(m, "RungeKutta")
      .def(py::init([](int order) {
             return Spec<RungeKutta>{
                 {[=]() -> std::unique_ptr<Integrator> { return std::make_unique<RungeKutta>(order); }}};
           }),
           py::kw_only(), arg("order"));
  py::class_<Spec<Newmark>, IntegratorSpec>(m, "Newmark")
      .def(py::init([](double beta, double gamma, int iterations, double tolerance,
                       const std::string& indefinite) {
             const Newmark::Settings settings{
                 beta, gamma, NewtonSettings{iterations, tolerance, to_indefinite(indefinite)}};
             return Spec<Newmark>{
                 {[=]() -> std::unique_ptr<Integrator> { return std::make_unique<Newmark>(settings); }}};
           }),
           py::kw_only(), arg("beta") = 0.25, arg("gamma") = 0.5, arg("newton_iterations") = 1,
           arg("newton_tolerance") = 1e-6, arg("indefinite") = "project");
  py::class_<Spec<Bdf2FixedPoint>, IntegratorSpec>(m, "Bdf2FixedPoint")
      .def(py::init([](int iterations, double tolerance, int anderson) {
             const Bdf2FixedPoint::Settings settings{iterations, tolerance, anderson};
             return Spec<Bdf2FixedPoint>{{[=]() -> std::unique_ptr<Integrator> {
               return std::make_unique<Bdf2FixedPoint>(settings);
             }}};
           }),
           py::kw_only(), arg("iterations") = 50, arg("tolerance") = 1e-6, arg("anderson") = 0);
  py::class_<Spec<StaticEquilibrium>, IntegratorSpec>(m, "Static")
      .def(py::init([](int iterations, double tolerance, int load_steps, int total, bool arc_length) {
             const StaticEquilibrium::Settings settings{NewtonSettings{iterations, tolerance}, load_steps,
                                                        total, arc_length};
             return Spec<StaticEquilibrium>{{[=]() -> std::unique_ptr<Integrator> {
               return std::make_unique<StaticEquilibrium>(settings);
             }}};
           }),
           py::kw_only(), arg("newton_iterations"), arg("newton_tolerance"), arg("load_steps"),
           arg("total_iterations") = 0, arg("arc_length") = false);
  py::class_<Spec<EnergyMomentum>, IntegratorSpec>(m, "EnergyMomentum")
      .def(py::init([](int iterations, double tolerance) {
             const NewtonSettings newton{iterations, tolerance};
             return Spec<EnergyMomentum>{
                 {[=]() -> std::unique_ptr<Integrator> { return std::make_unique<EnergyMomentum>(newton); }}};
           }),
           py::kw_only(), arg("newton_iterations") = 20, arg("newton_tolerance") = 1e-9);
}

}  // namespace

void bind_step(py::module_& m) {
  bind_report(m);
  py::class_<IntegratorSpec>(m, "Integrator");
  bind_explicit<ExplicitEuler>(m, "ExplicitEuler");
  bind_explicit<SymplecticEuler>(m, "SymplecticEuler");
  bind_implicit<ImplicitEuler>(m, "ImplicitEuler");
  bind_implicit<ImplicitMidpoint>(m, "ImplicitMidpoint");
  bind_implicit<Bdf2>(m, "Bdf2");
  bind_others(m);
}

}  // namespace tissu::bind
