#include "tissu/step/anderson.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace tissu {
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Anderson::kMost, Anderson::kMost>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Anderson::kMost, 1>;

/// Keeps differences that are nearly the same apart, once each is scaled to length 1.
constexpr double kRegularisation = 1e-13;

double dot(ConstReals a, ConstReals b, ConstReals weight) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weight[i] * a[i] * b[i];
  return sum;
}

}  // namespace

void Anderson::resize(std::size_t size) {
  x_.assign(size, 0.0);
  change_.assign(size, 0.0);
  const std::vector<double> none(size, 0.0);
  x_differences_.assign(static_cast<std::size_t>(depth_), none);
  change_differences_.assign(static_cast<std::size_t>(depth_), none);
  count_ = 0;
}

void Anderson::advance(Reals x, ConstReals change, double mixing, ConstReals weight) {
  if (depth_ > 0 && count_ > 0) {
    const auto slot = static_cast<std::size_t>((count_ - 1) % depth_);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x_differences_[slot][i] = x[i] - x_[i];
      change_differences_[slot][i] = change[i] - change_[i];
    }
  }
  if (depth_ > 0) {
    std::ranges::copy(x, x_.begin());
    std::ranges::copy(change, change_.begin());
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += mixing * change[i];
  const int known = std::min(count_, depth_);
  ++count_;
  if (known == 0) return;

  Small gram(known, known);
  SmallVector right(known);
  for (int a = 0; a < known; ++a) {
    const auto& row = change_differences_[static_cast<std::size_t>(a)];
    for (int b = 0; b <= a; ++b) {
      gram(a, b) = gram(b, a) = dot(row, change_differences_[static_cast<std::size_t>(b)], weight);
    }
    right(a) = dot(row, change, weight);
  }
  // Later differences may be far smaller than earlier ones.
  const SmallVector scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  gram = scale.asDiagonal() * gram * scale.asDiagonal();
  gram.diagonal().array() += kRegularisation;
  const SmallVector shares = scale.cwiseProduct(gram.ldlt().solve(scale.cwiseProduct(right)).eval());
  if (!shares.allFinite()) return;
  for (int a = 0; a < known; ++a) {
    const auto& dx = x_differences_[static_cast<std::size_t>(a)];
    const auto& dg = change_differences_[static_cast<std::size_t>(a)];
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= shares(a) * (dx[i] + mixing * dg[i]);
  }
}

}  // namespace tissu
