#pragma once

/// The tetrahedra of a body while repairs change them, one after the other.

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "edit/repair/operation.h"
#include "tissu/edit/cut/cut_plan.h"
#include "tissu/edit/cut/hosts.h"
#include "tissu/edit/cut/material.h"

namespace tissu {

/// Copies only what changes. Cells of the body have their numbers, new ones follow the last.
class RepairMesh {
 public:
  RepairMesh(const Hosts& hosts, const Material& material, ConstReals x);

  [[nodiscard]] bool has(std::int32_t cell) const;
  /// Numbers of the cells that are there, ascending.
  [[nodiscard]] std::vector<std::int32_t> numbers() const;
  /// Whether it is a tetrahedron of first order.
  [[nodiscard]] bool is_tetra(std::int32_t cell) const;
  [[nodiscard]] RepairCell cell(std::int32_t number) const;
  /// Numbers of the cells at a node, ascending; those that are not tetrahedra too.
  [[nodiscard]] std::span<const std::int32_t> cells_at(std::int32_t node) const;
  /// Numbers of the tetrahedra that have all of these nodes, ascending.
  [[nodiscard]] std::vector<std::int32_t> cells_with(std::span<const std::int32_t> nodes) const;
  /// Whether all cells at a node are tetrahedra.
  [[nodiscard]] bool is_solid(std::int32_t node) const;

  /// A face at a node: its other corners, the node of the cell that is not on it, and whether a cut opened
  /// it.
  struct Face {
    std::array<std::int32_t, 2> others;
    std::int32_t behind;
    bool cut;
  };
  /// The faces at a node that belong to one cell alone, or that a cut opened; one of two cells twice.
  [[nodiscard]] std::vector<Face> border(std::int32_t node) const;

  [[nodiscard]] Vec3 rest(std::int32_t node) const { return block(ConstReals(rest_), node); }
  [[nodiscard]] Vec3 now(std::int32_t node) const { return block(ConstReals(x_), node); }
  [[nodiscard]] ConstReals all_now() const { return x_; }
  [[nodiscard]] ConstReals all_rest() const { return rest_; }

  /// Numbers of the cells afterwards, in the order of the operation.
  std::vector<std::int32_t> apply(const Operation& operation);
  /// All that was changed; numbers of new cells are made to follow each other.
  [[nodiscard]] CutPlan plan() const;

 private:
  std::vector<std::int32_t>& own_cells_at(std::int32_t node);
  void join(std::int32_t number, const RepairCell& cell);
  void leave(std::int32_t number);

  const Hosts& hosts_;
  const Material& material_;
  std::vector<double> rest_;
  std::vector<double> x_;
  std::vector<NodeMove> moves_;
  std::unordered_map<std::int32_t, RepairCell> cells_;  ///< new and changed
  std::set<std::int32_t> gone_;
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> at_;  ///< of nodes whose cells changed
  std::int32_t next_;
};

}  // namespace tissu
