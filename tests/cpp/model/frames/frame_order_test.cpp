#include "tissu/model/frames/frame_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../../base/random.h"

namespace tissu {
namespace {

constexpr int kNeighbours = 3;
constexpr std::int32_t kFrames = 40;

/// Points in runs of the same frames, of different lengths.
std::vector<std::int32_t> sample() {
  test::Random random(2);
  std::vector<std::int32_t> frames;
  for (int run = 0; run < 60; ++run) {
    std::set<std::int32_t> some;
    while (some.size() < kNeighbours)
      some.insert(static_cast<std::int32_t>(kFrames * (random.number(0.499) + 0.5)));
    for (int i = 0; i <= run % 11; ++i) frames.insert(frames.end(), some.begin(), some.end());
  }
  return frames;
}

class FrameOrderTest : public testing::Test {
 protected:
  std::vector<std::int32_t> frames_ = sample();
  FrameOrder order_ = order_points(frames_, kNeighbours, kFrames);
  [[nodiscard]] std::vector<std::int32_t> frames_of(std::size_t lane) const {
    const auto begin = frames_.begin() + kNeighbours * order_.point[lane];
    return {begin, begin + kNeighbours};
  }
};

TEST_F(FrameOrderTest, HasEveryPointOnce) {
  std::vector<std::int32_t> points;
  for (std::size_t i = 0; i < order_.point.size(); ++i) {
    if (order_.real[i] != 0) points.push_back(order_.point[i]);
  }
  std::ranges::sort(points);
  ASSERT_EQ(points.size(), frames_.size() / kNeighbours);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i], static_cast<std::int32_t>(i));
}

TEST_F(FrameOrderTest, SaysWhereLanesHaveTheSameFrames) {
  bool some = false;
  for (std::size_t group = 0; group < order_.shared.size(); ++group) {
    if (order_.shared[group] == 0) continue;
    some = true;
    for (std::size_t lane = 1; lane < 8; ++lane) EXPECT_EQ(frames_of(8 * group + lane), frames_of(8 * group));
  }
  EXPECT_TRUE(some);
}

TEST_F(FrameOrderTest, ChunksOfOneColourShareNoFrame) {
  for (std::int32_t colour = 0; colour < order_.colours(); ++colour) {
    std::set<std::int32_t> taken;
    for (auto c = order_.colour_begin[static_cast<std::size_t>(colour)];
         c < order_.colour_begin[static_cast<std::size_t>(colour) + 1]; ++c) {
      const FrameOrder::Range chunk = order_.chunks[static_cast<std::size_t>(c)];
      std::set<std::int32_t> own;
      for (auto lane = static_cast<std::size_t>(8 * chunk.begin);
           lane < static_cast<std::size_t>(8 * chunk.end); ++lane) {
        for (const std::int32_t frame : frames_of(lane)) own.insert(frame);
      }
      for (const std::int32_t frame : own) EXPECT_TRUE(taken.insert(frame).second);
    }
  }
}

TEST_F(FrameOrderTest, EachFrameFindsItsShares) {
  std::size_t found = 0;
  for (std::int32_t frame = 0; frame < kFrames; ++frame) {
    const auto begin = static_cast<std::size_t>(order_.share_begin[static_cast<std::size_t>(frame)]);
    const auto end = static_cast<std::size_t>(order_.share_begin[static_cast<std::size_t>(frame) + 1]);
    for (std::size_t s = begin; s < end; ++s, ++found) {
      const auto place = static_cast<std::size_t>(order_.share[s]);
      const std::size_t lane = place / 8 / kNeighbours * 8 + place % 8;
      EXPECT_EQ(frames_of(lane)[place / 8 % kNeighbours], frame);
      EXPECT_NE(order_.real[lane], 0);
    }
  }
  EXPECT_EQ(found, frames_.size());
}

}  // namespace
}  // namespace tissu
