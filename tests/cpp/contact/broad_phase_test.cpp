#include <gtest/gtest.h>

#include <limits>

#include "../../../bench/contact/folded_sheet.h"
#include "box_sets.h"
#include "tissu/base/error.h"
#ifdef TISSU_FCL_ORACLE
#include "contact/fcl_broad_phase.h"
#endif

namespace tissu {
namespace {

struct BroadCase {
  const char* name;
  BroadPhaseKind kind;
};
void PrintTo(const BroadCase& c, std::ostream* out) { *out << c.name; }

class BroadPhases : public testing::TestWithParam<BroadCase> {
 protected:
  static std::unique_ptr<BroadPhase> make(const SearchPlan& plan) {
#ifdef TISSU_FCL_ORACLE  // where the library may have been built without
    if (GetParam().kind == BroadPhaseKind::fcl) return std::make_unique<FclBroadPhase>(plan);
#endif
    return make_broad_phase(GetParam().kind, plan);
  }
  /// The sentence of the refusal.
  static std::string refusal(const std::vector<Box>& boxes) {
    const auto broad = make({{0, 3}, {{0, 0}}});
    std::vector<BoxPair> pairs;
    try {
      broad->find(boxes, pairs);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_P(BroadPhases, HasItsName) { EXPECT_EQ(make({})->name(), GetParam().name); }

TEST_P(BroadPhases, FindWhatTestingEveryPairFinds) {
  for (const test::BoxScene& scene : test::box_scenes()) {
    std::vector<BoxPair> pairs{{3, 4}};  // of before: they leave
    const std::vector<Box> boxes = scene.boxes(0);
    make(scene.plan)->find(boxes, pairs);
    EXPECT_EQ(pairs, test::every_pair_tested(scene.plan, boxes)) << scene.name;
  }
}

// What is kept from call to call must not change an answer.
TEST_P(BroadPhases, FindTheSameAfterFiftySteps) {
  for (const test::BoxScene& scene : test::box_scenes()) {
    const auto kept = make(scene.plan);
    std::vector<BoxPair> pairs;
    std::vector<BoxPair> anew;
    for (int time = 0; time <= 50; ++time) {
      const std::vector<Box> boxes = scene.boxes(time);
      kept->find(boxes, pairs);
      make(scene.plan)->find(boxes, anew);
      ASSERT_EQ(pairs, anew) << scene.name << " at " << time;
      if (time % 10 == 0) {
        ASSERT_EQ(pairs, test::every_pair_tested(scene.plan, boxes)) << scene.name << " at " << time;
      }
    }
  }
}

TEST_P(BroadPhases, FindManyBoxesAsTheHierarchyDoes) {
  const SearchPlan plan{{0, 20000}, {{0, 0}}};
  const auto broad = make(plan);
  const auto hierarchy = make_broad_phase(BroadPhaseKind::hierarchy, plan);
  std::vector<BoxPair> pairs;
  std::vector<BoxPair> others;
  for (int time = 0; time < 3; ++time) {
    const std::vector<Box> boxes = bench::folded_sheet(100, 5, 0.4, 0.2, time);
    broad->find(boxes, pairs);
    hierarchy->find(boxes, others);
    EXPECT_EQ(pairs, others);
    EXPECT_GT(pairs.size(), 100000U);
  }
}

TEST_P(BroadPhases, RefuseBoxesThatAreNotFiniteOrTooMany) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(refusal({unit, unit, unit}), "");
  for (const Box& bad :
       {Box{{0, 0, 0}, {1, infinity, 1}}, Box{{0, 0, -infinity}, {1, 1, 1}}, Box{{nan, 0, 0}, {1, 1, 1}},
        Box{{0, 0, 0}, {1, 1, nan}}, Box{{0, 2, 0}, {1, 1, 1}}, Box::none()}) {
    EXPECT_NE(refusal({unit, bad, unit}).find("of primitive 1; finite numbers"), std::string::npos);
  }
  EXPECT_EQ(refusal({unit, unit}), "found 2 boxes; one for each of the plan's primitives, 3, is accepted.");
}

TEST_P(BroadPhases, RefusePlansThatNameNoSurface) {
  EXPECT_THROW(make({{0, 3}, {{0, 1}}}), ParameterError);
  EXPECT_THROW(make({{0, 3}, {{-1, 0}}}), ParameterError);
  EXPECT_THROW(make({{1, 3}, {}}), ParameterError);
  EXPECT_THROW(make({{0, 3, 2}, {}}), ParameterError);
}

TEST_P(BroadPhases, AMeetingNamedTwiceCountsOnce) {
  const std::vector<Box> boxes(4, Box{{0, 0, 0}, {1, 1, 1}});
  std::vector<BoxPair> pairs;
  make({{0, 2, 4}, {{0, 1}, {1, 0}}})->find(boxes, pairs);
  EXPECT_EQ(pairs, (std::vector<BoxPair>{{0, 2}, {0, 3}, {1, 2}, {1, 3}}));
}

INSTANTIATE_TEST_SUITE_P(Contact, BroadPhases,
                         testing::Values(BroadCase{"hierarchy", BroadPhaseKind::hierarchy},
                                         BroadCase{"sweep_and_prune", BroadPhaseKind::sweep_and_prune},
                                         BroadCase{"grid", BroadPhaseKind::grid},
                                         BroadCase{"octree", BroadPhaseKind::octree}),
                         testing::PrintToStringParamName());

#ifdef TISSU_FCL_ORACLE
INSTANTIATE_TEST_SUITE_P(ContactByFcl, BroadPhases, testing::Values(BroadCase{"fcl", BroadPhaseKind::fcl}),
                         testing::PrintToStringParamName());
#endif
#ifndef TISSU_HAVE_FCL
TEST(BroadPhase, FclIsRefusedByName) {
  try {
    make_broad_phase(BroadPhaseKind::fcl, {});
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("libfcl-dev"), std::string::npos);
    return;
  }
  FAIL() << "fcl was made";
}
#endif

}  // namespace
}  // namespace tissu
