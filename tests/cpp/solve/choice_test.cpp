#include "solve/choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Which way is chosen, from costs alone: what is spent stays near what the best way would have taken.
namespace tissu {
namespace {

ForArms<Cost> like(double making, double solving) {
  ForArms<Cost> costs;
  costs.fill({making, 0.0, solving, 0.0});
  return costs;
}

/// Solves `count` systems whose true costs are `real`; the whole work, cut solves counted.
double run(Choice& choice, const ForArms<Cost>& real, int count) {
  double sum = 0.0;
  ForArms<bool> made{};
  for (int i = 0; i < count; ++i) {
    choice.begin_solve();
    while (true) {
      const Arm arm = choice.current();
      const Cost& cost = real[number(arm)];
      const double making = made[number(arm)] ? 0.0 : cost.making;
      made[number(arm)] = true;
      const double allowed = choice.allowance();
      sum += making + std::min(cost.solving, allowed);
      if (cost.solving <= allowed) {
        choice.used({making, 0.0, cost.solving});
        break;
      }
      choice.leave(allowed, false);
    }
    for (const Arm arm : kAllArms) {
      made[number(arm)] = made[number(arm)] && (arm == choice.current() || arm == choice.spare());
    }
  }
  return sum;
}

TEST(Choice, BeginsWithWhatCostsLeastOverTheSolvesExpected) {
  ForArms<Cost> costs = like(1.0, 100.0);
  costs[number(Arm::multigrid)] = {30.0, 0.0, 4.0, 0.0};
  costs[number(Arm::block_jacobi)] = {0.0, 0.0, 10.0, 0.0};
  Choice choice;
  choice.begin(costs, 2.0);  // 20 against 38
  EXPECT_EQ(choice.current(), Arm::block_jacobi);
  choice.begin(costs, 20.0);  // 200 against 110
  EXPECT_EQ(choice.current(), Arm::multigrid);
}

TEST(Choice, FindsTheBestWayWhereThePredictionErred) {
  for (const Arm best : kAllArms) {
    ForArms<Cost> predicted = like(3.0, 10.0);
    predicted[number(best)].solving = 11.0;  // all alike, the best one a little worse
    ForArms<Cost> real = like(3.0, 10.0);
    real[number(best)].solving = 2.0;
    Choice choice;
    choice.begin(predicted, 10.0);
    run(choice, real, 300);
    EXPECT_EQ(choice.current(), best) << name_of(best);
  }
}

/// The rule of who rents skis costs a fixed multiple beyond the best way, which wears off.
TEST(Choice, WhatItSpendsNearsWhatTheBestWayTakes) {
  ForArms<Cost> real = like(20.0, 10.0);
  real[number(Arm::incomplete_cholesky)].solving = 6.0;
  real[number(Arm::stale_cholesky)] = {200.0, 0.0, 3.0, 0.0};
  ForArms<Cost> predicted = real;
  predicted[number(Arm::stale_cholesky)].solving = 7.0;
  predicted[number(Arm::multigrid)].solving = 1.0;
  Choice choice;
  choice.begin(predicted, 8.0);
  const double best = 200.0 + 3.0 * 2000;
  EXPECT_LT(run(choice, real, 2000), 1.25 * best);
}

TEST(Choice, AWayThatTakesForEverIsLeftWithinASolve) {
  ForArms<Cost> predicted = like(5.0, 10.0);
  predicted[number(Arm::multigrid)].solving = 1.0;
  ForArms<Cost> real = like(5.0, 10.0);
  real[number(Arm::multigrid)].solving = 1e9;
  Choice choice;
  choice.begin(predicted, 8.0);
  ASSERT_EQ(choice.current(), Arm::multigrid);
  // its making, what it may spend (one and a half of another's making and solve), and the other one
  EXPECT_LE(run(choice, real, 1), 5.0 + 1.5 * 15.0 + 15.0);
  EXPECT_NE(choice.current(), Arm::multigrid);
}

TEST(Choice, EqualWaysDoNotChangePlaces) {
  const ForArms<Cost> costs = like(3.0, 10.0);
  Choice choice;
  choice.begin(costs, 8.0);
  run(choice, costs, 20);
  const int early = choice.changes();
  run(choice, costs, 1000);
  // Each of the other four is tried, to and fro, after sums that grow by a half from four solves on, since
  // they are cheap to make: at most log1.5(1000 / 4) times.
  EXPECT_LE(choice.changes() - early, 4 * 2 * 14);
}

/// Work of the costliest of `count` solves after the first.
double worst(const ForArms<Cost>& predicted, const ForArms<Cost>& real, int count, double frame) {
  Choice choice;
  choice.begin(predicted, 8.0, frame);
  run(choice, real, 1);
  double most = 0.0;
  ForArms<bool> made{};
  made[number(choice.current())] = true;
  for (int i = 0; i < count; ++i) {
    choice.begin_solve();
    const Arm arm = choice.current();
    const Cost& cost = real[number(arm)];
    const double making = made[number(arm)] ? 0.0 : cost.making;
    made[number(arm)] = true;
    most = std::max(most, making + cost.solving);
    choice.used({making, 0.0, cost.solving});
  }
  return most;
}

TEST(Choice, ATrialMakesNoFrameLate) {
  ForArms<Cost> costs = like(5.0, 10.0);
  costs[number(Arm::stale_cholesky)] = {400.0, 0.0, 9.5, 0.0};  // 9.5 and hope: worth a trial
  EXPECT_DOUBLE_EQ(worst(costs, costs, 2000, HUGE_VAL), 409.5);
  EXPECT_LE(worst(costs, costs, 2000, 3.0), 30.0);
}

TEST(Choice, AFrameIsLateOnceForAGainThatIsClear) {
  ForArms<Cost> costs = like(5.0, 10.0);
  costs[number(Arm::stale_cholesky)] = {400.0, 0.0, 1.0, 0.0};  // saved again in 45 solves
  EXPECT_DOUBLE_EQ(worst(costs, costs, 200, 3.0), 401.0);
  costs[number(Arm::stale_cholesky)] = {500.0, 0.0, 1.0, 0.0};  // … in 56
  EXPECT_LE(worst(costs, costs, 2000, 3.0), 30.0);
}

TEST(Choice, AFailureHandsOnAndComesBackLater) {
  Choice choice;
  choice.begin(like(3.0, 10.0), 8.0);
  choice.begin_solve();
  for (std::size_t i = 0; i + 1 < kArms; ++i) {
    const Arm before = choice.current();
    ASSERT_TRUE(choice.leave(1.0, true));
    EXPECT_NE(choice.current(), before);
  }
  EXPECT_FALSE(choice.leave(1.0, true));  // all failed
  choice.begin_solve();
  EXPECT_TRUE(choice.leave(1.0, true));  // another solve, another try
}

/// A way whose making is infinite, as a factor that does not fit, is not even the last resort.
TEST(Choice, TheRestOfASolveCountsAsTheShareOfItsDigits) {
  EXPECT_DOUBLE_EQ(digits_left(1.0, 1e-6), 1.0);
  EXPECT_DOUBLE_EQ(digits_left(7.0, 1e-6), 1.0);  // it gained nothing
  EXPECT_NEAR(digits_left(1e-3, 1e-6), 0.5, 1e-12);
  EXPECT_NEAR(digits_left(1e-2, 1e-8), 0.75, 1e-12);
  EXPECT_DOUBLE_EQ(digits_left(1.1e-6, 1e-6), 0.2);  // a tenth of a digit says nothing of a whole solve
}

TEST(Choice, WhatDoesNotFitIsNeverTaken) {
  ForArms<Cost> costs = like(3.0, 10.0);
  costs[number(Arm::cholesky)].solving = costs[number(Arm::stale_cholesky)].solving = HUGE_VAL;
  Choice choice;
  choice.begin(costs, 8.0);
  choice.begin_solve();
  EXPECT_TRUE(choice.leave(1.0, true));
  EXPECT_TRUE(choice.leave(1.0, true));
  EXPECT_FALSE(choice.leave(1.0, true));
  run(choice, costs, 500);
  EXPECT_NE(choice.current(), Arm::cholesky);
  EXPECT_NE(choice.current(), Arm::stale_cholesky);
}

}  // namespace
}  // namespace tissu
