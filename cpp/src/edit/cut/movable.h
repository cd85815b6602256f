#pragma once

/// Nodes that a cut moves: where they are, and how far they may go.

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tissu/edit/cut/hosts.h"

namespace tissu {

/// A mesh of tetrahedra whose nodes move one at a time.
class Movable {
 public:
  Movable(const Hosts& hosts, ConstReals x) : before_(&hosts), hosts_(hosts), x_(x.begin(), x.end()) {}

  [[nodiscard]] const Hosts& hosts() const { return hosts_; }
  [[nodiscard]] ConstReals x() const { return x_; }
  [[nodiscard]] const std::vector<NodeMove>& moves() const { return moves_; }

  using Face = std::array<std::int32_t, 2>;  ///< the two other corners of a face at a node
  /// The faces at a node that belong to one cell alone.
  [[nodiscard]] std::vector<Face> border(std::int32_t node) const;
  /// A place of present space in one of the cells at a node; nothing where none of them has it.
  [[nodiscard]] std::optional<Rider> locate(std::int32_t node, const Vec3& place) const;
  /// The least quality at rest of the cells at a node after a move, where it is allowed; else nothing.
  /// `length`: of the edge for which it moves.
  [[nodiscard]] std::optional<double> quality_after(const NodeMove& move, double length);
  void move(const NodeMove& move);

 private:
  [[nodiscard]] double first_quality(std::int32_t cell);

  const Hosts* before_;
  Hosts hosts_;
  std::vector<double> x_;
  std::vector<NodeMove> moves_;
  std::unordered_map<std::int32_t, double> qualities_;  ///< of cells before the first move
};

}  // namespace tissu
