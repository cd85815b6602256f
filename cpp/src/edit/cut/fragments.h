#pragma once

/// The parts of each host, and the nodes of each part.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "edit/cut/carriers.h"
#include "edit/cut/patch.h"
#include "tissu/edit/cut/cut_plan.h"

namespace tissu {

/// Fragments of the hosts around the cells that were opened or removed: their material joined through
/// unopened faces. Fragments have the order of the numbers of their hosts.
class Fragments {
 public:
  struct Fragment {
    std::int32_t cell;  ///< place in the patch
    std::int32_t first_item;
    double volume;  ///< at rest [m3]
  };

  /// `touched`: numbers of hosts whose nodes may part, ascending; every cell at a node of them is in the
  /// patch. `removed`: of these, those that go, ascending.
  Fragments(const Hosts& hosts, const Patch& patch, const std::vector<std::int32_t>& touched,
            const std::vector<std::int32_t>& removed);

  [[nodiscard]] const std::vector<Fragment>& all() const { return fragments_; }
  /// The fragment of a tetrahedron; -1 where its host stays as it is or goes.
  [[nodiscard]] std::int32_t of(std::int32_t tetra) const { return of_[static_cast<std::size_t>(tetra)]; }
  /// The nodes of a fragment after the cut, in the order of its host's.
  [[nodiscard]] std::span<const std::int32_t> nodes(std::int32_t fragment) const;
  /// What a node of the fragment's host becomes.
  [[nodiscard]] std::int32_t becomes(std::int32_t fragment, std::int32_t node) const;
  [[nodiscard]] const std::vector<BornNode>& born() const { return born_; }
  /// Touched old nodes that have no material at them after the cut.
  [[nodiscard]] const std::vector<std::int32_t>& emptied() const { return emptied_; }
  /// Tetrahedra across the faces, -1 where no unopened material joins.
  [[nodiscard]] const std::vector<std::array<std::int32_t, 4>>& across() const { return across_; }
  /// Which pieces of different dimensions go together.
  [[nodiscard]] const Carriers& carriers() const { return carriers_; }

 private:
  void find_nodes(const std::vector<std::int32_t>& touched);
  void find_fragments(const std::vector<std::int32_t>& removed);
  void find_groups();
  void number_groups(std::int32_t node, const std::vector<std::int32_t>& items);
  [[nodiscard]] bool material_at(std::int32_t item) const;
  [[nodiscard]] double depth(std::int32_t fragment, const Vec3& p) const;
  [[nodiscard]] double depth_in(const Patch::Tetra& thin, const Vec3& p) const;

  const Hosts& hosts_;
  const Patch& patch_;
  std::vector<std::int32_t> touched_nodes_;  ///< ascending
  std::vector<std::int32_t> cells_;          ///< numbers of the hosts at them, ascending
  std::vector<std::array<std::int32_t, 4>> across_;
  Carriers carriers_;
  std::vector<std::int32_t> of_;
  std::vector<Fragment> fragments_;
  std::vector<std::int32_t> item_fragment_;
  std::vector<std::int32_t> item_first_;   ///< what stands for the items joined with this one
  std::vector<std::int32_t> item_node_;    ///< after the cut
  std::vector<std::int32_t> tetra_order_;  ///< tetrahedra, fragment after fragment
  std::vector<std::int32_t> tetra_first_;  ///< of each fragment in the list, and the end
  std::vector<BornNode> born_;
  std::vector<std::int32_t> emptied_;
};

}  // namespace tissu
