// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   Products of the line's Lagrange polynomials through the coordinates that the nodes have.
// Operations: values 9, gradients 7.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Line of 3 nodes on (-1, 1).
struct Line3 {
  static constexpr std::string_view kName = "line3";
  static constexpr int kNodes = 3;
  static constexpr int kDimension = 1;
  static constexpr int kOrder = 2;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 1>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 3> nodes = {{
      // clang-format off
      {-1},
      {1},
      {0},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 3> values(const Point& xi) {
    const double x = xi[0];
    return {
        // clang-format off
        -0.5 * x * (1 - x),
        0.5 * x * (1 + x),
        (1 - x) * (1 + x),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 3> gradients(const Point& xi) {
    const double x = xi[0];
    return {{
        // clang-format off
        {-0.5 * (1 - 2 * x)},
        {0.5 * (1 + 2 * x)},
        {-2 * x},
        // clang-format on
    }};
  }

  /// Gauss-Legendre, 1.
  /// Has one zero-energy mode beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 1;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<1>, 1> points = {{
        // clang-format off
        {{0.0}, 2.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 2; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 2;
    static constexpr int kDegree = 3;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<1>, 2> points = {{
        // clang-format off
        {{-0.5773502691896257}, 1.0},
        {{0.5773502691896257}, 1.0},
        // clang-format on
    }};
  };

  /// Gauss-Legendre, 3; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 3;
    static constexpr int kDegree = 5;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<1>, 3> points = {{
        // clang-format off
        {{-0.7745966692414834}, 0.5555555555555556},
        {{0.0}, 0.8888888888888888},
        {{0.7745966692414834}, 0.5555555555555556},
        // clang-format on
    }};
  };
};

}  // namespace tissu
