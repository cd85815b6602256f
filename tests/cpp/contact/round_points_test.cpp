#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "contact/round.h"
#include "tissu/contact/surface_set.h"

/// Points of a face at which it meets something round: close enough together, and the same ones of the body
/// when the face is stretched.
namespace tissu {
namespace {

constexpr double kRadius = 1.0;
constexpr double kGap = 0.02;
const double kChord = std::sqrt(8.0 * kRadius * kGap);  // its arc rises by the gap, to first order in that

/// A triangle with two edges of that length and a right angle, and a ball above it.
struct Face {
  explicit Face(double length) {
    SurfaceDescription face{.name = "face"};
    face.triangles = {{0, 1, 2}};
    SurfaceDescription ball{.name = "ball"};
    ball.vertices = {0.3 * length, 0.3 * length, kRadius};
    ball.points = {0};
    ball.radius = {kRadius};
    description.bodies = {face};
    description.obstacles = {{.surface = ball}};
    description.pairs = {{.a = 0, .b = 1, .gap = kGap}};
    rest = {0.0, 0.0, 0.0, length, 0.0, 0.0, 0.0, length, 0.0};
  }
  /// Where points with their numbers lie when the face is stretched along x: shares of vertices 1 and 2.
  [[nodiscard]] std::map<std::int32_t, std::array<double, 2>> points(double stretch) const {
    const std::vector<std::int32_t> first = {0};
    const SurfaceSet set(description, first, rest);
    std::vector<double> places(set.rest().begin(), set.rest().end());
    for (std::size_t i = 0; i < 9; i += 3) places[i] *= stretch;
    const Candidate candidate{PairKind::vertex_face, 3, 0, 0, {3, 0, 1, 2}, kRadius + kGap};
    const int parts = parts_before_round(set, candidate);
    EXPECT_GT(parts, 0);
    std::map<std::int32_t, std::array<double, 2>> met;
    RoundPoints round(set, places, places, candidate, parts);
    Found found{};
    while (round.next(1e9, found)) {
      std::array<double, 2> share{};
      for (std::size_t k = 1; k < 4; ++k) {
        if (found.vertex[k] > 0) share.at(static_cast<std::size_t>(found.vertex[k]) - 1) = -found.beta[k];
      }
      EXPECT_TRUE(met.emplace(round.number(), share).second) << "number " << round.number() << " twice";
    }
    return met;
  }
  ContactDescription description;
  std::vector<double> rest;
};

TEST(RoundPoints, StayTheSameOfTheBodyWhenItIsStretched) {
  for (const double chords : {0.9, 1.9, 3.5, 5.5}) {
    const Face face(chords * kChord);
    auto coarse = face.points(1.0);
    for (const double stretch : {1.3, 1.9, 2.9, 6.0}) {
      const auto fine = face.points(stretch);
      for (const auto& [number, share] : coarse) {
        const auto same = fine.find(number);
        ASSERT_NE(same, fine.end()) << number;
        EXPECT_NEAR(same->second[0], share[0], 1e-15);
        EXPECT_NEAR(same->second[1], share[1], 1e-15);
      }
      coarse = fine;
    }
  }
}

/// No point of the face is farther from the nearest three than their distance allows: along x they are at
/// most 1.05 chords apart.
TEST(RoundPoints, AreCloseEnoughAlsoWhereTheFaceIsStretched) {
  for (const double chords : {0.9, 1.9, 3.5}) {
    for (const double stretch : {1.0, 1.3, 1.9, 2.9, 6.0}) {
      const auto points = Face(chords * kChord).points(stretch);
      std::vector<double> on_edge = {0.0, 1.0};  // from vertex 0 to vertex 1
      std::vector<double> inside = {0.0};        // on the line of points that is the nearest to it
      double nearest = 1.0;
      for (const auto& [number, share] : points) {
        if (share[1] == 0.0) on_edge.push_back(share[0]);
        if (share[1] > 0.0 && share[0] > 0.0 && share[0] + share[1] < 1.0 - 1e-12)
          nearest = std::min(nearest, share[1]);
      }
      for (const auto& [number, share] : points) {
        if (std::abs(share[1] - nearest) < 1e-12) inside.push_back(share[0]);
      }
      inside.push_back(1.0 - nearest);
      for (auto* line : {&on_edge, &inside}) {
        std::ranges::sort(*line);
        for (std::size_t i = 1; i < line->size(); ++i) {
          EXPECT_LE(((*line)[i] - (*line)[i - 1]) * chords * stretch, 1.05 * (1.0 + 1e-12));
        }
      }
    }
  }
}

TEST(RoundPoints, AreAsFewAsAFaceNeedsAtRest) {
  // Two edges of 3.5 chords in 4 parts; the third, of 4.9 chords, is in 5, as is the inside: 6 points there.
  EXPECT_EQ(Face(3.5 * kChord).points(1.0).size(), 3U + 3U + 4U + 6U);
  EXPECT_EQ(Face(0.7 * kChord).points(1.0).size(), 0U);
}

}  // namespace
}  // namespace tissu
