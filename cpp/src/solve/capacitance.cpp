#include "capacitance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <span>

#include "work.h"

namespace tissu {
namespace {

constexpr double kZero = 1e-14;  ///< of the largest eigenvalue of H: round-off
/// Time of each of the columns that are solved for at once, over that of a solve alone: dense kernels read
/// the factor once for all of them. 0.31 was measured for 12,000 unknowns.
constexpr double kColumn = 0.31;
constexpr std::size_t kAtOnce = 12;  ///< rows of A: more columns at once are hardly faster

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

}  // namespace

/// The rows of G, and the rows of A that it touches.
bool Capacitance::lay_rows(const Couplings& couplings) {
  const std::vector<Coupling>& list = couplings.list();
  if (list.size() > static_cast<std::size_t>(kMostRows)) return false;
  touched_.clear();
  for (std::size_t c = 0; c < list.size(); ++c) {
    for (const Couplings::Term& term : couplings.terms(c)) touched_.push_back(term.row);
  }
  std::ranges::sort(touched_);
  touched_.erase(std::ranges::unique(touched_).begin(), touched_.end());
  G_.setZero(kMostRows, 3 * static_cast<Eigen::Index>(touched_.size()));
  Eigen::Index count = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(list[c].H);
    const double least = kZero * eigen.eigenvalues()[2];
    for (int k = 0; k < 3; ++k) {
      if (!(eigen.eigenvalues()[k] > least)) continue;
      if (count == kMostRows) return false;
      const Vec3 g = std::sqrt(eigen.eigenvalues()[k]) * eigen.eigenvectors().col(k);
      for (const Couplings::Term& term : couplings.terms(c)) {
        const auto number = std::ranges::lower_bound(touched_, term.row) - touched_.begin();
        G_.row(count).segment<3>(3 * number) += (term.B.transpose() * g).transpose();
      }
      ++count;
    }
  }
  G_.conservativeResize(count, G_.cols());
  return true;
}

/// Columns of the inverse of another matrix are dropped.
void Capacitance::take_matrix(const BlockMatrix& A) {
  size_ = 3 * static_cast<Eigen::Index>(A.rows());
  if (matrix_id_ == A.id() && values_version_ == A.values_version()) return;
  matrix_id_ = A.id();
  values_version_ = A.values_version();
  spent_ = 0;
  solved_.clear();
  inverse_.clear();
}

Eigen::Index Capacitance::place(std::int32_t row) const {
  return std::ranges::find(solved_, row) - solved_.begin();
}

/// Rows that are touched, and have no columns of the inverse.
std::size_t Capacitance::list_missing() {
  missing_.clear();
  for (const std::int32_t row : touched_) {
    if (at(place(row)) == solved_.size()) missing_.push_back(row);
  }
  return missing_.size();
}

bool Capacitance::make(SparseFactor& factor, const BlockMatrix& A) {
  id_ = 0;
  making_ = 0.0;
  if (!lay_rows(*A.couplings())) return false;
  take_matrix(A);
  const double column = sizeof(double) * static_cast<double>(size_);
  const auto fill = static_cast<std::size_t>(factor.number_bytes() / (3.0 * column));
  const std::size_t most = std::clamp(fill, kFewSolved, kMostSolved);
  if (solved_.size() + list_missing() > most) {
    solved_.clear();
    inverse_.clear();
    missing_ = touched_;
  }
  const auto wanted = 3 * static_cast<Eigen::Index>(missing_.size());
  // A second system with the same A is followed by others, as a rule.
  of_rows_ = wanted <= 2 * spent_ + G_.rows() && touched_.size() <= most;
  if (of_rows_) {
    solve_rows(factor);
  } else {
    solve_couplings(factor);
  }
  S_ = (0.5 * (S_ + S_.transpose())).eval();
  S_.diagonal().array() += 1.0;
  factor_.compute(S_);
  if (factor_.info() != Eigen::Success) return false;
  id_ = A.id();
  version_ = A.version();
  return true;
}

/// S = G A^-1 G^T from columns of A^-1, of which those that are missing are solved for.
void Capacitance::solve_rows(SparseFactor& factor) {
  if (!missing_.empty()) spent_ = 0;
  inverse_.reserve(inverse_.size() + at(3 * size_) * missing_.size());
  for (std::size_t first = 0; first < missing_.size(); first += kAtOnce) {
    const std::span<const std::int32_t> rows =
        std::span(missing_).subspan(first, std::min(kAtOnce, missing_.size() - first));
    const auto count = 3 * static_cast<Eigen::Index>(rows.size());
    const std::size_t begin = inverse_.size();
    right_.assign(at(size_ * count), 0.0);
    for (Eigen::Index i = 0; i < count; ++i) right_[at(i * size_ + 3 * rows[at(i / 3)] + i % 3)] = 1.0;
    inverse_.resize(begin + right_.size());
    factor.solve_all(static_cast<int>(count), right_, Reals(inverse_).subspan(begin));
    solved_.insert(solved_.end(), rows.begin(), rows.end());
    making_ += kColumn * static_cast<double>(count) * factor.application();
  }
  lay_inverse();
  S_.noalias() = G_ * K_ * G_.transpose();
}

/// Blocks of A^-1, each from the columns of the row with the lower number.
void Capacitance::lay_inverse() {
  const auto rows = static_cast<Eigen::Index>(touched_.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_.data(), size_,
                                                  3 * static_cast<Eigen::Index>(solved_.size()));
  K_.resize(3 * rows, 3 * rows);
  for (Eigen::Index a = 0; a < rows; ++a) {
    const Eigen::Index column = 3 * place(touched_[at(a)]);
    for (Eigen::Index b = a; b < rows; ++b) {
      const Mat3 block = inverse.block<3, 3>(3 * touched_[at(b)], column);
      K_.block<3, 3>(3 * b, 3 * a) = block;
      K_.block<3, 3>(3 * a, 3 * b) = block.transpose();
    }
  }
}

/// W itself, and S = G W.
void Capacitance::solve_couplings(SparseFactor& factor) {
  const Eigen::Index count = G_.rows();
  const auto rows = static_cast<Eigen::Index>(touched_.size());
  spent_ += count;
  right_.assign(at(size_ * count), 0.0);
  W_.resize(right_.size());
  Eigen::Map<Eigen::MatrixXd> right(right_.data(), size_, count);
  for (Eigen::Index r = 0; r < rows; ++r) {
    right.middleRows<3>(3 * touched_[at(r)]) = G_.middleCols<3>(3 * r).transpose();
  }
  if (count > 0) factor.solve_all(static_cast<int>(count), right_, W_);
  making_ = kColumn * static_cast<double>(count) * factor.application();
  const Eigen::Map<const Eigen::MatrixXd> W(W_.data(), size_, count);
  S_.setZero(count, count);
  for (Eigen::Index r = 0; r < rows; ++r) {
    S_.noalias() += G_.middleCols<3>(3 * r) * W.middleRows<3>(3 * touched_[at(r)]);
  }
}

void Capacitance::solve(SparseFactor& factor, ConstReals b, Reals x) {
  factor.solve(b, x);
  Eigen::Map<Eigen::VectorXd> y(x.data(), size_);
  const auto rows = static_cast<Eigen::Index>(touched_.size());
  y_.resize(3 * rows);
  for (Eigen::Index r = 0; r < rows; ++r) y_.segment<3>(3 * r) = y.segment<3>(3 * touched_[at(r)]);
  shares_.noalias() = G_ * y_;
  factor_.solveInPlace(shares_);
  if (!of_rows_) {
    y.noalias() -= Eigen::Map<const Eigen::MatrixXd>(W_.data(), size_, G_.rows()) * shares_;
    return;
  }
  y_.noalias() = G_.transpose() * shares_;
  const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_.data(), size_,
                                                  3 * static_cast<Eigen::Index>(solved_.size()));
  for (Eigen::Index r = 0; r < rows; ++r) {
    y.noalias() -= inverse.middleCols<3>(3 * place(touched_[at(r)])) * y_.segment<3>(3 * r);
  }
}

void Capacitance::forget() {
  id_ = 0;
  matrix_id_ = 0;
  solved_.clear();
  inverse_ = {};
}

double Capacitance::application() const {
  const auto columns = of_rows_ ? G_.cols() : G_.rows();
  return static_cast<double>(columns * size_) * sizeof(double);
}

std::size_t Capacitance::bytes() const {
  return (inverse_.capacity() + right_.capacity() + W_.capacity() + at(G_.size() + K_.size() + S_.size())) *
         sizeof(double);
}

}  // namespace tissu
