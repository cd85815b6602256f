#pragma once

/// The ends of the boxes along each axis, kept sorted. Where a low end comes before a high one that it stood
/// behind, two boxes may begin to overlap.

#include <array>

#include "contact/meetings.h"
#include "contact/pair_sort.h"

namespace tissu {

class SweepAndPrune final : public BroadPhase {
 public:
  explicit SweepAndPrune(const SearchPlan& plan);

  [[nodiscard]] std::string_view name() const override { return "sweep_and_prune"; }
  void find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) override;
  [[nodiscard]] std::size_t bytes() const override;
  /// Ends that changed places in the latest call.
  [[nodiscard]] std::int64_t swaps() const { return swaps_; }
  /// Calls that sorted all ends and swept over them, the first one among them.
  [[nodiscard]] std::int64_t sweeps() const { return sweeps_; }

 private:
  struct End {
    float value;
    std::uint32_t number;  ///< of the primitive; the highest bit is that of a high end
    [[nodiscard]] bool is_high() const { return (number >> 31U) != 0U; }
    [[nodiscard]] std::int32_t primitive() const { return static_cast<std::int32_t>(number & 0x7FFFFFFFU); }
    /// Of ends in one place the low ones come first, so that boxes that touch overlap.
    [[nodiscard]] bool before(const End& other) const {
      return value < other.value || (value == other.value && number < other.number);
    }
  };
  void read(std::span<const Box> boxes);
  [[nodiscard]] bool carry_order(std::span<const Box> boxes);
  [[nodiscard]] bool carry_order_along(std::size_t axis, std::span<const Box> boxes);
  void sort_anew(std::vector<End>& ends);
  [[nodiscard]] static std::size_t sparsest_axis(std::span<const Box> boxes,
                                                 std::span<const std::int32_t> searched);
  void sweep(std::span<const Box> boxes);
  void join(std::span<const Box> boxes, std::vector<BoxPair>& pairs);

  Meetings meetings_;
  std::array<std::vector<End>, 3> ends_;
  std::vector<End> merged_;            ///< scratch of the merge sort
  std::vector<std::int32_t> open_;     ///< boxes that the sweep is inside of
  std::vector<std::int32_t> place_;    ///< of each primitive in `open_`
  std::vector<BoxPair> kept_;          ///< pairs of the latest call
  std::vector<BoxPair> begun_sorted_;  ///< pairs that begin to overlap in this one
  FoundPairs begun_;
  PairSort sort_;
  std::int64_t swaps_ = 0;
  std::int64_t sweeps_ = 0;
};

}  // namespace tissu
