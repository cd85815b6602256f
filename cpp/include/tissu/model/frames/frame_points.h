#pragma once

/// Integration points among frames, as plain data: what a body without cells is made of.

#include <cstdint>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// Points with one number k of frames each. Lines and sheets are points too: `axes` says along what they
/// are thin, and the points beside the line or the sheet (second order: their moments of area are those of
/// the section) have the weights of the place they stand off from.
struct FramePoints {
  /// Where a point of a rod stands on its section.
  struct OnSection {
    Vec3 axis;    ///< of the section, a unit vector: the point is off the rod's axis along it
    bool is_up;   ///< it is that of LineSection::up
    double area;  ///< [m2] of the section
  };

  int neighbours = 0;                ///< k
  std::vector<std::int32_t> frames;  ///< [point][k], numbers among the nodes of the body
  std::vector<double> weights;       ///< [point][k], w
  std::vector<double> gradients;     ///< [point][k][3], dw/dX at rest [1/m]
  std::vector<double> positions;     ///< [point][3], at rest [m]
  std::vector<double> volumes;       ///< [point], at rest [m3]
  std::vector<std::int32_t> cells;   ///< [point], the cell whose part it is; empty: each is its own
  int dimension = 3;                 ///< 3 volume, 2 sheet, 1 line
  std::vector<double> axes;  ///< [point][3], normal of the sheet or tangent of the line; of volumes empty
  std::vector<double>
      turning;  ///< [point], inertia per mass that a point on its own has about `axes` [m2]; empty: none

  std::vector<OnSection> sections;  ///< [point], of rods whose points stand around the axis; else empty

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(volumes.size()); }
};

}  // namespace tissu
