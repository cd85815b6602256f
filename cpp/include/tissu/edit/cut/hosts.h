#pragma once

/// The cells of a body as a cut sees them: by numbers that live for ever, with the cells at each node.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "tissu/base/vec.h"
#include "tissu/mesh/mesh.h"

namespace tissu {

struct CutPlan;

/// A point of the material as weights of nodes, which sum to 1. A tetrahedron of the material lies inside one
/// between four corners of its host, so that four pairs are enough.
struct Rider {
  std::array<std::int32_t, 4> node{-1, -1, -1, -1};
  std::array<double, 4> weight{};
  std::int32_t count = 0;

  /// sum w x_node
  [[nodiscard]] Vec3 at(ConstReals x) const;
};

/// A node that goes to another place of the material: between nodes as they are after the moves before it.
struct NodeMove {
  std::int32_t node;
  Rider to;
};

/// A host is a cell that carries material: a first-day cell, or a replica that holds a part of one. Numbers
/// of cells and nodes are for ever: new ones follow the last, none is used twice.
class Hosts {
 public:
  /// One host by itself, as a file keeps it.
  struct Cell {
    std::int32_t number;
    CellType type;
    std::int32_t origin;  ///< number of the first-day cell
    double share;         ///< of the volume of the first-day cell's material
    std::vector<std::int32_t> nodes;
    double thickness = 1.0;  ///< of a sheet at rest [m], of a line its section [m2]; 1 for a volume
  };

  /// The cells of a first day, numbered across the blocks.
  explicit Hosts(const Mesh& mesh);
  /// Hosts as a file kept them: `rest` has 3 numbers per node [m], `root` the first-day node of each, `cells`
  /// ascend in number. Throws ParameterError where these do not fit together.
  /// `points`: the places on the first day of nodes that blades put on edges. `moved`: see `moved()`.
  Hosts(std::vector<double> rest, std::vector<std::int32_t> root, std::span<const Cell> cells,
        std::int32_t next_cell, std::vector<Rider> points = {}, bool moved = false);

  /// The same hosts, to which a plan may be applied that the others are kept from. What no plan touches is
  /// read from them: they outlive these, and stay as they are. It has no clusters.
  static Hosts over(const Hosts& below);

  [[nodiscard]] std::int32_t node_count() const {
    return first_node_ + static_cast<std::int32_t>(root_.size());
  }
  [[nodiscard]] std::int32_t next_cell() const {
    return first_cell_ + static_cast<std::int32_t>(cells_.size());
  }
  /// Numbers of the cells that are there, ascending.
  [[nodiscard]] std::vector<std::int32_t> numbers() const;

  [[nodiscard]] bool has(std::int32_t cell) const;
  [[nodiscard]] CellType type(std::int32_t cell) const { return slot(cell).type; }
  [[nodiscard]] std::int32_t origin(std::int32_t cell) const { return slot(cell).origin; }
  [[nodiscard]] double share(std::int32_t cell) const { return slot(cell).share; }
  [[nodiscard]] double thickness(std::int32_t cell) const { return slot(cell).thickness; }
  [[nodiscard]] std::span<const std::int32_t> nodes(std::int32_t cell) const;
  [[nodiscard]] std::span<const std::int32_t> corners(std::int32_t cell) const;

  /// Rest places of the nodes [m], 3 numbers each.
  [[nodiscard]] ConstReals rest() const { return rest_; }
  /// The first-day node that a node is a copy of; itself on the first day. Of a node that a blade put on an
  /// edge, -1 - i for the place points()[i] of the first day.
  [[nodiscard]] std::int32_t root(std::int32_t node) const {
    if (node < first_node_) return below_->root(node);
    return root_[static_cast<std::size_t>(node - first_node_)];
  }
  /// Between no nodes: on an edge that a repair made, between more than four nodes of the first day.
  [[nodiscard]] const std::vector<Rider>& points() const { return points_; }
  /// The same point between nodes of the first day, which are corners of one cell of that day. Places at rest
  /// follow from these alone, whatever the cuts were between. An edge that a repair made may lie between more
  /// than four nodes: then the point is between none.
  [[nodiscard]] Rider on_first_day(const Rider& rider) const;
  /// Whether a node was moved at rest, or lies between no nodes of the first day: then rest places do not
  /// follow from those of the first day.
  [[nodiscard]] bool moved() const { return moved_; }
  /// Numbers of the cells at a node, ascending.
  [[nodiscard]] std::span<const std::int32_t> cells_at(std::int32_t node) const {
    if (node < first_node_) return cells_at_below(node);
    return cells_at_[static_cast<std::size_t>(node - first_node_)];
  }

  /// Whether a volume cell has all corners of this one.
  [[nodiscard]] bool lies_in_volume(std::int32_t cell) const;

  /// The cells at the nodes of some cells, themselves included, ascending.
  [[nodiscard]] std::vector<std::int32_t> with_neighbours(std::span<const std::int32_t> cells) const;

  /// Cells that lie together, and every node that a corner of one of them is.
  struct Cluster {
    std::vector<std::int32_t> cells;
    std::vector<std::int32_t> corners;
    Eigen::AlignedBox3d rest = {};  ///< around the corners at rest; may be larger
  };
  [[nodiscard]] std::span<const Cluster> clusters() const { return clusters_; }

  void apply(const CutPlan& plan);
  /// Puts a node at another place at rest.
  void move(const NodeMove& move);
  /// Throws ParameterError, and removes none, when one of them is not there.
  void remove(std::span<const std::int32_t> cells);

 private:
  struct Slot {
    std::int32_t first;  ///< place of its nodes in the pool; -1: the cell is gone
    std::int32_t origin;
    double share;
    CellType type;
    std::int32_t cluster;
    double thickness;
  };
  [[nodiscard]] const Slot& slot(std::int32_t cell) const {
    if (cell < first_cell_) return slot_below(cell);
    return cells_[static_cast<std::size_t>(cell - first_cell_)];
  }
  /// What is edited of the hosts below is copied first.
  [[nodiscard]] const Slot& slot_below(std::int32_t cell) const;
  [[nodiscard]] std::span<const std::int32_t> cells_at_below(std::int32_t node) const;
  [[nodiscard]] std::span<const std::int32_t> pooled(std::int32_t cell, int count) const;
  Slot& editable_slot(std::int32_t cell);
  std::vector<std::int32_t>& editable_cells_at(std::int32_t node);
  void add(const Cell& cell, std::int32_t cluster);
  void take_out(std::int32_t cell);
  void replace_nodes(std::int32_t cell, std::span<const std::int32_t> nodes);
  void make_clusters();
  void join_cluster(std::int32_t cell, std::int32_t cluster);

  Hosts() = default;

  const Hosts* below_ = nullptr;  ///< of `over`
  std::int32_t first_node_ = 0;   ///< nodes before it are of those below, …
  std::int32_t first_cell_ = 0;   ///< … and cells before it, but for these:
  std::unordered_map<std::int32_t, Slot> slots_over_;
  std::unordered_map<std::int32_t, std::vector<std::int32_t>> cells_at_over_;
  std::vector<double> rest_;
  std::vector<std::int32_t> root_;
  std::vector<Rider> points_;  ///< in nodes of the first day
  bool moved_ = false;
  std::vector<Slot> cells_;         ///< by number, from `first_cell_` on
  std::vector<std::int32_t> pool_;  ///< the nodes of the cells
  std::vector<std::vector<std::int32_t>> cells_at_;
  std::vector<Cluster> clusters_;
};

}  // namespace tissu
