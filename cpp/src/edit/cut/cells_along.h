#pragma once

/// Cells through which the corner of a blade goes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "edit/cut/patch.h"

namespace tissu {

/// Cells (places, ascending) whose material segments pass, or in which they end. Lines have none.
std::vector<std::int32_t> cells_along(const Patch& patch, std::span<const std::array<Vec3, 2>> segments);

}  // namespace tissu
