#pragma once

/// Values that one thread writes at a fixed rate and another takes in their order, as many as there is room
/// for.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tissu::haptic {

template <class T>
class RecordRing {
 public:
  /// Room for so many; all memory is taken here.
  explicit RecordRing(std::size_t room) : slots_(std::max<std::size_t>(room, 1)) {}

  /// Called by the writer. False where there is no room: the value is lost, and counted.
  bool put(const T& value) noexcept {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) >= slots_.size()) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[end % slots_.size()] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// Called by the reader: what was written since it was last called.
  std::vector<T> take() {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    const std::uint64_t end = end_.load(std::memory_order_acquire);
    std::vector<T> taken;
    taken.reserve(static_cast<std::size_t>(end - begin));
    for (std::uint64_t k = begin; k < end; ++k) taken.push_back(slots_[k % slots_.size()]);
    begin_.store(end, std::memory_order_release);
    return taken;
  }
  [[nodiscard]] std::int64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  std::vector<T> slots_;
  std::atomic<std::uint64_t> begin_{0};
  std::atomic<std::uint64_t> end_{0};
  std::atomic<std::int64_t> lost_{0};
};

}  // namespace tissu::haptic
