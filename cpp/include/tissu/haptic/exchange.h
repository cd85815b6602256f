#pragma once

/// The newest value from one thread for another, without a lock and without waiting on either side.
///
/// There are three slots: one that the writer fills, one that the reader reads, and one between them.
/// Publishing swaps the writer's slot with the one between, taking swaps it with the reader's; each swap is
/// one atomic exchange of the index of the slot between, in which a bit says whether it holds something that
/// was not taken. What is published before the last is overwritten, never read in part.

#include <array>
#include <atomic>
#include <cstdint>

namespace tissu::haptic {

/// One thread publishes and one takes. T is copied by the caller, which can avoid the heap.
template <class T>
class Exchange {
 public:
  Exchange() = default;
  explicit Exchange(const T& first) { slots_.fill(Slot{first}); }

  /// The writer's slot. What stands in it is an older value.
  [[nodiscard]] T& to_write() noexcept { return slots_[back_].value; }
  void publish() noexcept { back_ = between_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex; }
  void publish(const T& value) {
    to_write() = value;
    publish();
  }

  /// Takes the newest value, where one was published since; whether there was one.
  bool take() noexcept {
    if ((between_.load(std::memory_order_relaxed) & kNew) == 0U) return false;
    front_ = between_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  /// The value that was taken last.
  [[nodiscard]] const T& value() const noexcept { return slots_[front_].value; }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kNew = 4;
  static constexpr std::size_t kLine = 64;  // bytes that two threads do not share

  struct alignas(kLine) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(kLine) std::atomic<std::uint32_t> between_{2};
  alignas(kLine) std::uint32_t back_ = 0;
  alignas(kLine) std::uint32_t front_ = 1;
};

}  // namespace tissu::haptic
