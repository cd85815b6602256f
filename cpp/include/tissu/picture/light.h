#pragma once

/// The seen surface as a picture: its colours under three lights, with the edges of what is nearer.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/picture/raster.h"

namespace tissu {

/// What a surface is coloured with: one colour, or a table of colours for values.
struct Paint {
  std::array<double, 3> colour;    ///< red, green, blue in [0, 1]
  std::span<const double> values;  ///< at the corners, three for each triangle; empty: one colour
  /// Three each: the colours of equal parts of the range, then those below it, above it and of no number.
  std::span<const double> table;
  double low;   ///< the value at which the table begins
  double high;  ///< and ends
};

/// A picture (height, width) without what is beside the surface: black and infinitely far there.
struct Canvas {
  std::int64_t width;
  std::int64_t height;
  std::vector<double> colour;    ///< three for each pixel, in [0, 1]
  std::vector<double> nearness;  ///< towards the viewer
};

/// Colours of the seen pixels. `normals`: nine for each triangle, of length 1 at its corners, in the
/// picture's axes. `towards`: for each triangle, positive where the side is seen that its normals point out
/// of. A surface that faces the viewer keeps its colour, so that it can be read off a colour bar.
Canvas light(const Seen& seen, std::span<const double> normals, std::span<const double> towards,
             const Paint& paint, std::int64_t width, std::int64_t height);

/// Darkens the near side of jumps in nearness by more than `step`.
void darken_edges(double step, Canvas& canvas);

/// RGBA, four for each shown pixel, from finer ones: `finer` times as many in each direction, of which each
/// has a colour and an opacity.
std::vector<double> shown_pixels(std::span<const double> colour, std::span<const double> opacity,
                                 std::int64_t width, std::int64_t height, std::int64_t finer);

}  // namespace tissu
