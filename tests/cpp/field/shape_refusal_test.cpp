#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "sample_frames.h"
#include "tissu/base/error.h"

/// What is refused, in which words.
namespace tissu {
namespace {

using test::kSpacing;

template <class Refusal>
std::string refused(const ShapeFunctionUse& use, ConstReals frames, ConstReals points,
                    const FieldNames& names = {.body = "liver"}) {
  try {
    shape_weights(use, frames, points, names);
  } catch (const Refusal& error) {
    return error.what();
  }
  return "nothing was refused";
}

class EveryRefusal : public testing::TestWithParam<ShapeFunctionInfo> {
 protected:
  const ShapeFunctionInfo& info_ = GetParam();
  ShapeFunctionUse use_ = test::use_of(info_);
  std::string name_{info_.name};
  std::vector<double> frames_ = test::sample_frames(info_);
  std::vector<double> points_ = test::sample_points(5);
};

TEST_P(EveryRefusal, OfFramesThatCoincide) {
  frames_.insert(frames_.end(), frames_.begin() + 9, frames_.begin() + 12);
  const std::string text = refused<MeshError>(use_, frames_, points_);
  EXPECT_TRUE(text.starts_with("body \"liver\": frames 3 and 80 coincide at (")) << text;
  EXPECT_TRUE(text.ends_with(") m; remove one of them.")) << text;
}

TEST_P(EveryRefusal, OfNumbersThatAreNotFinite) {
  auto frames = frames_;
  frames[7] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused<ParameterError>(use_, frames, points_).starts_with("body \"liver\": frame 2 is at ("));
  points_[4] = std::numeric_limits<double>::quiet_NaN();
  const std::string text = refused<ParameterError>(use_, frames_, points_);
  EXPECT_TRUE(text.starts_with("body \"liver\": integration point 1 is at (")) << text;
  EXPECT_TRUE(text.ends_with("; give finite coordinates.")) << text;
}

TEST_P(EveryRefusal, OfNoFramesAndOfHalfFrames) {
  EXPECT_EQ(refused<ParameterError>(use_, {}, points_),
            "body \"liver\": found no frames; the shape function " + name_ + " needs one at least.");
  EXPECT_EQ(refused<ParameterError>(use_, ConstReals(frames_).first(7), points_),
            "body \"liver\": found 7 coordinates of frames; give three for each.");
}

TEST_P(EveryRefusal, OfTooFewFrames) {
  use_.neighbours = 9;
  const std::string text = refused<ParameterError>(use_, ConstReals(frames_).first(6), points_);
  if (info_.takes_neighbours) {
    EXPECT_EQ(text, "body \"liver\": found 2 frames where the shape function " + name_ +
                        " has 9 neighbours for each point; add frames or ask for fewer neighbours.");
  } else {
    EXPECT_TRUE(text.starts_with("body \"liver\": the shape function " + name_ +
                                 " is asked for 9 neighbours; it has 2, since "))
        << text;
  }
}

TEST_P(EveryRefusal, OfNegativeNumbers) {
  use_.neighbours = -1;
  EXPECT_EQ(refused<ParameterError>(use_, frames_, points_),
            "body \"liver\": found -1 neighbours of the shape function " + name_ +
                "; accepted are 1 and more, or 0 for its own number.");
  use_.neighbours = 0;
  use_.radius = -0.5;
  EXPECT_EQ(
      refused<ParameterError>(use_, frames_, points_),
      "body \"liver\": the shape function " + name_ +
          " has a radius of -0.5 m; accepted is a positive one, or 0 for one that follows the neighbours.");
}

TEST_P(EveryRefusal, OfARadiusThatNobodyTakesOrThatReachesNothing) {
  use_.radius = 1e-3 * kSpacing;
  const std::vector<double> point{0.004, 0.005, 0.005};
  if (info_.takes_radius) {
    const std::string text = refused<MeshError>(use_, frames_, point);
    EXPECT_TRUE(
        text.starts_with("body \"liver\": integration point 0 at (0.004, 0.005, 0.005) m is reached by no "
                         "frame: the nearest is 0.00"))
        << text;
    EXPECT_TRUE(
        text.ends_with(" m away, the support ends at 1e-05 m; ask for a greater radius or add frames."))
        << text;
  } else {
    EXPECT_EQ(refused<ParameterError>(use_, frames_, point),
              "body \"liver\": the shape function " + name_ +
                  " has a radius of 1e-05 m and takes none; leave it out.");
  }
}

INSTANTIATE_TEST_SUITE_P(List, EveryRefusal, testing::ValuesIn(all_shape_functions()),
                         [](const auto& tested) { return test::parameter_name(tested.param); });

TEST(ShapeRefusal, OfAnUnknownFunctionNamesThoseThereAre) {
  const std::vector<double> frames{0.0, 0.0, 0.0};
  const std::string text = refused<ParameterError>({.name = "quadratic"}, frames, frames, {});
  EXPECT_TRUE(text.starts_with("found the shape function \"quadratic\"; there are shepard, wendland, "))
      << text;
}

TEST(ShapeRefusal, OfACuspAtEachFrame) {
  const auto frames = test::frame_lattice({3, 3, 3}, 0.1);
  EXPECT_EQ(
      refused<ParameterError>({.power = 1.0}, frames, frames),
      "body \"liver\": the shape function shepard has a power of 1; accepted is above 1, where its weights "
      "have a gradient at each frame.");
}

TEST(ShapeRefusal, OfFramesThatAreNoGrid) {
  const ShapeFunctionUse use{.name = "trilinear"};
  const std::string words =
      " frames are not a grid along the axes, as the shape function trilinear needs: each combination of "
      "some "
      "x, "
      "some y and some z once; make such a grid or take another shape function.";
  const std::vector<double> point{0.0, 0.0, 0.0};
  EXPECT_EQ(refused<MeshError>(use, test::frame_lattice({3, 3, 3}, 0.1), point),
            "body \"liver\": the 27" + words);
  auto frames = test::frame_lattice({3, 3, 3}, 0.0);
  frames.resize(frames.size() - 3);  // one is missing
  EXPECT_EQ(refused<MeshError>(use, frames, point), "body \"liver\": the 26" + words);
}

// The count of all, and the first.
TEST(ShapeRefusal, OfPointsBeyondHalfACellOfTheGrid) {
  const auto frames = test::frame_lattice({3, 3, 3}, 0.0);
  const std::vector<double> points{0.01, 0.01, 0.01, 0.01, -0.006, 0.01, 0.03, 0.01, 0.01};
  EXPECT_EQ(
      refused<MeshError>({.name = "trilinear"}, frames, points, {.body = "liver", .point = "vertex"}),
      "body \"liver\": vertex 1 at (0.01, -0.006, 0.01) m, the first of 2 such, lies 0.006 m beyond the grid "
      "of its frames along y, where half a cell, 0.005 m, is accepted; let the grid reach it.");
}

/// A sheet of 36 frames in z = 0 and one frame far above it.
std::vector<double> sheet_and_one() {
  auto frames = test::frame_lattice({6, 6, 1}, 0.2);
  frames.insert(frames.end(), {0.0, 0.0, 1.0});
  return frames;
}

TEST(ShapeRefusal, OfATetrahedronWhereTheNearFramesAreASheet) {
  const std::vector<double> point{0.025, 0.025, 0.0};
  EXPECT_EQ(refused<MeshError>({.name = "linear"}, sheet_and_one(), point),
            "body \"liver\": integration point 0 at (0.025, 0.025, 0) m has near frames that are in one "
            "plane or on "
            "one line, though the frames as a whole are not; move or add frames there, or take another shape "
            "function.");
}

TEST(ShapeRefusal, OfAFitToNeighboursThatAreNearlyASheet) {
  auto frames = test::frame_lattice({6, 6, 1}, 0.2);
  test::Random random(2);
  for (std::size_t i = 2; i < frames.size(); i += 3) frames[i] = random.number(1e-3 * kSpacing);
  const std::vector<double> point{0.025, 0.025, 0.0};
  EXPECT_EQ(refused<MeshError>({.name = "moving_least_squares"}, frames, point),
            "body \"liver\": integration point 0 at (0.025, 0.025, 0) m has neighbours that lie nearly in "
            "one plane "
            "or on one line; ask for more neighbours, or move the frames apart or fully into the plane.");
}

TEST(ShapeRefusal, OfWildExtrapolation) {
  const auto frames = test::frame_lattice({4, 4, 4}, 0.2);
  const std::vector<double> point{9.0, 9.0, 9.0};
  EXPECT_EQ(refused<MeshError>({.name = "linear"}, frames, point),
            "body \"liver\": integration point 0 at (9, 9, 9) m lies far outside of its frames, so that "
            "their weights "
            "would exceed 100; add frames around it.");
  EXPECT_EQ(refused<MeshError>({.name = "moving_least_squares"}, frames, point),
            "body \"liver\": integration point 0 at (9, 9, 9) m lies far outside of its frames, or these are "
            "too few "
            "in its support; add frames around it, or ask for a greater radius or more neighbours.");
}

}  // namespace
}  // namespace tissu
