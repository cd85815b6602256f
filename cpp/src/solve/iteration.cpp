#include "iteration.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "make_preconditioner.h"
#include "tissu/base/interruption.h"
#include "work.h"

namespace tissu {
namespace {

/// A residual this many times the first: the matrix is singular, and x runs off along its kernel.
constexpr double kLost = 1e8;
constexpr int kBetween = 5;    ///< iterations of a solve after which it may spend another part on a making
constexpr double kDear = 2.0;  ///< times the iterations that are allowed: a price that no solve may pay

}  // namespace

template <class T>
Iteration<T>::Iteration(Preconditioning kind) : M_(make_preconditioner<T>(kind)) {}

template <class T>
double Iteration<T>::scale() const {
  return std::is_same_v<T, float> ? matrix_.scale() : 1.0;
}

template <class T>
template <class V>
bool Iteration<T>::prepare(const LinearOperator& A, bool forced) {
  if constexpr (std::is_same_v<V, float>) {
    if (matrix_.update(*A.matrix())) work_ += kConversion * static_cast<double>(A.bytes());
  } else if constexpr (std::is_same_v<T, float>) {
    matrix_.measure(*A.matrix());
  }
  const bool serves = made_ && id_ == A.id() && given_ == A.given();
  if (serves && version_ == A.version()) return false;
  if (serves && !forced && (spent_ < kBetween * parts_ || (!in_parts_ && !renewal_.due(expected(A)))))
    return false;
  if (serves && !forced) {
    ++parts_;
    in_parts_ = !M_->make_part(A, scale());
    if (in_parts_) return true;
  } else {
    in_parts_ = false;
    made_ = false;
    M_->make(A, scale());
  }
  renewal_.made(M_->price());
  making_ += M_->making();
  once_ += M_->once();
  made_ = true;
  made_midway_ = forced;
  id_ = A.id();
  version_ = A.version();
  given_ = A.given();
  known_.clear();
  if (A.couplings() != nullptr) A.couplings()->keys(known_);
  return true;
}

/// A coupling of three axes puts three eigenvalues outside those that the preconditioner gathers, and each
/// takes the conjugate gradient one iteration more.
template <class T>
double Iteration<T>::expected(const LinearOperator& A) {
  if ((A.couplings() == nullptr && known_.empty()) || !M_->takes_couplings()) return 0.0;
  keys_.clear();
  if (A.couplings() != nullptr) A.couplings()->keys(keys_);
  std::size_t common = 0;
  for (std::size_t i = 0, k = 0; i < keys_.size() && k < known_.size();) {
    common += keys_[i] == known_[k] ? 1 : 0;
    const bool next = keys_[i] <= known_[k];
    k += known_[k] <= keys_[i] ? 1 : 0;
    i += next ? 1 : 0;
  }
  return 3.0 * static_cast<double>(keys_.size() + known_.size() - 2 * common);
}

template <class T>
void Iteration<T>::begin_solve() {
  spent_ = 0;
  work_ = 0.0;
  making_ = 0.0;
  once_ = 0.0;
  goes_on_ = false;
  made_midway_ = false;
  parts_ = 0;
}

template <class T>
void Iteration<T>::take_over(const LinearOperator& A) {
  version_ = A.version();
  making_ = M_->making();
  once_ = M_->once();
}

template <class T>
void Iteration<T>::end_solve() {
  if (spent_ > 0 && !made_midway_) renewal_.used(spent_);
}

template <class T>
template <class V>
double Iteration<T>::iteration_work(const LinearOperator& A) const {
  constexpr double kShare = sizeof(V) / static_cast<double>(sizeof(double));
  const double product = kShare * (static_cast<double>(A.bytes()) + kVectorBytes * A.rows());
  return product + M_->application();
}

template <class T>
template <class V>
Iteration<T>::template Vectors<V>& Iteration<T>::vectors() {
  if constexpr (std::is_same_v<V, T>) {
    return own_;
  } else {
    return wide_;
  }
}

template <class T>
template <class V>
void Iteration<T>::multiply(const LinearOperator& A) {
  Vectors<V>& v = vectors<V>();
  if constexpr (std::is_same_v<V, float>) {
    matrix_.multiply(v.p, v.q);
  } else {
    A.multiply(v.p, v.q);
  }
}

template <class T>
void Iteration<T>::narrow(std::span<const double> r, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) r_[i] = static_cast<T>(r[i] / unit_);
}

template <class T>
void Iteration<T>::widen(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) wide_.z[i] = unit_ * static_cast<double>(z_[i]);
}

template <class T>
template <class V>
double Iteration<T>::advance(const Threads& threads, std::span<V> r, std::span<V> d, double alpha,
                             double& square) {
  constexpr bool kWide = !std::is_same_v<V, T>;
  Vectors<V>& v = vectors<V>();
  const auto rows = static_cast<std::int32_t>(r.size() / 3);
  squares_.resize(static_cast<std::size_t>(Threads::pieces(rows)));
  const V a = static_cast<V>(alpha);
  const bool local = M_->is_local();
  double rz = threads.sum(rows, partial_, [&](std::int32_t begin, std::int32_t end) {
    const auto first = 3 * static_cast<std::size_t>(begin);
    const auto last = 3 * static_cast<std::size_t>(end);
    for (std::size_t i = first; i < last; ++i) {
      d[i] += a * v.p[i];
      r[i] -= a * v.q[i];
    }
    if constexpr (kWide) {
      narrow(r, first, last);
      if (local) {
        M_->apply_rows(begin, end, r_.data(), z_.data());
        widen(first, last);
      }
    } else if (local) {
      M_->apply_rows(begin, end, r.data(), v.z.data());
    }
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      sum += static_cast<double>(r[i]) * static_cast<double>(v.z[i]);
      squares += static_cast<double>(r[i]) * static_cast<double>(r[i]);
    }
    squares_[static_cast<std::size_t>(begin / Threads::kPiece)] = squares;
    return sum;
  });
  square = 0.0;
  for (const double s : squares_) square += s;
  if (local) return rz;
  if constexpr (kWide) {
    M_->apply(r_, z_);
    threads.for_pieces(rows, [&](std::int32_t begin, std::int32_t end) {
      widen(3 * static_cast<std::size_t>(begin), 3 * static_cast<std::size_t>(end));
    });
  } else {
    M_->apply(r, v.z);
  }
  return dot<V>(threads, r, v.z, partial_);
}

template <class T>
template <class V>
void Iteration<T>::go_on(double scale) {
  goes_on_ = true;
  for (V& p : vectors<V>().p) p = static_cast<V>(static_cast<double>(p) / scale);
  rz_ /= scale * scale;
}

template <class T>
template <class V>
void Iteration<T>::turn(const Threads& threads, double beta) {
  Vectors<V>& v = vectors<V>();
  const V b = static_cast<V>(beta);
  threads.for_pieces(static_cast<std::int32_t>(v.p.size() / 3), [&](std::int32_t begin, std::int32_t end) {
    for (auto i = 3 * static_cast<std::size_t>(begin); i < 3 * static_cast<std::size_t>(end); ++i) {
      v.p[i] = v.z[i] + b * v.p[i];
    }
  });
}

template <class T>
template <class V>
End Iteration<T>::run(const LinearOperator& A, std::span<V> r, std::span<V> d, double target, int most) {
  const Threads& threads = A.threads();
  Vectors<V>& v = vectors<V>();
  v.z.resize(r.size());
  v.p.resize(r.size());
  v.q.resize(r.size());
  if constexpr (!std::is_same_v<V, T>) {
    r_.resize(r.size());
    z_.resize(r.size());
    const double length = std::sqrt(dot<V>(threads, r, r, partial_));
    unit_ = length > 0.0 ? length : 1.0;
  }
  constexpr bool kDouble = std::is_same_v<V, double>;
  if (!goes_on_) std::ranges::fill(v.p, V(0));
  if (!goes_on_ || !kDouble) std::ranges::fill(v.q, V(0));
  std::ranges::fill(d, V(0));
  // A new one is made when half of what is allowed is gone, unless it costs far more than all of that.
  const double half = renewal_.price() < kDear * most ? 0.5 * most : Renewal::kUnlimited;
  const double left =
      version_ == A.version() || in_parts_ ? Renewal::kUnlimited : std::min(half, renewal_.left() - spent_);
  // Runs in single precision are short, and leave their parts to the next one.
  const int part = in_parts_ && kDouble ? std::max(1, kBetween * parts_ - spent_) : most;
  iterations_ = 0;
  work_ += M_->application();
  double square = 0.0;
  double rz = advance<V>(threads, r, d, 0.0, square);
  double beta = goes_on_ && rz_ > 0.0 ? rz / rz_ : 0.0;
  // Where the preconditioner has changed, the direction is conjugate to the latest one all the same.
  if (goes_on_ && kDouble) beta = -dot<V>(threads, v.z, v.q, partial_) / curvature_;
  goes_on_ = false;
  const double first = std::sqrt(square);
  while (true) {
    residual_ = std::sqrt(square);
    if (residual_ <= target) return End::reached;
    if (iterations_ >= most) return End::exhausted;
    if (!(residual_ < kLost * first)) return End::lost;
    if (!(rz > 0.0)) {  // no preconditioner: that of an older matrix may serve the older one only
      made_ = false;
      return version_ == A.version() ? End::curvature : End::renewal;
    }
    if (iterations_ >= left) return End::renewal;
    if (iterations_ >= part) return End::part;
    stop_if_asked();
    turn<V>(threads, beta);
    rz_ = rz;
    multiply<V>(A);
    curvature_ = dot<V>(threads, v.p, v.q, partial_);
    if (!(curvature_ > 0.0)) return End::curvature;
    rz = advance<V>(threads, r, d, rz_ / curvature_, square);
    beta = rz / rz_;
    ++iterations_;
    ++spent_;
    work_ += iteration_work<V>(A);
  }
}

template <class T>
void Iteration<T>::forget() {
  made_ = in_parts_ = false;
  renewal_ = Renewal();
  M_->forget();
}

template <class T>
std::size_t Iteration<T>::bytes() const {
  const std::size_t between = (r_.size() + z_.size()) * sizeof(T);
  return own_.bytes() + wide_.bytes() + between + matrix_.bytes() + M_->bytes();
}

template class Iteration<double>;
template class Iteration<float>;
template bool Iteration<double>::prepare<double>(const LinearOperator&, bool);
template bool Iteration<float>::prepare<double>(const LinearOperator&, bool);
template bool Iteration<float>::prepare<float>(const LinearOperator&, bool);
template End Iteration<double>::run<double>(const LinearOperator&, std::span<double>, std::span<double>,
                                            double, int);
template End Iteration<float>::run<double>(const LinearOperator&, std::span<double>, std::span<double>,
                                           double, int);
template End Iteration<float>::run<float>(const LinearOperator&, std::span<float>, std::span<float>, double,
                                          int);
template void Iteration<double>::go_on<double>(double);
template void Iteration<float>::go_on<double>(double);
template void Iteration<float>::go_on<float>(double);
template double Iteration<double>::iteration_work<double>(const LinearOperator&) const;
template double Iteration<float>::iteration_work<double>(const LinearOperator&) const;
template double Iteration<float>::iteration_work<float>(const LinearOperator&) const;

}  // namespace tissu
