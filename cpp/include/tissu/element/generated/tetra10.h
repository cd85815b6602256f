// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   L (2 L - 1) at corners, 4 L_a L_b on edges; L are the barycentric coordinates.
// Operations: values 40, gradients 51.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Tetrahedron of 10 nodes on the corner at the origin and the three unit points.
struct Tetra10 {
  static constexpr std::string_view kName = "tetra10";
  static constexpr int kNodes = 10;
  static constexpr int kDimension = 3;
  static constexpr int kOrder = 2;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 3>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 10> nodes = {{
      // clang-format off
      {0, 0, 0},
      {1, 0, 0},
      {0, 1, 0},
      {0, 0, 1},
      {0.5, 0, 0},
      {0.5, 0.5, 0},
      {0, 0.5, 0},
      {0, 0, 0.5},
      {0.5, 0, 0.5},
      {0, 0.5, 0.5},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 10> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {
        // clang-format off
        (1 - x - y - z) * (1 - 2 * x - 2 * y - 2 * z),
        -x * (1 - 2 * x),
        -y * (1 - 2 * y),
        -z * (1 - 2 * z),
        4 * x * (1 - x - y - z),
        4 * x * y,
        4 * y * (1 - x - y - z),
        4 * z * (1 - x - y - z),
        4 * x * z,
        4 * y * z,
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 10> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    return {{
        // clang-format off
        {-3 + 4 * x + 4 * y + 4 * z, -3 + 4 * x + 4 * y + 4 * z, -3 + 4 * x + 4 * y + 4 * z},
        {-1 + 4 * x, 0, 0},
        {0, -1 + 4 * y, 0},
        {0, 0, -1 + 4 * z},
        {4 * (1 - 2 * x - y - z), -4 * x, -4 * x},
        {4 * y, 4 * x, 0},
        {-4 * y, 4 * (1 - x - 2 * y - z), -4 * y},
        {-4 * z, -4 * z, 4 * (1 - x - y - 2 * z)},
        {4 * z, 0, 4 * x},
        {0, 4 * z, 4 * y},
        // clang-format on
    }};
  }

  /// Symmetric, 1 point.
  /// Has 18 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 18;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<3>, 1> points = {{
        // clang-format off
        {{0.25, 0.25, 0.25}, 0.16666666666666666},
        // clang-format on
    }};
  };

  /// Symmetric, 4 points; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 4;
    static constexpr int kDegree = 2;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<3>, 4> points = {{
        // clang-format off
        {{0.1381966011250105, 0.1381966011250105, 0.5854101966249684}, 0.041666666666666664},
        {{0.1381966011250105, 0.5854101966249684, 0.1381966011250105}, 0.041666666666666664},
        {{0.5854101966249684, 0.1381966011250105, 0.1381966011250105}, 0.041666666666666664},
        {{0.1381966011250105, 0.1381966011250105, 0.1381966011250105}, 0.041666666666666664},
        // clang-format on
    }};
  };

  /// Symmetric, 14 points; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 14;
    static constexpr int kDegree = 5;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<3>, 14> points = {{
        // clang-format off
        {{0.09273525031089122, 0.09273525031089122, 0.7217942490673264}, 0.012248840519393659},
        {{0.09273525031089122, 0.7217942490673264, 0.09273525031089122}, 0.012248840519393659},
        {{0.7217942490673264, 0.09273525031089122, 0.09273525031089122}, 0.012248840519393659},
        {{0.09273525031089122, 0.09273525031089122, 0.09273525031089122}, 0.012248840519393659},
        {{0.3108859192633006, 0.3108859192633006, 0.06734224221009817}, 0.018781320953002643},
        {{0.3108859192633006, 0.06734224221009817, 0.3108859192633006}, 0.018781320953002643},
        {{0.06734224221009817, 0.3108859192633006, 0.3108859192633006}, 0.018781320953002643},
        {{0.3108859192633006, 0.3108859192633006, 0.3108859192633006}, 0.018781320953002643},
        {{0.04550370412564965, 0.45449629587435036, 0.45449629587435036}, 0.007091003462846911},
        {{0.45449629587435036, 0.04550370412564965, 0.45449629587435036}, 0.007091003462846911},
        {{0.45449629587435036, 0.45449629587435036, 0.04550370412564965}, 0.007091003462846911},
        {{0.04550370412564965, 0.04550370412564965, 0.45449629587435036}, 0.007091003462846911},
        {{0.04550370412564965, 0.45449629587435036, 0.04550370412564965}, 0.007091003462846911},
        {{0.45449629587435036, 0.04550370412564965, 0.04550370412564965}, 0.007091003462846911},
        // clang-format on
    }};
  };
};

}  // namespace tissu
