#pragma once

/// Where a blade went: surfaces of triangles in present space.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

/// One connected surface, its triangles turned alike. Parts of a sweep are cut one after the other.
struct SweepPart {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<std::uint8_t> border;  ///< of each triangle, bit i: no other one has its edge from corner i on
  std::int32_t incision = -1;  ///< number of the incision that goes on here; -1: no later sweep goes on here
  /// Of a swept edge that turns back here, but not on the way that it came: where it turns. The next part
  /// begins there, and material between both may stay joined.
  std::vector<std::array<Vec3, 2>> corner = {};
  std::int32_t fresh = 0;  ///< triangles from here on go where the incision has not been
};

struct Sweep {
  std::vector<SweepPart> parts;
};

/// Each of these throws ParameterError for numbers that are not finite and for surfaces without area. The
/// plane is clipped to a square that covers the box low..high; it is empty where the plane misses the box.
Sweep plane_sweep(const Vec3& point, const Vec3& normal, const Vec3& low, const Vec3& high);
/// A polygon of 32 sides around a circle of that radius.
Sweep disc_sweep(const Vec3& center, const Vec3& normal, double radius);
/// Triangles of any surface, 3 numbers per point. Those that share an edge are one part; they are turned
/// alike. Refused: a part that cannot be turned alike, as a Moebius strip.
Sweep triangle_sweep(std::span<const double> points, std::span<const std::array<std::int32_t, 3>> triangles);
/// The ruled surface that an edge of `points` points sweeps through `moments` moments, 3 numbers per point,
/// moment after moment. Where it turns back by more than 175 degrees another part begins. A blade that goes
/// on begins some moments earlier, so that the surfaces overlap; it was at the first `past` moments before.
/// Vertices at the front of that `incision` stay on the cut without a look at the blade. Edges that end at
/// its walls are cut where the blade crosses them on its new way.
Sweep edge_sweep(std::span<const double> places, std::int32_t moments, std::int32_t points,
                 std::int32_t incision = -1, std::int32_t past = 0);

}  // namespace tissu
