#include "tissu/haptic/timing.h"

#include <gtest/gtest.h>

#include <limits>

namespace tissu::haptic {
namespace {

TEST(HapticTiming, PercentilesAreAtMostOneSixteenthTooLarge) {
  Timing timing;
  for (std::int64_t k = 1; k <= 100'000; ++k) timing.add(10 * k);  // 10 ns to 1 ms, each as often
  const TimingReport found = timing.report();
  EXPECT_EQ(found.count, 100'000);
  const double shares[] = {0.5, 0.99, 0.999};
  const double values[] = {found.p50, found.p99, found.p999};
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(values[k], 1e-3 * shares[k]);
    EXPECT_LE(values[k], 1e-3 * shares[k] * (1.0 + 1.0 / 16.0));
  }
  EXPECT_DOUBLE_EQ(found.max, 1e-3);
}

TEST(HapticTiming, TakesEveryDuration) {
  Timing timing;
  timing.add(-5);
  timing.add(0);
  timing.add(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(timing.report().count, 3);
  EXPECT_DOUBLE_EQ(timing.report().p50, 0.0);
  EXPECT_DOUBLE_EQ(timing.report().max, 1e-9 * static_cast<double>(std::numeric_limits<std::int64_t>::max()));
  timing.clear();
  EXPECT_EQ(timing.report().count, 0);
  EXPECT_DOUBLE_EQ(timing.report().p99, 0.0);
}

TEST(HapticTiming, SmallDurationsAreExact) {
  for (std::int64_t k = 0; k < 32; ++k) {
    Timing timing;
    timing.add(k);
    EXPECT_DOUBLE_EQ(timing.report().p50, 1e-9 * static_cast<double>(k));
  }
}

}  // namespace
}  // namespace tissu::haptic
