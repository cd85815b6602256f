#pragma once

/// How to make an integrator or a solver: each simulation makes its own; and what a body's model is.

#include <functional>
#include <memory>

#include "tissu/model/options.h"
#include "tissu/solve/linear_solver.h"
#include "tissu/step/integrator.h"

namespace tissu::bind {

struct IntegratorSpec {
  std::function<std::unique_ptr<Integrator>()> make;
};
struct SolverSpec {
  std::function<std::unique_ptr<LinearSolver>()> make;
};
/// A model by its options. A class of its own: a bare variant would be taken for one of its members.
struct ModelSpec {
  ModelOptions options;
};

}  // namespace tissu::bind
