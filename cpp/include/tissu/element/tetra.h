#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Linear tetrahedron, nodes (0,0,0) (1,0,0) (0,1,0) (0,0,1) as in VTK.
struct Tetra4 {
  static constexpr std::string_view kName = "tetra";
  static constexpr int kNodes = 4;
  static constexpr bool kAffine = true;  ///< one Jacobian serves the whole cell
  using Full = TetraCentroid;            ///< F is constant, so one point is exact for every law
  using Over = TetraCentroid;

  static constexpr std::array<double, 4> values(const std::array<double, 3>& xi) {
    return {1.0 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};
  }
  static constexpr std::array<std::array<double, 3>, 4> gradients(const std::array<double, 3>& /*xi*/) {
    return {{{-1.0, -1.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  }
};

}  // namespace tissu
