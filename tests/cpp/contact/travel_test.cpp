#include "tissu/contact/travel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pair_samples.h"
#include "tissu/base/crossing.h"
#include "tissu/contact/closest.h"

namespace tissu {
namespace {

constexpr std::size_t kPairs = 100'000;
constexpr int kSamples = 200;
constexpr double kRoundOff = 32.0 * std::numeric_limits<double>::epsilon();  ///< of a distance, in sizes
constexpr std::array<PairKind, 4> kKinds = {PairKind::vertex_face, PairKind::edge_edge, PairKind::vertex_edge,
                                            PairKind::vertex_vertex};
constexpr std::array<std::size_t, 4> kFirstSide = {1, 2, 1, 1};

double distance(PairKind kind, const Four& p) {
  Part part{};
  Part other{};
  switch (kind) {
    case PairKind::vertex_face:
      return std::sqrt(closest_point_triangle(p, part).square);
    case PairKind::edge_edge:
      return std::sqrt(closest_edge_edge(p, part, other).square);
    case PairKind::vertex_edge:
      return std::sqrt(closest_point_edge(p, part).square);
    case PairKind::vertex_vertex:
      break;
  }
  return (p[0] - p[1]).norm();
}

/// At a share of its own for each vertex.
Four at(const PairWay& pair, const std::array<double, 4>& share) {
  Four p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = pair.from[i] + share[i] * pair.way[i];
  return p;
}

double distance_at(const PairWay& pair, double share) {
  return distance(pair.kind, at(pair, {share, share, share, share}));
}

/// What round-off may take from a distance on the way.
double round_off(const PairWay& pair) {
  Four end;
  double place = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    end[i] = pair.from[i] + pair.way[i];
    place = std::max({place, pair.from[i].norm(), end[i].norm()});
  }
  return kRoundOff * (size_of(pair.from) + size_of(end) + place);
}

/// Ways on which much is near to happen: short and long ones, common ones, head on, along, of one vertex.
PairWay random_way(PairSamples& samples, std::size_t number) {
  const std::size_t kind = number % 4;
  const std::size_t shape = number / 4 % 8;
  PairWay pair{kKinds[kind],
               kind == 0 ? samples.point_and_triangle(shape == 6 ? 7 : shape) : samples.two_edges(shape),
               {}};
  if (kind >= 2) pair.from[3] = pair.from[0];  // unused
  const double length = std::pow(10.0, samples.uniform(-3, 1));
  const Vec3 common = 10.0 * samples.vector();
  const Vec3 along = (pair.from[1] - pair.from[2]).normalized();
  for (std::size_t i = 0; i < 4; ++i) {
    const bool first = i < kFirstSide[kind];
    switch (number / 32 % 5) {
      case 0:  // towards the middle of the other side
        pair.way[i] = first ? Vec3(samples.uniform(0.5, 1.5) *
                                   (pair.from[kFirstSide[kind]] - pair.from[0] + 0.1 * samples.vector()))
                            : Vec3(0.01 * samples.vector());
        break;
      case 1:
        pair.way[i] = common + length * samples.vector();
        break;
      case 2:
        pair.way[i] = first ? Vec3(length * along) : Vec3::Zero();
        break;
      case 3:
        pair.way[i] = i == number / 160 % 4 ? Vec3(length * samples.vector()) : Vec3::Zero();
        break;
      default:
        pair.way[i] = length * samples.vector();
    }
  }
  return pair;
}

/// A sample of what `least` may be: from nothing to nearly all of the distance at the start.
double random_least(PairSamples& samples, const PairWay& pair, std::size_t number) {
  return number % 3 == 0 ? 0.0 : samples.uniform(0.0, 0.99) * distance_at(pair, 0.0);
}

TEST(TravelTest, OnTheFreeShareThePairIsApartAndATenthIsLeft) {
  PairSamples samples(1);
  for (std::size_t number = 0; number < kPairs; ++number) {
    const PairWay pair = random_way(samples, number);
    const double least = random_least(samples, pair, number);
    const double share = free_share(pair, least);
    const double error = round_off(pair);
    ASSERT_GE(share, 0.0);
    ASSERT_LE(share, 1.0);
    for (int i = 0; i <= kSamples; ++i) {
      ASSERT_GE(distance_at(pair, share * i / kSamples), least - error) << number << " of share " << share;
    }
    const double start = distance_at(pair, 0.0) - least;
    EXPECT_GE(distance_at(pair, share) - least, 0.1 * start - error) << number;
  }
}

/// The share that the rule of a tenth means, by small steps: the answer is at least half of it but for few
/// pairs, and the whole way where the way never comes near.
TEST(TravelTest, TheFreeShareIsNotNeedlesslySmall) {
  PairSamples samples(2);
  int held = 0;
  int small = 0;
  int clear = 0;
  int stopped = 0;
  for (std::size_t number = 0; number < 20'000; ++number) {
    const PairWay pair = random_way(samples, number);
    const double least = random_least(samples, pair, number);
    const double start = distance_at(pair, 0.0) - least;
    double way = 0.0;
    for (const Vec3& one : pair.way) way = std::max(way, one.norm());
    if (start < 0.02 * way) continue;  // a thousand steps would pass over what the way meets
    double nearest = start;
    double truth = 1.0;
    for (int i = 1; i <= 1000 && truth == 1.0; ++i) {
      nearest = std::min(nearest, distance_at(pair, 1e-3 * i) - least);
      if (nearest < 0.1 * start) truth = 1e-3 * (i - 1);
    }
    const double share = free_share(pair, least);
    if (truth < 1.0) {
      ++held;
      if (share < 0.5 * truth) ++small;
    } else if (nearest > 0.2 * start) {
      ++clear;
      if (share < 1.0) ++stopped;
    }
  }
  EXPECT_GT(held, 2000);
  EXPECT_LT(small, held / 100);
  EXPECT_GT(clear, 5000);
  EXPECT_LE(stopped, clear / 1000);
}

TEST(TravelTest, HeadOnATenthOfTheDistanceIsLeft) {
  const Vec3 aside(3, -2, 0);
  for (const double fall : {1.0, 2.0, 100.0}) {
    const PairWay to_face = {PairKind::vertex_face,
                             {Vec3(0, 0, 0.5), Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)},
                             {Vec3(0, 0, -fall), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
    EXPECT_NEAR(free_share(to_face, 0.1), 0.9 * 0.4 / fall, 1e-15);
    PairWay to_edge = {PairKind::edge_edge,
                       {Vec3(-1, 0, 0.5), Vec3(1, 0, 0.5), Vec3(0, -1, 0), Vec3(0, 1, 0)},
                       {Vec3(0, 0, -fall), Vec3(0, 0, -fall), Vec3::Zero(), Vec3::Zero()}};
    EXPECT_NEAR(free_share(to_edge, 0.1), 0.9 * 0.4 / fall, 1e-15);
    for (Vec3& way : to_edge.way) way += aside;  // what is common to all changes nothing
    EXPECT_NEAR(free_share(to_edge, 0.1), 0.9 * 0.4 / fall, 1e-15);
    PairWay to_vertex = {PairKind::vertex_vertex, {Vec3(0, 0, 0.5), Vec3::Zero()}, {Vec3(0, 0, -fall)}};
    to_vertex.way[1] = Vec3(0, 0, 0);
    EXPECT_NEAR(free_share(to_vertex, 0.1), 0.9 * 0.4 / fall, 1e-15);
  }
}

TEST(TravelTest, WhatSlidesOrPartsOrFliesTogetherIsFree) {
  PairWay pair = {PairKind::vertex_face,
                  {Vec3(0, 0, 0.01), Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)},
                  {Vec3(100, 50, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
  EXPECT_EQ(free_share(pair, 0.009), 1.0);
  EXPECT_TRUE(is_kept_apart(pair, 0.009));
  pair.way[0] = Vec3(5, 0, 100);
  EXPECT_EQ(free_share(pair, 0.009), 1.0);
  EXPECT_TRUE(is_kept_apart(pair, 0.009));
  pair.way = {Vec3(3, 4, -100), Vec3(3, 4, -100), Vec3(3, 4, -100), Vec3(3, 4, -100)};
  EXPECT_EQ(free_share(pair, 0.009), 1.0);
  EXPECT_FALSE(is_kept_apart(pair, 0.009));  // were one of the ways shortened, the two would meet
}

TEST(TravelTest, NearerThanTheLeastOrNotFiniteNothingIsFree) {
  PairWay pair = {PairKind::vertex_edge, {Vec3(0, 0, 0.5), Vec3(-1, 0, 0), Vec3(1, 0, 0)}, {}};
  pair.way = {Vec3(0, 0, 1), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  EXPECT_EQ(free_share(pair, 0.6), 0.0);
  EXPECT_EQ(free_share(pair, 0.5), 0.0);
  EXPECT_FALSE(is_kept_apart(pair, 0.6));
  EXPECT_EQ(free_share(pair, 0.4), 1.0);
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    pair.way[1] = Vec3(0, bad, 0);
    EXPECT_EQ(free_share(pair, 0.4), 0.0);
    EXPECT_FALSE(is_kept_apart(pair, 0.4));
  }
}

TEST(TravelTest, BothSidesMayCloseWhatThePlaneLeavesThem) {
  for (const double closing : {0.19, 0.21}) {
    const PairWay pair = {
        PairKind::edge_edge,
        {Vec3(-1, 0, 0.5), Vec3(1, 0, 0.5), Vec3(0, -1, 0), Vec3(0, 1, 0)},
        {Vec3(1, 0, -closing), Vec3(2, 0, -closing), Vec3(0, 0, closing), Vec3(0, 3, closing)}};
    EXPECT_EQ(is_kept_apart(pair, 0.1), closing < 0.2);
  }
}

TEST(TravelTest, ThePlaneKeepsThePairApartHoweverTheWaysAreShortened) {
  PairSamples samples(3);
  int kept = 0;
  int at_the_end = 0;
  for (std::size_t number = 0; number < kPairs; ++number) {
    const PairWay pair = random_way(samples, number);
    const double least = random_least(samples, pair, number);
    if (!is_kept_apart(pair, least)) continue;
    ++kept;
    if (distance_at(pair, 1.0) < distance_at(pair, 0.0)) ++at_the_end;
    const double error = round_off(pair);
    for (int i = 0; i < 40; ++i) {
      std::array<double, 4> share{};
      for (double& one : share) one = std::clamp(samples.uniform(-0.3, 1.3), 0.0, 1.0);
      const double time = i == 0 ? 1.0 : samples.uniform(0.0, 1.0);
      for (double& one : share) one *= time;
      ASSERT_GE(distance(pair.kind, at(pair, share)), least - error) << number;
      ASSERT_GE(distance_at(pair, time), least - error) << number;
    }
  }
  EXPECT_GT(kept, 10'000);
  EXPECT_GT(at_the_end, 5000);
}

/// The share at which the way crosses first, by bisection of the exact question whether it has crossed; 2 if
/// never.
template <class Crossed>
double first_crossing(const Crossed& crossed) {
  if (!crossed(1.0)) return 2.0;
  double before = 0.0;
  double after = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (before + after);
    (crossed(middle) ? after : before) = middle;
  }
  return after;
}

TEST(TravelTest, NoCrossingThatExactBisectionFindsIsPassed) {
  PairSamples samples(4);
  int crossings = 0;
  for (std::size_t number = 0; number < kPairs; ++number) {
    PairWay pair = random_way(samples, 4 * (number / 2) + number % 2);
    const bool edges = pair.kind == PairKind::edge_edge;
    const Four& p = pair.from;
    // One side is at rest, so that what the other sweeps only grows.
    const Vec3 way = p[2] - p[0] + 0.7 * samples.vector();
    pair.way = {way, edges ? way : Vec3(Vec3::Zero()), Vec3::Zero(), Vec3::Zero()};
    const double crossing = first_crossing([&](double share) {
      const Vec3 end = p[0] + share * way;
      if (!edges) return crosses(p[0], end, {p[1], p[2], p[3]});
      const Vec3 other = p[1] + share * way;
      return crosses(p[2], p[3], {p[0], p[1], other}) || crosses(p[2], p[3], {p[0], other, end});
    });
    if (crossing < 2.0) ++crossings;
    // Below what round-off leaves of a distance neither side of it is known.
    const double least = round_off(pair);
    EXPECT_LT(free_share(pair, least), crossing) << number;
    EXPECT_FALSE(crossing < 2.0 && is_kept_apart(pair, least)) << number;
  }
  EXPECT_GT(crossings, 10'000);
}

}  // namespace
}  // namespace tissu
