#pragma once

/// Overlap of thick and round things, whose middles do not cross.

#include "tissu/contact/audit.h"
#include "tissu/contact/candidates.h"

namespace tissu {

/// As `overlaps`, of those alone that overlap by more than so many of their gaps, at these places of the
/// vertices, for which the list of candidates was made.
Depths deep_overlaps(const Contact& contact, const Candidates& candidates, ConstReals places,
                     const State& state, double gaps);

}  // namespace tissu
