#pragma once

/// A request to stop what a thread computes, asked for between iterations: of Newton, of the linear solver.

#include <atomic>

#include "tissu/base/error.h"

namespace tissu {

/// What was computed was asked to stop. A step that throws it leaves the state as it was before the step.
class Interrupted : public Error {
 public:
  Interrupted() : Error("the step was interrupted; the simulation stands at its last good step.") {}
};

/// While it lives, this thread stops at the next iteration after `asked` was set. Signal handlers may set
/// it: it is lock-free.
class Interruptible {
 public:
  explicit Interruptible(const std::atomic<bool>& asked);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  const std::atomic<bool>* before_;
};

/// Throws Interrupted where this thread is asked to stop: one relaxed read.
void stop_if_asked();

}  // namespace tissu
