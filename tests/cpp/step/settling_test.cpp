/// When the systems of a step with contact are given up.

#include "step/settling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace tissu {
namespace {

using Left = Settling::Left;

/// The first of 40 systems after which a step is lost; 0: none.
int lost_after(const std::function<Left(int)>& system) {
  Settling settling;
  for (int i = 1; i <= 40; ++i) {
    if (settling.is_lost(system(i))) return i;
  }
  return 0;
}

TEST(SettlingTest, ACycleThatHoldsRowsBackIsLostOnceItWasSeenTwice) {
  for (int period = 1; period <= 4; ++period) {
    const auto cycle = [&](int i) {
      const int k = i % period;
      return Left{k == 0 ? 12 : 0, static_cast<std::size_t>(100 + k), 1.0, 0.1 * k, 0.0};
    };
    EXPECT_EQ(lost_after(cycle), 8) << period;
  }
}

TEST(SettlingTest, ACycleThatBeginsLateIsLostThen) {
  const auto late = [](int i) {
    return i < 10 ? Left{0, 100, 1.0 / i, 0.0, 0.0} : Left{i % 3 == 0 ? 7 : 0, 100, 1.0, 0.5, 0.1 * (i % 3)};
  };
  EXPECT_EQ(lost_after(late), 15);
}

TEST(SettlingTest, RowsThatAreHeldInEachSystemAreLost) {
  EXPECT_EQ(lost_after([](int i) { return Left{80 + i % 3, 100, 1.0 + 0.1 * i, 2.0 + i, 0.6}; }), 8);
}

TEST(SettlingTest, FewerAndFewerHeldRowsAreProgress) {
  EXPECT_EQ(lost_after([](int i) { return Left{100 - i, 100, 1.0 / i, 1.0, 0.6}; }), 0);
}

TEST(SettlingTest, SlowOrUnevenProgressIsNotLost) {
  EXPECT_EQ(lost_after([](int i) { return Left{0, 100, std::pow(0.98, i), 0.0, 0.0}; }), 0);
  EXPECT_EQ(lost_after([](int i) { return Left{0, 100, i % 2 == 0 ? 1.0 : 0.05, 2.0 / i, 1e-5}; }), 0);
  // What merely alternates may be good enough at its end.
  EXPECT_EQ(lost_after([](int i) { return Left{0, 100, i % 2 == 0 ? 0.5 : 0.09, 0.02, 1e-5}; }), 0);
}

}  // namespace
}  // namespace tissu
