#pragma once

/// Which arm solves the next system. It knows costs only: no matrix, no clock.

#include <limits>

#include "arm.h"

namespace tissu {

/// What a solve took: makings, what the pattern asked for, and the rest.
struct Spent {
  double making = 0.0;
  double once = 0.0;
  double solving = 0.0;
};

/// The first arm is the one whose making and first solves cost least as predicted. From then on what the arms
/// in use cost is counted, and the rule of renting skis says when to change: what the present arm took
/// beyond what another one would have taken is added up, and the other one is tried when the sum reaches the
/// price of making it. One solve then says whether it stays; a few do of a factor, which grows old, and of
/// what is cheap to make. An arm that did not stay is tried again only after a sum three times as large, as
/// is one that was left for good, so that changes become rare whatever the matrices do, and all that is spent
/// in vain stays a fixed multiple of what the best arm takes.
///
/// Where each solve belongs to a frame, a trial must not make one late: an arm is tried only where its first
/// solve fits a frame, or where the price of making it is saved again soon by its cost as predicted or
/// counted.
class Choice {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// Begins anew. `solves`: how many are expected to share the making. `frame`: how many solves of the
  /// present arm the first one of a trial may take.
  void begin(const ForArms<Cost>& predicted, double solves, double frame = kNever);
  /// Predictions for arms that were not used yet.
  void predict(const ForArms<Cost>& predicted);
  /// A solve begins: every arm that did not fail may be used in it.
  void begin_solve();
  [[nodiscard]] Arm current() const { return current_; }
  [[nodiscard]] const Cost& cost(Arm arm) const { return at(arm).cost; }
  /// Its cost was counted; else it was predicted.
  [[nodiscard]] bool is_counted(Arm arm) const { return at(arm).solves > 0; }
  /// Work, makings not counted, that the present arm may spend in this solve: then another one solves it for
  /// less.
  [[nodiscard]] double allowance() const;
  /// The present arm spent as much without an answer; `failed`: it has none to give. Another one goes on.
  /// When all were left, those that did not fail are taken up again without a limit; false when all failed.
  bool leave(double spent, bool failed);
  /// The present arm ended a solve. Afterwards `current` may be another one.
  void used(const Spent& spent);
  /// How often the present arm changed.
  [[nodiscard]] int changes() const { return changes_; }
  /// The arm that solved before the present one and is kept until that has proven better; the present one
  /// where there is none.
  [[nodiscard]] Arm spare() const { return on_trial_ ? before_ : current_; }

 private:
  struct State {
    Cost cost;
    double regret = 0.0;    ///< what it would have saved
    double patience = 1.0;  ///< regret at which it is tried, in makings
    double hope = 1.0;      ///< what its cost is multiplied by: it may be cheaper than when it was used
    int solves = 0;         ///< counted in its cost
    bool left = false;      ///< in this solve, …
    bool failed = false;    ///< … without hope
  };
  State& at(Arm arm) { return state_[number(arm)]; }
  [[nodiscard]] const State& at(Arm arm) const { return state_[number(arm)]; }
  [[nodiscard]] bool is_open(Arm arm) const { return !at(arm).left && at(arm).cost.first() < kNever; }
  [[nodiscard]] double expected(Arm arm) const;
  /// A trial of it makes no frame late, or saves soon what it makes late.
  [[nodiscard]] bool fits(Arm arm, double rate) const;
  /// Making it costs less than a solve.
  [[nodiscard]] bool is_cheap(Arm arm) const;
  void change(Arm to, bool trial);
  /// `first`: what was made is the price of the change, not a share of what solves cost.
  void count(double making, double solving, bool first);
  void end_trial(double rate);
  void regret(double work);
  void wait_longer(Arm arm, double times);

  ForArms<State> state_{};
  Arm current_ = Arm::block_jacobi;
  Arm before_ = Arm::block_jacobi;
  double frame_ = kNever;
  bool on_trial_ = false;
  int trial_left_ = 0;      ///< solves
  bool unlimited_ = false;  ///< in this solve
  bool fresh_ = true;       ///< the present arm has ended no solve since it became that
  int changes_ = 0;
};

/// What an attempt that was abandoned has not gained of the digits of a solve, so that the cost of the rest
/// says what a whole solve costs; at least a fifth.
double digits_left(double residual, double tolerance);

}  // namespace tissu
