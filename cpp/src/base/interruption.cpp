#include "tissu/base/interruption.h"

namespace tissu {
namespace {

static_assert(std::atomic<bool>::is_always_lock_free);

constexpr std::atomic<bool> kNever = false;
thread_local const std::atomic<bool>* asked_of_thread = &kNever;

}  // namespace

Interruptible::Interruptible(const std::atomic<bool>& asked) : before_(asked_of_thread) {
  asked_of_thread = &asked;
}

Interruptible::~Interruptible() { asked_of_thread = before_; }

void stop_if_asked() {
  if (asked_of_thread->load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace tissu
