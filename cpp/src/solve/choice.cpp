#include "choice.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

constexpr double kBetter = 0.9;   ///< rate, of the present arm's, below which another one is worth a change
constexpr double kHopeful = 0.8;  ///< what a prediction is multiplied by, so that a doubtful arm gets a trial
constexpr double kLeast = 4.0;    ///< solves of the present arm that a change has to save, at least
constexpr double kRoom = 1.5;     ///< of another arm's first solve, which an arm may spend in vain
constexpr double kExpected = 3.0;  ///< of its own rate, which an arm may spend at least
/// Solves within which a trial that makes a frame late has to save its price: twice over the hundred frames
/// of which the 99th percentile leaves one out.
constexpr double kSoon = 50.0;
/// Of the rate of the present arm: above it a rate may be the lower one only as far as predictions err.
constexpr double kClear = 0.5;
constexpr int kFactorTrial = 4;  ///< solves of a trial of a factor, which the first ones flatter
constexpr int kCheapTrial = 3;   ///< solves of a trial of what costs less to make than to use
constexpr int kMemory = 8;       ///< solves over which a cost is averaged, …
constexpr int kLongMemory = 32;  ///< … and the share of those with makings
constexpr double kHoping =
    0.99;  ///< by which the cost of an arm is doubted with every solve of another one: bodies slow down
constexpr double kAfterTrial = 3.0;       ///< times the patience of the arm that did not stay
constexpr double kAfterCheapTrial = 1.5;  ///< the same where the trial cost little
constexpr double kAfterFailure = 4.0;     ///< times the patience of an arm that failed
constexpr double kUnfinished = 2.0;       ///< times what it spent: the price of a solve that was left
constexpr double kMostPatience = 1e6;
constexpr double kLeastDigits = 0.2;

}  // namespace

void Choice::begin(const ForArms<Cost>& predicted, double solves, double frame) {
  *this = Choice();
  frame_ = frame;
  predict(predicted);
  const auto price = [&](Arm arm) {
    const Cost& cost = at(arm).cost;
    return cost.making + cost.once + (solves - 1.0) * cost.rate() + cost.solving;
  };
  current_ = *std::ranges::min_element(kAllArms, {}, price);
}

void Choice::predict(const ForArms<Cost>& predicted) {
  for (const Arm arm : kAllArms) {
    if (at(arm).solves == 0) at(arm).cost = predicted[number(arm)];
  }
}

void Choice::begin_solve() {
  unlimited_ = false;
  for (State& state : state_) state.left = state.failed = false;
}

double Choice::allowance() const {
  if (current_ == Arm::cholesky || unlimited_) return kNever;
  if (on_trial_) return kRoom * at(before_).cost.rate();
  double other = kNever;
  for (const Arm arm : kAllArms) {
    if (arm != current_ && is_open(arm)) other = std::min(other, at(arm).cost.first());
  }
  return std::max(kRoom * other, (is_counted(current_) ? kExpected : kRoom) * at(current_).cost.solving);
}

bool Choice::leave(double spent, bool failed) {
  State& mine = at(current_);
  mine.left = true;
  mine.failed = failed;
  if (failed) {
    wait_longer(current_, kAfterFailure);
  } else {
    count(0.0, kUnfinished * spent, true);
  }
  if (std::ranges::none_of(kAllArms, [&](Arm arm) { return is_open(arm); })) {
    unlimited_ = true;
    for (State& state : state_) state.left = state.failed;
  }
  Arm next = current_;
  for (const Arm arm : kAllArms) {
    if (is_open(arm) && (at(next).left || at(arm).cost.first() < at(next).cost.first())) next = arm;
  }
  if (on_trial_ && is_open(before_)) {
    wait_longer(current_, kAfterTrial);
    next = before_;  // what it made is kept
  }
  if (at(next).left) return false;
  if (next != current_) change(next, false);
  return true;
}

double Choice::expected(Arm arm) const {
  return at(arm).hope * (is_counted(arm) ? 1.0 : kHopeful) * at(arm).cost.rate();
}

/// Costs as they are known, without hope: a frame that is late for sure needs a gain that is.
bool Choice::fits(Arm arm, double rate) const {
  const Cost& other = at(arm).cost;
  if (other.first() <= frame_ * rate) return true;
  const bool soon = other.making + other.once <= kSoon * (rate - other.rate());
  return frame_ == kNever || (soon && other.rate() < kClear * rate);
}

bool Choice::is_cheap(Arm arm) const {
  const Cost& cost = at(arm).cost;
  return cost.making + cost.once < cost.solving;
}

void Choice::change(Arm to, bool trial) {
  before_ = current_;
  current_ = to;
  on_trial_ = trial;
  fresh_ = true;
  trial_left_ = to == Arm::stale_cholesky ? kFactorTrial : is_cheap(to) ? kCheapTrial : 1;
  ++changes_;
}

void Choice::used(const Spent& spent) {
  const bool first = fresh_;
  fresh_ = false;
  const double solving = spent.solving + (first ? 0.0 : spent.once);
  count(first ? 0.0 : spent.making, solving, first);
  if (first && spent.making > 0.0) at(current_).cost.making = spent.making;
  const double rate = at(current_).cost.rate();
  if (on_trial_) {
    if (--trial_left_ == 0) end_trial(rate);
    return;
  }
  regret(first ? solving : solving + spent.making);
  Arm best = current_;
  for (const Arm arm : kAllArms) {
    const State& other = at(arm);
    if (arm == current_ || !(expected(arm) < kBetter * rate) || !fits(arm, rate)) continue;
    if (other.regret < other.patience * std::max(other.cost.making + other.cost.once, kLeast * rate))
      continue;
    if (best == current_ || expected(arm) < expected(best)) best = arm;
  }
  if (best != current_) change(best, true);
}

void Choice::count(double making, double solving, bool first) {
  State& mine = at(current_);
  const double weight = 1.0 / std::min(kMemory, mine.solves + 1);
  mine.cost.solving += (mine.solves == 0 ? 1.0 : weight) * (solving - mine.cost.solving);
  if (!first) mine.cost.share += 1.0 / kLongMemory * ((making > 0.0 ? 1.0 : 0.0) - mine.cost.share);
  if (making > 0.0) mine.cost.making = making;
  ++mine.solves;
  mine.hope = 1.0;
  for (const Arm arm : kAllArms) {
    if (arm != current_) at(arm).hope *= kHoping;
  }
}

void Choice::end_trial(double rate) {
  on_trial_ = false;
  at(current_).regret = 0.0;
  if (rate < kBetter * at(before_).cost.rate()) {
    for (State& state : state_) state.regret = 0.0;
    wait_longer(before_, kAfterTrial);
    return;
  }
  wait_longer(current_, is_cheap(current_) ? kAfterCheapTrial : kAfterTrial);
  change(before_, false);
}

void Choice::wait_longer(Arm arm, double times) {
  at(arm).patience = std::min(times * at(arm).patience, kMostPatience);
}

void Choice::regret(double work) {
  for (const Arm arm : kAllArms) {
    if (arm != current_) at(arm).regret = std::max(0.0, at(arm).regret + work - expected(arm));
  }
}

double digits_left(double residual, double tolerance) {
  if (!(residual < 1.0)) return 1.0;
  return std::clamp(1.0 - std::log(residual) / std::log(tolerance), kLeastDigits, 1.0);
}

}  // namespace tissu
