// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   Products of the line's Lagrange polynomials through the coordinates that the nodes have.
// Operations: values 48, gradients 96.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Hexahedron of 8 nodes on (-1, 1)^3.
struct Hexahedron8 {
  static constexpr std::string_view kName = "hexahedron";
  static constexpr int kNodes = 8;
  static constexpr int kDimension = 3;
  static constexpr int kOrder = 1;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 3>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 8> nodes = {{
      // clang-format off
      {-1, -1, -1},
      {1, -1, -1},
      {1, 1, -1},
      {-1, 1, -1},
      {-1, -1, 1},
      {1, -1, 1},
      {1, 1, 1},
      {-1, 1, 1},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 8> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {
        // clang-format off
        0.125 * (1 - x) * (1 - y) * (1 - z),
        0.125 * (1 + x) * (1 - y) * (1 - z),
        0.125 * (1 + x) * (1 + y) * (1 - z),
        0.125 * (1 - x) * (1 + y) * (1 - z),
        0.125 * (1 - x) * (1 - y) * (1 + z),
        0.125 * (1 + x) * (1 - y) * (1 + z),
        0.125 * (1 + x) * (1 + y) * (1 + z),
        0.125 * (1 - x) * (1 + y) * (1 + z),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 8> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {{
        // clang-format off
        {-0.125 * (1 - y) * (1 - z), -0.125 * (1 - x) * (1 - z), -0.125 * (1 - x) * (1 - y)},
        {0.125 * (1 - y) * (1 - z), -0.125 * (1 + x) * (1 - z), -0.125 * (1 + x) * (1 - y)},
        {0.125 * (1 + y) * (1 - z), 0.125 * (1 + x) * (1 - z), -0.125 * (1 + x) * (1 + y)},
        {-0.125 * (1 + y) * (1 - z), 0.125 * (1 - x) * (1 - z), -0.125 * (1 - x) * (1 + y)},
        {-0.125 * (1 - y) * (1 + z), -0.125 * (1 - x) * (1 + z), 0.125 * (1 - x) * (1 - y)},
        {0.125 * (1 - y) * (1 + z), -0.125 * (1 + x) * (1 + z), 0.125 * (1 + x) * (1 - y)},
        {0.125 * (1 + y) * (1 + z), 0.125 * (1 + x) * (1 + z), 0.125 * (1 + x) * (1 + y)},
        {-0.125 * (1 + y) * (1 + z), 0.125 * (1 - x) * (1 + z), 0.125 * (1 - x) * (1 + y)},
        // clang-format on
    }};
  }

  /// Gauss-Legendre, 1 x 1 x 1.
  /// Has 12 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 12;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<3>, 1> points = {{
        // clang-format off
        {{0.0, 0.0, 0.0}, 8.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 2 x 2 x 2; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 8;
    static constexpr int kDegree = 3;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<3>, 8> points = {{
        // clang-format off
        {{-0.5773502691896257, -0.5773502691896257, -0.5773502691896257}, 1.0},
        {{0.5773502691896257, -0.5773502691896257, -0.5773502691896257}, 1.0},
        {{-0.5773502691896257, 0.5773502691896257, -0.5773502691896257}, 1.0},
        {{0.5773502691896257, 0.5773502691896257, -0.5773502691896257}, 1.0},
        {{-0.5773502691896257, -0.5773502691896257, 0.5773502691896257}, 1.0},
        {{0.5773502691896257, -0.5773502691896257, 0.5773502691896257}, 1.0},
        {{-0.5773502691896257, 0.5773502691896257, 0.5773502691896257}, 1.0},
        {{0.5773502691896257, 0.5773502691896257, 0.5773502691896257}, 1.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 3 x 3 x 3; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 27;
    static constexpr int kDegree = 5;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<3>, 27> points = {{
        // clang-format off
        {{-0.7745966692414834, -0.7745966692414834, -0.7745966692414834}, 0.1714677640603567},
        {{0.0, -0.7745966692414834, -0.7745966692414834}, 0.27434842249657065},
        {{0.7745966692414834, -0.7745966692414834, -0.7745966692414834}, 0.1714677640603567},
        {{-0.7745966692414834, 0.0, -0.7745966692414834}, 0.27434842249657065},
        {{0.0, 0.0, -0.7745966692414834}, 0.438957475994513},
        {{0.7745966692414834, 0.0, -0.7745966692414834}, 0.27434842249657065},
        {{-0.7745966692414834, 0.7745966692414834, -0.7745966692414834}, 0.1714677640603567},
        {{0.0, 0.7745966692414834, -0.7745966692414834}, 0.27434842249657065},
        {{0.7745966692414834, 0.7745966692414834, -0.7745966692414834}, 0.1714677640603567},
        {{-0.7745966692414834, -0.7745966692414834, 0.0}, 0.27434842249657065},
        {{0.0, -0.7745966692414834, 0.0}, 0.43895747599451296},
        {{0.7745966692414834, -0.7745966692414834, 0.0}, 0.27434842249657065},
        {{-0.7745966692414834, 0.0, 0.0}, 0.43895747599451296},
        {{0.0, 0.0, 0.0}, 0.7023319615912208},
        {{0.7745966692414834, 0.0, 0.0}, 0.43895747599451296},
        {{-0.7745966692414834, 0.7745966692414834, 0.0}, 0.27434842249657065},
        {{0.0, 0.7745966692414834, 0.0}, 0.43895747599451296},
        {{0.7745966692414834, 0.7745966692414834, 0.0}, 0.27434842249657065},
        {{-0.7745966692414834, -0.7745966692414834, 0.7745966692414834}, 0.1714677640603567},
        {{0.0, -0.7745966692414834, 0.7745966692414834}, 0.27434842249657065},
        {{0.7745966692414834, -0.7745966692414834, 0.7745966692414834}, 0.1714677640603567},
        {{-0.7745966692414834, 0.0, 0.7745966692414834}, 0.27434842249657065},
        {{0.0, 0.0, 0.7745966692414834}, 0.438957475994513},
        {{0.7745966692414834, 0.0, 0.7745966692414834}, 0.27434842249657065},
        {{-0.7745966692414834, 0.7745966692414834, 0.7745966692414834}, 0.1714677640603567},
        {{0.0, 0.7745966692414834, 0.7745966692414834}, 0.27434842249657065},
        {{0.7745966692414834, 0.7745966692414834, 0.7745966692414834}, 0.1714677640603567},
        // clang-format on
    }};
  };
};

}  // namespace tissu
