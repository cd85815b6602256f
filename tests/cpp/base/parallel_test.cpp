#include "tissu/base/parallel.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

/// Every call of a loop happens once, before the loop ends, on any thread.
namespace tissu {
namespace {

/// A loop of `count` calls; true when each happened once.
bool once_each(int threads, std::int32_t count) {
  std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
  Threads(threads).for_each(count, [&](std::int32_t i) { ++calls[static_cast<std::size_t>(i)]; });
  return std::ranges::all_of(calls, [](const auto& c) { return c == 1; });
}

TEST(Parallel, CallsEachOnce) {
  for (const int threads : {1, 2, 3, 4, 7, 20}) {
    for (const std::int32_t count : {0, 1, 2, 3, 5, 8, 64, 1001}) {
      EXPECT_TRUE(once_each(threads, count)) << threads << " threads, " << count << " calls";
    }
  }
}

// Loops follow each other at once, so that threads are late for some and meet the next.
TEST(Parallel, LoopsInARowDoNotMix) {
  std::vector<std::int64_t> sums(5);
  const Threads threads(3);
  for (int turn = 0; turn < 20000; ++turn) {
    const auto count = static_cast<std::int32_t>(2 + turn % 4);
    std::ranges::fill(sums, 0);
    threads.for_each(count, [&](std::int32_t i) { sums[static_cast<std::size_t>(i)] = turn + i; });
    for (std::int32_t i = 0; i < 5; ++i) {
      ASSERT_EQ(sums[static_cast<std::size_t>(i)], i < count ? turn + i : 0) << turn;
    }
  }
}

TEST(Parallel, ThreadsComeBackFromSleep) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(once_each(4, 100));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

// Simulations on threads of a program's own share the same few: each loop is whole when it returns.
TEST(Parallel, SeveralCallersAtOnce) {
  std::atomic<int> whole{0};
  {
    std::vector<std::jthread> callers;
    for (int t = 0; t < 4; ++t) {
      callers.emplace_back([&] {
        for (int i = 0; i < 500; ++i) whole += once_each(2 + i % 3, 50) ? 1 : 0;
      });
    }
  }
  EXPECT_EQ(whole, 4 * 500);
}

TEST(Parallel, TheSumIsTheSameForAnyNumberOfThreads) {
  std::vector<double> partial;
  const auto sum = [&](int threads) {
    return Threads(threads).sum(100'000, partial, [](std::int32_t begin, std::int32_t end) {
      double total = 0.0;
      for (std::int32_t i = begin; i < end; ++i) total += 1.0 / (1.0 + i);
      return total;
    });
  };
  for (const int threads : {2, 3, 8}) EXPECT_EQ(sum(1), sum(threads));
}

// A fork has the memory of the threads but not the threads (multiprocessing in Python).
TEST(Parallel, AForkRunsItsLoops) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the thread sanitizer does not follow a fork of several threads";
#endif
  ASSERT_TRUE(once_each(3, 100));
  const pid_t child = fork();
  if (child == 0) _exit(once_each(3, 100) ? 0 : 1);
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace tissu
