#pragma once

/// The stored energy of each connected part: cells of different parts share no node.

#include <cstddef>
#include <cstdint>
#include <span>

#include "tissu/base/vec.h"
#include "tissu/cell/element_order.h"
#include "tissu/force/scratch.h"
#include "tissu/state/state.h"

namespace tissu {

/// A body's model that can say which part stores how much.
class PartEnergies {
 public:
  PartEnergies() = default;
  PartEnergies(const PartEnergies&) = delete;
  PartEnergies& operator=(const PartEnergies&) = delete;
  /// energies[part_of[i]] += what is stored at the nodes i of that part [J]; `part_of` has each row's part.
  virtual void add_part_energies(const State& state, Scratch& scratch, std::span<const std::int32_t> part_of,
                                 Reals energies) const = 0;

 protected:
  ~PartEnergies() = default;
};

/// Sums the energies of lanes by the parts of their elements, in the order of sums over all. `nodes` has
/// `size` nodes of each element.
inline void add_by_part(const ElementOrder& order, ConstReals of_lanes, std::span<const std::int32_t> nodes,
                        std::size_t size, std::span<const std::int32_t> part_of, Reals energies) {
  const auto add = [&](std::int32_t begin, std::int32_t end) {
    const auto last = static_cast<std::size_t>(end) * ElementOrder::kLanes;
    for (auto i = static_cast<std::size_t>(begin) * ElementOrder::kLanes; i < last; ++i) {
      if (order.real[i] == 0) continue;
      const std::int32_t node = nodes[size * static_cast<std::size_t>(order.element[i])];
      const std::int32_t part = part_of[static_cast<std::size_t>(node)];
      if (part >= 0) energies[static_cast<std::size_t>(part)] += of_lanes[i];
    }
  };
  if (order.runs.empty()) return add(0, order.groups());
  for (const ElementOrder::Run run : order.runs) add(run.begin, run.end);
}

}  // namespace tissu
