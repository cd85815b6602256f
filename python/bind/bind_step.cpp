#include "bind.h"
#include "specs.h"
#include "tissu/step/implicit_euler.h"
#include "tissu/step/static_equilibrium.h"

namespace tissu::bind {
namespace {

struct ImplicitEulerSpec : IntegratorSpec {};
struct StaticSpec : IntegratorSpec {};

void bind_report(py::module_& m) {
  py::class_<StepReport>(m, "StepReport")
      .def_readonly("time", &StepReport::time)
      .def_readonly("newton_iterations", &StepReport::newton_iterations)
      .def_readonly("solver_iterations", &StepReport::solver_iterations)
      .def_readonly("residual", &StepReport::residual)
      .def_readonly("converged", &StepReport::converged)
      .def_readonly("milliseconds", &StepReport::milliseconds)
      .def_readonly("message", &StepReport::message);
}

}  // namespace

void bind_step(py::module_& m) {
  using py::arg;
  bind_report(m);
  py::class_<IntegratorSpec>(m, "Integrator");
  py::class_<ImplicitEulerSpec, IntegratorSpec>(m, "ImplicitEuler")
      .def(py::init([](int iterations, double tolerance) {
             return ImplicitEulerSpec{{[=]() -> std::unique_ptr<Integrator> {
               return std::make_unique<ImplicitEuler>(NewtonSettings{iterations, tolerance});
             }}};
           }),
           py::kw_only(), arg("newton_iterations") = 1, arg("newton_tolerance") = 1e-6);
  py::class_<StaticSpec, IntegratorSpec>(m, "Static")
      .def(py::init([](int iterations, double tolerance, int load_steps) {
             return StaticSpec{{[=]() -> std::unique_ptr<Integrator> {
               return std::make_unique<StaticEquilibrium>(
                   StaticEquilibrium::Settings{NewtonSettings{iterations, tolerance}, load_steps});
             }}};
           }),
           py::kw_only(), arg("newton_iterations"), arg("newton_tolerance"), arg("load_steps"));
}

}  // namespace tissu::bind
