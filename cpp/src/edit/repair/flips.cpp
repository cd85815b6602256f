#include "edit/repair/flips.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace tissu {
namespace {

using Triangle = std::array<std::int32_t, 3>;

Triangle face_of(const RepairCell& cell, std::size_t f) {
  Triangle face{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i != f) face[count++] = cell.nodes[i];
  }
  std::ranges::sort(face);
  return face;
}

/// New cells between the nodes of a patch; their faces are cut where those of the patch were.
class Flip {
 public:
  Flip(const RepairMesh& mesh, const std::vector<std::int32_t>& patch)
      : operation_{.kind = Repair::flip, .patch = patch} {
    for (const std::int32_t number : patch) {
      const RepairCell cell = mesh.cell(number);
      for (std::size_t f = 0; f < 4; ++f) cut_[face_of(cell, f)] |= cell.is_cut(f);
    }
  }

  /// A cell of the patch with another node in place of one of its own.
  void add(RepairCell cell, std::int32_t node, std::int32_t other) {
    cell.nodes[place_in(cell, node)] = other;
    cell.cut = 0;
    for (std::size_t f = 0; f < 4; ++f) {
      const auto known = cut_.find(face_of(cell, f));
      if (known != cut_.end() && known->second) cell.cut |= static_cast<std::uint8_t>(1U << f);
    }
    operation_.after.emplace_back(-1, cell);
  }
  [[nodiscard]] Operation operation() && { return std::move(operation_); }

 private:
  Operation operation_;
  std::map<Triangle, bool> cut_;
};

template <class Nodes>
bool are_kept(const Nodes& nodes, const KeptNodes& kept) {
  return std::ranges::all_of(nodes, [&](std::int32_t n) { return kept[static_cast<std::size_t>(n)] != 0; });
}

/// The face opposite to a node goes, and an edge between the two nodes beside it comes.
std::optional<Operation> two_to_three(const RepairMesh& mesh, std::int32_t number, std::size_t f,
                                      const KeptNodes& kept) {
  const RepairCell cell = mesh.cell(number);
  const Triangle face = face_of(cell, f);
  if (cell.is_cut(f) || are_kept(face, kept)) return std::nullopt;
  const std::vector<std::int32_t> beside = mesh.cells_with(face);
  if (beside.size() != 2) return std::nullopt;
  const std::int32_t other = beside[0] == number ? beside[1] : beside[0];
  const RepairCell next = mesh.cell(other);
  const auto top = std::ranges::find_if(
      next.nodes, [&](std::int32_t node) { return std::ranges::find(face, node) == face.end(); });
  if (next.is_cut(place_in(next, *top))) return std::nullopt;
  if (!mesh.cells_with(std::array{cell.nodes[f], *top}).empty()) return std::nullopt;
  Flip flip(mesh, beside);
  for (const std::int32_t node : face) flip.add(cell, node, *top);
  return std::move(flip).operation();
}

/// Nodes around an edge inside, and the cells between each and the next.
struct Ring {
  std::vector<std::int32_t> nodes;
  std::vector<std::int32_t> cells;
};
std::optional<Ring> ring_of(const RepairMesh& mesh, std::int32_t p, std::int32_t q) {
  std::vector<std::int32_t> left = mesh.cells_with(std::array{p, q});
  if (left.size() < 3 || left.size() > 4) return std::nullopt;
  const auto others = [&](std::int32_t number) {
    std::array<std::int32_t, 2> two{};
    std::size_t count = 0;
    for (const std::int32_t node : mesh.cell(number).nodes) {
      if (node != p && node != q) two[count++] = node;
    }
    return two;
  };
  for (const std::int32_t number : left) {
    const RepairCell cell = mesh.cell(number);
    for (const std::int32_t node : others(number)) {
      if (cell.is_cut(place_in(cell, node))) return std::nullopt;
    }
  }
  Ring ring{{others(left.front()).front()}, {}};
  while (!left.empty()) {
    const std::int32_t last = ring.nodes.back();
    const auto next = std::ranges::find_if(
        left, [&](std::int32_t number) { return std::ranges::count(others(number), last) > 0; });
    if (next == left.end()) return std::nullopt;
    const auto [a, b] = others(*next);
    ring.cells.push_back(*next);
    ring.nodes.push_back(a == last ? b : a);
    left.erase(next);
  }
  if (ring.nodes.front() != ring.nodes.back()) return std::nullopt;
  ring.nodes.pop_back();
  return ring;
}

/// The edge p q goes; of a ring of three nodes their triangle comes, of four an edge between the node `first`
/// and the one opposite to it.
std::optional<Operation> without_edge(const RepairMesh& mesh, std::int32_t p, std::int32_t q,
                                      const Ring& ring, std::size_t first) {
  const std::size_t size = ring.nodes.size();
  const auto node = [&](std::size_t i) { return ring.nodes[(first + i) % size]; };
  if (size == 3 && !mesh.cells_with(std::array{node(0), node(1), node(2)}).empty()) return std::nullopt;
  if (size == 4 && !mesh.cells_with(std::array{node(0), node(2)}).empty()) return std::nullopt;
  std::vector<std::int32_t> patch = ring.cells;
  std::ranges::sort(patch);
  Flip flip(mesh, patch);
  // Each triangle 0 i i+1 of the ring, from the cell between i and i + 1.
  for (std::size_t i = 1; i + 1 < size; ++i) {
    const RepairCell cell = mesh.cell(ring.cells[(first + i) % size]);
    flip.add(cell, q, node(0));
    flip.add(cell, p, node(0));
  }
  return std::move(flip).operation();
}

}  // namespace

std::vector<Operation> flips_of(const RepairMesh& mesh, std::int32_t number, const KeptNodes& kept) {
  std::vector<Operation> found;
  const auto add = [&](std::optional<Operation> flip) {
    if (flip) found.push_back(*std::move(flip));
  };
  const RepairCell cell = mesh.cell(number);
  for (std::size_t f = 0; f < 4; ++f) add(two_to_three(mesh, number, f, kept));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      const std::array edge{cell.nodes[i], cell.nodes[k]};
      if (are_kept(edge, kept)) continue;
      const auto ring = ring_of(mesh, edge[0], edge[1]);
      if (!ring) continue;
      const std::size_t ways = ring->nodes.size() == 4 ? 2 : 1;
      for (std::size_t first = 0; first < ways; ++first)
        add(without_edge(mesh, edge[0], edge[1], *ring, first));
    }
  }
  return found;
}

}  // namespace tissu
