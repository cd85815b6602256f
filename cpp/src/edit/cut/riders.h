#pragma once

/// What carries a vertex of the material, and points between vertices.

#include <cstdint>
#include <optional>
#include <span>

#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// A node carries itself.
Rider rider_of(const Material& material, std::int32_t vertex);

/// The point sum weight vertex, by ascending nodes. Nothing where more than four nodes would carry it, or a
/// weight is not finite.
std::optional<Rider> between(const Material& material, std::span<const std::int32_t> vertices,
                             std::span<const double> weights);

}  // namespace tissu
