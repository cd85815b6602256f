/// Repairs after random cuts. Every failure prints its seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>

#include "../cut/cut_body.h"
#include "edit/cut/remedies.h"
#include "tissu/edit/cut_body.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;

const Vec3 kSize(0.02, 0.012, 0.009);
constexpr double kRoundOff = 1e-13;  ///< of a sum over some thousand cells

double least_quality(const Hosts& hosts) {
  double least = 1.0;
  for (const std::int32_t cell : hosts.numbers()) {
    const auto nodes = hosts.nodes(cell);
    const auto p = [&](std::size_t i) -> Vec3 { return block(hosts.rest(), nodes[i]); };
    least = std::min(least, tetra_quality(p(0), p(1), p(2), p(3)));
  }
  return least;
}

/// How far x lies from a linear map of the places at rest.
double off_linear(const test::CutBody& body, const Mat3& map) {
  double most = 0.0;
  for (std::int32_t node = 0; node < body.hosts.node_count(); ++node) {
    const Vec3 place = block(ConstReals(body.x), node);
    most = std::max(most, (place - map * block(body.hosts.rest(), node)).norm());
  }
  return most;
}

/// Every face between cells twice, and cells of positive volume now, where all were before.
std::string mesh_fault(const test::CutBody& body) {
  std::map<std::array<std::int32_t, 3>, int> faces;
  for (const std::int32_t cell : body.hosts.numbers()) {
    const auto nodes = body.hosts.nodes(cell);
    const auto p = [&](std::size_t i) -> Vec3 { return block(ConstReals(body.x), nodes[i]); };
    if (!((p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) > 0.0)) return "a cell is inside out now";
    for (std::size_t f = 0; f < 4; ++f) {
      std::array<std::int32_t, 3> face{};
      std::size_t count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != f) face[count++] = nodes[i];
      }
      std::ranges::sort(face);
      if (++faces[face] > 2) return "three cells share a face";
    }
  }
  return {};
}

struct Tally {
  long cuts = 0;
  RepairCounts made;
};

/// What a repair after one cut does wrong, or nothing.
std::string repair_once(test::CutBody& body, const Mat3* map, Tally& tally) {
  const int characteristic = body.characteristic();
  const std::size_t parts = body.piece_count();
  const double volume = body.volume();
  const double area = body.cut_area();
  const double least = least_quality(body.hosts);
  const std::string before = mesh_fault(body);
  const RepairPlan plan = body.repair();
  tally.made.collapses += plan.counts.collapses;
  tally.made.flips += plan.counts.flips;
  tally.made.moves += plan.counts.moves;
  tally.made.bad_before += plan.counts.bad_before;
  tally.made.bad_after += plan.counts.bad_after;
  if (plan.counts.least_after != least_quality(body.hosts)) return "the least quality is another one";
  if (plan.counts.least_after < least) return "the least quality fell";
  if (body.characteristic() != characteristic) return "the characteristic changed";
  if (body.piece_count() != parts) return "the number of pieces changed";
  if (std::abs(body.volume() - volume) > kRoundOff * volume) return "the volume changed";
  if (std::abs(body.cut_area() - area) > kRoundOff * (area + 1e-4))
    return "the cut faces changed by " + std::to_string((body.cut_area() - area) / area);
  if (map != nullptr && off_linear(body, *map) > 1e-15) return "a linear field changed";
  if (before.empty() && !mesh_fault(body).empty()) return mesh_fault(body);
  return body.fault();
}

/// Cuts a jittered, perhaps deformed bar of this seed up to five times, and repairs it each time.
std::string repair_some(std::uint64_t seed, Tally& tally) {
  Random random(seed);
  const auto count = [&] { return 1 + static_cast<int>(random() % 3); };
  const std::array<int, 3> cells{1 + count(), count(), count()};
  const double jitter = random() % 3 == 0 ? 0.0 : 0.15;
  test::CutBody body(test::typed_box(CellType::tetra, kSize, cells, jitter, random()));
  const bool is_bent = random() % 2 == 0;
  Mat3 map = Mat3::Identity();
  map(0, 1) = 0.2;
  map(2, 2) = 1.3;
  if (is_bent) {
    body.move([](const Vec3& X) -> Vec3 { return X + Vec3(0, 3.0 * X[0] * X[0], 0); });
  } else {
    body.move([&](const Vec3& X) -> Vec3 { return map * X; });
  }
  const auto many = static_cast<int>(1 + random() % 5);
  for (int i = 0; i < many; ++i, ++tally.cuts) {
    const Sweep sweep = test::random_sweep(random, body);
    if (random() % 3 == 0) {
      body.snap(sweep);
    } else {
      body.cut(sweep, {.divide = true});
    }
    const std::string fault = repair_once(body, is_bent ? nullptr : &map, tally);
    if (!fault.empty()) return "seed " + std::to_string(seed) + ", cut " + std::to_string(i) + ": " + fault;
  }
  return {};
}

/// TISSU_REPAIRS: how many cuts, 400 unless given.
TEST(RepairTest, RandomCutsKeepEveryInvariant) {
  const char* wanted = std::getenv("TISSU_REPAIRS");  // NOLINT(concurrency-mt-unsafe): one thread reads it
  const long cuts = wanted == nullptr ? 400 : std::strtol(wanted, nullptr, 10);
  Tally tally;
  for (std::uint64_t seed = 1; tally.cuts < cuts; ++seed) {
    const std::string fault = repair_some(seed, tally);
    ASSERT_TRUE(fault.empty()) << fault;
  }
  EXPECT_GT(tally.made.collapses, 10);
  EXPECT_GT(tally.made.flips, 10);
  EXPECT_GT(tally.made.moves, 10);
  EXPECT_LT(tally.made.bad_after, tally.made.bad_before);
  RecordProperty("collapses", tally.made.collapses);
  RecordProperty("flips", tally.made.flips);
  RecordProperty("moves", tally.made.moves);
  RecordProperty("bad_before", tally.made.bad_before);
  RecordProperty("bad_after", tally.made.bad_after);
}

/// Three planes that leave bad cells; before the repair.
test::CutBody cut_thrice() {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 4, 4}, 0.1, 5));
  for (const double place : {0.45, 0.5, 0.55})
    body.cut(body.plane(Vec3(place * kSize[0], 0.006, 0.004), Vec3(1, 0.4, 0.4 - place)), {.divide = true});
  return body;
}

using Cells = std::set<std::set<std::int32_t>>;

Cells cells_of(const Hosts& hosts) {
  Cells cells;
  for (const std::int32_t cell : hosts.numbers())
    cells.insert({hosts.nodes(cell).begin(), hosts.nodes(cell).end()});
  return cells;
}

RepairRules free_rules(const test::CutBody& body) {
  RepairRules rules;
  rules.may_move.assign(static_cast<std::size_t>(body.hosts.node_count()), 1);
  return rules;
}

TEST(RepairTest, MostIsANumberOfOperations) {
  const test::CutBody body = cut_thrice();
  const RepairCounts all = test::CutBody(body).repair().counts;
  ASSERT_GT(all.collapses + all.flips + all.moves, 3);
  const RepairCounts two = test::CutBody(body).repair({.most = 2}).counts;
  EXPECT_EQ(two.collapses + two.flips + two.moves, 2);
}

TEST(RepairTest, CellsAboveTheBoundStay) {
  test::CutBody body = cut_thrice();
  const Cells before = cells_of(body.hosts);
  const RepairPlan plan = body.repair({.below = 1e-6});
  EXPECT_EQ(plan.counts.bad_before, 0);
  EXPECT_FALSE(changes(plan.plan));
  EXPECT_EQ(cells_of(body.hosts), before);
}

/// Cells that no cut made or opened are not repaired, however bad they are.
TEST(RepairTest, CellsOfTheFirstDayStay) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {3, 2, 2}, 0.3, 5));
  EXPECT_EQ(body.repair({.below = 0.5}).counts.bad_before, 0);
}

TEST(RepairTest, RulesAreKept) {
  const test::CutBody body = cut_thrice();
  RepairRules rules = free_rules(body);
  rules.are_alike = [](const auto&) { return false; };
  EXPECT_FALSE(changes(test::CutBody(body).repair({}, rules).plan));
  rules = free_rules(body);
  rules.allows_jump = [](auto, const auto&, const auto&) { return false; };
  EXPECT_FALSE(changes(test::CutBody(body).repair({}, rules).plan));
  rules = free_rules(body);
  rules.is_held.assign(rules.may_move.size(), 1);
  EXPECT_EQ(test::CutBody(body).repair({}, rules).counts.collapses, 0);
  rules = free_rules(body);
  rules.may_move.assign(rules.may_move.size(), 0);
  const RepairCounts still = test::CutBody(body).repair({}, rules).counts;
  EXPECT_EQ(still.collapses + still.moves, 0);
  EXPECT_GT(still.flips, 0);
}

std::set<std::set<std::int32_t>> surface_of(const test::CutBody& body) {
  const MaterialSurface surface = material_surface(body.hosts, body.material);
  std::set<std::set<std::int32_t>> triangles;
  for (const auto& t : surface.triangles) {
    std::set<std::int32_t> nodes;
    for (const std::int32_t v : t) nodes.insert(surface.vertex_node[static_cast<std::size_t>(v)]);
    triangles.insert(nodes);
  }
  return triangles;
}

TEST(RepairTest, TheSurfaceStaysWhereItMust) {
  test::CutBody body = cut_thrice();
  const auto before = surface_of(body);
  test::CutBody free = body;
  free.repair();
  EXPECT_NE(surface_of(free), before);
  RepairRules rules = free_rules(body);
  rules.surface_stays = true;
  const RepairCounts counts = body.repair({}, rules).counts;
  EXPECT_GT(counts.collapses + counts.flips + counts.moves, 0);
  EXPECT_EQ(surface_of(body), before);
}

/// Nodes of an incision with which a knife goes on stay, and so do the faces between them.
TEST(RepairTest, IncisionsThatGoOnStay) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 4, 4}, 0.1, 5));
  std::int32_t number = 7;
  for (const double place : {0.45, 0.5, 0.55}) {
    Sweep sweep = body.plane(Vec3(place * kSize[0], 0.006, 0.004), Vec3(1, 0.4, 0.4 - place));
    for (SweepPart& part : sweep.parts) part.incision = number;
    body.cut(sweep, {.divide = true});
    ++number;
  }
  ASSERT_EQ(body.material.incisions.size(), 3U);
  const std::vector<std::int32_t> nodes = body.material.incisions.back().vertices;
  const auto changed = [&](const RepairOptions& options) {
    test::CutBody repaired = body;
    repaired.repair(options);
    return std::ranges::count_if(nodes, [&](std::int32_t node) {
      return repaired.hosts.cells_at(node).empty() ||
             block(repaired.hosts.rest(), node) != block(body.hosts.rest(), node);
    });
  };
  EXPECT_GT(changed({.below = 0.3}), 0);
  EXPECT_EQ(changed({.below = 0.3, .goes_on = {9}}), 0);
  EXPECT_GT(changed({.below = 0.3, .goes_on = {10}}), 0);
}

/// A later cut divides an edge that a repair made between nodes of several first-day cells.
TEST(RepairTest, RepairedCellsAreCutAgain) {
  test::CutBody body = cut_thrice();
  body.repair();
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    test::CutBody again = body;
    const Vec3 point = kSize.cwiseProduct(Vec3(0.4 + 0.01 * i, 0.5, 0.5));
    again.cut(again.plane(point, Vec3(1, -0.6, 0.1 * i)), {.divide = true});
    ASSERT_EQ(again.fault(), "") << i;
  }
}

}  // namespace
}  // namespace tissu
