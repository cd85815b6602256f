#include <cmath>
#include <limits>

#include "shape_row.h"

/// Shepard's inverse distance weighting over the k nearest frames (Shepard, A two-dimensional interpolation
/// function for irregularly-spaced data, Proc. 23rd ACM National Conference, 1968):
///
///   w_i = d_i^-p / sum_j d_j^-p,   d_i = |X - x_i| [m]
///   dw_i/dX = w_i sum_j w_j (g_i - g_j),   g_i = d(ln d_i^-p)/dX = -p (X - x_i) / d_i^2 [1/m]
///
/// At a frame w_i = 1, and for p > 1 all gradients vanish: the others go with d_i^p.

namespace tissu {
namespace {

class Shepard final : public ShapeFunction {
 public:
  explicit Shepard(const ShapeRequest& request) : near_(request), power_(request.use.power) {}
  [[nodiscard]] int neighbours() const override { return near_.neighbours(); }
  [[nodiscard]] std::string fill(const Vec3& x, ShapeRow& row) override;

 private:
  Neighbourhood near_;
  double power_;
};

std::string Shepard::fill(const Vec3& x, ShapeRow& row) {
  near_.move_to(x, row);
  const Eigen::VectorXd& d = near_.distances();
  const auto k = row.weights.size();
  double sum = 0.0;
  if (d[0] * d[0] < std::numeric_limits<double>::min()) {
    row.weights[0] = 1.0;
    return {};
  }
  for (std::size_t i = 0; i < k; ++i) {
    row.weights[i] = std::pow(d[0] / d[static_cast<Eigen::Index>(i)], power_);  // (0, 1]: nothing overflows
    sum += row.weights[i];
  }
  for (double& w : row.weights) w /= sum;
  const auto g = [&](std::size_t i) -> Vec3 {
    const auto column = static_cast<Eigen::Index>(i);
    return near_.offsets().col(column) * (-power_ / (d[column] * d[column]));
  };
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 share = row.weights[i] * row.weights[j] * (g(i) - g(j));
      row.gradients[i] += share;
      row.gradients[j] -= share;
    }
  }
  return {};
}

}  // namespace

std::unique_ptr<ShapeFunction> make_shepard(const ShapeRequest& request) {
  return std::make_unique<Shepard>(request);
}

}  // namespace tissu
