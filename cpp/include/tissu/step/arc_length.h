#pragma once

#include <vector>

#include "tissu/step/equilibrium.h"

namespace tissu {

/// Follows equilibria by the length of their path in displacements and share of the load together (Riks
/// 1979), so that it passes limit points, where the load turns. Each correction stays in the plane normal to
/// the path's tangent: two solves with the tangent matrix, one for the residual and one for the load.
class ArcLength {
 public:
  enum class End {
    unused,
    reached,    ///< share 1
    most,       ///< iterations
    no_longer,  ///< steps below the shortest find nothing
    released,   ///< the load went below minus itself: the path leads to a state that is not an equilibrium
  };
  ArcLength(Equilibrium& equilibrium, NewtonSettings newton);

  /// From an equilibrium at `share`, which becomes the share that was reached, in first steps that change the
  /// share by about `part`. At most `total` iterations stand in the report at the end.
  End follow(const LoadPath& path, double& share, double part, int total, State& state, StepReport& report);

 private:
  /// The change of the equilibrium for a unit of share goes into `rate`; false: no solution.
  bool find_rate(const LoadPath& path, double share, const State& state, std::vector<double>& rate,
                 StepReport& report);
  bool find_tangent(const LoadPath& path, double share, const State& state, StepReport& report);
  /// One step of that length; false: it did not converge, and state and share are as they were.
  bool advance(const LoadPath& path, double length, double& share, State& state, StepReport& report);
  /// Moves free rows by `change`, held ones to where the path leads them.
  void go(const LoadPath& path, double before, double after, ConstReals change, State& state);

  Equilibrium& equilibrium_;
  NewtonSettings newton_;
  double scale_ = 1.0;  ///< displacement that counts as much as the whole load [m]
  double tangent_share_ = 1.0;
  int iterations_ = 0;  ///< of the latest step
  State trial_;
  State other_;  ///< at a share nearby
  State start_;  ///< of a step
  std::vector<double> tangent_;
  std::vector<double> rate_;
  std::vector<double> change_;
  std::vector<double> correction_;
  std::vector<double> right_;
  std::vector<double> way_;
};

}  // namespace tissu
