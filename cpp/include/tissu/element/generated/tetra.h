// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   The barycentric coordinates L: 1 - x - y - z, x, y, z.
// Operations: values 3, gradients 0.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Tetrahedron of 4 nodes on the corner at the origin and the three unit points.
struct Tetra4 {
  static constexpr std::string_view kName = "tetra";
  static constexpr int kNodes = 4;
  static constexpr int kDimension = 3;
  static constexpr int kOrder = 1;
  static constexpr bool kAffine = true;  ///< one Jacobian serves the whole cell
  using Point = std::array<double, 3>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 4> nodes = {{
      // clang-format off
      {0, 0, 0},
      {1, 0, 0},
      {0, 1, 0},
      {0, 0, 1},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 4> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {
        // clang-format off
        1 - x - y - z,
        x,
        y,
        z,
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 4> gradients(const Point& /*xi*/) {
    return {{
        // clang-format off
        {-1, -1, -1},
        {1, 0, 0},
        {0, 1, 0},
        {0, 0, 1},
        // clang-format on
    }};
  }

  /// Symmetric, 1 point; exact for StVK on affine cells.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<3>, 1> points = {{
        // clang-format off
        {{0.25, 0.25, 0.25}, 0.16666666666666666},
        // clang-format on
    }};
  };
  using Full = Reduced;
  using Over = Reduced;
};

}  // namespace tissu
