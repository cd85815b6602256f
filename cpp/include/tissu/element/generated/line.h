// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   Products of the line's Lagrange polynomials through the coordinates that the nodes have.
// Operations: values 4, gradients 0.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Line of 2 nodes on (-1, 1).
struct Line2 {
  static constexpr std::string_view kName = "line";
  static constexpr int kNodes = 2;
  static constexpr int kDimension = 1;
  static constexpr int kOrder = 1;
  static constexpr bool kAffine = true;  ///< one Jacobian serves the whole cell
  using Point = std::array<double, 1>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 2> nodes = {{
      // clang-format off
      {-1},
      {1},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 2> values(const Point& xi) {
    const double x = xi[0];
    return {
        // clang-format off
        0.5 * (1 - x),
        0.5 * (1 + x),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 2> gradients(const Point& /*xi*/) {
    return {{
        // clang-format off
        {-0.5},
        {0.5},
        // clang-format on
    }};
  }

  /// Gauss-Legendre, 1; exact for StVK on affine cells.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<1>, 1> points = {{
        // clang-format off
        {{0.0}, 2.0},
        // clang-format on
    }};
  };
  using Full = Reduced;
  using Over = Reduced;
};

}  // namespace tissu
