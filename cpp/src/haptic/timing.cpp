#include "tissu/haptic/timing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tissu::haptic {

std::size_t Timing::class_of(std::uint64_t nanoseconds) noexcept {
  constexpr std::uint64_t kFirst = 1U << kFine;
  if (nanoseconds < kFirst) return static_cast<std::size_t>(nanoseconds);  // one class for each
  const auto power = static_cast<unsigned>(std::bit_width(nanoseconds)) - 1U - kFine;
  const std::uint64_t fine = (nanoseconds >> power) - kFirst;
  return std::min(kClasses - 1, static_cast<std::size_t>(((power + 1ULL) << kFine) + fine));
}

double Timing::end_of(std::size_t number) noexcept {
  constexpr std::size_t kFirst = 1U << kFine;
  if (number < kFirst) return static_cast<double>(number);
  const auto power = static_cast<int>(number >> kFine) - 1;
  const auto fine = static_cast<double>((number & (kFirst - 1)) + kFirst + 1);
  return std::ldexp(fine, power) - 1.0;
}

void Timing::add(std::int64_t nanoseconds) noexcept {
  nanoseconds = std::max<std::int64_t>(nanoseconds, 0);
  counts_[class_of(static_cast<std::uint64_t>(nanoseconds))].fetch_add(1, std::memory_order_relaxed);
  if (nanoseconds > max_.load(std::memory_order_relaxed)) max_.store(nanoseconds, std::memory_order_relaxed);
}

TimingReport Timing::report() const noexcept {
  std::array<std::int64_t, kClasses> counts{};
  TimingReport found;
  for (std::size_t k = 0; k < kClasses; ++k) {
    counts[k] = counts_[k].load(std::memory_order_relaxed);
    found.count += counts[k];
  }
  const double largest = static_cast<double>(max_.load(std::memory_order_relaxed));
  const auto percentile = [&](double share) {
    const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(found.count)));
    std::int64_t below = 0;
    for (std::size_t k = 0; k < kClasses; ++k) {
      below += counts[k];
      if (below >= wanted && below > 0) return 1e-9 * std::min(end_of(k), largest);
    }
    return 0.0;
  };
  found.p50 = percentile(0.5);
  found.p99 = percentile(0.99);
  found.p999 = percentile(0.999);
  found.max = 1e-9 * largest;
  return found;
}

void Timing::clear() noexcept {
  for (std::atomic<std::int64_t>& count : counts_) count.store(0, std::memory_order_relaxed);
  max_.store(0, std::memory_order_relaxed);
}

}  // namespace tissu::haptic
