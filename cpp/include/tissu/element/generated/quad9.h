// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   Products of the line's Lagrange polynomials through the coordinates that the nodes have.
// Operations: values 59, gradients 98.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Quadrangle of 9 nodes on (-1, 1)^2.
struct Quad9 {
  static constexpr std::string_view kName = "quad9";
  static constexpr int kNodes = 9;
  static constexpr int kDimension = 2;
  static constexpr int kOrder = 2;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 2>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 9> nodes = {{
      // clang-format off
      {-1, -1},
      {1, -1},
      {1, 1},
      {-1, 1},
      {0, -1},
      {1, 0},
      {0, 1},
      {-1, 0},
      {0, 0},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 9> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    return {
        // clang-format off
        0.25 * x * y * (1 - x) * (1 - y),
        -0.25 * x * y * (1 + x) * (1 - y),
        0.25 * x * y * (1 + x) * (1 + y),
        -0.25 * x * y * (1 - x) * (1 + y),
        -0.5 * y * (1 - x) * (1 + x) * (1 - y),
        0.5 * x * (1 + x) * (1 - y) * (1 + y),
        0.5 * y * (1 - x) * (1 + x) * (1 + y),
        -0.5 * x * (1 - x) * (1 - y) * (1 + y),
        (1 - x) * (1 + x) * (1 - y) * (1 + y),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 9> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    return {{
        // clang-format off
        {0.25 * y * (1 - 2 * x) * (1 - y), 0.25 * x * (1 - x) * (1 - 2 * y)},
        {-0.25 * y * (1 + 2 * x) * (1 - y), -0.25 * x * (1 + x) * (1 - 2 * y)},
        {0.25 * y * (1 + 2 * x) * (1 + y), 0.25 * x * (1 + x) * (1 + 2 * y)},
        {-0.25 * y * (1 - 2 * x) * (1 + y), -0.25 * x * (1 - x) * (1 + 2 * y)},
        {x * y * (1 - y), -0.5 * (1 - x) * (1 + x) * (1 - 2 * y)},
        {0.5 * (1 + 2 * x) * (1 - y) * (1 + y), -x * y * (1 + x)},
        {-x * y * (1 + y), 0.5 * (1 - x) * (1 + x) * (1 + 2 * y)},
        {-0.5 * (1 - 2 * x) * (1 - y) * (1 + y), x * y * (1 - x)},
        {-2 * x * (1 - y) * (1 + y), -2 * y * (1 - x) * (1 + x)},
        // clang-format on
    }};
  }

  /// Gauss-Legendre, 2 x 2.
  /// Has 3 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 4;
    static constexpr int kDegree = 3;
    static constexpr int kZeroEnergyModes = 3;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<2>, 4> points = {{
        // clang-format off
        {{-0.5773502691896257, -0.5773502691896257}, 1.0},
        {{0.5773502691896257, -0.5773502691896257}, 1.0},
        {{-0.5773502691896257, 0.5773502691896257}, 1.0},
        {{0.5773502691896257, 0.5773502691896257}, 1.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 3 x 3; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 9;
    static constexpr int kDegree = 5;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
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

  /// Gauss-Legendre, 5 x 5; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 25;
    static constexpr int kDegree = 9;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<2>, 25> points = {{
        // clang-format off
        {{-0.906179845938664, -0.906179845938664}, 0.056134348862428636},
        {{-0.5384693101056831, -0.906179845938664}, 0.1134},
        {{0.0, -0.906179845938664}, 0.1347850723875209},
        {{0.5384693101056831, -0.906179845938664}, 0.1134},
        {{0.906179845938664, -0.906179845938664}, 0.056134348862428636},
        {{-0.906179845938664, -0.5384693101056831}, 0.1134},
        {{-0.5384693101056831, -0.5384693101056831}, 0.22908540422399112},
        {{0.0, -0.5384693101056831}, 0.2722865325507507},
        {{0.5384693101056831, -0.5384693101056831}, 0.22908540422399112},
        {{0.906179845938664, -0.5384693101056831}, 0.1134},
        {{-0.906179845938664, 0.0}, 0.1347850723875209},
        {{-0.5384693101056831, 0.0}, 0.2722865325507507},
        {{0.0, 0.0}, 0.32363456790123457},
        {{0.5384693101056831, 0.0}, 0.2722865325507507},
        {{0.906179845938664, 0.0}, 0.1347850723875209},
        {{-0.906179845938664, 0.5384693101056831}, 0.1134},
        {{-0.5384693101056831, 0.5384693101056831}, 0.22908540422399112},
        {{0.0, 0.5384693101056831}, 0.2722865325507507},
        {{0.5384693101056831, 0.5384693101056831}, 0.22908540422399112},
        {{0.906179845938664, 0.5384693101056831}, 0.1134},
        {{-0.906179845938664, 0.906179845938664}, 0.056134348862428636},
        {{-0.5384693101056831, 0.906179845938664}, 0.1134},
        {{0.0, 0.906179845938664}, 0.1347850723875209},
        {{0.5384693101056831, 0.906179845938664}, 0.1134},
        {{0.906179845938664, 0.906179845938664}, 0.056134348862428636},
        // clang-format on
    }};
  };
};

}  // namespace tissu
