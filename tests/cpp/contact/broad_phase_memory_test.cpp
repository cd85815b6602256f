#include <gtest/gtest.h>

#include <algorithm>

#include "../../../bench/contact/folded_sheet.h"
#include "../base/allocations.h"
#include "box_sets.h"
#include "contact/hierarchy.h"
#include "contact/octree.h"
#include "contact/sweep_and_prune.h"

/// What broad phases keep from call to call, counted: memory, trees, swaps.

namespace tissu {
namespace {

SearchPlan itself(std::size_t count) { return {{0, static_cast<std::int32_t>(count)}, {{0, 0}}}; }

#ifdef TISSU_COUNTS_ALLOCATIONS
using test::allocations;
using test::counting;

class BroadPhaseMemory : public testing::TestWithParam<BroadPhaseKind> {};

// There and back again: the most crowded time comes first, then what is kept is of another state each time.
TEST_P(BroadPhaseMemory, NoneIsTakenAfterTheMostPairs) {
  long at_first = 0;
  for (const test::BoxScene& scene : test::box_scenes()) {
    constexpr int kTimes = 12;
    const auto broad = make_broad_phase(GetParam(), scene.plan);
    std::vector<std::vector<Box>> boxes;
    std::vector<BoxPair> pairs;
    for (int time = 0; time < kTimes; ++time) boxes.push_back(scene.boxes(time));
    allocations = 0;
    counting = true;
    for (const std::vector<Box>& at : boxes) broad->find(at, pairs);
    at_first += allocations;
    allocations = 0;
    for (int time = kTimes; time-- > 0;) broad->find(boxes[static_cast<std::size_t>(time)], pairs);
    for (const std::vector<Box>& at : boxes) broad->find(at, pairs);
    counting = false;
    EXPECT_EQ(allocations, 0) << scene.name;
    EXPECT_GE(broad->bytes(), scene.plan.meetings.size() * sizeof(SearchPlan::Meeting)) << scene.name;
  }
  EXPECT_GT(at_first, 0);  // the count works
}

INSTANTIATE_TEST_SUITE_P(Contact, BroadPhaseMemory,
                         testing::Values(BroadPhaseKind::hierarchy, BroadPhaseKind::sweep_and_prune,
                                         BroadPhaseKind::grid, BroadPhaseKind::octree));
#endif

std::vector<Box> moved(std::vector<Box> boxes, float by) {
  for (Box& box : boxes) {
    box.low[0] += by;
    box.high[0] += by;
  }
  return boxes;
}

TEST(BroadPhaseWork, ATreeIsBuiltAgainWhenItsBoxesAreMixedUpOnly) {
  std::vector<Box> boxes = bench::folded_sheet(20, 4, 0.4, 0.1, 0.0);
  Hierarchy hierarchy(itself(boxes.size()));
  std::vector<BoxPair> pairs;
  hierarchy.find(boxes, pairs);
  hierarchy.find(moved(boxes, 1000.0F), pairs);
  hierarchy.find(bench::folded_sheet(20, 4, 0.4, 0.5, 1.0), pairs);  // larger ones, a little on
  EXPECT_EQ(hierarchy.builds(), 1);
  std::reverse(boxes.begin() + 200, boxes.begin() + 600);
  hierarchy.find(boxes, pairs);
  EXPECT_EQ(hierarchy.builds(), 2);
  hierarchy.find(boxes, pairs);
  EXPECT_EQ(hierarchy.builds(), 2);
}

TEST(BroadPhaseWork, AnOctreeIsBuiltAgainWhenAFifthHaveLeftTheirCubes) {
  std::vector<Box> boxes = bench::folded_sheet(20, 4, 0.4, 0.1, 0.0);
  Octree octree(itself(boxes.size()));
  std::vector<BoxPair> pairs;
  octree.find(boxes, pairs);
  const auto swap_ends = [&](std::ptrdiff_t count) {
    std::vector<Box> some = boxes;
    std::swap_ranges(some.begin(), some.begin() + count, some.end() - count);
    return some;
  };
  octree.find(swap_ends(60), pairs);  // 120 of 800
  EXPECT_EQ(octree.builds(), 1);
  octree.find(swap_ends(100), pairs);  // 200 of 800
  EXPECT_EQ(octree.builds(), 2);
}

TEST(BroadPhaseWork, SortedEndsAreCarriedWhileTheBoxesMoveALittle) {
  const std::vector<Box> boxes = bench::folded_sheet(20, 4, 0.4, 0.1, 0.0);
  SweepAndPrune sweep(itself(boxes.size()));
  std::vector<BoxPair> pairs;
  sweep.find(boxes, pairs);
  sweep.find(moved(boxes, 2.0F), pairs);  // in one order with those before
  EXPECT_EQ(sweep.swaps(), 0);
  // Two boxes change places with one that stands alone: each end of the one passes both ends of the two.
  const auto row = [](float third) {
    return std::vector<Box>{
        {{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}, {{third, 0, 0}, {third + 1, 1, 1}}};
  };
  SweepAndPrune three(itself(3));
  three.find(row(5), pairs);
  three.find(row(-5), pairs);
  EXPECT_EQ(three.swaps(), 8);
  EXPECT_EQ(three.sweeps(), 1);
  EXPECT_TRUE(pairs.empty());
  three.find(row(0.5), pairs);
  EXPECT_EQ(pairs, (std::vector<BoxPair>{{0, 2}}));
  EXPECT_EQ(three.sweeps(), 1);
}

// So that an order that is lost costs n log n and not n^2.
TEST(BroadPhaseWork, AnOrderThatIsLostIsSortedAnew) {
  std::vector<Box> boxes = bench::folded_sheet(40, 4, 0.4, 0.1, 0.0);
  SweepAndPrune sweep(itself(boxes.size()));
  std::vector<BoxPair> pairs;
  sweep.find(boxes, pairs);
  std::reverse(boxes.begin(), boxes.end());
  sweep.find(boxes, pairs);
  EXPECT_EQ(sweep.sweeps(), 2);
}

}  // namespace
}  // namespace tissu
