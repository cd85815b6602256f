#pragma once

#include "aggregates.h"

namespace tissu {

/// The same couplings between aggregates, with the prolongation before it is smoothed: a vertex on an
/// aggregate is a point on a frame. What is given on the finer level does not move; of rows that are given in
/// some axes only, the others are taken as free.
void coarsen_couplings(const Couplings& fine, const Aggregates& aggregates, const RowPlaces& fine_places,
                       const RowPlaces& coarse_places, std::vector<CarriedPart>& scratch, Couplings& coarse);

}  // namespace tissu
