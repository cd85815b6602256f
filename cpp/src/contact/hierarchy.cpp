#include "contact/hierarchy.h"

#include "contact/tree_pairs.h"

namespace tissu {

void Hierarchy::find(std::span<const Box> boxes, std::vector<BoxPair>& pairs) {
  meetings_.check(boxes);
  follow(boxes);
  found_.clear();
  for (const SearchPlan::Meeting& meeting : meetings_.all()) {
    const BoxTree& a = trees_[static_cast<std::size_t>(meeting.a)];
    if (meeting.a == meeting.b) {
      add_pairs_within(a, found_);
    } else {
      add_pairs_between(a, trees_[static_cast<std::size_t>(meeting.b)], found_);
    }
  }
  sort_.sort(found_.all(), meetings_.primitive_count(), pairs);
}

void Hierarchy::follow(std::span<const Box> boxes) {
  const bool at_first = trees_.empty();
  if (at_first) trees_.resize(static_cast<std::size_t>(meetings_.surface_count()));
  for (std::int32_t s = 0; s < meetings_.surface_count(); ++s) {
    if (!meetings_.has_meeting(s)) continue;
    if (at_first || trees_[static_cast<std::size_t>(s)].refit(boxes)) build(s, boxes);
  }
}

void Hierarchy::build(std::int32_t surface, std::span<const Box> boxes) {
  ++builds_;
  trees_[static_cast<std::size_t>(surface)].build(boxes, meetings_.of(surface));
}

std::size_t Hierarchy::bytes() const {
  std::size_t sum = meetings_.bytes() + found_.bytes() + sort_.bytes();
  for (const BoxTree& tree : trees_) sum += tree.bytes();
  return sum;
}

}  // namespace tissu
