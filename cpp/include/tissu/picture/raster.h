#pragma once

/// Which triangle is seen at each pixel: a buffer of the nearest, filled one row of a triangle at a time.

#include <cstdint>
#include <span>
#include <vector>

namespace tissu {

/// What is seen at the covered pixels, in the order of the pixels.
struct Seen {
  std::vector<std::int64_t> pixel;     ///< row times width plus column
  std::vector<std::int64_t> triangle;  ///< seen there
  std::vector<double> weights;         ///< three each: barycentric coordinates of the pixel's middle in it
  std::vector<double> nearness;        ///< towards the viewer, in the unit of the corners
};

/// The nearest triangle at the middle of each pixel; of equally near ones the last.
///
/// `corners`: column, row and nearness of each point [pixels]. `triangles`: three points each. An edge is cut
/// by a row at the same place for both its triangles, so that no pixel between them is left out.
Seen rasterise(std::span<const double> corners, std::span<const std::int64_t> triangles, std::int64_t width,
               std::int64_t height);

}  // namespace tissu
