#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tissu/step/parts.h"
#include "tissu/world/world.h"

namespace tissu {

/// Takes the rigid motion out of a displacement, part by part: what is left has, in the metric of the masses,
/// neither linear nor angular momentum about the places given. Connected parts with held nodes are left as
/// they are, for supports take their momentum.
class MomentumFree {
 public:
  void prepare(const World& world, std::span<const ConnectedPart> parts);
  void project(ConstReals places, Reals way) const;

 private:
  void project(std::span<const std::int32_t> nodes, ConstReals places, Reals way) const;

  const World* world_ = nullptr;
  std::vector<std::vector<std::int32_t>> free_;  ///< nodes of each part that is not held
};

}  // namespace tissu
