#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <string>
#include <vector>

#include "interruption.h"
#include "tissu/base/interruption.h"

#if defined(__linux__)
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace tissu::bind {
namespace {

constexpr int kMostSignals = 65;

std::atomic<bool> asked = false;
std::vector<int> named;                               ///< by `interrupt_on`; read under the lock
std::array<struct sigaction, kMostSignals> before{};  ///< the interpreter's

/// Python's own handlers run in the main thread alone.
bool in_main_thread() {
#if defined(__linux__)
  return ::syscall(SYS_gettid) == ::getpid();
#else
  return false;
#endif
}

extern "C" void note_signal(int number) {
  asked.store(true, std::memory_order_relaxed);
  before[static_cast<std::size_t>(number)].sa_handler(number);
}

/// While it lives, signals set `asked` on their way to the interpreter.
class Watch {
 public:
  explicit Watch(const std::vector<int>& numbers) {
    asked.store(false, std::memory_order_relaxed);
    for (const int number : numbers) {
      auto& old = before[static_cast<std::size_t>(number)];
      if (::sigaction(number, nullptr, &old) != 0 || (old.sa_flags & SA_SIGINFO) != 0) continue;
      if (old.sa_handler == SIG_DFL || old.sa_handler == SIG_IGN) continue;
      struct sigaction watched = old;
      watched.sa_handler = &note_signal;
      if (::sigaction(number, &watched, nullptr) == 0) numbers_.push_back(number);
    }
  }
  ~Watch() {
    for (const int number : numbers_) ::sigaction(number, &before[static_cast<std::size_t>(number)], nullptr);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  std::vector<int> numbers_;
};

/// The signals that stop a step now.
std::vector<int> watched_signals() {
  std::vector<int> numbers = named;
  const py::module_ signals = py::module_::import("signal");
  const bool raises = signals.attr("getsignal")(SIGINT).is(signals.attr("default_int_handler"));
  if (raises && std::ranges::find(numbers, SIGINT) == numbers.end()) numbers.push_back(SIGINT);
  return numbers;
}

}  // namespace

StepReport step_interruptibly(Simulation& simulation, double h) {
  if (!in_main_thread()) {
    const py::gil_scoped_release unlocked;
    return simulation.step(h);
  }
  const Watch watch(watched_signals());
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // one that came before the watch
  try {
    const py::gil_scoped_release unlocked;
    const Interruptible interruptible(asked);
    return simulation.step(h);
  } catch (const Interrupted& stopped) {
    if (PyErr_CheckSignals() == 0) PyErr_SetString(PyExc_KeyboardInterrupt, stopped.what());
    throw py::error_already_set();
  }
}

void bind_interruption(py::module_& m) {
  m.def(
      "interrupt_on",
      [](const std::vector<int>& numbers) {
        for (const int number : numbers) {
          if (number < 1 || number >= kMostSignals) {
            throw ParameterError("found signal " + std::to_string(number) + "; 1 to 64 are accepted.");
          }
        }
        named = numbers;
      },
      py::arg("signals"));
}

}  // namespace tissu::bind
