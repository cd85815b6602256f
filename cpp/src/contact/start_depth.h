#pragma once

/// Overlap of thick and round things, whose middles do not cross.

#include <map>
#include <utility>

#include "tissu/contact/candidates.h"
#include "tissu/contact/contact.h"

namespace tissu {

/// Of surfaces whose half thicknesses overlap by more than their gap at these places of the vertices: how far
/// [m], by the lower number of a surface and the higher one.
using Depths = std::map<std::pair<std::int32_t, std::int32_t>, double>;
Depths deep_overlaps(const Contact& contact, const Candidates& candidates, ConstReals places,
                     const State& state);

}  // namespace tissu
