// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   Products of the line's Lagrange polynomials through the coordinates that the nodes have.
// Operations: values 16, gradients 16.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Quadrangle of 4 nodes on (-1, 1)^2.
struct Quad4 {
  static constexpr std::string_view kName = "quad";
  static constexpr int kNodes = 4;
  static constexpr int kDimension = 2;
  static constexpr int kOrder = 1;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 2>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 4> nodes = {{
      // clang-format off
      {-1, -1},
      {1, -1},
      {1, 1},
      {-1, 1},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 4> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    return {
        // clang-format off
        0.25 * (1 - x) * (1 - y),
        0.25 * (1 + x) * (1 - y),
        0.25 * (1 + x) * (1 + y),
        0.25 * (1 - x) * (1 + y),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 4> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    return {{
        // clang-format off
        {-0.25 * (1 - y), -0.25 * (1 - x)},
        {0.25 * (1 - y), -0.25 * (1 + x)},
        {0.25 * (1 + y), 0.25 * (1 + x)},
        {-0.25 * (1 + y), 0.25 * (1 - x)},
        // clang-format on
    }};
  }

  /// Gauss-Legendre, 1 x 1.
  /// Has 2 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 2;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<2>, 1> points = {{
        // clang-format off
        {{0.0, 0.0}, 4.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 2 x 2; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 4;
    static constexpr int kDegree = 3;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<2>, 4> points = {{
        // clang-format off
        {{-0.5773502691896257, -0.5773502691896257}, 1.0},
        {{0.5773502691896257, -0.5773502691896257}, 1.0},
        {{-0.5773502691896257, 0.5773502691896257}, 1.0},
        {{0.5773502691896257, 0.5773502691896257}, 1.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 3 x 3; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 9;
    static constexpr int kDegree = 5;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<2>, 9> points = {{
        // clang-format off
        {{-0.7745966692414834, -0.7745966692414834}, 0.308641975308642},
        {{0.0, -0.7745966692414834}, 0.49382716049382713},
        {{0.7745966692414834, -0.7745966692414834}, 0.308641975308642},
        {{-0.7745966692414834, 0.0}, 0.49382716049382713},
        {{0.0, 0.0}, 0.7901234567901234},
        {{0.7745966692414834, 0.0}, 0.49382716049382713},
        {{-0.7745966692414834, 0.7745966692414834}, 0.308641975308642},
        {{0.0, 0.7745966692414834}, 0.49382716049382713},
        {{0.7745966692414834, 0.7745966692414834}, 0.308641975308642},
        // clang-format on
    }};
  };
};

}  // namespace tissu
