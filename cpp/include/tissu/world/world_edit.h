#pragma once

/// Edits bodies of a world in place: what an edit does not touch stays as it is, where it is. What comes out
/// is the world that is made of the edited description, bit for bit, but for where rows and groups of cells
/// stand in memory.

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/model/cell_editor.h"
#include "tissu/world/world.h"

namespace tissu {

/// An edit of one body, in its own numbers.
struct BodyChange {
  CellEdit cells;
  /// Of each new node, which follow the last: the node that it copies; -1 - i: it is at point i of the body.
  std::vector<std::int32_t> copied;
  std::vector<FirstDayPoint> points;  ///< of those nodes, which follow the points of the body
  std::vector<std::int32_t> nodes;    ///< whose cells change, new ones among them, ascending
  std::vector<std::int32_t> bare;     ///< all nodes with cells but without material, ascending
  std::int32_t next_cell = 0;
  std::vector<std::int32_t> loose;  ///< nodes that no cell uses from now on
  std::vector<double> places;       ///< where they are held [m], three numbers each
};

class WorldEdit {
 public:
  /// Whether any body of a world can be edited in place.
  static bool serves(const World& world);
  /// Of a world that was made for editing and outlives it.
  explicit WorldEdit(World& world);

  /// Material of cells at rest [m3], and their elastic energy [J].
  [[nodiscard]] double volume(std::string_view body, std::span<const std::int32_t> cells) const;
  [[nodiscard]] double energy(std::string_view body, std::span<const std::int32_t> cells, ConstReals x) const;
  /// What the world and a body are made of, for what is kept beside cells and nodes.
  [[nodiscard]] WorldDescription& description();
  [[nodiscard]] BodyDescription& description(std::string_view body);
  /// Whether any edit of a body can be made in place.
  [[nodiscard]] bool follows(std::string_view body) const {
    return !bodies_[number_of(body)].editors.empty();
  }
  /// Whether an edit of a body can be made in place. It cannot where models of the body or forces of the
  /// world follow cells in other ways, or where it leaves no cell of a block.
  [[nodiscard]] bool can(std::string_view body, const BodyChange& change) const;
  /// Whether nodes part or come loose that are held or loaded, or cells change at faces that are loaded.
  [[nodiscard]] bool parts_bound(std::string_view body, const BodyChange& change) const;
  /// Whether supports and loads can follow such an edit: not while a run leads or changes them, and not where
  /// a support that has a name would lose all its nodes.
  [[nodiscard]] bool may_part_bound(std::string_view body, const BodyChange& change,
                                    const State& state) const;
  /// Supports are those of the description now.
  void renew_supports();
  /// Loads on a body are those of the description now.
  void renew_loads(std::string_view body);
  /// Pressures on a body act on the faces that its description has now.
  void renew_pressures(std::string_view body);
  /// Takes the surfaces of a contact made by `with_surfaces`, and gives it its own.
  void exchange_surfaces(Contact& other);
  /// Cells at a node of the body after the edit, ascending.
  using CellsAt = std::function<std::span<const std::int32_t>(std::int32_t)>;
  /// Returns the rows of the world whose columns changed, ascending.
  std::vector<std::int32_t> apply(std::string_view body, const BodyChange& change, const CellsAt& cells_at);

 private:
  struct EditedBody {
    std::vector<std::unique_ptr<CellEditor>> editors;  ///< of its models; empty: it is not edited in place
    std::vector<BlockTable> tables;                    ///< of the blocks of its description
    std::vector<char> bound;                           ///< its nodes that are held or loaded
    std::vector<char> held_at_first;                   ///< by supports of the first day
    std::vector<char> faces;                           ///< of the first day, on faces that a load acts on
  };
  [[nodiscard]] std::size_t number_of(std::string_view body) const;
  void prepare(std::size_t body);
  void list_bound(std::size_t body);
  [[nodiscard]] bool changes_faces(std::size_t body, const BodyChange& change) const;
  void add_nodes(std::size_t body, const BodyChange& change);
  void edit_description(std::size_t body, const BodyChange& change);
  void lay_rows(std::size_t body, std::span<const std::int32_t> rows, const CellsAt& cells_at);
  void weigh(std::size_t body, std::span<const std::int32_t> rows, const CellsAt& cells_at);
  void loosen(std::size_t body, const BodyChange& change);

  World& world_;
  std::vector<EditedBody> bodies_;
  std::int64_t first_blocks_;  ///< of the matrix
  Eigen::AlignedBox3d box_;    ///< around all rows at rest
};

}  // namespace tissu
