#include <Eigen/Cholesky>
#include <cmath>

#include "affine_span.h"
#include "shape_row.h"
#include "window.h"

/// First-order moving least squares with Wendland's window (Belytschko, Lu and Gu, Element-free Galerkin
/// methods, Int. J. Numer. Methods Eng. 37, 1994):
///
///   w_i = p^T M^-1 b_i phi_i,   M = sum_j phi_j b_j b_j^T,   b_i = (1, A^T (x_i - X0) / h)
///
/// about the point X0 itself, where p = (1, 0, 0, 0) and dp/dX = (0, A^T / h). With C_i = M^-1 b_i,
/// alpha_i = p . C_i and Q = sum_j alpha_j dphi_j/dX (x) b_j:
///
///   dw_i/dX = phi_i ((A / h) C_i - Q C_i) + alpha_i dphi_i/dX [1/m]
///
/// The columns of A are the axes that the reached neighbours span. Where these lie in a plane or on a line
/// the others are left out, and M has a one instead: that is M's pseudo-inverse, and complete within the
/// span.

namespace tissu {
namespace {

constexpr double kNearlyFlat = 1e-2;   ///< of a span's extents: gradients would be a hundred times too steep
constexpr double kMostExcess = 100.0;  ///< sum |w_i| of an extrapolation
constexpr double kIncomplete = 1e-7;   ///< round-off in what must be X and the identity

class MovingLeastSquares final : public ShapeFunction {
 public:
  explicit MovingLeastSquares(const ShapeRequest& request) : near_(request), radius_(request.use.radius) {}
  [[nodiscard]] int neighbours() const override { return near_.neighbours(); }
  [[nodiscard]] std::string fill(const Vec3& x, ShapeRow& row) override;

 private:
  /// The axes A / h, and b_i in the columns of basis_. False where the span is neither flat nor well-shaped.
  bool find_basis();
  /// alpha_i, C_i and Q.
  void solve();
  [[nodiscard]] bool is_complete(const ShapeRow& row) const;

  Neighbourhood near_;
  double radius_;
  WindowValues window_;
  int dimension_ = 0;
  Mat3 axes_;       ///< A / h, zero for what is left out [1/m]
  double h_ = 1.0;  ///< distance of the farthest neighbour that is reached [m]
  Eigen::Matrix<double, 4, Eigen::Dynamic> basis_;  ///< b_i
  Eigen::Matrix<double, 4, Eigen::Dynamic> C_;
  Eigen::Matrix<double, 3, 4> Q_;
};

bool MovingLeastSquares::find_basis() {
  const Eigen::Index k = near_.distances().size();
  Eigen::Index reached = 0;  // nearest first: what the window reaches comes first
  while (reached < k && window_.phi[reached] > 0.0) ++reached;
  const AffineSpan span = affine_span(near_.offsets().leftCols(reached));
  if (span.flatness < kNearlyFlat) return false;
  dimension_ = span.dimension;
  h_ = near_.distances()[reached - 1] > 0.0 ? near_.distances()[reached - 1] : 1.0;
  axes_ = span.axes / h_;
  axes_.rightCols(3 - dimension_).setZero();
  basis_.resize(4, k);
  basis_.row(0).setOnes();
  basis_.bottomRows<3>().noalias() = -axes_.transpose() * near_.offsets();
  return true;
}

void MovingLeastSquares::solve() {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  for (int i = dimension_ + 1; i < 4; ++i) M(i, i) = 1.0;
  for (Eigen::Index i = 0; i < basis_.cols(); ++i) {
    M.noalias() += window_.phi[i] * basis_.col(i) * basis_.col(i).transpose();
  }
  C_ = M.ldlt().solve(basis_);
  Q_.setZero();
  for (Eigen::Index j = 0; j < basis_.cols(); ++j) {
    Q_.noalias() += C_(0, j) * window_.gradients.col(j) * basis_.col(j).transpose();
  }
}

bool MovingLeastSquares::is_complete(const ShapeRow& row) const {
  Eigen::Vector4d value = -Eigen::Vector4d::Unit(0);
  Eigen::Matrix<double, 3, 4> gradient = Eigen::Matrix<double, 3, 4>::Zero();
  gradient.rightCols<3>() = -axes_;
  double excess = 0.0;
  for (std::size_t i = 0; i < row.weights.size(); ++i) {
    const auto b = basis_.col(static_cast<Eigen::Index>(i));
    value += row.weights[i] * b;
    gradient += row.gradients[i] * b.transpose();
    excess += std::abs(row.weights[i]);
  }
  return value.norm() <= kIncomplete && gradient.norm() * h_ <= kIncomplete && excess <= kMostExcess;
}

std::string MovingLeastSquares::fill(const Vec3& x, ShapeRow& row) {
  near_.move_to(x, row);
  evaluate_window(wendland_window, radius_, near_.offsets(), near_.distances(), window_);
  const double most = window_.phi[0];
  if (!(most > 0.0)) return unreached(near_.distances()[0], radius_);
  window_.phi /= most;  // the weights do not change, and M is near one
  window_.gradients /= most;
  if (!find_basis()) {
    return "has neighbours that lie nearly in one plane or on one line; ask for more neighbours, or move the "
           "frames apart or fully into the plane";
  }
  solve();
  for (std::size_t i = 0; i < row.weights.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto C = C_.col(column);
    row.weights[i] = C[0] * window_.phi[column];
    row.gradients[i] =
        window_.phi[column] * (axes_ * C.tail<3>() - Q_ * C) + C[0] * window_.gradients.col(column);
  }
  if (is_complete(row)) return {};
  return "lies far outside of its frames, or these are too few in its support; "
         "add frames around it, or ask for a greater radius or more neighbours";
}

}  // namespace

std::unique_ptr<ShapeFunction> make_moving_least_squares(const ShapeRequest& request) {
  return std::make_unique<MovingLeastSquares>(request);
}

}  // namespace tissu
