#include "tissu/contact/closest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pair_samples.h"

namespace tissu {
namespace {

constexpr std::size_t kPairs = 100'000;
constexpr double kRoundOff = 32.0 * std::numeric_limits<double>::epsilon();  ///< of a distance, in sizes

using Long3 = Eigen::Matrix<long double, 3, 1>;

Long3 exact(const Vec3& v) { return v.cast<long double>(); }

long double square_to_edge(const Long3& p, const Long3& a, const Long3& b) {
  const Long3 edge = b - a;
  const long double square = edge.squaredNorm();
  const long double share = square > 0 ? std::clamp((p - a).dot(edge) / square, 0.0L, 1.0L) : 0.0L;
  return (p - a - share * edge).squaredNorm();
}

/// In long double, by areas: other formulas than those tested. The foot is corrected by the foot of what is
/// left, or the areas of slivers would be wrong by more than what is tested.
double distance_to_triangle(const Four& p) {
  const Long3 u = exact(p[2]) - exact(p[1]);
  const Long3 v = exact(p[3]) - exact(p[1]);
  const Long3 normal = u.cross(v);
  long double square = std::min({square_to_edge(exact(p[0]), exact(p[1]), exact(p[2])),
                                 square_to_edge(exact(p[0]), exact(p[2]), exact(p[3])),
                                 square_to_edge(exact(p[0]), exact(p[3]), exact(p[1]))});
  Long3 r = exact(p[0]) - exact(p[1]);
  long double of_u = 0;
  long double of_v = 0;
  for (int time = 0; time < 3 && normal.squaredNorm() > 0; ++time) {
    of_u += r.cross(v).dot(normal) / normal.squaredNorm();
    of_v += u.cross(r).dot(normal) / normal.squaredNorm();
    r = exact(p[0]) - exact(p[1]) - of_u * u - of_v * v;
  }
  if (of_u > 0 && of_v > 0 && of_u + of_v < 1) square = std::min(square, r.squaredNorm());
  return static_cast<double>(std::sqrt(square));
}

double distance_of_edges(const Four& p) {
  const std::array<Long3, 4> x = {exact(p[0]), exact(p[1]), exact(p[2]), exact(p[3])};
  long double square = std::min({square_to_edge(x[0], x[2], x[3]), square_to_edge(x[1], x[2], x[3]),
                                 square_to_edge(x[2], x[0], x[1]), square_to_edge(x[3], x[0], x[1])});
  const Long3 u = x[1] - x[0];
  const Long3 v = x[3] - x[2];
  const Long3 normal = u.cross(v);
  const long double nn = normal.squaredNorm();
  const long double s = (x[2] - x[0]).cross(v).dot(normal);
  if (nn > 0 && s > 0 && s < nn) square = std::min(square, square_to_edge(x[0] + s / nn * u, x[2], x[3]));
  return static_cast<double>(std::sqrt(square));
}

/// What every answer keeps: weights that are shares, r that is their sum, the distance of r.
void expect_consistent(const Closest& closest, const Four& p, std::size_t first_side) {
  Vec3 sum = Vec3::Zero();
  double left = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += closest.beta[i] * (p[i] - p[0]);
    left += closest.beta[i];
    EXPECT_LE(std::abs(closest.beta[i]), 1.0 + 1e-15);
    EXPECT_GE(i < first_side ? closest.beta[i] : -closest.beta[i], 0.0);
  }
  EXPECT_NEAR(left, 0.0, 1e-15);
  EXPECT_LE((sum - closest.r).cwiseAbs().maxCoeff(), kRoundOff * size_of(p));
  EXPECT_EQ(closest.square, closest.r.squaredNorm());
}

/// The nearest points of convex sets: no vertex of one is nearer to the other along r. Each product is one of
/// two lengths, wrong by round-off of both.
void expect_nearest(const Closest& closest, const Four& p, std::size_t first_side) {
  const double lengths = (p[1] - p[0]).norm() + (p[2] - p[0]).norm() + (p[3] - p[0]).norm();
  for (std::size_t i = 0; i < first_side; ++i) {
    for (std::size_t j = first_side; j < 4; ++j) {
      EXPECT_GE(closest.r.dot(p[i] - p[j]) - closest.square, -kRoundOff * lengths * lengths);
    }
  }
}

TEST(ClosestTest, APointAndATriangleAreAsFarAsInLongDouble) {
  PairSamples samples(1);
  for (std::size_t number = 0; number < kPairs; ++number) {
    const Four p = samples.point_and_triangle(number);
    Part part{};
    const Closest closest = closest_point_triangle(p, part);
    expect_consistent(closest, p, 1);
    expect_nearest(closest, p, 1);
    EXPECT_NEAR(std::sqrt(closest.square), distance_to_triangle(p), kRoundOff * size_of(p)) << number;
    if (testing::Test::HasFailure()) break;
  }
}

TEST(ClosestTest, TwoEdgesAreAsFarAsInLongDouble) {
  PairSamples samples(2);
  for (std::size_t number = 0; number < kPairs; ++number) {
    const Four p = samples.two_edges(number);
    Part first{};
    Part second{};
    const Closest closest = closest_edge_edge(p, first, second);
    expect_consistent(closest, p, 2);
    expect_nearest(closest, p, 2);
    EXPECT_NEAR(std::sqrt(closest.square), distance_of_edges(p), kRoundOff * size_of(p)) << number;
    if (testing::Test::HasFailure()) break;
  }
}

TEST(ClosestTest, APointAndAnEdgeAreAsFarAsInLongDouble) {
  PairSamples samples(3);
  for (std::size_t number = 0; number < kPairs; ++number) {
    Four p = samples.two_edges(number);
    p[3] = p[0];  // unused
    Part part{};
    const Closest closest = closest_point_edge(p, part);
    expect_consistent(closest, p, 1);
    const auto other = static_cast<double>(std::sqrt(square_to_edge(exact(p[0]), exact(p[1]), exact(p[2]))));
    EXPECT_NEAR(std::sqrt(closest.square), other, kRoundOff * size_of(p)) << number;
    if (testing::Test::HasFailure()) break;
  }
}

TEST(ClosestTest, NoPlaceOnAFineNetIsNearer) {
  constexpr int kNet = 40;
  PairSamples samples(4);
  for (std::size_t number = 0; number < 800; ++number) {
    const Four p = samples.point_and_triangle(number);
    const Four q = samples.two_edges(number);
    Part part{};
    Part other{};
    double to_triangle = std::numeric_limits<double>::infinity();
    double of_edges = to_triangle;
    for (int i = 0; i <= kNet; ++i) {
      const double s = static_cast<double>(i) / kNet;
      for (int j = 0; j <= kNet; ++j) {
        const double t = static_cast<double>(j) / kNet;
        const Vec3 r = q[0] + s * (q[1] - q[0]) - q[2] - t * (q[3] - q[2]);
        of_edges = std::min(of_edges, r.norm());
        if (i + j > kNet) continue;
        to_triangle = std::min(to_triangle, (p[0] - p[1] - s * (p[2] - p[1]) - t * (p[3] - p[1])).norm());
      }
    }
    const double point_distance = std::sqrt(closest_point_triangle(p, part).square);
    const double edge_distance = std::sqrt(closest_edge_edge(q, part, other).square);
    EXPECT_LE(point_distance, to_triangle + kRoundOff * size_of(p));
    EXPECT_LE(edge_distance, of_edges + kRoundOff * size_of(q));
    // No place is farther from the net than half a mesh of it in each direction.
    const double mesh = 0.5 / kNet;
    EXPECT_GE(point_distance, to_triangle - mesh * ((p[2] - p[1]).norm() + (p[3] - p[1]).norm()));
    EXPECT_GE(edge_distance, of_edges - mesh * ((q[1] - q[0]).norm() + (q[3] - q[2]).norm()));
  }
}

TEST(ClosestTest, ThePartIsWhereTheWeightsAre) {
  constexpr std::array<std::array<bool, 3>, 7> kHas = {{{true, false, false},
                                                        {false, true, false},
                                                        {false, false, true},
                                                        {true, true, false},
                                                        {false, true, true},
                                                        {true, false, true},
                                                        {true, true, true}}};
  PairSamples samples(5);
  std::array<int, 7> seen{};
  for (std::size_t number = 0; number < kPairs; ++number) {
    const Four p = samples.point_and_triangle(number);
    Part part{};
    Part second{};
    const Closest closest = closest_point_triangle(p, part);
    const auto kind = static_cast<std::size_t>(part);
    ++seen[kind];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(closest.beta[1 + i] != 0.0, kHas[kind][i]) << number;
    const Four q = samples.two_edges(number);
    const Closest edges = closest_edge_edge(q, part, second);
    EXPECT_EQ(edges.beta[1] == 0.0, part == Part::vertex0);
    EXPECT_EQ(edges.beta[1] == 1.0, part == Part::vertex1);
    EXPECT_EQ(edges.beta[3] == 0.0, second == Part::vertex0);
    EXPECT_EQ(edges.beta[3] == -1.0, second == Part::vertex1);
    if (testing::Test::HasFailure()) break;
  }
  for (const int times : seen) EXPECT_GT(times, 1000);
}

TEST(ClosestTest, ThePlaceInSpaceChangesNoBit) {
  const auto coarse = [](Four p) {  // multiples of 2^-40, so that the sums below are exact
    for (Vec3& vertex : p) vertex = (vertex * 0x1p40).array().round().matrix() * 0x1p-40;
    return p;
  };
  PairSamples samples(6);
  for (std::size_t number = 0; number < 10'000; ++number) {
    const Vec3 far = (1000.0 * samples.vector()).array().round();
    for (const bool edges : {false, true}) {
      const Four p = coarse(edges ? samples.two_edges(number) : samples.point_and_triangle(number % 6));
      Four q = p;
      for (Vec3& vertex : q) vertex += far;
      Part part{};
      Part other{};
      const Closest here = edges ? closest_edge_edge(p, part, other) : closest_point_triangle(p, part);
      const Closest there = edges ? closest_edge_edge(q, part, other) : closest_point_triangle(q, part);
      EXPECT_EQ(here.r, there.r);
      EXPECT_EQ(here.beta, there.beta);
    }
  }
}

TEST(ClosestTest, TheOrderOfTheVerticesChangesNoDistance) {
  PairSamples samples(7);
  for (std::size_t number = 0; number < 10'000; ++number) {
    const Four p = samples.point_and_triangle(number);
    Part part{};
    Part other{};
    const double distance = std::sqrt(closest_point_triangle(p, part).square);
    for (const Four& q : {Four{p[0], p[2], p[3], p[1]}, Four{p[0], p[2], p[1], p[3]}}) {
      EXPECT_NEAR(std::sqrt(closest_point_triangle(q, part).square), distance, kRoundOff * size_of(p));
    }
    const Four e = samples.two_edges(number);
    const double of_edges = std::sqrt(closest_edge_edge(e, part, other).square);
    for (const Four& q : {Four{e[2], e[3], e[0], e[1]}, Four{e[1], e[0], e[2], e[3]}}) {
      EXPECT_NEAR(std::sqrt(closest_edge_edge(q, part, other).square), of_edges, kRoundOff * size_of(e));
    }
  }
}

/// d(d^2)/dp_k = 2 beta_k r, by central differences where none of the ends is on another part. They are wrong
/// by round-off over the step, 1e-10, and by the step squared.
TEST(ClosestTest, TheWeightsAreTheDerivativesOfTheDistance) {
  constexpr double kStep = 1e-6;
  PairSamples samples(8);
  int seen = 0;
  for (std::size_t number = 0; number < 2000; ++number) {
    const bool edges = number % 2 == 0;
    const Four p = edges ? samples.two_edges(7) : samples.point_and_triangle(7);
    const auto closest = [&](const Four& at, Part& part, Part& other) {
      return edges ? closest_edge_edge(at, part, other) : closest_point_triangle(at, part);
    };
    Part part{};
    Part other{};
    const Closest here = closest(p, part, other);
    for (std::size_t k = 0; k < 4; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        std::array<Part, 4> at{};
        Four q = p;
        q[k][axis] += kStep;
        const double more = closest(q, at[0], at[1]).square;
        q[k][axis] -= 2.0 * kStep;
        const double less = closest(q, at[2], at[3]).square;
        if (at != std::array<Part, 4>{part, other, part, other}) continue;
        ++seen;
        EXPECT_NEAR((more - less) / (2.0 * kStep), 2.0 * here.beta[k] * here.r[axis], 1e-7);
      }
    }
  }
  EXPECT_GT(seen, 23'000);
}

TEST(ClosestTest, ParallelEdgesAreNearestInTheMiddleOfWhereTheyFaceEachOther) {
  Part first{};
  Part second{};
  const Four facing = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(6, 1, 0), Vec3(2, 1, 0)};
  const Closest middle = closest_edge_edge(facing, first, second);
  EXPECT_EQ(middle.beta, (std::array<double, 4>{0.25, 0.75, -0.25, -0.75}));
  EXPECT_EQ(middle.r, Vec3(0, -1, 0));
  EXPECT_EQ(first, Part::interior);
  EXPECT_EQ(second, Part::interior);
  const Four apart = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(6, 1, 0), Vec3(5, 1, 0)};
  const Closest ends = closest_edge_edge(apart, first, second);
  EXPECT_EQ(ends.beta, (std::array<double, 4>{0.0, 1.0, 0.0, -1.0}));
  EXPECT_EQ(ends.r, Vec3(-1, -1, 0));
}

TEST(ClosestTest, OfATriangleWithoutAreaItIsTheEdges) {
  Part part{};
  const Vec3 p(1.5, 2, 0);
  const Closest line = closest_point_triangle({p, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, part);
  EXPECT_EQ(line.r, Vec3(0, 2, 0));
  EXPECT_EQ(part, Part::edge12);
  const Closest point = closest_point_triangle({p, Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}, part);
  EXPECT_EQ(point.r, Vec3(0.5, 1, -1));
  EXPECT_EQ(part, Part::vertex0);
}

TEST(ClosestTest, AnswersAreFiniteFromTheSmallestToTheLargestSize) {
  PairSamples samples(9);
  for (std::size_t number = 0; number < 10'000; ++number) {
    for (const double scale : {1e-300, 1e-160, 1e-80, 1e-70, 1e70}) {
      Four p = samples.point_and_triangle(number);
      Four q = samples.two_edges(number);
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] *= number % 8 == 6 ? 1e-6 * scale : scale;  // those are up to 1e6 away
        q[k] *= scale;
      }
      Part part{};
      Part other{};
      for (const Closest& closest : {closest_point_triangle(p, part), closest_edge_edge(q, part, other),
                                     closest_point_edge(q, part)}) {
        EXPECT_TRUE(closest.r.allFinite() && std::isfinite(closest.square));
        for (const double beta : closest.beta) EXPECT_LE(std::abs(beta), 1.0 + 1e-15);
      }
    }
  }
}

}  // namespace
}  // namespace tissu
