#pragma once

/// Which way leads from a vertex of a surface into the body.

#include <optional>
#include <span>

#include "tissu/base/vec.h"

namespace tissu {

struct WayIn {
  Vec3 along;    ///< of length 1
  double slant;  ///< its length over the depth that it gains
};

/// Away from all walls, and along the other faces or inside them. Without walls, away from the others. Empty
/// if no direction leads away from all of them, as at the front of a cut, where two walls face each other.
/// `walls`: normals, as long as twice the areas; `others`: of length 1.
std::optional<WayIn> way_in(std::span<const Vec3> walls, std::span<const Vec3> others);

}  // namespace tissu
