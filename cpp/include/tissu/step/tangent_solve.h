#pragma once

#include <vector>

#include "tissu/step/system.h"

namespace tissu {

/// K x = b with the tangent K = -df/dx of a state, definite and symmetric or not. Where the linear solver
/// finds it indefinite, as beyond a limit point of the load, generalised conjugate residuals (Eisenstat,
/// Elman, Schultz 1983) work on K, preconditioned by that solver with the definite matrix: the two differ in
/// a few directions. So they do where external moments act on frames. A moment whose axis is fixed in space
/// has no energy, and the tangent is the symmetric one of the models and half the cross product with the
/// elastic moment.
class TangentSolve {
 public:
  explicit TangentSolve(System& system) : system_(system) {}

  /// Adds so much of the mass to the matrices that systems are solved with [1/s2], which holds what nothing
  /// else does. 0, as at first: none.
  void set_mass(double mass) { mass_ = mass; }

  /// Held rows of b and x are zero. `report.positive_definite` is what K is.
  SolveReport solve(const State& state, ConstReals b, Reals x);
  /// The same with a mean of K and of the definite matrix, whose `share` is raised until the mean is positive
  /// definite: x is a direction in which the energy falls. A small share keeps the directions in which the
  /// energy curves down, and with them the long way that a body topples or snaps.
  SolveReport solve_mean(const State& state, ConstReals b, Reals x, double& share);
  /// Whether K of the state, without moments, is found indefinite when it is solved with for b.
  bool is_indefinite(const State& state, ConstReals b, Reals x);

 private:
  SolveReport iterate(const State& state, ConstReals b, Reals x);
  /// The elastic forces, where moments from outside act on free frames; false: none do.
  bool find_moments(const State& state);
  /// q = K p
  void multiply(const State& state, ConstReals p, Reals q);

  System& system_;
  double mass_ = 0.0;
  bool has_moments_ = false;
  std::vector<double> moments_;
  std::vector<double> left_;
  std::vector<std::vector<double>> directions_;
  std::vector<std::vector<double>> products_;
};

}  // namespace tissu
