#include "tissu/haptic/loop.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tissu/base/error.h"

namespace tissu::haptic {
namespace {

/// Counts ticks; sleeps through ten periods once.
class Counting final : public Ticked {
 public:
  void tick(std::int64_t number) noexcept override {
    if (number <= last) ++backwards;
    if (number - last - 1 > most_missed) most_missed = number - last - 1;
    last = number;
    if (++ticks == 20) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  void end() noexcept override { ++ends; }

  std::atomic<int> ticks{0};
  int backwards = 0, ends = 0;
  std::int64_t last = -1, most_missed = 0;
};

/// A plain thread: what a test may ask of a machine that others use.
LoopOptions plain() {
  return {.period = 1e-3, .priority = 0, .lock_memory = false, .pin = false, .spin = 0.0};
}

void wait_for(const Counting& counting, int ticks) {
  while (counting.ticks < ticks) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(HapticLoop, ThreadTicksSkipsWhatItMissedAndEndsOnce) {
  Counting counting;
  Loop loop(counting, plain());
  loop.start();
  wait_for(counting, 40);
  loop.stop();
  const LoopReport report = loop.report();
  EXPECT_FALSE(report.running);
  EXPECT_EQ(report.ticks, counting.ticks.load());
  EXPECT_EQ(counting.backwards, 0);
  EXPECT_EQ(counting.ends, 1);
  // Each period has a tick or is missed; the tick of 10 ms misses 9 at least, which are more than five.
  EXPECT_EQ(report.ticks + report.missed, counting.last + 1);
  EXPECT_GE(counting.most_missed, 9);
  EXPECT_GE(report.held, 1);
  EXPECT_GE(report.lateness.max, 9e-3);
  EXPECT_GE(report.compute.max, 10e-3);
  EXPECT_EQ(report.lateness.count, report.ticks);
}

TEST(HapticLoop, ThreadStartsAgain) {
  Counting counting;
  Loop loop(counting, plain());
  for (int k = 0; k < 3; ++k) {
    loop.start();
    loop.start();  // once
    wait_for(counting, 5 * (k + 1));
    loop.stop();
    loop.stop();
  }
  EXPECT_EQ(counting.ends, 3);
}

TEST(HapticLoop, ThreadSaysWhatTheMachineGrantedAndTheRemedyWhereNot) {
  Counting counting;
  LoopOptions options;
  options.lock_memory = false;  // it would stay locked for the tests that follow
  Loop loop(counting, options);
  loop.start();
  loop.stop();
  const LoopReport report = loop.report();
  ASSERT_EQ(report.grants.size(), 2U);
  EXPECT_EQ(report.grants[0].what, "SCHED_FIFO 60");
  EXPECT_EQ(report.grants[1].what, "core " + std::to_string(last_core()));
  for (const Grant& grant : report.grants) {
    EXPECT_EQ(grant.granted, grant.error == 0);
    EXPECT_EQ(grant.granted, grant.remedy.empty());
  }
}

TEST(HapticLoop, ThreadsOfSeveralLoopsArePinnedToDifferentCores) {
  const int last = last_core();
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  if (CPU_COUNT(&allowed) < 2) GTEST_SKIP() << "one core";
  Counting one, other, third;
  LoopOptions options = plain();
  options.pin = true;
  Loop first(one, options), second(other, options), again(third, options);
  first.start();
  second.start();
  const std::string taken = "core " + std::to_string(last);
  EXPECT_EQ(first.report().grants.back().what, taken);
  EXPECT_NE(second.report().grants.back().what, taken);
  first.stop();
  again.start();  // on the core that the first has left
  EXPECT_EQ(again.report().grants.back().what, taken);
  again.stop();
  second.stop();
}

TEST(HapticLoop, RefusesAPeriodThatIsTooLongOrTooShort) {
  Counting counting;
  for (const double period : {0.0, 9e-5, 3.4e-3, 1.0}) {
    LoopOptions options = plain();
    options.period = period;
    EXPECT_THROW(Loop(counting, options), ParameterError) << period;
  }
}

}  // namespace
}  // namespace tissu::haptic
