#pragma once

/// Whether the systems of a step with contact still bring its contacts nearer to rest.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tissu {

class Settling {
 public:
  /// What a system left.
  struct Left {
    int held_back = 0;          ///< rows
    std::size_t acting = 0;     ///< contacts
    double change = 0.0;        ///< of the contacts' forces, as a share of them
    double inadmissible = 0.0;  ///< share of these forces
    double depth = 0.0;         ///< as a share of the gap
  };

  /// Adds a system. True when the same few systems come again and again, some of which hold rows back, or
  /// when the latest ones all do, and not fewer than before. Slow or uneven progress is progress.
  bool is_lost(const Left& left) {
    fewest_ = count_ < kSystems / 2 ? fewest_ : std::min(fewest_, of(kSystems / 2).held_back);
    latest_[count_++ % kSystems] = left;
    if (count_ < kSystems) return false;
    for (std::size_t period = 1; period <= kSystems / 2; ++period) {
      if (repeats(period)) return true;
    }
    for (std::size_t k = 1; k <= kSystems / 2; ++k) {
      if (of(k).held_back == 0 || of(k).held_back < fewest_) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t kSystems = 8;
  static constexpr double kSame = 1e-3;

  /// The k-th latest, from 1 on.
  [[nodiscard]] const Left& of(std::size_t k) const { return latest_[(count_ - k) % kSystems]; }
  static bool is_same(double a, double b) { return std::abs(a - b) <= kSame * std::max(1.0, std::abs(a)); }
  [[nodiscard]] bool repeats(std::size_t period) const {
    bool holds = false;
    for (std::size_t k = 1; k <= period; ++k) {
      const Left& now = of(k);
      const Left& before = of(k + period);
      if (now.held_back != before.held_back || now.acting != before.acting) return false;
      if (!is_same(now.change, before.change) || !is_same(now.depth, before.depth)) return false;
      if (!is_same(now.inadmissible, before.inadmissible)) return false;
      holds = holds || now.held_back > 0;
    }
    return holds;
  }

  std::array<Left, kSystems> latest_;
  int fewest_ = std::numeric_limits<int>::max();  ///< rows that any system but the latest four held back
  std::size_t count_ = 0;
};

}  // namespace tissu
