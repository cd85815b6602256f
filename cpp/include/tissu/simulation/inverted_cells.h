#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tissu/element/reference_cell.h"
#include "tissu/model/points/thin_ratios.h"
#include "tissu/world/world.h"

namespace tissu {

/// Numbers of the cells of a body that are inside out, ascending. A volume cell is when det F <= 0 at a point
/// of its quadrature, where its law is evaluated, or at one of the element's full rule. Of cells whose points
/// are not their own (frames) and of thin ones the mean det F counts. Eliminated nodes are taken where the
/// state has them: settle it first.
std::vector<std::int32_t> inverted_cells(const World& world, const State& state, const Body& body);

/// Whether any cell of a world is inside out, asked again and again: it takes no memory.
class InversionCheck {
 public:
  explicit InversionCheck(const World& world);
  /// `world` is the one that it was made for.
  [[nodiscard]] bool any(const World& world, const State& state);

 private:
  struct Rules {
    ReferenceCell own;
    ReferenceCell full;
    bool by_points = false;          ///< else by the mean det F, …
    std::optional<ThinRatios> thin;  ///< … the volume ratios of sheets and lines

    [[nodiscard]] bool any(const World& world, const State& state, const BodyModel& model,
                           Scratch& scratch) const;
  };
  std::vector<Rules> rules_;  ///< of each model of each body
  Scratch scratch_;
};

/// A sentence on the cells of all bodies that are inside out; empty where there are none.
std::string say_inverted(const World& world, const State& state);

}  // namespace tissu
