#pragma once

/// A body of hexahedra, wedges, pyramids and tetrahedra whose faces match: 23 x 8 x 8 grid cells of 1 cm,
/// 2008 nodes and 3072 elements, 5 kPa, nu 0.45, 1000 kg/m3, St-Venant–Kirchhoff, held at its face of
/// hexahedra, under gravity.

#include "tissu/world/description.h"

namespace tissu::bench {

WorldDescription mixed_body(int threads);

}  // namespace tissu::bench
