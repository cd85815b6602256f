#pragma once

/// Newton's method for f(x) = 0 at one share of a load.

#include <optional>
#include <vector>

#include "tissu/step/integrator.h"
#include "tissu/step/load_path.h"
#include "tissu/step/system.h"
#include "tissu/step/tangent_solve.h"

namespace tissu {

/// A state is in equilibrium when |f| on the free rows is at most the tolerance times the load that acts: the
/// norm of the external forces on free rows, and of the reactions at that same state where nodes are led or
/// no external force acts. Beside it, the last correction is at most a hundredth of the displacement. What
/// round-off alone leaves of f is equilibrium too, and a few times as much where Newton's method stands
/// still.
class Equilibrium {
 public:
  /// Why Newton's iteration ended.
  enum class End {
    reached,
    most,        ///< iterations
    ran_away,    ///< the correction grew without bound, or the residual did not fall any more
    no_descent,  ///< the energy did not fall
    solver,      ///< the linear solver gave up, and the residual did not fall
    flew,        ///< the latest correction was cut, see `steady`
  };
  enum class Search {
    none,    ///< whole steps, which may pass through worse states on the way to a better one
    energy,  ///< steps along which the potential energy falls, or which halve the residual where the tangent
             ///< is indefinite: at a saddle of the energy nothing else converges fast
  };

  Equilibrium(const World& world, LinearSolver* solver, Profile& profile, NewtonSettings newton);

  [[nodiscard]] System& system() { return system_; }
  [[nodiscard]] TangentSolve& tangent() { return tangent_; }
  [[nodiscard]] const World& world() const { return system_.world(); }
  [[nodiscard]] ConstReals right() const { return right_; }

  /// Where contact alone holds a body: so much of the mass stands beside the tangent [1/s2], and a correction
  /// goes no farther than `farthest` [m]. 0 and 0, as at first: neither.
  void steady(double mass, double farthest);
  /// `state` goes only that share of the latest correction; what is led goes all of it.
  void shorten(double share, State& state);

  /// A step begins: what acts at its end is the load of all its parts.
  void begin(const LoadPath& path, const State& start);

  /// Newton's iteration at `share` of the path, from a state that stands at the share `before`. At most
  /// `most` iterations; they are added to the report, whose residual is that of the state.
  End find(const LoadPath& path, double before, double share, Search search, int most, State& state,
           StepReport& report);

  /// f on the free rows goes into `right`; its norm.
  double residual(const State& state);
  /// Whether a state of that residual, which the last correction |`correction`| led to, is in equilibrium.
  bool is_reached(double share, const State& state, double now, std::optional<double> correction,
                  StepReport& report);
  /// Whether the latest state that was reached was so by round-off, above the tolerance on its load.
  [[nodiscard]] bool is_at_round_off() const { return at_round_off_; }
  /// Whether a state that was reached is a saddle of the energy. It is asked only where the latest tangent
  /// was indefinite.
  bool is_unstable(const State& state);
  /// The potential energy of all forces [J].
  [[nodiscard]] double energy(const State& state);

 private:
  struct Progress {
    double lowest;
    int idle = 0;  ///< iterations since it was
  };
  /// The change by the tangent, by the definite matrix where that gives none.
  bool solve(const State& state, StepReport& report);
  /// The change by a mean of the tangent and of the definite matrix, which has no negative direction.
  void solve_mean(const State& state, StepReport& report);
  /// Cuts the change where it goes too far; what is led still goes `way_`.
  void cut(bool leads);
  /// The first step: led nodes go their way, the body follows in its linear answer.
  void lead(const LoadPath& path, double before, double share, State& state, StepReport& report);
  /// The load that acts at a share, after `residual` of the same state [N].
  double load(double share, const State& state);
  /// Whether the latest correction goes out of the scene.
  [[nodiscard]] bool is_too_far() const;
  /// Moves by the whole change where that halves the residual; false: the state is as it was.
  bool halve(State& state, double& now);
  /// Moves by the change, whole or halved until the energy falls; false: it does not.
  bool descend(State& state, double& now);
  /// One iteration of the search on the energy; false: neither matrix gives a step along which it falls.
  bool search_energy(State& state, double& now, StepReport& report);
  /// state = from_ moved by that length of change_; the residual.
  double go(State& state, double length);

  System system_;
  TangentSolve tangent_;
  NewtonSettings newton_;
  State rest_;
  State from_;
  std::vector<double> change_;
  std::vector<double> right_;
  std::vector<double> work_;
  std::vector<double> way_;  ///< of led nodes
  std::vector<double> reactions_;
  double end_load_ = 0.0;             ///< |external forces| at the end of the step [N]
  double start_way_ = 0.0;            ///< |displacement| that the body had at most
  std::optional<double> correction_;  ///< |last correction|
  double previous_ = 0.0;             ///< residual that was judged before
  bool linear_solved_ = true;
  bool is_exact_ = false;        ///< the latest change is by a tangent that is indefinite
  bool is_in_vain_ = false;      ///< the latest tangent is indefinite and gave no change
  bool was_indefinite_ = false;  ///< the latest tangent that was looked at
  double share_ = 0.0;           ///< of the definite matrix; 0: the tangent was definite
  int pause_ = 0;                ///< iterations that do not try an exact change
  int next_pause_ = 0;           ///< the latest of them, longer each time that it was in vain
  bool at_round_off_ = false;
  double farthest_ = 0.0;
  bool flew_ = false;  ///< the latest change was cut
};

}  // namespace tissu
