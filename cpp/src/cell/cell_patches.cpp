#include "tissu/cell/cell_patches.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "tissu/base/error.h"
#include "tissu/mesh/cell_shape.h"

namespace tissu {
namespace {

using Numbers = std::vector<std::int32_t>;

/// How large patches are: cells that a node takes at most and at least, and that a patch has at most once
/// those that are left have joined it. Measured: of a third less, tetrahedra still lock, and of twice as many
/// coarse meshes are too soft; docs/measured/mean-dilatation.md.
struct Sizes {
  std::size_t most;
  std::size_t least;
  std::size_t full;
};
Sizes sizes_of(CellType type) { return type == CellType::tetra ? Sizes{8, 4, 12} : Sizes{6, 4, 10}; }

/// Puts the cells of one type together.
class Grouping {
 public:
  Grouping(CellType type, std::span<const std::int32_t> cells, std::size_t size,
           std::span<const std::int32_t> kinds)
      : cells_(cells), size_(size), kinds_(kinds), sizes_(sizes_of(type)), patch_(cells.size() / size, -1) {
    find_cells_of_nodes();
    find_neighbours(faces(type));
  }
  Numbers found() {
    take_stars();
    for (bool changed = true; changed;) changed = join_rest(sizes_.full);
    gather_rest();
    join_single();
    return numbered();
  }

 private:
  struct Patch {
    std::size_t cells = 0;
    Numbers nodes;
  };
  std::span<const std::int32_t> cell(std::int32_t e) const {
    return cells_.subspan(static_cast<std::size_t>(e) * size_, size_);
  }
  bool is_free(std::int32_t e) const { return patch_[static_cast<std::size_t>(e)] < 0; }
  bool alike(std::int32_t one, std::int32_t other) const {
    return kinds_.empty() || kinds_[static_cast<std::size_t>(one)] == kinds_[static_cast<std::size_t>(other)];
  }
  std::span<const std::int32_t> cells_of(std::int32_t node) const {
    const auto n = static_cast<std::size_t>(node);
    return {of_node_.data() + first_[n], static_cast<std::size_t>(first_[n + 1] - first_[n])};
  }
  std::int32_t free_cells(std::int32_t node) const {
    return static_cast<std::int32_t>(
        std::ranges::count_if(cells_of(node), [&](std::int32_t e) { return is_free(e); }));
  }

  void find_cells_of_nodes() {
    const std::int32_t nodes = *std::ranges::max_element(cells_) + 1;
    first_.assign(static_cast<std::size_t>(nodes) + 1, 0);
    for (const std::int32_t node : cells_) ++first_[static_cast<std::size_t>(node) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    of_node_.resize(cells_.size());
    Numbers next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      of_node_[static_cast<std::size_t>(next[static_cast<std::size_t>(cells_[i])]++)] =
          static_cast<std::int32_t>(i / size_);
    }
  }

  void find_neighbours(std::span<const LocalFace> faces) {
    using Face = std::pair<std::array<std::int32_t, 4>, std::int32_t>;  // its nodes in order, its cell
    std::vector<Face> all;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(patch_.size()); ++e) {
      for (const LocalFace& face : faces) {
        std::array<std::int32_t, 4> nodes{-1, -1, -1, -1};
        for (std::size_t c = 0; c < static_cast<std::size_t>(face.corners); ++c)
          nodes[c] = cell(e)[face.node[c]];
        std::ranges::sort(nodes);
        all.emplace_back(nodes, e);
      }
    }
    std::ranges::sort(all);
    neighbours_.resize(patch_.size());
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      if (all[i].first != all[i + 1].first || !alike(all[i].second, all[i + 1].second)) continue;
      neighbours_[static_cast<std::size_t>(all[i].second)].push_back(all[i + 1].second);
      neighbours_[static_cast<std::size_t>(all[i + 1].second)].push_back(all[i].second);
    }
    for (Numbers& of_cell : neighbours_) std::ranges::sort(of_cell);
  }

  /// Nodes of the patch with those of the cell.
  Numbers with(const Patch& patch, std::int32_t e) const {
    Numbers nodes = patch.nodes;
    for (const std::int32_t node : cell(e)) {
      if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
    }
    return nodes;
  }
  bool put(std::int32_t e, std::size_t patch, std::size_t most) {
    if (patches_[patch].cells >= most) return false;
    Numbers nodes = with(patches_[patch], e);
    if (nodes.size() > static_cast<std::size_t>(kMostPatchNodes)) return false;
    patches_[patch].nodes = std::move(nodes);
    ++patches_[patch].cells;
    patch_[static_cast<std::size_t>(e)] = static_cast<std::int32_t>(patch);
    return true;
  }

  /// Free cells that `may` join, from one of them on through faces, until there are enough.
  template <class Function>
  Numbers connected(std::int32_t from, std::size_t enough, Function&& may) const {
    Numbers front{from};
    for (std::size_t i = 0; i < front.size() && front.size() < enough; ++i) {
      for (const std::int32_t next : neighbours_[static_cast<std::size_t>(front[i])]) {
        if (is_free(next) && may(next) && std::ranges::find(front, next) == front.end())
          front.push_back(next);
      }
    }
    return front;
  }
  /// The most free cells of a node that hang together, those near the first of them before the others.
  Numbers star_of(std::int32_t node) const {
    const auto of_node = cells_of(node);
    const auto is_here = [&](std::int32_t e) { return std::ranges::binary_search(of_node, e); };
    Numbers best;
    for (const std::int32_t e : of_node) {
      if (!is_free(e) || std::ranges::find(best, e) != best.end()) continue;
      Numbers found = connected(e, of_node.size(), is_here);
      if (found.size() > best.size()) best = std::move(found);
    }
    return best;
  }
  void make_patch(const Numbers& cells) {
    patches_.emplace_back();
    for (const std::int32_t e : cells) {
      if (!put(e, patches_.size() - 1, sizes_.most)) return;
    }
  }

  /// The node with most free cells takes them.
  void take_stars() {
    std::priority_queue<std::pair<std::int32_t, std::int32_t>> queue;  // free cells, minus the node
    const auto nodes = static_cast<std::int32_t>(first_.size()) - 1;
    for (std::int32_t node = 0; node < nodes; ++node) queue.emplace(free_cells(node), -node);
    while (!queue.empty()) {
      const auto [count, minus] = queue.top();
      queue.pop();
      const std::int32_t now = free_cells(-minus);
      if (static_cast<std::size_t>(now) < sizes_.least) continue;
      if (now == count) {
        const Numbers star = star_of(-minus);
        if (star.size() < sizes_.least) continue;
        make_patch(star);
      }
      queue.emplace(free_cells(-minus), minus);
    }
  }

  /// The patch across a face that has fewest cells; -1 when there is none.
  std::int32_t smallest_beside(std::int32_t e) const {
    std::int32_t best = -1;
    for (const std::int32_t next : neighbours_[static_cast<std::size_t>(e)]) {
      const std::int32_t p = patch_[static_cast<std::size_t>(next)];
      if (p < 0 || p == patch_[static_cast<std::size_t>(e)]) continue;
      const auto size = [&](std::int32_t patch) { return patches_[static_cast<std::size_t>(patch)].cells; };
      if (best < 0 || size(p) < size(best)) best = p;
    }
    return best;
  }
  bool join_rest(std::size_t most) {
    bool changed = false;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(patch_.size()); ++e) {
      if (!is_free(e)) continue;
      const std::int32_t patch = smallest_beside(e);
      changed = (patch >= 0 && put(e, static_cast<std::size_t>(patch), most)) || changed;
    }
    return changed;
  }
  /// Cells between full patches make patches of their own, …
  void gather_rest() {
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(patch_.size()); ++e) {
      if (is_free(e)) make_patch(connected(e, sizes_.most, [](std::int32_t) { return true; }));
    }
  }
  /// … but one that stands alone joins a full one.
  void join_single() {
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(patch_.size()); ++e) {
      const auto own = static_cast<std::size_t>(patch_[static_cast<std::size_t>(e)]);
      if (patches_[own].cells > 1) continue;
      const std::int32_t other = smallest_beside(e);
      if (other >= 0 && put(e, static_cast<std::size_t>(other), patch_.size())) patches_[own].cells = 0;
    }
  }
  /// Numbers without gaps.
  Numbers numbered() {
    Numbers number(patches_.size(), -1);
    std::int32_t count = 0;
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      if (patches_[p].cells > 0) number[p] = count++;
    }
    for (std::int32_t& patch : patch_) patch = number[static_cast<std::size_t>(patch)];
    return std::move(patch_);
  }

  std::span<const std::int32_t> cells_;
  std::size_t size_;
  std::span<const std::int32_t> kinds_;
  Sizes sizes_;
  Numbers patch_;
  Numbers first_;                    ///< [node + 1], in of_node_
  Numbers of_node_;                  ///< cells of each node, ascending
  std::vector<Numbers> neighbours_;  ///< across faces, of one kind
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<std::int32_t> group_cells(std::string_view element, std::span<const std::int32_t> cells, int size,
                                      std::span<const std::int32_t> kinds) {
  const std::optional<CellType> type = cell_type(element);
  if (!type) throw ParameterError("unknown cell type \"" + std::string(element) + "\".");
  if (*type != CellType::hexahedron)
    return Grouping(*type, cells, static_cast<std::size_t>(size), kinds).found();
  Numbers own(cells.size() / static_cast<std::size_t>(size));
  std::iota(own.begin(), own.end(), 0);
  return own;
}

}  // namespace tissu
