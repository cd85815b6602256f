#pragma once

/// The dynamic tree of boxes of the Flexible Collision Library, with one box object for each primitive: a
/// comparison. It takes memory as it goes.

#include <memory>

#include "contact/meetings.h"
#include "contact/pair_sort.h"

namespace tissu {

class FclBroadPhase final : public BroadPhase {
 public:
  explicit FclBroadPhase(const SearchPlan& plan);
  ~FclBroadPhase() override;

  [[nodiscard]] std::string_view name() const override { return "fcl"; }
  void find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) override;
  /// Without what the library itself holds.
  [[nodiscard]] std::size_t bytes() const override;

 private:
  struct Library;  ///< its objects, so that its headers stay in one source

  Meetings meetings_;
  std::unique_ptr<Library> library_;
  FoundPairs found_;
  PairSort sort_;
};

}  // namespace tissu
