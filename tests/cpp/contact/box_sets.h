#pragma once

/// Boxes that broad phases find hard, and the plain answer to compare with.

#include <functional>
#include <vector>

#include "tissu/contact/broad_phase.h"

namespace tissu::test {

/// Boxes, what is looked for among them, and how they move: boxes of a time.
struct BoxScene {
  const char* name;
  SearchPlan plan;
  std::function<std::vector<Box>(int time)> boxes;
};

/// Every pair tested, O(n^2).
std::vector<BoxPair> every_pair_tested(const SearchPlan& plan, const std::vector<Box>& boxes);

/// The scenes, each of fewer than a thousand boxes.
std::vector<BoxScene> box_scenes();

}  // namespace tissu::test
