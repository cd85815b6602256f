/// A knife that goes a way with one bend in steps of half a cell: its second wall leaves the first as it is,
/// so that two parts are left, with the volumes that the way bounds. Every failure prints its seed;
/// TISSU_KNIVES sets how many ways there are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "bends.h"

namespace tissu::bends {
namespace {

constexpr double kStep = 0.5;
constexpr double kBehind = 1.5;  ///< so far back a sweep begins, over the last ones
constexpr double kFar = 10.5;    ///< outside of the body

/// Places on the way, one for each step.
std::vector<Point> way_of(const Bend& bend) {
  const auto [a, b, c] = bend.line();
  const Point from = b + kFar * (a - b).normalized();
  const Point to = b + kFar * (c - b).normalized();
  const int count = static_cast<int>(kFar / kStep);
  std::vector<Point> way;
  for (int i = 0; i < count; ++i) way.emplace_back(from + (b - from) * i / count);
  for (int i = 0; i <= count; ++i) way.emplace_back(b + (to - b) * i / count);
  return way;
}

/// The sweep of the step that ends at a place of the way, an edge along z.
Sweep sweep_to(const std::vector<Point>& way, std::size_t end, int points) {
  std::size_t begin = end - 1;
  while (begin > 0 && (way[begin] - way[end]).norm() <= kBehind) --begin;
  std::vector<double> places;
  for (std::size_t k = begin; k <= end; ++k) {
    for (int i = 0; i < points; ++i)
      places.insert(places.end(), {way[k][0], way[k][1], -1.0 + 6.0 * i / (points - 1)});
  }
  const auto past = static_cast<std::int32_t>(end - begin);
  return edge_sweep(places, past + 1, points, 1, past);
}

/// Volumes of the pieces, ascending.
std::vector<double> volumes(const Mesh& mesh, const Bend& bend, const Carrier& carrier) {
  Hosts hosts(mesh);
  Material material;
  std::vector<double> x = mesh.positions;
  const std::vector<Point> way = way_of(bend);
  for (std::size_t end = 1; end < way.size(); ++end) {
    const Sweep sweep = sweep_to(way, end, carrier.thin() ? 3 : 13);
    const CutPlan plan = plan_cut(hosts, material, x, sweep, {.divide = carrier.divide});
    hosts.apply(plan);
    material.apply(plan);
    for (const BornNode& node : plan.nodes) {
      const bool is_copy = node.between.count == 0;
      const Vec3 place = is_copy ? Vec3(block(ConstReals(x), node.copied)) : node.between.at(x);
      x.insert(x.end(), place.data(), place.data() + 3);
    }
  }
  std::vector<double> found;
  for (const Piece& piece : pieces(hosts, material)) found.push_back(piece.volume);
  std::ranges::sort(found);
  return found;
}

TEST(KnifeBendsTest, TheSecondWallLeavesTheFirst) {
  const char* text = std::getenv("TISSU_KNIVES");
  const long count = text == nullptr ? 12 : std::strtol(text, nullptr, 10);
  for (const Carrier& carrier : kCarriers) {
    for (long seed = 1; seed <= count; ++seed) {
      const std::string what = carrier.name() + ", seed " + std::to_string(seed);
      Random random(static_cast<std::uint64_t>(seed));
      Bend bend = random_bend(random, false);
      bend.degrees = carrier.divide  ? real(random, 10.0, 120.0)
                     : seed % 2 == 0 ? real(random, 130.0, 165.0)
                                     : real(random, 10.0, 165.0);
      const std::vector<double> found =
          volumes(mesh_of(carrier, static_cast<std::uint64_t>(seed)), bend, carrier);
      EXPECT_EQ(found.size(), 2U) << what << ", " << bend.degrees << " degrees";
      if (found.size() != 2) continue;
      const double depth = carrier.thin() ? 1.0 : kSize[2];
      const double inner = depth * inner_area(bend);
      const double least = std::min(inner, depth * kSize[0] * kSize[1] - inner);
      EXPECT_NEAR(found[0], least, tolerance(bend, carrier)) << what;
    }
  }
}

}  // namespace
}  // namespace tissu::bends
