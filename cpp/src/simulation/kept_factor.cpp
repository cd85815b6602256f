#include "kept_factor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>

#include "tissu/solve/conjugate_gradient.h"

namespace tissu {
namespace {

constexpr int kMostCorrections = 2;
constexpr std::size_t kMostNumbers = 8'000'000;  ///< of columns of A^-1 that are kept
constexpr std::int32_t kNear = 48;               ///< rows of a correction among themselves
constexpr double kFirstTolerance = 1e-2;         ///< of the conjugate gradient, …
constexpr double kLastTolerance = 1e-9;          ///< … which falls by tens
constexpr double kNoise = 1e-9;                  ///< of a compliance that is none

ConstReals numbers(const Eigen::MatrixXd& X, Eigen::Index column) {
  return {X.col(column).data(), static_cast<std::size_t>(X.rows())};
}
Reals numbers(Eigen::MatrixXd& X, Eigen::Index column) {
  return {X.col(column).data(), static_cast<std::size_t>(X.rows())};
}

void multiply(const BlockMatrix& A, const Eigen::MatrixXd& X, Eigen::MatrixXd& out) {
  out.resize(X.rows(), X.cols());
  for (Eigen::Index c = 0; c < X.cols(); ++c) A.multiply(numbers(X, c), numbers(out, c));
}

void make_symmetric(Eigen::MatrixXd& W) { W = (0.5 * (W + W.transpose())).eval(); }

bool is_semidefinite(const Eigen::MatrixXd& W) {
  const Eigen::MatrixXd shifted = W + kNoise * W.trace() * Eigen::MatrixXd::Identity(W.rows(), W.cols());
  return W.isZero(0.0) || Eigen::LLT<Eigen::MatrixXd>(shifted).info() == Eigen::Success;
}

}  // namespace

double Inertia::bound(const Eigen::VectorXd& r) const {
  Eigen::VectorXd f = r;
  mass->divide(*state, Reals(f.data(), static_cast<std::size_t>(f.size())));
  return r.dot(f);
}

bool KeptFactor::find(const BlockMatrix& A, const PointLoads& loads, const Inertia& inertia,
                      double tolerance) {
  error_ = 0.0;
  corrections_ = 0;
  made_ = false;
  if (id_ == A.id() && !factor_.is_of(A, true) && correct(A, loads, inertia, tolerance)) return true;
  if ((id_ != A.id() || !factor_.is_of(A, true)) && !renew(A)) return false;
  combine(A, loads);
  W_ = loads.motions(X_);
  make_symmetric(W_);
  error_ = 0.0;
  return true;
}

bool KeptFactor::renew(const BlockMatrix& A) {
  factor_.make(A, true);
  id_ = A.id();
  kept_.clear();
  made_ = true;
  return factor_.is_definite();
}

void KeptFactor::combine(const BlockMatrix& A, const PointLoads& loads) {
  std::vector<std::int32_t> missing;
  const auto collect = [&] {
    for (const PointLoads::Entry& e : loads.entries()) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t number = 3 * e.row + axis;
        if (e.load[axis] == 0.0 || kept_.contains(number)) continue;
        kept_.emplace(number, Eigen::VectorXd());
        missing.push_back(number);
      }
    }
  };
  collect();
  if (kept_.size() * static_cast<std::size_t>(3 * A.rows()) > kMostNumbers) {
    kept_.clear();  // all but those that are asked for now
    missing.clear();
    collect();
  }
  solve_columns(A.rows(), missing);
  X_.setZero(3 * static_cast<Eigen::Index>(A.rows()), loads.columns());
  for (const PointLoads::Entry& e : loads.entries()) {
    for (int axis = 0; axis < 3; ++axis) {
      if (e.load[axis] != 0.0) X_.col(e.column) += e.load[axis] * kept_.at(3 * e.row + axis);
    }
  }
}

void KeptFactor::solve_columns(std::int32_t rows, const std::vector<std::int32_t>& numbers) {
  if (numbers.empty()) return;
  const auto count = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(rows), count);
  for (Eigen::Index c = 0; c < count; ++c) right(numbers[static_cast<std::size_t>(c)], c) = 1.0;
  Eigen::MatrixXd answer(right.rows(), count);
  const auto size = static_cast<std::size_t>(right.size());
  factor_.solve_all(static_cast<int>(count), {right.data(), size}, {answer.data(), size});
  for (Eigen::Index c = 0; c < count; ++c) kept_[numbers[static_cast<std::size_t>(c)]] = answer.col(c);
}

bool KeptFactor::correct(const BlockMatrix& A, const PointLoads& loads, const Inertia& inertia,
                         double tolerance) {
  combine(A, loads);
  multiply(A, X_, Y_);
  R_ = loads.right(A.rows()) - Y_;
  for (;; ++corrections_) {
    judge(loads, inertia);
    if (error_ <= tolerance) return is_semidefinite(W_);
    if (corrections_ == kMostCorrections) return false;
    if (corrections_ == 0) {
      solve_far();
    } else {
      solve_near(A);
    }
    improve(A);
  }
}

void KeptFactor::judge(const PointLoads& loads, const Inertia& inertia) {
  W_ = loads.motions(X_) + X_.transpose() * R_;
  make_symmetric(W_);
  if (inertia.mass == nullptr && !iterates_) solve_far();
  error_ = 0.0;
  for (Eigen::Index c = 0; c < W_.cols(); ++c) {
    const double left = inertia.mass != nullptr ? inertia.bound(R_.col(c)) : Z_.col(c).dot(R_.col(c));
    if (left == 0.0) continue;
    const double share = W_(c, c) > 0.0 ? left / W_(c, c) : std::numeric_limits<double>::infinity();
    error_ = share <= error_ ? error_ : share;  // not a number counts as too large
  }
}

void KeptFactor::improve(const BlockMatrix& A) {
  multiply(A, Z_, Y_);
  Eigen::MatrixXd G = Z_.transpose() * Y_;
  G.diagonal().array() += 1e-14 * G.trace();
  const Eigen::MatrixXd c = G.ldlt().solve(Z_.transpose() * R_);
  X_ += Z_ * c;
  R_ -= Y_ * c;
}

void KeptFactor::solve_near(const BlockMatrix& A) {
  std::vector<double> sizes(static_cast<std::size_t>(A.rows()));
  for (std::int32_t row = 0; row < A.rows(); ++row) {
    sizes[static_cast<std::size_t>(row)] = R_.middleRows<3>(3 * static_cast<Eigen::Index>(row)).squaredNorm();
  }
  std::vector<std::int32_t> rows(sizes.size());
  std::iota(rows.begin(), rows.end(), 0);
  const auto count = static_cast<std::size_t>(std::min(kNear, A.rows()));
  std::ranges::partial_sort(rows, rows.begin() + static_cast<std::ptrdiff_t>(count), [&](auto a, auto b) {
    const double first = sizes[static_cast<std::size_t>(a)];
    const double second = sizes[static_cast<std::size_t>(b)];
    return first != second ? first > second : a < b;
  });
  rows.resize(count);
  const auto size = 3 * static_cast<Eigen::Index>(count);
  Eigen::MatrixXd near = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd right(size, R_.cols());
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = 3 * static_cast<Eigen::Index>(i);
    right.middleRows<3>(at) = R_.middleRows<3>(3 * static_cast<Eigen::Index>(rows[i]));
    for (std::size_t j = 0; j < count; ++j) {
      const std::int32_t slot = A.sparsity().slot(rows[i], rows[j]);
      if (slot < 0) continue;
      near.block<3, 3>(at, 3 * static_cast<Eigen::Index>(j)) =
          Eigen::Map<const Mat3>(A.values() + 9 * static_cast<std::ptrdiff_t>(slot));
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(near);
  Z_.setZero(R_.rows(), R_.cols());
  const Eigen::MatrixXd answer =
      factor.info() == Eigen::Success ? Eigen::MatrixXd(factor.solve(right)) : right;
  for (std::size_t i = 0; i < count; ++i) {
    Z_.middleRows<3>(3 * static_cast<Eigen::Index>(rows[i])) =
        answer.middleRows<3>(3 * static_cast<Eigen::Index>(i));
  }
}

void KeptFactor::solve_far() {
  Z_.resize(R_.rows(), R_.cols());
  const auto size = static_cast<std::size_t>(R_.size());
  factor_.solve_all(static_cast<int>(R_.cols()), {R_.data(), size}, {Z_.data(), size});
}

bool KeptFactor::iterate(const BlockMatrix& A, const PointLoads& loads, const Inertia& inertia,
                         double tolerance) {
  corrections_ = 0;
  made_ = false;
  iterates_ = true;
  const Eigen::MatrixXd right = loads.right(A.rows());
  X_.setZero(right.rows(), right.cols());
  ConjugateGradient rough({.tolerance = kFirstTolerance});  // of what is left, where no inertia bounds it
  for (double now = kFirstTolerance; now >= kLastTolerance; now *= 0.1) {
    ConjugateGradient solver({.tolerance = now});
    for (Eigen::Index c = 0; c < right.cols(); ++c) {
      const SolveReport report = solver.solve(A, numbers(right, c), numbers(X_, c), 0.0);
      corrections_ += report.iterations;
      if (!report.positive_definite) return false;
    }
    multiply(A, X_, Y_);
    R_ = right - Y_;
    if (inertia.mass == nullptr) Z_.setZero(right.rows(), right.cols());
    for (Eigen::Index c = 0; inertia.mass == nullptr && c < right.cols(); ++c) {
      corrections_ += rough.solve(A, numbers(R_, c), numbers(Z_, c), 0.0).iterations;
    }
    judge(loads, inertia);
    if (error_ <= tolerance) break;
  }
  return is_semidefinite(W_);
}

Eigen::MatrixXd KeptFactor::among(const BlockMatrix& A, std::span<const std::int32_t> rows) {
  renew(A);
  const auto size = 3 * static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd table(size, size);
  Eigen::Index column = 0;
  for (const std::int32_t row : rows) {
    const std::vector<std::int32_t> numbers = {3 * row, 3 * row + 1, 3 * row + 2};
    solve_columns(A.rows(), numbers);
    for (const std::int32_t number : numbers) {
      const Eigen::VectorXd& answer = kept_.at(number);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        table.col(column).segment<3>(3 * static_cast<Eigen::Index>(i)) =
            answer.segment<3>(3 * static_cast<Eigen::Index>(rows[i]));
      }
      ++column;
    }
    kept_.clear();
  }
  make_symmetric(table);
  return table;
}

}  // namespace tissu
