#pragma once

/// A tree of boxes for each surface; two trees are walked together for each meeting.

#include "contact/box_tree.h"
#include "contact/meetings.h"
#include "contact/pair_sort.h"

namespace tissu {

class Hierarchy final : public BroadPhase {
 public:
  explicit Hierarchy(const SearchPlan& plan) : meetings_(plan) {}

  [[nodiscard]] std::string_view name() const override { return "hierarchy"; }
  void find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) override;
  [[nodiscard]] std::size_t bytes() const override;
  /// Trees built so far, those of the first call among them.
  [[nodiscard]] std::int64_t builds() const { return builds_; }

 private:
  void build(std::int32_t surface, std::span<const Box> boxes);
  void follow(std::span<const Box> boxes);

  Meetings meetings_;
  std::vector<BoxTree> trees_;  ///< of each surface; empty where it meets none
  FoundPairs found_;
  PairSort sort_;
  std::int64_t builds_ = 0;
};

}  // namespace tissu
