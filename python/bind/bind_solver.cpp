#include "bind.h"
#include "specs.h"
#include "tissu/solve/cholesky.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu::bind {
namespace {

struct ConjugateGradientSpec : SolverSpec {};
struct CholeskySpec : SolverSpec {};

}  // namespace

void bind_solver(py::module_& m) {
  using py::arg;
  py::class_<SolverSpec>(m, "LinearSolver");
  py::class_<ConjugateGradientSpec, SolverSpec>(m, "ConjugateGradient")
      .def(py::init([](double tolerance, int iterations) {
             return ConjugateGradientSpec{{[=]() -> std::unique_ptr<LinearSolver> {
               return std::make_unique<ConjugateGradient>(ConjugateGradient::Settings{tolerance, iterations});
             }}};
           }),
           py::kw_only(), arg("tolerance") = 1e-6, arg("iterations") = 1000);
  py::class_<CholeskySpec, SolverSpec>(m, "Cholesky").def(py::init([] {
    return CholeskySpec{{[]() -> std::unique_ptr<LinearSolver> { return std::make_unique<Cholesky>(); }}};
  }));
}

}  // namespace tissu::bind
