#pragma once

/// When to make a preconditioner again.

#include <algorithm>

namespace tissu {

/// The rule of renting skis: what an old preconditioner costs in iterations beyond those of its best solve
/// is added up, and a new one is made when the sum reaches the price of making it. Whatever the matrices do,
/// that costs at most twice what knowing them beforehand would. Prices are counted in iterations, from
/// numbers of operations and bytes, never from time measured: the same run decides the same.
class Renewal {
 public:
  /// A preconditioner was made, at a price in iterations.
  void made(double price) { *this = Renewal{price}; }
  /// A solve took so many iterations with it.
  void used(int iterations) {
    best_ = best_ < 0 ? iterations : std::min(best_, iterations);
    excess_ += iterations - best_;
  }
  /// `expected`: iterations that the next solve will take beyond its best one, as far as is known beforehand.
  [[nodiscard]] bool due(double expected = 0.0) const { return excess_ + expected >= price_; }
  /// Iterations that a solve may take before a new one pays at once, the first ones that it has to take
  /// counted. One that takes less than twice those ends with the old one: the new one is made before the next
  /// solve, in parts.
  [[nodiscard]] double left() const {
    return best_ < 0 ? kUnlimited : 2.0 * best_ + std::max(price_ - excess_, 0.0);
  }

  /// Of the preconditioner, in iterations.
  [[nodiscard]] double price() const { return price_; }

  static constexpr double kUnlimited = 1e30;

  Renewal() = default;

 private:
  explicit Renewal(double price) : price_(price) {}
  double price_ = 0.0;
  double excess_ = 0.0;
  int best_ = -1;  ///< iterations of the best solve; -1: none yet
};

}  // namespace tissu
