#include "tissu/field/cell_gradients.h"

#include <Eigen/LU>
#include <string>

#include "tissu/base/error.h"
#include "tissu/element/reference_cell.h"

namespace tissu {
namespace {

using Gradient = Eigen::Map<const Eigen::RowVector3d>;

/// grad N_a = J^-T dN_a/dxi at a point, added to `out`.
void add_gradients(const ReferenceCell::Point& point, std::span<const std::int32_t> cell, ConstReals X,
                   double share, std::size_t number, Reals out) {
  Mat3 J = Mat3::Zero();
  for (std::size_t a = 0; a < cell.size(); ++a) J += block(X, cell[a]) * Gradient(point.gradients[a].data());
  const Mat3 inverse = J.inverse().transpose();
  if (!(J.determinant() > 0.0) || !inverse.allFinite()) {
    throw MeshError("cell " + std::to_string(number) + " is inverted or has no volume; mend the mesh.");
  }
  for (std::size_t a = 0; a < cell.size(); ++a)
    block(out, static_cast<std::int32_t>(a)) +=
        share * (inverse * Gradient(point.gradients[a].data()).transpose());
}

}  // namespace

std::vector<double> mean_gradients(std::string_view element, ConstReals positions,
                                   std::span<const std::int32_t> cells) {
  const ReferenceCell reference = reference_cell(element, "full");
  const auto nodes = static_cast<std::size_t>(reference.nodes);
  if (reference.points.empty() || reference.dimension != 3 || cells.size() % nodes != 0) {
    throw MeshError("cells of type " + std::string(element) +
                    " have no gradient in space; whole volume cells are accepted.");
  }
  std::vector<double> result(3 * cells.size(), 0.0);
  const double share = 1.0 / static_cast<double>(reference.points.size());
  for (std::size_t e = 0; e < cells.size() / nodes; ++e) {
    const Reals out = Reals(result).subspan(3 * e * nodes, 3 * nodes);
    for (const ReferenceCell::Point& point : reference.points)
      add_gradients(point, cells.subspan(e * nodes, nodes), positions, share, e, out);
  }
  return result;
}

}  // namespace tissu
