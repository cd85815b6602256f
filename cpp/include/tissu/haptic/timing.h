#pragma once

/// How long something takes, of millions of times: a histogram of durations, written by one thread, read by
/// others.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tissu::haptic {

/// What a histogram says. Durations are upper ends of its classes, so that none is understated; the
/// largest is exact.
struct TimingReport {
  std::int64_t count = 0;
  double p50 = 0.0;   ///< [s], 0 where nothing was counted
  double p99 = 0.0;   ///< [s]
  double p999 = 0.0;  ///< [s]
  double max = 0.0;   ///< [s]
};

/// Sixteen classes for each factor of two, from 1 ns to hundreds of years: a percentile is at most 1/16 too
/// large.
class Timing {
 public:
  /// Counts a duration; one below zero counts as zero. Called by one thread.
  void add(std::int64_t nanoseconds) noexcept;
  [[nodiscard]] TimingReport report() const noexcept;
  /// Called while nothing is added.
  void clear() noexcept;

 private:
  static constexpr unsigned kFine = 4;  // classes of a factor of two, as a power of two
  static constexpr std::size_t kClasses = (64U - kFine) << kFine;

  static std::size_t class_of(std::uint64_t nanoseconds) noexcept;
  static double end_of(std::size_t number) noexcept;

  std::array<std::atomic<std::int64_t>, kClasses> counts_{};
  std::atomic<std::int64_t> max_{0};
};

}  // namespace tissu::haptic
