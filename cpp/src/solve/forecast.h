#pragma once

/// The first guess of a solve from the answers of those before it.

#include <array>
#include <cstdint>
#include <vector>

#include "tissu/assembly/linear_operator.h"

namespace tissu {

/// Answers of successive systems, as of the steps of a motion that is smooth, hardly differ. The guess is
/// that combination of the latest answers whose residual is least (Fischer 1998, Computer Methods in Applied
/// Mechanics and Engineering 163, 193-204, with the residual in place of the energy): never worse than no
/// guess. The products of the answers are its price, in one reading of the matrix; where the guesses do not
/// pay they are tried more and more seldom.
class Forecast {
 public:
  /// x = 0 becomes the guess, and r = b its residual, whose norm is `size`; the new norm. `work`
  /// grows by what its products read.
  double start(const LinearOperator& A, double size, Reals r, Reals x, double& work);
  /// An answer that was accepted, of a system of this operator; those of another one are forgotten.
  void keep(const LinearOperator& A, ConstReals x);
  void forget();
  [[nodiscard]] std::size_t bytes() const;

 private:
  static constexpr std::size_t kMost = 3;
  static constexpr std::size_t kPairs = kMost * (kMost + 1) / 2;
  using Shares = std::array<double, kMost>;
  using Sums = std::array<double, kPairs + kMost>;  ///< products with each other, pair by pair, and with r

  /// A x of all answers; the work that it takes.
  double multiply(const LinearOperator& A);
  Sums sums(const Threads& threads, ConstReals r);
  /// The shares of the answers whose residual is least.
  static Shares shares(const Sums& sums);

  std::array<std::vector<double>, kMost> answers_;  ///< the latest first
  std::array<std::vector<double>, kMost> products_;
  std::vector<double> partial_;
  std::vector<Sums> partial_sums_;
  std::uint64_t id_ = 0;   ///< of the operator
  std::size_t count_ = 0;  ///< of answers
  int pause_ = 0;          ///< solves that go without
  int pauses_ = 0;         ///< length of the next pause
};

}  // namespace tissu
