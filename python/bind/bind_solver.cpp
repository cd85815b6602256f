#include <array>
#include <string_view>

#include "bind.h"
#include "specs.h"
#include "tissu/solve/automatic.h"
#include "tissu/solve/cholesky.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu::bind {
namespace {

template <class Value>
using Names = std::span<const std::pair<std::string_view, Value>>;

constexpr std::pair<std::string_view, Preconditioning> kPreconditioners[] = {
    {"jacobi", Preconditioning::jacobi},
    {"block_jacobi", Preconditioning::block_jacobi},
    {"incomplete_cholesky", Preconditioning::incomplete_cholesky},
    {"stale_cholesky", Preconditioning::stale_cholesky},
    {"multigrid", Preconditioning::multigrid}};
constexpr std::pair<std::string_view, Precision> kPrecisions[] = {{"double", Precision::full},
                                                                  {"single", Precision::single}};
constexpr std::pair<std::string_view, Product> kMatrices[] = {{"assembled", Product::assembled},
                                                              {"free", Product::free}};

template <class Value>
Value named(Names<Value> names, const std::string& name) {
  for (const auto& [known, value] : names) {
    if (known == name) return value;
  }
  throw ParameterError("found \"" + name + "\" as a choice of the conjugate gradient, which has none such.");
}

}  // namespace

/// Each solver by the name of its class in a scene; the defaults are there.
void bind_solver(py::module_& m) {
  using py::arg;
  py::class_<SolverSpec>(m, "LinearSolver");
  m.def(
      "ConjugateGradient",
      [](double tolerance, int iterations, const std::string& preconditioner, const std::string& precision,
         const std::string& matrix) {
        const ConjugateGradient::Settings settings{
            tolerance, iterations, named<Preconditioning>(kPreconditioners, preconditioner),
            named<Precision>(kPrecisions, precision), named<Product>(kMatrices, matrix)};
        return SolverSpec{
            [=]() -> std::unique_ptr<LinearSolver> { return std::make_unique<ConjugateGradient>(settings); }};
      },
      py::kw_only(), arg("tolerance"), arg("iterations"), arg("preconditioner"), arg("precision"),
      arg("matrix"));
  m.def(
      "Auto",
      [](double tolerance, bool equilibrium) {
        const Automatic::Settings settings{tolerance, equilibrium};
        return SolverSpec{
            [=]() -> std::unique_ptr<LinearSolver> { return std::make_unique<Automatic>(settings); }};
      },
      py::kw_only(), arg("tolerance"), arg("equilibrium"));
  m.def("Cholesky", [] {
    return SolverSpec{[]() -> std::unique_ptr<LinearSolver> { return std::make_unique<Cholesky>(); }};
  });
}

}  // namespace tissu::bind
