#include "chebyshev.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "block_inverse.h"
#include "dot.h"

namespace tissu {
namespace {

constexpr int kSteps = 2;     ///< of the polynomial
constexpr int kLanczos = 12;  ///< products that find the largest eigenvalue
constexpr double kAbove = 1.05;
constexpr double kExhausted = 1e-10;  ///< of a residual, squared: there is nothing more to find
constexpr double kSmoothed = 10.0;    ///< ratio of the eigenvalues between which it smooths

/// Numbers between -1 and 1 without a pattern, the same every time.
double scattered(std::size_t i) {
  const double x = std::sin(12.9898 * static_cast<double>(i) + 1.0) * 43758.5453;
  return 2.0 * (x - std::floor(x)) - 1.0;
}

}  // namespace

template <class T>
void Chebyshev<T>::make(const LevelMatrix& A, Isa isa, const Threads& threads, bool measured) {
  A_.refer(*A.begin, *A.column, isa, A.end);
  couplings_ = A.couplings;
  coupling_scale_ = A.coupling_scale;
  const auto size = 3 * static_cast<std::size_t>(A.rows());
  inverse_.resize(3 * size);
  for (auto* vector : {&r_, &d_, &q_}) vector->assign(size, T(0));
  threads.for_pieces(A.rows(), [&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      for (std::int64_t k = 9 * A.first(i); k < 9 * A.last(i); ++k) {
        A_.block(0)[k] = static_cast<T>(A.scale * A.values[k]);
      }
      const Mat3 inverse = positive_inverse(A.couplings == nullptr ? A.diagonal(i) : A.coupled_diagonal(i));
      Eigen::Map<Eigen::Matrix<T, 3, 3>>(inverse_.data() + 9 * static_cast<std::ptrdiff_t>(i)) =
          (0.5 * (inverse + inverse.transpose())).template cast<T>();
    }
  });
  if (measured) find_largest(threads);
}

template <class T>
void Chebyshev<T>::gather(const Threads& threads, const T* p) const {
  if (couplings_ != nullptr) couplings_->gather(threads, p);
}

template <class T>
void Chebyshev<T>::multiply_rows(std::int32_t begin, std::int32_t end, const T* p, T* out) const {
  A_.multiply_rows(begin, end, p, out);
  if (couplings_ != nullptr) couplings_->scatter(begin, end, coupling_scale_, out);
}

/// Iterations of the conjugate gradient from a residual without a pattern: their coefficients are the
/// tridiagonal matrix of Lanczos' method (Golub and Van Loan, Matrix Computations, 4th edition, 11.3).
template <class T>
void Chebyshev<T>::find_largest(const Threads& threads) {
  using Tridiagonal = Eigen::Matrix<double, kLanczos, kLanczos>;
  Tridiagonal matrix = Tridiagonal::Zero();  // zeros behind what is found when the iterations end early
  for (std::size_t i = 0; i < r_.size(); ++i) r_[i] = static_cast<T>(scattered(i));
  std::ranges::fill(d_, T(0));
  const auto precondition = [&] {
    threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
      multiply_blocks(inverse_.data(), begin, end, r_.data(), q_.data());
    });
    return dot<T>(threads, r_, q_, partial_);
  };
  double rz = precondition();
  const double first = rz;
  double alpha = 0.0;
  double beta = 0.0;
  int size = 0;
  while (size < kLanczos && rz > kExhausted * first && std::isfinite(rz)) {
    for (std::size_t i = 0; i < d_.size(); ++i) d_[i] = q_[i] + static_cast<T>(beta) * d_[i];
    A_.multiply(threads, d_.data(), q_.data());
    if (couplings_ != nullptr) couplings_->add_product(threads, coupling_scale_, d_.data(), q_.data());
    const double curvature = dot<T>(threads, d_, q_, partial_);
    if (!(curvature > 0.0)) break;
    const double last = alpha;
    alpha = rz / curvature;
    matrix(size, size) = 1.0 / alpha + (size == 0 ? 0.0 : beta / last);
    if (size > 0) matrix(size, size - 1) = matrix(size - 1, size) = std::sqrt(beta) / last;
    ++size;
    for (std::size_t i = 0; i < r_.size(); ++i) r_[i] -= static_cast<T>(alpha) * q_[i];
    const double next = precondition();
    beta = next / rz;
    rz = next;
  }
  largest_ = 1.0;
  if (size == 0 || !std::isfinite(beta)) return;
  const Eigen::SelfAdjointEigenSolver<Tridiagonal> eigen(matrix);
  const double off =
      std::sqrt(std::max(beta, 0.0)) / alpha * std::abs(eigen.eigenvectors()(size - 1, kLanczos - 1));
  largest_ = eigen.eigenvalues()[kLanczos - 1] + off;
}

template <class T>
void Chebyshev<T>::smooth_from_zero(const Threads& threads, const T* b, T* x) {
  std::copy_n(b, r_.size(), r_.data());
  std::fill_n(x, r_.size(), T(0));
  iterate(threads, x, kSteps);
}

template <class T>
void Chebyshev<T>::smooth(const Threads& threads, const T* b, T* x) {
  gather(threads, x);
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows(begin, end, x, r_.data());
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
      r_[i] = b[i] - r_[i];
    }
  });
  iterate(threads, x, kSteps - 1);
}

template <class T>
void Chebyshev<T>::iterate(const Threads& threads, T* x, int residuals) {
  const double upper = kAbove * largest_;
  const double centre = 0.5 * (upper + upper / kSmoothed);
  const double half = 0.5 * (upper - upper / kSmoothed);
  double rho = half / centre;
  for (int step = 0; step < kSteps; ++step) {
    const double next = step == 0 ? 0.0 : 1.0 / (2.0 * centre / half - rho);
    const T own = static_cast<T>(step == 0 ? 0.0 : next * rho);
    const T share = static_cast<T>(step == 0 ? 1.0 / centre : 2.0 * next / half);
    if (step > 0) rho = next;
    threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
      multiply_blocks(inverse_.data(), begin, end, r_.data(), q_.data());
      for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
        d_[i] = step == 0 ? share * q_[i] : own * d_[i] + share * q_[i];
        x[i] += d_[i];
      }
    });
    if (step < residuals) subtract_product(threads);
  }
}

/// r -= A d
template <class T>
void Chebyshev<T>::subtract_product(const Threads& threads) {
  gather(threads, d_.data());
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows(begin, end, d_.data(), q_.data());
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
      r_[i] -= q_[i];
    }
  });
}

template <class T>
std::size_t Chebyshev<T>::bytes() const {
  return A_.bytes() + (inverse_.size() + r_.size() + d_.size() + q_.size()) * sizeof(T);
}

template <class T>
double Chebyshev<T>::cycle_bytes() const {
  const auto products = static_cast<double>(2 * kSteps);
  const auto vectors = static_cast<double>((15 * kSteps + 6) * 3 * sizeof(T));
  return products * static_cast<double>(A_.bytes()) + vectors * A_.rows();
}

template class Chebyshev<double>;
template class Chebyshev<float>;

}  // namespace tissu
