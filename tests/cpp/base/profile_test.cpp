#include "tissu/base/profile.h"

#include <gtest/gtest.h>

/// What the longest step did, from times that are given.
namespace tissu {
namespace {

void take(Profile& profile, std::size_t row, double spent, int iterations, double seconds) {
  profile.begin_step();
  profile.add(row, spent);
  ++profile.solves().solves;
  profile.solves().iterations += iterations;
  profile.add_step(seconds);
}

TEST(Profile, TheFirstStepIsTheWorstOnlyWhileItIsTheOnlyOne) {
  Profile profile;
  const std::size_t matrix = profile.row("elasticity", "matrix");
  const std::size_t solve = profile.row("linear solver", "solve");
  EXPECT_EQ(profile.worst().step, 0);
  take(profile, solve, 9.0, 90, 10.0);
  EXPECT_EQ(profile.worst().step, 1);
  take(profile, matrix, 1.0, 3, 2.0);
  EXPECT_EQ(profile.worst().step, 2);
  take(profile, solve, 4.0, 30, 5.0);
  take(profile, matrix, 0.5, 2, 1.0);
  EXPECT_EQ(profile.worst().step, 3);
  EXPECT_EQ(profile.worst().seconds, 5.0);
  EXPECT_EQ(profile.worst().row_seconds, (std::vector<double>{0.0, 4.0}));
  EXPECT_EQ(profile.worst().iterations, 30);
  EXPECT_EQ(profile.worst().solves, 1);
}

/// What a step that was rolled back took, or what ran between two steps, belongs to no step.
TEST(Profile, AStepThatWasNotTakenIsNoPartOfTheNextOne) {
  Profile profile;
  const std::size_t solve = profile.row("linear solver", "solve");
  take(profile, solve, 1.0, 1, 1.0);
  profile.begin_step();
  profile.add(solve, 100.0);
  profile.solves().iterations += 100;
  take(profile, solve, 2.0, 5, 3.0);
  EXPECT_EQ(profile.worst().step, 2);
  EXPECT_EQ(profile.worst().row_seconds, (std::vector<double>{2.0}));
  EXPECT_EQ(profile.worst().iterations, 5);
  profile.clear();
  EXPECT_EQ(profile.worst().step, 0);
  take(profile, solve, 2.0, 7, 3.0);
  EXPECT_EQ(profile.worst().iterations, 7);
}

}  // namespace
}  // namespace tissu
