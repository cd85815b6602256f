#pragma once

#include "tissu/model/point_fields.h"

namespace tissu {

struct ElasticBlock;

/// Where the energy is sum_g w_g W(F_g) over the quadrature points of the block's cells.
PointFields elastic_points(const ElasticBlock& block, const PointQuery& query);

/// The cell of each point.
std::vector<std::int32_t> cells_of_points(const PointFields& points);

}  // namespace tissu
