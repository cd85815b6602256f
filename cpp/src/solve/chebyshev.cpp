#include "chebyshev.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "block_inverse.h"
#include "dot.h"

namespace tissu {
namespace {

constexpr int kSteps = 2;     ///< of the polynomial, each written out with the products that it needs
constexpr int kLanczos = 12;  ///< products that find the largest eigenvalue
constexpr double kAbove = 1.05;
constexpr double kExhausted = 1e-10;  ///< of a residual, squared: there is nothing more to find
constexpr double kSmoothed = 10.0;    ///< ratio of the eigenvalues between which it smooths

/// Numbers between -1 and 1 without a pattern, the same every time (the finalizer of SplitMix64: Steele, Lea
/// and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
double scattered(std::uint64_t i) {
  std::uint64_t x = (i + 1) * 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  x ^= x >> 31;
  return std::ldexp(static_cast<double>(x >> 11), -52) - 1.0;
}

/// f(i) for the numbers of rows [begin, end).
template <class Function>
void for_numbers(std::int32_t begin, std::int32_t end, Function&& f) {
  for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) f(i);
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
/// tridiagonal matrix of Lanczos' method (Golub and Van Loan, Matrix Computations, 4th edition, 11.3). Each
/// row of the residual is as large as the root of its diagonal, so that all rows have the same part in r .
/// D^-1 r: those of a soft body beside a stiff one, or of held nodes, whose diagonal is 1, would else be all
/// that is found, and the eigenvalue too small.
template <class T>
void Chebyshev<T>::find_largest(const Threads& threads) {
  using Tridiagonal = Eigen::Matrix<double, kLanczos, kLanczos>;
  Tridiagonal matrix = Tridiagonal::Zero();  // zeros behind what is found when the iterations end early
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row) {
      const T* D = inverse_.data() + 9 * row;
      const double mean =
          (static_cast<double>(D[0]) + static_cast<double>(D[4]) + static_cast<double>(D[8])) / 3.0;
      const double root = mean > 0.0 ? 1.0 / std::sqrt(mean) : 0.0;
      for (std::size_t i = 3 * row; i < 3 * row + 3; ++i) r_[i] = static_cast<T>(root * scattered(i));
    }
  });
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
typename Chebyshev<T>::Polynomial Chebyshev<T>::polynomial() const {
  const double upper = kAbove * largest_;
  const double centre = 0.5 * (upper + upper / kSmoothed);
  const double half = 0.5 * (upper - upper / kSmoothed);
  const double first = half / centre;
  const double second = 1.0 / (2.0 / first - first);
  return {static_cast<T>(1.0 / centre), static_cast<T>(second * first), static_cast<T>(2.0 * second / half)};
}

/// to = own d + share D^-1 (r - to), and r = r - to, for rows [begin, end).
template <class T>
void Chebyshev<T>::second_step(std::int32_t begin, std::int32_t end, const T* r, T* to) {
  const Polynomial with = polynomial();
  for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
    T left[3];
    T step[3];
    for (std::size_t k = 0; k < 3; ++k) left[k] = r_[3 * i + k] = r[3 * i + k] - to[3 * i + k];
    multiply_blocks(inverse_.data() + 9 * i, 0, 1, left, step);
    for (std::size_t k = 0; k < 3; ++k) to[3 * i + k] = with.own * d_[3 * i + k] + with.share * step[k];
  }
}

template <class T>
void Chebyshev<T>::smooth_from_zero(const Threads& threads, const T* b, T* x) {
  const T share = polynomial().first;
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_blocks(inverse_.data(), begin, end, b, d_.data());
    for_numbers(begin, end, [&](std::size_t i) { d_[i] *= share; });
  });
  gather(threads, d_.data());
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows(begin, end, d_.data(), q_.data());
    second_step(begin, end, b, q_.data());
    for_numbers(begin, end, [&](std::size_t i) { x[i] = d_[i] + q_[i]; });
  });
  gather(threads, q_.data());
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows(begin, end, q_.data(), d_.data());
    for_numbers(begin, end, [&](std::size_t i) { r_[i] -= d_[i]; });
  });
}

template <class T>
void Chebyshev<T>::smooth(const Threads& threads, const T* b, T* x) {
  const T share = polynomial().first;
  gather(threads, x);
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows(begin, end, x, r_.data());
    for_numbers(begin, end, [&](std::size_t i) { r_[i] = b[i] - r_[i]; });
    multiply_blocks(inverse_.data(), begin, end, r_.data(), d_.data());
    for_numbers(begin, end, [&](std::size_t i) { d_[i] *= share; });
  });
  gather(threads, d_.data());
  threads.for_pieces(rows(), [&](std::int32_t begin, std::int32_t end) {
    multiply_rows(begin, end, d_.data(), q_.data());
    second_step(begin, end, r_.data(), q_.data());
    for_numbers(begin, end, [&](std::size_t i) { x[i] = (x[i] + d_[i]) + q_[i]; });
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
  return products * static_cast<double>(A_.product_bytes()) + vectors * A_.rows();
}

template class Chebyshev<double>;
template class Chebyshev<float>;

}  // namespace tissu
