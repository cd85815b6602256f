#include "tissu/element/measure.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tissu {

std::vector<double> measures(const ReferenceCell& reference, std::span<const std::int32_t> nodes,
                             ConstReals positions) {
  const auto width = static_cast<std::size_t>(reference.nodes);
  std::vector<double> sizes(nodes.size() / width, 0.0);
  for (std::size_t e = 0; e < sizes.size(); ++e) {
    for (const ReferenceCell::Point& point : reference.points) {
      Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, reference.dimension);
      for (std::size_t a = 0; a < width; ++a) {
        const Eigen::Map<const Eigen::RowVectorXd> gradient(point.gradients[a].data(), reference.dimension);
        J += block(positions, nodes[e * width + a]) * gradient;
      }
      sizes[e] += point.weight * std::sqrt(std::max(0.0, (J.transpose() * J).determinant()));
    }
  }
  return sizes;
}

}  // namespace tissu
