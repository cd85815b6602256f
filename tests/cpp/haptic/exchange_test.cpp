#include "tissu/haptic/exchange.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "tissu/haptic/record_ring.h"

namespace tissu::haptic {
namespace {

/// A value that shows whether it was read in part.
struct Value {
  std::array<std::uint64_t, 40> numbers{};

  [[nodiscard]] bool whole() const {
    for (const std::uint64_t number : numbers) {
      if (number != numbers[0]) return false;
    }
    return true;
  }
};

#if defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kPublications = 1'000'000;
#else
constexpr std::uint64_t kPublications = 10'000'000;
#endif

TEST(HapticExchange, GivesTheNewestValueOnce) {
  Exchange<int> exchange(3);
  EXPECT_FALSE(exchange.take());
  EXPECT_EQ(exchange.value(), 3);
  for (int k = 0; k < 5; ++k) exchange.publish(10 + k);
  EXPECT_TRUE(exchange.take());
  EXPECT_EQ(exchange.value(), 14);
  EXPECT_FALSE(exchange.take());
  EXPECT_EQ(exchange.value(), 14);
}

TEST(HapticExchange, ThreadsNeverSeeAPartOfAValueNorAnOlderOne) {
  Exchange<Value> exchange;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t k = 1; k <= kPublications; ++k) {
      exchange.to_write().numbers.fill(k);
      exchange.publish();
    }
    done = true;
  });
  std::uint64_t last = 0;
  std::uint64_t faults = 0;
  std::uint64_t taken = 0;
  for (bool end = false; !end;) {
    end = done;  // then once more
    if (!exchange.take()) continue;
    const Value& value = exchange.value();
    if (!value.whole() || value.numbers[0] <= last) ++faults;
    last = value.numbers[0];
    ++taken;
  }
  writer.join();
  EXPECT_EQ(faults, 0U);
  EXPECT_EQ(last, kPublications);
  EXPECT_GT(taken, 0U);
}

TEST(HapticRecordRing, ThreadsLoseNothingThatTheyDoNotCount) {
  RecordRing<std::uint64_t> ring(64);
  std::thread writer([&] {
    for (std::uint64_t k = 1; k <= 200'000; ++k) ring.put(k);
    while (!ring.put(0)) std::this_thread::yield();  // the end
  });
  std::uint64_t last = 0;
  std::uint64_t taken = 0;
  for (bool end = false; !end;) {
    for (const std::uint64_t value : ring.take()) {
      if (value == 0) {
        end = true;
        break;
      }
      EXPECT_GT(value, last);
      last = value;
      ++taken;
    }
  }
  writer.join();
  // Attempts to write the end where there was no room are counted too.
  EXPECT_GE(static_cast<std::int64_t>(taken) + ring.lost(), 200'000);
}

}  // namespace
}  // namespace tissu::haptic
