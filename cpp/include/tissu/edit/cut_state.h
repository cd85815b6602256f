#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "tissu/edit/cut/material.h"
#include "tissu/world/world.h"

namespace tissu {

/// The cells of a body as a cut sees them, and what blades have left of the material of those that they met.
struct CutState {
  Hosts hosts;
  Material material;
};

/// As what a cut sees the cells of a block: volumes, sheets and lines of all types; nothing for points.
std::optional<CellType> host_type(const ElasticBlock& block);

/// Whether a body is made of cells, which have a material that can be cut: volumes, sheets and lines. The
/// points of tissue are not cells, and listen to frames anywhere. Nodes may have rotations.
bool has_material(const BodyDescription& body);

/// Of a body as its description has it: every cell whole, or the material given.
CutState cut_state_of(BodyDescription body, Material material = {});

/// The same of the cells and the material that a body has; made anew where it was never cut.
std::shared_ptr<const CutState> cut_state_now(const BodyDescription& body);

/// Of a body of a world that can be edited; made anew where it was never cut.
std::shared_ptr<const CutState> cut_state(const World& world, std::string_view body);

}  // namespace tissu
