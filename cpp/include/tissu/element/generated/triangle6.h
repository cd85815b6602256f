// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   L (2 L - 1) at corners, 4 L_a L_b on edges; L are the barycentric coordinates.
// Operations: values 23, gradients 24.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Triangle of 6 nodes on the corners (0,0) (1,0) (0,1).
struct Triangle6 {
  static constexpr std::string_view kName = "triangle6";
  static constexpr int kNodes = 6;
  static constexpr int kDimension = 2;
  static constexpr int kOrder = 2;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 2>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 6> nodes = {{
      // clang-format off
      {0, 0},
      {1, 0},
      {0, 1},
      {0.5, 0},
      {0.5, 0.5},
      {0, 0.5},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 6> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    return {
        // clang-format off
        (1 - x - y) * (1 - 2 * x - 2 * y),
        -x * (1 - 2 * x),
        -y * (1 - 2 * y),
        4 * x * (1 - x - y),
        4 * x * y,
        4 * y * (1 - x - y),
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 6> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    return {{
        // clang-format off
        {-3 + 4 * x + 4 * y, -3 + 4 * x + 4 * y},
        {-1 + 4 * x, 0},
        {0, -1 + 4 * y},
        {4 * (1 - 2 * x - y), -4 * x},
        {4 * y, 4 * x},
        {-4 * y, 4 * (1 - x - 2 * y)},
        // clang-format on
    }};
  }

  /// Symmetric, 1 point.
  /// Has 6 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 6;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<2>, 1> points = {{
        // clang-format off
        {{0.3333333333333333, 0.3333333333333333}, 0.5},
        // clang-format on
    }};
  };

  /// Symmetric, 3 points; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 3;
    static constexpr int kDegree = 2;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<2>, 3> points = {{
        // clang-format off
        {{0.16666666666666666, 0.6666666666666666}, 0.16666666666666666},
        {{0.6666666666666666, 0.16666666666666666}, 0.16666666666666666},
        {{0.16666666666666666, 0.16666666666666666}, 0.16666666666666666},
        // clang-format on
    }};
  };

  /// Symmetric, 6 points; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 6;
    static constexpr int kDegree = 4;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<2>, 6> points = {{
        // clang-format off
        {{0.09157621350977074, 0.8168475729804585}, 0.054975871827660935},
        {{0.8168475729804585, 0.09157621350977074}, 0.054975871827660935},
        {{0.09157621350977074, 0.09157621350977074}, 0.054975871827660935},
        {{0.4459484909159649, 0.10810301816807023}, 0.11169079483900574},
        {{0.10810301816807023, 0.4459484909159649}, 0.11169079483900574},
        {{0.4459484909159649, 0.4459484909159649}, 0.11169079483900574},
        // clang-format on
    }};
  };
};

}  // namespace tissu
