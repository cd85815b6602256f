#include "tissu/base/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#if defined(__linux__)
#include <sched.h>
#endif

namespace tissu {
namespace {

constexpr int kMostThreads = 256;
constexpr std::int32_t kShut = 0x7FFFFFFF;
constexpr int kSpins = 4000;  ///< looks for new work before a thread sleeps: some tens of microseconds

void pause_briefly() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Threads that wait for loops. Each has its share of a loop, [first, end) in the loop's order, so that the
/// same core meets the same data again; a thread that is done takes from the shares of the others. So a
/// thread that the system keeps waiting, on a busy machine, holds up no more than the one call that it is in.
///
/// A share is one number: the loop's turn and the next index, so that a thread that comes late cannot take
/// from a loop that is over.
class Pool {
 public:
  /// Made once and never destroyed: its threads may outlive what a process tears down at its end. In a fork
  /// its threads are missing, and the caller does all.
  static Pool& only() {
    static Pool* const pool = new Pool;
    return *pool;
  }

  void share(int threads, std::int32_t count, void (*call)(void*, std::int32_t), void* called) {
    const std::unique_lock lock(busy_, std::try_to_lock);
    if (!lock.owns_lock()) {  // another simulation has the threads
      for (std::int32_t i = 0; i < count; ++i) call(called, i);
      return;
    }
    threads = std::min({threads, kMostThreads, static_cast<int>(count)});
    grow(threads);
    const std::uint32_t turn = ++turn_;
    // Shut before anything changes: a thread that is late finds nothing to take.
    for (int t = 0; t < made_; ++t) {
      shares_[static_cast<std::size_t>(t)].next.store(ticket(turn, kShut), std::memory_order_relaxed);
    }
    call_.store(call, std::memory_order_relaxed);
    called_.store(called, std::memory_order_relaxed);
    threads_.store(threads, std::memory_order_relaxed);
    done_.store(0, std::memory_order_relaxed);
    const std::int32_t each = count / threads + (count % threads == 0 ? 0 : 1);
    for (int t = 0; t < threads; ++t) {
      Share& own = shares_[static_cast<std::size_t>(t)];
      own.end.store(std::min(count, (t + 1) * each), std::memory_order_release);
      own.next.store(ticket(turn, std::min(count, t * each)), std::memory_order_release);
    }
    for (int t = 1; t < threads; ++t) {
      std::atomic<std::uint32_t>& called_for = shares_[static_cast<std::size_t>(t)].turn;
      called_for.store(turn, std::memory_order_release);
      called_for.notify_one();
    }
    work(0, turn);
    for (int spins = 0; done_.load(std::memory_order_acquire) < count; ++spins) {
      if (spins < kSpins) {
        pause_briefly();
      } else {
        std::this_thread::yield();
      }
    }
  }

 private:
  struct alignas(64) Share {
    std::atomic<std::uint64_t> next{0};  ///< turn and index of the next call
    std::atomic<std::int32_t> end{0};
    std::atomic<std::uint32_t> turn{0};  ///< the last one that its thread is called for
  };

  static std::uint64_t ticket(std::uint32_t turn, std::int32_t index) {
    return (static_cast<std::uint64_t>(turn) << 32) | static_cast<std::uint32_t>(index);
  }

  void grow(int threads) {
    for (; made_ < threads; ++made_) {
      std::thread([this, me = made_] { wait(me); }).detach();
    }
  }

  /// Of thread `me`, for ever.
  [[noreturn]] void wait(int me) {
    const std::atomic<std::uint32_t>& called_for = shares_[static_cast<std::size_t>(me)].turn;
    std::uint32_t seen = 0;
    while (true) {
      std::uint32_t turn = called_for.load(std::memory_order_acquire);
      for (int spins = 0; turn == seen && spins < kSpins; ++spins) {
        pause_briefly();
        turn = called_for.load(std::memory_order_acquire);
      }
      if (turn == seen) {
        called_for.wait(seen, std::memory_order_acquire);
        continue;
      }
      seen = turn;
      work(me, turn);
    }
  }

  /// Calls of the own share, then of those of the others, until none is left.
  void work(int me, std::uint32_t turn) {
    const int threads = threads_.load(std::memory_order_relaxed);
    if (me >= threads) return;
    for (int k = 0; k < threads; ++k) {
      Share& from = shares_[static_cast<std::size_t>((me + k) % threads)];
      std::uint64_t next = from.next.load(std::memory_order_acquire);
      while (static_cast<std::uint32_t>(next >> 32) == turn) {
        const auto index = static_cast<std::int32_t>(next & 0xFFFFFFFFU);
        if (index >= from.end.load(std::memory_order_acquire)) break;
        // What the call is, is read before it is taken: taken of this turn, it was of this turn.
        auto* const call = call_.load(std::memory_order_relaxed);
        void* const called = called_.load(std::memory_order_relaxed);
        if (!from.next.compare_exchange_weak(next, next + 1, std::memory_order_acq_rel,
                                             std::memory_order_acquire)) {
          continue;
        }
        call(called, index);
        done_.fetch_add(1, std::memory_order_release);
        next = from.next.load(std::memory_order_acquire);
      }
    }
  }

  std::mutex busy_;
  int made_ = 1;            ///< threads so far, with the one that calls
  std::uint32_t turn_ = 0;  ///< how many loops there were; of the one that holds busy_
  std::atomic<void (*)(void*, std::int32_t)> call_{nullptr};
  std::atomic<void*> called_{nullptr};
  std::atomic<int> threads_{0};
  alignas(64) std::atomic<std::int32_t> done_{0};
  std::array<Share, kMostThreads> shares_;
};

}  // namespace

void Threads::share(int threads, std::int32_t count, void (*call)(void*, std::int32_t), void* called) {
  Pool::only().share(threads, count, call, called);
}

int available_threads() {
#if defined(__linux__)
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace tissu
