#pragma once

/// How to make an integrator or a solver: each simulation makes its own.

#include <functional>
#include <memory>

#include "tissu/solve/linear_solver.h"
#include "tissu/step/integrator.h"

namespace tissu::bind {

struct IntegratorSpec {
  std::function<std::unique_ptr<Integrator>()> make;
};
struct SolverSpec {
  std::function<std::unique_ptr<LinearSolver>()> make;
};

}  // namespace tissu::bind
