#pragma once

/// On which side of a blade a point lies, and how far.

#include <cstdint>
#include <span>

#include "tissu/edit/cut/sweep.h"

namespace tissu {

/// Distance to the nearest of the named triangles [m], infinite for none.
double distance(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p);

/// Whether the place on the named triangles that is nearest to a point lies on the border of the blade.
bool is_beyond_border(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p);

/// Height above the plane of the nearest triangle, negative below [m]. Of triangles equally near, at an edge
/// or a corner, the one whose plane is farthest away counts.
double signed_height(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p);

/// The nearest place on the named triangles, and the normal there, of length 1.
struct NearestPlace {
  Vec3 place;
  Vec3 normal;
  std::int32_t triangle = -1;
};
NearestPlace nearest_place(const SweepPart& part, std::span<const std::int32_t> triangles, const Vec3& p);

}  // namespace tissu
