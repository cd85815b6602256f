#pragma once

/// Quadrature rules on the reference cells: points and weights that sum to the reference volume.

#include <array>

namespace tissu {

template <int Dimension>
struct WeightedPoint {
  std::array<double, Dimension> xi;
  double weight;
};
using QuadraturePoint = WeightedPoint<3>;

/// One point at the centroid of the reference tetrahedron (volume 1/6): exact for degree 1.
struct TetraCentroid {
  static constexpr int kPoints = 1;
  static constexpr std::array<QuadraturePoint, 1> points = {{{{0.25, 0.25, 0.25}, 1.0 / 6.0}}};
};

/// Gauss–Legendre on the cube (-1, 1)^3, N points a side: exact for degree 2 N - 1 in each direction.
template <int N>
struct CubeGauss {
  static_assert(N == 2 || N == 3);
  static constexpr int kPoints = N * N * N;
  static constexpr std::array<QuadraturePoint, kPoints> points = [] {
    constexpr double a = N == 2 ? 0.57735026918962576451 : 0.77459666924148337704;
    constexpr std::array<double, 3> x =
        N == 2 ? std::array<double, 3>{-a, a, 0.0} : std::array<double, 3>{-a, 0.0, a};
    constexpr std::array<double, 3> w = N == 2 ? std::array<double, 3>{1.0, 1.0, 0.0}
                                               : std::array<double, 3>{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    std::array<QuadraturePoint, kPoints> result{};
    int g = 0;
    for (std::size_t k = 0; k < N; ++k) {
      for (std::size_t j = 0; j < N; ++j) {
        for (std::size_t i = 0; i < N; ++i) {
          result[static_cast<std::size_t>(g++)] = {{x[i], x[j], x[k]}, w[i] * w[j] * w[k]};
        }
      }
    }
    return result;
  }();
};

}  // namespace tissu
