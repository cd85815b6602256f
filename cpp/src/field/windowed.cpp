#include "shape_row.h"
#include "window.h"

/// Normalised windows, of the k nearest frames: w_i = phi_i / S, S = sum_j phi_j;
/// dw_i/dX = (dphi_i/dX - w_i dS/dX) / S [1/m].

namespace tissu {
namespace {

class Windowed final : public ShapeFunction {
 public:
  Windowed(const ShapeRequest& request, Window window)
      : near_(request), window_(window), radius_(request.use.radius) {}
  [[nodiscard]] int neighbours() const override { return near_.neighbours(); }
  [[nodiscard]] std::string fill(const Vec3& x, ShapeRow& row) override;

 private:
  Neighbourhood near_;
  Window window_;
  double radius_;
  WindowValues values_;
};

std::string Windowed::fill(const Vec3& x, ShapeRow& row) {
  near_.move_to(x, row);
  evaluate_window(window_, radius_, near_.offsets(), near_.distances(), values_);
  const double S = values_.phi.sum();
  if (!(S > 0.0)) return unreached(near_.distances()[0], radius_);
  const Vec3 dS = values_.gradients.rowwise().sum();
  for (std::size_t i = 0; i < row.weights.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    row.weights[i] = values_.phi[column] / S;
    row.gradients[i] = (values_.gradients.col(column) - row.weights[i] * dS) / S;
  }
  return {};
}

}  // namespace

std::unique_ptr<ShapeFunction> make_wendland(const ShapeRequest& request) {
  return std::make_unique<Windowed>(request, wendland_window);
}

std::unique_ptr<ShapeFunction> make_cubic_spline(const ShapeRequest& request) {
  return std::make_unique<Windowed>(request, cubic_spline_window);
}

}  // namespace tissu
