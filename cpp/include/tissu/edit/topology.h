#pragma once

/// What edits have made of a body, as plain data: from it and the world of the first day the same world comes
/// again, with the same bits, whatever the edits were.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tissu/edit/cut/material.h"
#include "tissu/state/state.h"
#include "tissu/world/world.h"

namespace tissu {

/// The material of cut cells as lists.
struct PackedMaterial {
  std::vector<std::int32_t> rider_nodes;  ///< four for each rider, -1 beyond the last
  std::vector<double> rider_weights;      ///< four for each
  std::vector<std::int32_t> hosts;        ///< ascending
  std::vector<std::int32_t> first;        ///< of each host the first of its tetrahedra, and their number
  std::vector<std::int32_t> vertices;     ///< four for each tetrahedron, kNoVertex where there is none
  std::vector<std::int32_t> cut;          ///< of each, the bits of its opened faces
  std::vector<std::int32_t> incisions;    ///< numbers, ascending
  std::vector<std::int32_t> first_of_incision;
  std::vector<std::int32_t> on_incision;  ///< vertices
  std::vector<std::int32_t> at_front;     ///< of each of these: 1 at the front of the incision, else 0
};

struct BodyTopology {
  std::string body;
  std::vector<std::int32_t> cells;        ///< that are there, by their numbers
  std::vector<std::int32_t> loose_nodes;  ///< that no cell uses, numbers in the body
  std::vector<double> places;             ///< where these are held [m], three for each
  // Of a body that was cut only:
  std::vector<std::int32_t> origins;      ///< the first day's cell that each cell comes from
  std::vector<double> shares;             ///< of material, of each
  std::vector<std::int32_t> nodes;        ///< cell after cell
  std::vector<std::int32_t> copies_of;    ///< of the nodes that edits made: as `BodyDescription` has them
  std::vector<std::int32_t> point_nodes;  ///< of its points, four for each, -1 beyond the last
  std::vector<double> point_weights;      ///< four for each
  std::vector<double> rest;               ///< of all nodes [m], where cuts moved some at rest; else empty
  std::vector<std::int32_t> bare;         ///< nodes without material at them
  std::int32_t next_cell = 0;             ///< the number that the next cell gets
  PackedMaterial material;

  [[nodiscard]] bool was_cut() const { return !origins.empty(); }
};

PackedMaterial pack(const Material& material);
/// Refuses lists that do not fit together, or name other nodes than 0 to `nodes` - 1.
Material unpack(const PackedMaterial& packed, std::int32_t nodes);

/// Of every body of a world that can be edited; empty for others.
std::vector<BodyTopology> topologies(const World& world);

/// `fresh`, from which no cell was taken yet, edited so that its bodies are as told; null where they are so
/// already. Refuses what does not fit.
std::shared_ptr<const World> with_topologies(const World& fresh, const std::vector<BodyTopology>& bodies);

}  // namespace tissu
