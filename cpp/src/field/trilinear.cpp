#include <algorithm>
#include <array>
#include <cmath>

#include "grid.h"
#include "shape_row.h"
#include "tissu/base/error.h"

/// The trilinear functions of a grid of frames (bosman2014 section 5.2): with xi_a the place of the point in
/// its cell along axis a, 0 to 1, and h_a the cell's edge [m],
///
///   w = prod_a N_a,   N_a = xi_a or 1 - xi_a,   dw/dX_a = +-1/h_a prod_(b != a) N_b [1/m]
///
/// An axis along which the grid has one layer only is left out.

namespace tissu {
namespace {

constexpr double kBeyond = 0.5;     ///< of the outermost cell's edge
constexpr double kRoundOff = 1e-9;  ///< of that edge

/// Along one axis: the first of two layers, the weights of both and their derivatives.
struct Along {
  std::size_t first = 0;
  std::size_t layers = 1;
  std::array<double, 2> values{1.0, 0.0};
  std::array<double, 2> slopes{};
};

class Trilinear final : public ShapeFunction {
 public:
  explicit Trilinear(const ShapeRequest& request);
  [[nodiscard]] int neighbours() const override { return neighbours_; }
  [[nodiscard]] std::string fill(const Vec3& x, ShapeRow& row) override;

 private:
  Grid grid_;
  int neighbours_ = 1;
};

Trilinear::Trilinear(const ShapeRequest& request) {
  std::optional<Grid> grid = find_grid(request.frames);
  if (!grid) {
    throw MeshError(request.where + "the " + std::to_string(request.nearest.count()) +
                    " frames are not a grid along the axes, as the shape function trilinear needs: each "
                    "combination of some x, some y and some z once; make such a grid or take another shape "
                    "function.");
  }
  grid_ = std::move(*grid);
  int dimension = 0;
  for (const auto& axis : grid_.coordinates) dimension += axis.size() > 1 ? 1 : 0;
  neighbours_ = 1 << dimension;
  check_implied_neighbours(request, neighbours_, "its grid has " + std::to_string(dimension) + " dimensions");
}

/// False where the point is too far beyond the ends; `beyond` is how far, `accepted` how far it may be.
bool find_along(const std::vector<double>& layers, double x, Along& along, double& beyond, double& accepted) {
  if (layers.size() == 1) return true;
  const auto after = std::ranges::upper_bound(layers, x) - layers.begin();
  along.first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(layers.size()) - 2));
  along.layers = 2;
  const double h = layers[along.first + 1] - layers[along.first];
  const double xi = (x - layers[along.first]) / h;
  along.values = {(layers[along.first + 1] - x) / h, xi};
  along.slopes = {-1.0 / h, 1.0 / h};
  beyond = std::max(-xi, xi - 1.0) * h;
  accepted = kBeyond * h;
  return beyond <= accepted + kRoundOff * h;
}

std::string Trilinear::fill(const Vec3& x, ShapeRow& row) {
  std::array<Along, 3> along;
  for (std::size_t a = 0; a < 3; ++a) {
    double beyond = 0.0;
    double accepted = 0.0;
    if (find_along(grid_.coordinates[a], x[static_cast<Eigen::Index>(a)], along[a], beyond, accepted))
      continue;
    return "lies " + metres(beyond) + " beyond the grid of its frames along " + std::string(1, "xyz"[a]) +
           ", where half a cell, " + metres(accepted) + ", is accepted; let the grid reach it";
  }
  const auto& [X, Y, Z] = along;
  std::size_t n = 0;
  for (std::size_t k = 0; k < Z.layers; ++k) {
    for (std::size_t j = 0; j < Y.layers; ++j) {
      for (std::size_t i = 0; i < X.layers; ++i, ++n) {
        row.frames[n] = grid_.number({X.first + i, Y.first + j, Z.first + k});
        row.weights[n] = X.values[i] * Y.values[j] * Z.values[k];
        row.gradients[n] = {X.slopes[i] * Y.values[j] * Z.values[k], X.values[i] * Y.slopes[j] * Z.values[k],
                            X.values[i] * Y.values[j] * Z.slopes[k]};
      }
    }
  }
  return {};
}

}  // namespace

std::unique_ptr<ShapeFunction> make_trilinear(const ShapeRequest& request) {
  return std::make_unique<Trilinear>(request);
}

}  // namespace tissu
