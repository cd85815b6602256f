// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   L (1 +- z)/2; L are the barycentric coordinates of the triangle.
// Operations: values 22, gradients 26.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Wedge of 6 nodes on the triangle (0,0) (1,0) (0,1) times (-1, 1), nodes 0 1 2 at z = -1.
struct Wedge6 {
  static constexpr std::string_view kName = "wedge";
  static constexpr int kNodes = 6;
  static constexpr int kDimension = 3;
  static constexpr int kOrder = 1;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 3>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 6> nodes = {{
      // clang-format off
      {0, 0, -1},
      {1, 0, -1},
      {0, 1, -1},
      {0, 0, 1},
      {1, 0, 1},
      {0, 1, 1},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 6> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {
        // clang-format off
        0.5 * (1 - x - y) * (1 - z),
        0.5 * x * (1 - z),
        0.5 * y * (1 - z),
        0.5 * (1 - x - y) * (1 + z),
        0.5 * x * (1 + z),
        0.5 * y * (1 + z),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 6> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {{
        // clang-format off
        {-0.5 * (1 - z), -0.5 * (1 - z), -0.5 * (1 - x - y)},
        {0.5 * (1 - z), 0, -0.5 * x},
        {0, 0.5 * (1 - z), -0.5 * y},
        {-0.5 * (1 + z), -0.5 * (1 + z), 0.5 * (1 - x - y)},
        {0.5 * (1 + z), 0, 0.5 * x},
        {0, 0.5 * (1 + z), 0.5 * y},
        // clang-format on
    }};
  }

  /// Symmetric triangle of 1 points x Gauss-Legendre of 1.
  /// Has 6 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 6;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<3>, 1> points = {{
        // clang-format off
        {{0.3333333333333333, 0.3333333333333333, 0.0}, 1.0},
        // clang-format on
    }};
  };

  /// Symmetric triangle of 3 points x Gauss-Legendre of 2; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 6;
    static constexpr int kDegree = 2;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<3>, 6> points = {{
        // clang-format off
        {{0.16666666666666666, 0.6666666666666666, -0.5773502691896257}, 0.16666666666666666},
        {{0.6666666666666666, 0.16666666666666666, -0.5773502691896257}, 0.16666666666666666},
        {{0.16666666666666666, 0.16666666666666666, -0.5773502691896257}, 0.16666666666666666},
        {{0.16666666666666666, 0.6666666666666666, 0.5773502691896257}, 0.16666666666666666},
        {{0.6666666666666666, 0.16666666666666666, 0.5773502691896257}, 0.16666666666666666},
        {{0.16666666666666666, 0.16666666666666666, 0.5773502691896257}, 0.16666666666666666},
        // clang-format on
    }};
  };

  /// Symmetric triangle of 6 points x Gauss-Legendre of 3; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 18;
    static constexpr int kDegree = 4;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<3>, 18> points = {{
        // clang-format off
        {{0.09157621350977074, 0.8168475729804585, -0.7745966692414834}, 0.030542151015367187},
        {{0.8168475729804585, 0.09157621350977074, -0.7745966692414834}, 0.030542151015367187},
        {{0.09157621350977074, 0.09157621350977074, -0.7745966692414834}, 0.030542151015367187},
        {{0.4459484909159649, 0.10810301816807023, -0.7745966692414834}, 0.062050441577225404},
        {{0.10810301816807023, 0.4459484909159649, -0.7745966692414834}, 0.062050441577225404},
        {{0.4459484909159649, 0.4459484909159649, -0.7745966692414834}, 0.062050441577225404},
        {{0.09157621350977074, 0.8168475729804585, 0.0}, 0.0488674416245875},
        {{0.8168475729804585, 0.09157621350977074, 0.0}, 0.0488674416245875},
        {{0.09157621350977074, 0.09157621350977074, 0.0}, 0.0488674416245875},
        {{0.4459484909159649, 0.10810301816807023, 0.0}, 0.09928070652356065},
        {{0.10810301816807023, 0.4459484909159649, 0.0}, 0.09928070652356065},
        {{0.4459484909159649, 0.4459484909159649, 0.0}, 0.09928070652356065},
        {{0.09157621350977074, 0.8168475729804585, 0.7745966692414834}, 0.030542151015367187},
        {{0.8168475729804585, 0.09157621350977074, 0.7745966692414834}, 0.030542151015367187},
        {{0.09157621350977074, 0.09157621350977074, 0.7745966692414834}, 0.030542151015367187},
        {{0.4459484909159649, 0.10810301816807023, 0.7745966692414834}, 0.062050441577225404},
        {{0.10810301816807023, 0.4459484909159649, 0.7745966692414834}, 0.062050441577225404},
        {{0.4459484909159649, 0.4459484909159649, 0.7745966692414834}, 0.062050441577225404},
        // clang-format on
    }};
  };
};

}  // namespace tissu
