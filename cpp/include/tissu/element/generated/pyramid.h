// Made by `python -m tissu.codegen --update`, elements version 1, from
// python/tissu/codegen/elements.py. Change that, not this.
//
// Shape functions:
//   N = (1 - z +- x)(1 - z +- y) / (4 (1 - z)) on the base, z at the apex.
// Operations: values 32, gradients 44.

#pragma once

#include <array>
#include <string_view>

#include "tissu/element/quadrature.h"

namespace tissu {

/// Pyramid of 5 nodes on the base (-1, 1)^2 at z = 0 and the apex (0, 0, 1).
struct Pyramid5 {
  static constexpr std::string_view kName = "pyramid";
  static constexpr int kNodes = 5;
  static constexpr int kDimension = 3;
  static constexpr int kOrder = 1;
  static constexpr bool kAffine = false;
  using Point = std::array<double, 3>;

  /// Reference coordinates of the nodes.
  static constexpr std::array<Point, 5> nodes = {{
      // clang-format off
      {-1, -1, 0},
      {1, -1, 0},
      {1, 1, 0},
      {-1, 1, 0},
      {0, 0, 1},
      // clang-format on
  }};

  /// N_a(xi)
  static constexpr std::array<double, 5> values(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    const double w = z < 1 ? 1 / (1 - z) : 0.0;  // limit along the axis
    return {
        // clang-format off
        0.25 * (1 - x - y - z) + 0.25 * x * y * w,
        0.25 * (1 + x - y - z) - 0.25 * x * y * w,
        0.25 * (1 + x + y - z) + 0.25 * x * y * w,
        0.25 * (1 - x + y - z) - 0.25 * x * y * w,
        z,
        // clang-format on
    };
  }
  /// dN_a/dxi
  static constexpr std::array<Point, 5> gradients(const Point& xi) {
    const double x = xi[0];
    const double y = xi[1];
    const double z = xi[2];
    const double w = z < 1 ? 1 / (1 - z) : 0.0;  // limit along the axis
    return {{
        // clang-format off
        {-0.25 + 0.25 * y * w, -0.25 + 0.25 * x * w, -0.25 + 0.25 * x * y * w * w},
        {0.25 - 0.25 * y * w, -0.25 - 0.25 * x * w, -0.25 - 0.25 * x * y * w * w},
        {0.25 + 0.25 * y * w, 0.25 + 0.25 * x * w, -0.25 + 0.25 * x * y * w * w},
        {-0.25 - 0.25 * y * w, 0.25 - 0.25 * x * w, -0.25 - 0.25 * x * y * w * w},
        {0, 0, 1},
        // clang-format on
    }};
  }

  /// Conical product, 1 x 1 x 1.
  /// Has 3 zero-energy modes beyond the rigid motions.
  struct Reduced {
    static constexpr int kPoints = 1;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 3;
    static constexpr std::string_view kExactFor = "";
    static constexpr std::array<WeightedPoint<3>, 1> points = {{
        // clang-format off
        {{0.0, 0.0, 0.25}, 1.3333333333333333},
        // clang-format on
    }};
  };

  /// Conical product, 2 x 2 x 1; exact for Hooke on affine cells.
  struct Full {
    static constexpr int kPoints = 4;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "hooke";
    static constexpr std::array<WeightedPoint<3>, 4> points = {{
        // clang-format off
        {{-0.4330127018922193, -0.4330127018922193, 0.25}, 0.3333333333333333},
        {{0.4330127018922193, -0.4330127018922193, 0.25}, 0.3333333333333333},
        {{-0.4330127018922193, 0.4330127018922193, 0.25}, 0.3333333333333333},
        {{0.4330127018922193, 0.4330127018922193, 0.25}, 0.3333333333333333},
        // clang-format on
    }};
  };

  /// Conical product, 3 x 3 x 1; exact for StVK on affine cells.
  struct Over {
    static constexpr int kPoints = 9;
    static constexpr int kDegree = 1;
    static constexpr int kZeroEnergyModes = 0;
    static constexpr std::string_view kExactFor = "stvk";
    static constexpr std::array<WeightedPoint<3>, 9> points = {{
        // clang-format off
        {{-0.5809475019311126, -0.5809475019311126, 0.25}, 0.10288065843621398},
        {{0.0, -0.5809475019311126, 0.25}, 0.1646090534979424},
        {{0.5809475019311126, -0.5809475019311126, 0.25}, 0.10288065843621398},
        {{-0.5809475019311126, 0.0, 0.25}, 0.1646090534979424},
        {{0.0, 0.0, 0.25}, 0.2633744855967078},
        {{0.5809475019311126, 0.0, 0.25}, 0.1646090534979424},
        {{-0.5809475019311126, 0.5809475019311126, 0.25}, 0.10288065843621398},
        {{0.0, 0.5809475019311126, 0.25}, 0.1646090534979424},
        {{0.5809475019311126, 0.5809475019311126, 0.25}, 0.10288065843621398},
        // clang-format on
    }};
  };
};

}  // namespace tissu
