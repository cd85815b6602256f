#pragma once

#include <vector>

#include "tissu/world/world.h"

namespace tissu {

/// Takes the rigid motion out of a displacement, body by body: what is left has, in the metric of the masses,
/// neither linear nor angular momentum about the places given. Bodies with held nodes are left as they are,
/// for supports take their momentum.
class MomentumFree {
 public:
  void prepare(const World& world);
  void project(ConstReals places, Reals way) const;

 private:
  const World* world_ = nullptr;
  std::vector<std::pair<std::int32_t, std::int32_t>> free_;  ///< first node and number of nodes of bodies
};

}  // namespace tissu
