#include "tissu/state/row_blend.h"

namespace tissu {

void blend_rows(std::span<const RowBlend> blends, Reals values) {
  for (const RowBlend& blend : blends) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < blend.from.size() && blend.from[i] >= 0; ++i)
      sum += blend.weight[i] * block(ConstReals(values), blend.from[i]);
    block(values, blend.to) = sum;
  }
}

}  // namespace tissu
