#pragma once

/// Cubes in eighths of cubes. A box is in the cube that holds its middle and is no smaller than the box, so
/// that it reaches out of it by half a side at most: a loose octree.

#include <array>

#include "contact/meetings.h"
#include "contact/pair_sort.h"

namespace tissu {

class Octree final : public BroadPhase {
 public:
  explicit Octree(const SearchPlan& plan);

  [[nodiscard]] std::string_view name() const override { return "octree"; }
  void find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) override;
  [[nodiscard]] std::size_t bytes() const override;
  /// Trees built so far, that of the first call among them.
  [[nodiscard]] std::int64_t builds() const { return builds_; }

 private:
  struct Placed {
    std::uint64_t cube;  ///< places along the three axes, bits interleaved, then the depth
    std::int32_t primitive;
  };
  /// What is in a cube stands together in `placed_`: its own boxes first, then cube by cube those inside.
  struct Node {
    Box box;             ///< of all that is in it
    std::int32_t first;  ///< of `placed_`
    std::int32_t own;    ///< end of its own
    std::int32_t end;
    std::int32_t next;  ///< the node after this one and those inside
  };
  [[nodiscard]] std::uint64_t cube_of(const Box& box) const;
  [[nodiscard]] bool most_stay(std::span<const Box> boxes) const;
  void build(std::span<const Box> boxes);
  void add_node(std::int32_t first, std::int32_t end, int depth);
  void follow(std::span<const Box> boxes);
  void add_pairs();
  void add_pairs_after(std::int32_t place);

  Meetings meetings_;
  std::array<double, 3> origin_{};
  double side_ = 0.0;  ///< of the largest cube
  std::vector<Placed> placed_;
  std::vector<Box> boxes_;   ///< of each of `placed_`
  std::vector<Node> nodes_;  ///< each before those inside it
  FoundPairs found_;
  PairSort sort_;
  std::int64_t builds_ = 0;
};

}  // namespace tissu
