#include "forecast.h"

#include <algorithm>
#include <cmath>

#include "assembly/kernels/product_list.h"
#include "tissu/assembly/block_matrix.h"

namespace tissu {
namespace {

constexpr double kPays = 0.5;        ///< of the residual: what a guess has to leave less of
constexpr int kLongest = 16;         ///< solves that go without at most
constexpr double kDependent = 1e-8;  ///< of a product, squared: what the other ones leave of it is round-off
constexpr double kThree = 1.7;       ///< times the work of one product: that of three in one reading

}  // namespace

double Forecast::multiply(const LinearOperator& A) {
  const BlockMatrix* matrix = A.matrix();
  if (matrix == nullptr || count_ < kMost) {
    for (std::size_t n = 0; n < count_; ++n) A.multiply(answers_[n], products_[n]);
    return static_cast<double>(count_) * static_cast<double>(A.bytes());
  }
  const Sparsity& pattern = matrix->sparsity();
  const MultiplyThree multiply_three = multiply_three_of(matrix->isa());
  const double* const from[kMost] = {answers_[0].data(), answers_[1].data(), answers_[2].data()};
  double* const to[kMost] = {products_[0].data(), products_[1].data(), products_[2].data()};
  A.threads().for_pieces(matrix->rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_three(pattern.row_begin.data(), pattern.row_end(), pattern.column.data(), matrix->values(),
                   begin, end, from, to);
  });
  if (const Couplings* couplings = matrix->couplings(); couplings != nullptr) {
    for (std::size_t n = 0; n < kMost; ++n) couplings->add_product(A.threads(), 1.0, from[n], to[n]);
  }
  return kThree * static_cast<double>(A.bytes());
}

Forecast::Sums Forecast::sums(const Threads& threads, ConstReals r) {
  const auto rows = static_cast<std::int32_t>(r.size() / 3);
  partial_sums_.resize(static_cast<std::size_t>(Threads::pieces(rows)));
  threads.for_each(Threads::pieces(rows), [&](std::int32_t piece) {
    Sums sum{};
    const auto begin = 3 * static_cast<std::size_t>(Threads::begin_of(piece));
    const auto end = 3 * static_cast<std::size_t>(Threads::end_of(piece, rows));
    for (std::size_t i = begin; i < end; ++i) {
      const Shares y = {products_[0][i], products_[1][i], products_[2][i]};
      std::size_t pair = 0;
      for (std::size_t n = 0; n < kMost; ++n) {
        for (std::size_t k = 0; k <= n; ++k) sum[pair++] += y[n] * y[k];
        sum[kPairs + n] += y[n] * r[i];
      }
    }
    partial_sums_[static_cast<std::size_t>(piece)] = sum;
  });
  Sums total{};
  for (const Sums& sum : partial_sums_) {
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += sum[k];
  }
  return total;
}

/// Cholesky's factor of the sums of pairs, without the answers that depend on those before them. What is kept
/// of a pivot is known to eight digits at least, which is what a guess needs.
Forecast::Shares Forecast::shares(const Sums& sums) {
  std::array<Shares, kMost> L{};
  Shares y{};
  for (std::size_t n = 0, pair = 0; n < kMost; ++n) {
    double left = sums[kPairs + n];
    double pivot = 0.0;
    for (std::size_t k = 0; k <= n; ++k) {
      double sum = sums[pair++];
      for (std::size_t m = 0; m < k; ++m) sum -= L[n][m] * L[k][m];
      if (k < n) {
        L[n][k] = L[k][k] > 0.0 ? sum / L[k][k] : 0.0;
        left -= L[n][k] * y[k];
      } else {
        pivot = sum;
      }
    }
    if (!(pivot > kDependent * sums[pair - 1])) {
      L[n] = {};
      continue;
    }
    L[n][n] = std::sqrt(pivot);
    y[n] = left / L[n][n];
  }
  for (std::size_t n = kMost; n-- > 0;) {
    if (!(L[n][n] > 0.0)) continue;
    for (std::size_t k = n + 1; k < kMost; ++k) y[n] -= L[k][n] * y[k];
    y[n] /= L[n][n];
  }
  return y;
}

double Forecast::start(const LinearOperator& A, double size, Reals r, Reals x, double& work) {
  if (count_ == 0 || id_ != A.id() || answers_.front().size() != x.size()) return size;
  if (pause_ > 0) {
    --pause_;
    return size;
  }
  const Threads& threads = A.threads();
  work += multiply(A);
  const Shares share = shares(sums(threads, r));
  const auto rows = static_cast<std::int32_t>(r.size() / 3);
  const double square = threads.sum(rows, partial_, [&](std::int32_t begin, std::int32_t end) {
    double sum = 0.0;
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
      for (std::size_t n = 0; n < kMost; ++n) {
        x[i] += share[n] * answers_[n][i];
        r[i] -= share[n] * products_[n][i];
      }
      sum += r[i] * r[i];
    }
    return sum;
  });
  const double left = std::sqrt(square);
  pauses_ = left < kPays * size ? 0 : std::clamp(2 * pauses_, 1, kLongest);
  pause_ = pauses_;
  return left;
}

void Forecast::keep(const LinearOperator& A, ConstReals x) {
  if (id_ != A.id() || answers_.front().size() != x.size()) {
    forget();
    id_ = A.id();
    for (auto* vectors : {&answers_, &products_}) {
      for (auto& v : *vectors) v.resize(x.size());
    }
  }
  count_ = std::min(count_ + 1, kMost);
  std::ranges::rotate(answers_, answers_.end() - 1);
  std::ranges::copy(x, answers_.front().begin());
}

void Forecast::forget() { *this = Forecast(); }

std::size_t Forecast::bytes() const {
  std::size_t sum = partial_.size() + partial_sums_.size() * std::tuple_size_v<Sums>;
  for (const auto& v : answers_) sum += v.size();
  for (const auto& v : products_) sum += v.size();
  return sum * sizeof(double);
}

}  // namespace tissu
