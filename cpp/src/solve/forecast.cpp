#include "forecast.h"

#include <algorithm>
#include <cmath>

#include "dot.h"

namespace tissu {
namespace {

constexpr double kPays = 0.5;        ///< of the residual: what a guess has to leave less of
constexpr int kLongest = 16;         ///< solves that go without at most
constexpr double kDependent = 1e-8;  ///< of a product, squared: what the other ones leave of it is round-off

}  // namespace

void Forecast::add(const Threads& threads, double a, ConstReals x, Reals y) {
  threads.for_pieces(static_cast<std::int32_t>(x.size() / 3), [&](std::int32_t begin, std::int32_t end) {
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i)
      y[i] += a * x[i];
  });
}

double Forecast::start(const LinearOperator& A, double size, Reals r, Reals x, double& work) {
  if (count_ == 0 || id_ != A.id() || answers_.front().size() != x.size()) return size;
  if (pause_ > 0) {
    --pause_;
    return size;
  }
  const Threads& threads = A.threads();
  for (std::size_t n = 0; n < count_; ++n) {
    std::vector<double>& answer = answers_[n];
    std::vector<double>& product = products_[n];
    A.multiply(answer, product);
    work += static_cast<double>(A.bytes());
    const double whole = dot<double>(threads, product, product, partial_);
    for (std::size_t k = 0; k < n; ++k) {
      const double length = dot<double>(threads, products_[k], products_[k], partial_);
      if (!(length > 0.0)) continue;
      const double share = dot<double>(threads, product, products_[k], partial_) / length;
      add(threads, -share, products_[k], product);
      add(threads, -share, answers_[k], answer);
    }
    const double length = dot<double>(threads, product, product, partial_);
    if (!(length > kDependent * whole)) {
      std::ranges::fill(product, 0.0);
      continue;
    }
    const double share = dot<double>(threads, r, product, partial_) / length;
    add(threads, share, answer, x);
    add(threads, -share, product, r);
  }
  const double left = std::sqrt(dot<double>(threads, r, r, partial_));
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
  std::size_t sum = partial_.size();
  for (const auto& v : answers_) sum += v.size();
  for (const auto& v : products_) sum += v.size();
  return sum * sizeof(double);
}

}  // namespace tissu
