#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Trilinear hexahedron on (-1, 1)^3, nodes as in VTK: the bottom quadrangle, then the top one.
struct Hexahedron8 {
  static constexpr std::string_view kName = "hexahedron";
  static constexpr int kNodes = 8;
  static constexpr bool kAffine = false;
  using Full = CubeGauss<2>;  ///< exact for the stiffness of a parallelepiped under Hooke's law
  using Over = CubeGauss<3>;  ///< exact for St-Venant–Kirchhoff on a parallelepiped

  static constexpr std::array<std::array<double, 3>, 8> corners = {
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

  static constexpr std::array<double, 8> values(const std::array<double, 3>& xi) {
    std::array<double, 8> N{};
    for (std::size_t a = 0; a < 8; ++a) {
      N[a] = 0.125 * (1 + corners[a][0] * xi[0]) * (1 + corners[a][1] * xi[1]) * (1 + corners[a][2] * xi[2]);
    }
    return N;
  }
  static constexpr std::array<std::array<double, 3>, 8> gradients(const std::array<double, 3>& xi) {
    std::array<std::array<double, 3>, 8> dN{};
    for (std::size_t a = 0; a < 8; ++a) {
      const auto& c = corners[a];
      const double fx = 1 + c[0] * xi[0];
      const double fy = 1 + c[1] * xi[1];
      const double fz = 1 + c[2] * xi[2];
      dN[a] = {0.125 * c[0] * fy * fz, 0.125 * fx * c[1] * fz, 0.125 * fx * fy * c[2]};
    }
    return dN;
  }
};

}  // namespace tissu
