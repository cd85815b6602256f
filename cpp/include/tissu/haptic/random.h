#pragma once

/// Random numbers that are the same on every machine for the same seed.

#include <cstdint>

namespace tissu::haptic {

/// SplitMix64 (Steele, Lea and Flood 2014): 64 bits of state, no allocation.
class Random {
 public:
  explicit Random(std::uint64_t seed) noexcept : state_(seed) {}

  std::uint64_t bits() noexcept {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  /// In [0, 1).
  double uniform() noexcept { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }
  double between(double low, double high) noexcept { return low + (high - low) * uniform(); }
  bool happens(double probability) noexcept { return probability > 0.0 && uniform() < probability; }

 private:
  std::uint64_t state_;
};

}  // namespace tissu::haptic
