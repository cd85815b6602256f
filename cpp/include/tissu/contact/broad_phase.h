#pragma once

/// The first of the two phases of detection: which primitives have boxes that overlap.

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "tissu/contact/boxes.h"

namespace tissu {

/// Two primitives, a < b.
struct BoxPair {
  std::int32_t a;
  std::int32_t b;
  friend auto operator<=>(const BoxPair&, const BoxPair&) = default;
};

/// Primitives are numbered across the surfaces. Pairs are looked for between the surfaces that meet.
struct SearchPlan {
  struct Meeting {
    std::int32_t a;  ///< number of a surface
    std::int32_t b;  ///< of another one, or the same: its primitives meet each other
  };
  std::vector<std::int32_t> first;  ///< primitive of each surface, and the end
  std::vector<Meeting> meetings;    ///< each pair of surfaces once
};

/// A broad phase finds all pairs of primitives of surfaces that meet whose boxes overlap, each once, none
/// else, ascending: all of them give the same answer, so that which one ran changes no bit of a step. What it
/// keeps from one call to the next changes its time alone. Memory is taken when there are more boxes or pairs
/// than before, never else.
class BroadPhase {
 public:
  BroadPhase() = default;
  virtual ~BroadPhase() = default;
  BroadPhase(const BroadPhase&) = delete;
  BroadPhase& operator=(const BroadPhase&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// One box for each primitive of the plan. Throws ParameterError where their number is another, or a box
  /// holds NaN, an infinite number, or a low side above its high side.
  virtual void find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

enum class BroadPhaseKind { hierarchy, sweep_and_prune, grid, octree, fcl };

/// Throws ParameterError for `fcl` where the library was built without it, and for a plan whose meetings name
/// no surface or whose `first` does not ascend from 0. A meeting that is named twice counts once.
std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, const SearchPlan& plan);

}  // namespace tissu
