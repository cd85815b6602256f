#include "tissu/haptic/loop.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <mutex>
#include <system_error>

#include "tissu/base/error.h"
#include "tissu/base/number_text.h"

namespace tissu::haptic {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kInARow = 5;  // ticks that may be missed before the state is held

std::int64_t now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

Grant ask(std::string what, int error, std::string remedy) {
  return {std::move(what), error == 0, error, error == 0 ? std::string() : std::move(remedy)};
}

Grant ask_priority(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  return ask("SCHED_FIFO " + std::to_string(priority),
             pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted),
             "raise RLIMIT_RTPRIO: a line '@realtime - rtprio " + std::to_string(priority) +
                 "' in /etc/security/limits.conf, the user in that group, a new login");
}

Grant ask_memory() {
  // Pages are locked as they are first touched: the whole of a large process is not brought into memory for
  // it.
  const int error = mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
  return ask("locked memory", error,
             "raise RLIMIT_MEMLOCK: a line '@realtime - memlock unlimited' in /etc/security/limits.conf, the "
             "user in "
             "that group, a new login");
}

/// How many loops of this process are pinned to each processor.
struct Pins {
  std::mutex mutex;
  std::array<int, CPU_SETSIZE> loops{};
};
Pins& pins() {
  static Pins made;
  return made;
}

/// Takes the processor with the fewest loops, of these the last; -1: none is known.
int take_core() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return -1;
  Pins& all = pins();
  const std::scoped_lock lock(all.mutex);
  std::size_t taken = all.loops.size();
  for (std::size_t core = 0; core < all.loops.size(); ++core) {
    if (!CPU_ISSET(core, &allowed)) continue;
    if (taken == all.loops.size() || all.loops[core] <= all.loops[taken]) taken = core;
  }
  if (taken == all.loops.size()) return -1;
  ++all.loops[taken];
  return static_cast<int>(taken);
}

void give_back(int core) {
  if (core < 0) return;
  Pins& all = pins();
  const std::scoped_lock lock(all.mutex);
  --all.loops[static_cast<std::size_t>(core)];
}

Grant ask_core(int core) {
  int error = EINVAL;
  if (core >= 0) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(static_cast<std::size_t>(core), &only);
    error = pthread_setaffinity_np(pthread_self(), sizeof only, &only);
  }
  return ask("core " + std::to_string(core), error,
             "let the process run on a fixed set of processors (taskset)");
}

/// Touches the stack that ticks will use, so that none of its pages is missing later.
void touch_stack() {
  std::array<volatile char, 64 * 1024> stack;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t k = 0; k < stack.size(); k += 1024) stack[k] = 0;
}

}  // namespace

int last_core() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return -1;
  int last = -1;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &allowed)) last = core;
  }
  return last;
}

Loop::Loop(Ticked& ticked, const LoopOptions& options)
    : ticked_(ticked), options_(options), period_(std::llround(options.period * 1e9)) {
  if (!(options.period >= 1e-4 && options.period <= 1.0 / 299.0)) {
    throw ParameterError("found a period of " + number_text(1e3 * options.period) +
                         " ms; 0.1 to 3.33 ms are accepted, which are 10 kHz to 300 Hz.");
  }
}

Loop::~Loop() { stop(); }

void Loop::start() {
  if (thread_.joinable()) return;
  ticks_ = missed_ = held_ = 0;
  lateness_.clear();
  compute_.clear();
  wanted_ = true;
  ready_ = false;
  try {
    thread_ = std::thread([this] {
      prepare();
      ready_.store(true, std::memory_order_release);
      ready_.notify_all();
      run();
      give_back(core_);
      core_ = -1;
    });
  } catch (const std::system_error& error) {
    throw Error(std::string("the machine gives no thread for the haptic loop (") + error.what() +
                "); end other programs, or run it stepped.");
  }
  ready_.wait(false, std::memory_order_acquire);
}

void Loop::stop() {
  wanted_ = false;
  if (thread_.joinable()) thread_.join();
}

void Loop::prepare() {
  grants_.clear();
  if (options_.priority > 0) grants_.push_back(ask_priority(options_.priority));
  if (options_.lock_memory) grants_.push_back(ask_memory());
  if (options_.pin) {
    core_ = take_core();
    grants_.push_back(ask_core(core_));
  }
  touch_stack();
}

std::int64_t Loop::wait_until(std::int64_t deadline) const noexcept {
  const std::int64_t wake = deadline - std::llround(options_.spin * 1e9);
  const timespec until{.tv_sec = wake / kSecond, .tv_nsec = wake % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  std::int64_t time = now();
  while (time < deadline) time = now();
  return time;
}

std::int64_t Loop::missed_by(std::int64_t late) noexcept {
  const std::int64_t periods = late / period_;
  if (periods > 0) missed_.fetch_add(periods, std::memory_order_relaxed);
  if (periods > kInARow) held_.fetch_add(1, std::memory_order_relaxed);
  return periods;
}

void Loop::run() noexcept {
  const std::int64_t start = now() + period_;
  for (std::int64_t number = 0; wanted_.load(std::memory_order_relaxed); ++number) {
    const std::int64_t due = start + number * period_;
    const std::int64_t began = wait_until(due);
    lateness_.add(began - due);
    // Ticks that are due in the past are not made up for: the device has held the torque meanwhile.
    number += missed_by(began - due);
    ticked_.tick(number);
    compute_.add(now() - began);
    ticks_.fetch_add(1, std::memory_order_relaxed);
  }
  ticked_.end();
}

LoopReport Loop::report() const {
  const bool ready = ready_.load(std::memory_order_acquire);
  return {ready && wanted_.load(),
          ticks_.load(std::memory_order_relaxed),
          missed_.load(std::memory_order_relaxed),
          held_.load(std::memory_order_relaxed),
          lateness_.report(),
          compute_.report(),
          ready ? grants_ : std::vector<Grant>()};
}

}  // namespace tissu::haptic
