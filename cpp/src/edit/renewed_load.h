#pragma once

/// The nodes of a load and the forces on them, laid anew after an edit.

#include <cstdint>

#include "tissu/base/vec.h"
#include "tissu/world/description.h"

namespace tissu {

class RenewedLoad {
 public:
  /// From now on the load has no node.
  explicit RenewedLoad(LoadDescription& load) : load_(load) {
    load.nodes.clear();
    load.forces.clear();
    load.left.clear();
  }
  void add(std::int32_t node, const Vec3& force) {
    load_.nodes.push_back(node);
    load_.forces.insert(load_.forces.end(), force.data(), force.data() + 3);
  }
  /// A force that is not the one of the first day: so much for each component of what acts on an area.
  void add_left(std::int32_t node, const Vec3& per_unit) {
    load_.left.push_back({load_.nodes.size(), per_unit});
    add(node, per_unit.cwiseProduct(load_.unit));
  }

 private:
  LoadDescription& load_;
};

}  // namespace tissu
