#pragma once

/// What incisions remember from cut to cut: the vertices of the material that they went through.

#include <cstdint>
#include <utility>
#include <vector>

#include "edit/cut/crossings.h"
#include "edit/cut/fans.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

/// What parts of a sweep put on the incisions of these numbers.
using OnIncisions = std::vector<std::pair<std::int32_t, OnCut>>;

/// What is known before a part of a sweep cuts: the vertices at the front of its incision are on the cut.
/// Those that the incision has doubled stand at its walls, and the blade may be elsewhere. Of a part without
/// an incision: nothing. `divide`: vertices of walls beside the front stay on the cut near the blade, which
/// may go to them.
OnCut known_before(const Patch& patch, const Material& material, const SweepPart& part, bool divide);

/// Vertices that a blade met which opened nothing, added to those of their incisions.
void remember_incisions(const Patch& patch, const Material& material, const OnIncisions& met, CutPlan& plan);

/// Vertices that the parts put on their incisions; of old ones, the copies and new numbers too.
void write_incisions(const Patch& patch, const Material& material, const OnIncisions& met, const Fans& fans,
                     CutPlan& plan);

}  // namespace tissu
