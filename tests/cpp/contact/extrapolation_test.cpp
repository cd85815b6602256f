/// Multipliers that settle slowly are led to where they go, and no others.

#include "tissu/contact/extrapolation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace tissu {
namespace {

constexpr double kRoundOff = 1e-13;

/// Contacts that press along z with these forces [N], and rub along x with a tenth of them.
std::vector<ContactNumbers> contacts(const std::vector<double>& forces) {
  std::vector<ContactNumbers> all(forces.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].a = static_cast<double>(i);
    all[i].normal = {0.0, 0.0, 1.0};
    all[i].force = forces[i];
    all[i].drag = {0.1 * forces[i], 0.0, 0.0};
    all[i].push = {0.1 * forces[i], 0.0, forces[i]};
  }
  return all;
}

/// Forces after so many systems, of which all modes but one have settled.
std::vector<double> forces_after(int systems, double ratio) {
  const double left = std::pow(ratio, systems);
  return {2.0 + 0.7 * left, 1.0 - 0.3 * left, 0.5 + 0.1 * left};
}

/// What the next system starts from after three of them [N].
std::vector<ContactNumbers> led(double ratio, bool slides = false) {
  Extrapolation extrapolation;
  std::vector<ContactNumbers> next;
  for (int system = 1; system <= 3; ++system) {
    auto solved = contacts(forces_after(system, ratio));
    if (slides) solved[1].sliding = 1.0;
    next = solved;
    extrapolation.lead(solved, next);
    if (system < 3) {
      EXPECT_EQ(next[0].push, solved[0].push);
    }
  }
  return next;
}

TEST(Extrapolation, LeadsOneSlowModeToItsLimit) {
  for (const double ratio : {0.6, 0.8, 0.93}) {
    const auto next = led(ratio);
    const std::vector<double> limit = forces_after(1000, ratio);
    for (std::size_t i = 0; i < limit.size(); ++i) {
      EXPECT_NEAR(next[i].push[2], limit[i], kRoundOff / (1.0 - ratio));
      EXPECT_NEAR(next[i].push[0], 0.1 * limit[i], kRoundOff / (1.0 - ratio));
      EXPECT_EQ(next[i].push[1], 0.0);
    }
  }
}

TEST(Extrapolation, LeavesWhatSettlesFastOrGrows) {
  for (const double ratio : {0.3, -0.9}) {
    EXPECT_NEAR(led(ratio)[0].push[2], forces_after(3, ratio)[0], kRoundOff);
  }
}

TEST(Extrapolation, LeadsWhatHardlySettlesNoFartherThanTwentyChanges) {
  const auto next = led(0.999);
  const double change = forces_after(3, 0.999)[0] - forces_after(2, 0.999)[0];
  EXPECT_NEAR(next[0].push[2], forces_after(3, 0.999)[0] + 19.0 * change, 1e-12);
}

TEST(Extrapolation, LeavesTheFrictionOfWhatSlides) {
  const auto next = led(0.8, true);
  EXPECT_NEAR(next[1].push[2], 1.0, kRoundOff * 10.0);
  EXPECT_EQ(next[1].push[0], 0.1 * forces_after(3, 0.8)[1]);
  EXPECT_NEAR(next[0].push[0], 0.2, kRoundOff * 10.0);
}

TEST(Extrapolation, LeadsForcesAlongNormalsThatTurn) {
  Extrapolation extrapolation;
  std::vector<ContactNumbers> next;
  for (int system = 1; system <= 3; ++system) {  // without friction
    auto solved = contacts(forces_after(system, 0.8));
    for (std::size_t i = 0; i < solved.size(); ++i) {
      const double turn = 0.05 * system * static_cast<double>(i + 1);
      solved[i].normal = {std::sin(turn), 0.0, std::cos(turn)};
      solved[i].drag = {};
      for (std::size_t axis = 0; axis < 3; ++axis)
        solved[i].push[axis] = solved[i].force * solved[i].normal[axis];
    }
    next = solved;
    extrapolation.lead(solved, next);
  }
  const std::vector<double> limit = forces_after(1000, 0.8);
  for (std::size_t i = 0; i < limit.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(next[i].push[axis], limit[i] * next[i].normal[axis], kRoundOff * 10.0);
    }
  }
}

TEST(Extrapolation, LetsNothingPull) {
  Extrapolation extrapolation;
  std::vector<ContactNumbers> next;
  for (int system = 1; system <= 3; ++system) {  // to -0.4 N, and 2 N
    const double left = std::pow(0.9, system);
    const auto solved = contacts({-0.4 + 0.7 * left, 2.0 + left});
    next = solved;
    extrapolation.lead(solved, next);
  }
  EXPECT_EQ(next[0].push[2], 0.0);
  EXPECT_NEAR(next[1].push[2], 2.0, kRoundOff * 10.0);
}

TEST(Extrapolation, WaitsForOneMode) {
  Extrapolation extrapolation;
  std::vector<ContactNumbers> solved;
  std::vector<ContactNumbers> next;
  for (int system = 1; system <= 3; ++system) {  // two modes that shrink at different rates
    const double slow = std::pow(0.95, system);
    const double fast = std::pow(0.55, system);
    solved = contacts({2.0 + 3.0 * slow, 1.0 + fast});
    next = solved;
    extrapolation.lead(solved, next);
  }
  EXPECT_EQ(next[0].push, solved[0].push);
  EXPECT_EQ(next[1].push, solved[1].push);
}

TEST(Extrapolation, BeginsAgainWithOtherContactsAndWithAnotherStep) {
  for (const bool other : {true, false}) {
    Extrapolation extrapolation;
    std::vector<ContactNumbers> solved;
    std::vector<ContactNumbers> next;
    for (int system = 1; system <= 4; ++system) {
      solved = contacts(forces_after(system, 0.8));
      if (other && system > 2) solved[2].point = 1.0;
      if (!other && system == 3) extrapolation.forget();
      next = solved;
      extrapolation.lead(solved, next);
      EXPECT_EQ(next[0].push, solved[0].push) << system;
    }
  }
}

}  // namespace
}  // namespace tissu
