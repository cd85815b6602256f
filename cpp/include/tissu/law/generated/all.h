#pragma once

// Made from python/tissu/codegen/laws
// by `python -m tissu.codegen --update` (generator 1, SymPy 1.14.0). Do not edit.

#include "tissu/law/generated/arruda_boyce.h"
#include "tissu/law/generated/fibre.h"
#include "tissu/law/generated/hooke.h"
#include "tissu/law/generated/mooney_rivlin.h"
#include "tissu/law/generated/neo_hooke.h"
#include "tissu/law/generated/stable_neo_hooke.h"
#include "tissu/law/generated/stvk.h"
#include "tissu/law/generated/yeoh.h"
#include "tissu/law/law_list.h"

namespace tissu {

/// Every law of the library, additions last.
using AllLaws = LawList<Hooke, StVK, NeoHooke, StableNeoHooke, MooneyRivlin, Yeoh, ArrudaBoyce, Fibre>;
/// Those that stand alone.
using BaseLaws = LawList<Hooke, StVK, NeoHooke, StableNeoHooke, MooneyRivlin, Yeoh, ArrudaBoyce>;
/// Those to be added to one that does.
using AdditionLaws = LawList<Fibre>;
/// Those that sheets and lines may be made of.
using ThinLaws = LawList<Hooke, StVK>;

}  // namespace tissu
