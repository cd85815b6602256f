#pragma once

/// The same few steps of a simulation, again and again: every repetition of a row does the same work, however
/// many there are, and two versions of the code are compared on the same steps.

#include <benchmark/benchmark.h>

#include <memory>

#include "tissu/simulation/simulation.h"
#include "tissu/solve/conjugate_gradient.h"

namespace tissu::bench {

class Window {
 public:
  /// Steps of 10 ms by implicit Euler: `before` of them lead to the state from which the `steps` that are
  /// measured start. The solver forgets what it knows from earlier steps each time, so that its
  /// preconditioner is made at least once.
  Window(std::shared_ptr<const World> world, const ConjugateGradient::Settings& solver, int before,
         int steps);
  /// The loop of a row and its counters: elements, nodes, steps of an iteration, steps/s, ns/element of a
  /// step, CG iterations of a step, the shares of time of forces, matrix, preconditioner and solve, the
  /// bandwidth that the solve reached as a share of the machine's limit, the residual; bytes/element held by
  /// models, matrix and solver. "failed" counts solves that did not reach the tolerance.
  void measure(benchmark::State& run);
  /// What the process grew by while the simulation was made and took its first steps [bytes].
  [[nodiscard]] double resident() const { return resident_; }

 private:
  void count_time(benchmark::State& run);
  void count_memory(benchmark::State& run) const;

  ConjugateGradient::Settings solver_;
  int steps_;
  double resident_;
  double processor_seconds_ = 0.0;  ///< of the latest measurement
  Simulation simulation_;
  Snapshot start_;
};

}  // namespace tissu::bench
