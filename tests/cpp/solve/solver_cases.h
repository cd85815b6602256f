#pragma once

/// Every solver that works on an assembled matrix.

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "tissu/solve/automatic.h"
#include "tissu/solve/cholesky.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu::test {

struct SolverCase {
  std::string name;
  std::function<std::unique_ptr<LinearSolver>(double tolerance)> make;
};

inline void PrintTo(const SolverCase& c, std::ostream* out) { *out << c.name; }

inline SolverCase gradient_case(std::string name, Preconditioning preconditioning,
                                Precision precision = Precision::full, Product product = Product::assembled) {
  return {std::move(name), [=](double tolerance) {
            return std::make_unique<ConjugateGradient>(
                ConjugateGradient::Settings{tolerance, 5000, preconditioning, precision, product});
          }};
}

inline std::vector<SolverCase> solver_cases() {
  std::vector<SolverCase> cases = {
      {"cholesky", [](double /*tolerance*/) { return std::make_unique<Cholesky>(); }},
      {"automatic",
       [](double tolerance) { return std::make_unique<Automatic>(Automatic::Settings{tolerance, false}); }}};
  using P = Preconditioning;
  for (const Precision precision : {Precision::full, Precision::single}) {
    const std::string end = precision == Precision::single ? "_single" : "";
    cases.push_back(gradient_case("jacobi" + end, P::jacobi, precision));
    cases.push_back(gradient_case("block_jacobi" + end, P::block_jacobi, precision));
    cases.push_back(gradient_case("incomplete_cholesky" + end, P::incomplete_cholesky, precision));
    cases.push_back(gradient_case("stale_cholesky" + end, P::stale_cholesky, precision));
    cases.push_back(gradient_case("multigrid" + end, P::multigrid, precision));
  }
  return cases;
}

/// The same, and those that multiply only.
inline std::vector<SolverCase> all_solver_cases() {
  std::vector<SolverCase> cases = solver_cases();
  using P = Preconditioning;
  cases.push_back(gradient_case("jacobi_free", P::jacobi, Precision::full, Product::free));
  cases.push_back(gradient_case("block_jacobi_free", P::block_jacobi, Precision::full, Product::free));
  return cases;
}

}  // namespace tissu::test
