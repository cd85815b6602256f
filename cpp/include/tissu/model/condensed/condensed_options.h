#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tissu/base/vec.h"

namespace tissu {

struct CondensedOptions {
  static constexpr std::string_view kName = "condensed";
  std::vector<std::int32_t> kept;  ///< the nodes of the body that are not eliminated
  Vec3 gravity = Vec3::Zero();     ///< pulls at those that are [m/s2]; the world gives it
};

}  // namespace tissu
