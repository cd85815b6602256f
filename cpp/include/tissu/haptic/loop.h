#pragma once

/// A thread that does something at a fixed rate, and says how well the machine let it.

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "tissu/haptic/timing.h"

namespace tissu::haptic {

/// What is done at each tick. Called by the thread of the loop alone: no lock, no heap, no exception.
class Ticked {
 public:
  Ticked() = default;
  Ticked(const Ticked&) = delete;
  Ticked& operator=(const Ticked&) = delete;
  Ticked(Ticked&&) = delete;
  Ticked& operator=(Ticked&&) = delete;
  virtual ~Ticked() = default;

  /// `number` counts periods from the start, those that were missed too.
  virtual void tick(std::int64_t number) noexcept = 0;
  /// The loop has ended: what is last sent to the device.
  virtual void end() noexcept = 0;
};

struct LoopOptions {
  double period = 1e-3;     ///< [s]
  int priority = 60;        ///< of SCHED_FIFO; 0: not asked for
  bool lock_memory = true;  ///< whether pages are to stay in memory
  bool pin = true;  ///< whether the thread is to stay on one core: the last one with the fewest loops of this
                    ///< process
  double spin = 0.0;  ///< the last part of each wait that is spent awake [s]
};

/// Something that was asked of the machine. A refusal is not an error.
struct Grant {
  std::string what;  ///< "SCHED_FIFO 60"
  bool granted = false;
  int error = 0;       ///< errno where it was refused
  std::string remedy;  ///< what to do about it; empty where it was granted
};

/// How the loop has run.
struct LoopReport {
  bool running = false;
  std::int64_t ticks = 0;
  std::int64_t missed = 0;  ///< periods without a tick
  std::int64_t held = 0;    ///< times that more than five in a row were missed
  TimingReport lateness;    ///< from when a tick was due to when it began
  TimingReport compute;     ///< of a tick
  std::vector<Grant> grants;
};

/// The last processor that this process may run on; -1 where it cannot be known.
int last_core();

class Loop {
 public:
  /// Throws `ParameterError` for a period that is not between 0.1 and 3.34 ms.
  Loop(Ticked& ticked, const LoopOptions& options);
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  Loop(Loop&&) = delete;
  Loop& operator=(Loop&&) = delete;
  ~Loop();

  /// Returns when the thread has what it was granted, and before its first tick. Throws `Error` where the
  /// machine gives no thread.
  void start();
  /// Returns when the last tick is done. Nothing where it does not run.
  void stop();
  [[nodiscard]] LoopReport report() const;

 private:
  void prepare();
  void run() noexcept;
  std::int64_t wait_until(std::int64_t deadline) const noexcept;
  std::int64_t missed_by(std::int64_t late) noexcept;

  Ticked& ticked_;
  LoopOptions options_;
  std::int64_t period_;  // [ns]
  std::thread thread_;
  std::atomic<bool> wanted_{false};
  std::atomic<bool> ready_{false};
  std::atomic<std::int64_t> ticks_{0};
  std::atomic<std::int64_t> missed_{0};
  std::atomic<std::int64_t> held_{0};
  Timing lateness_;
  Timing compute_;
  int core_ = -1;              // that the thread is pinned to; of the thread alone
  std::vector<Grant> grants_;  // written before `ready_`, constant after
};

}  // namespace tissu::haptic
