/// Plans that divide cells along the cut. Every failure prints its seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "cut_body.h"
#include "edit/cut/remedies.h"
#include "tissu/base/error.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;

constexpr CutOptions kDivide{.t0 = 0.02, .refine = false, .divide = true};

double quality(const Hosts& hosts, std::int32_t cell) {
  const auto nodes = hosts.nodes(cell);
  const auto p = [&](std::size_t i) -> Vec3 { return block(hosts.rest(), nodes[i]); };
  return tetra_quality(p(0), p(1), p(2), p(3));
}

/// What a plan must do beside what every cut does: new cells are whole, and none is too flat.
std::string fault_of(const CutPlan& plan, const std::map<std::int32_t, double>& before,
                     const test::CutBody& body) {
  if (!body.material.riders.empty()) return "a vertex rides";
  for (const BornCell& cell : plan.born) {
    if (cell.share != 1.0) return "a new cell is a part";
    const double least = std::min(0.05, 0.25 * before.at(cell.parent));
    const double found = quality(body.hosts, cell.number);
    if (!(found >= least * (1.0 - 1e-9))) return "a new cell has quality " + std::to_string(found);
  }
  if (std::ranges::any_of(plan.nodes, [](const BornNode& node) { return !node.material; }))
    return "a node has no material";
  return body.fault();
}

/// Cuts a jittered, perhaps deformed bar of this seed up to six times; what is wrong, or nothing.
std::string divide_some(std::uint64_t seed, long& cuts, long& divided) {
  Random random(seed);
  const auto count = [&] { return 1 + static_cast<int>(random() % 3); };
  const std::array<int, 3> cells{1 + count(), count(), count()};
  const double jitter = random() % 3 == 0 ? 0.0 : 0.15;
  test::CutBody body(test::typed_box(CellType::tetra, Vec3(0.02, 0.012, 0.009), cells, jitter, random()));
  if (random() % 2 == 0) body.move([](const Vec3& X) -> Vec3 { return X + Vec3(0, 3.0 * X[0] * X[0], 0); });
  const auto many = static_cast<int>(1 + random() % 6);
  for (int i = 0; i < many; ++i, ++cuts) {
    std::map<std::int32_t, double> before;
    for (const std::int32_t cell : body.hosts.numbers()) before[cell] = quality(body.hosts, cell);
    CutOptions options = kDivide;
    options.refine = random() % 4 == 0;
    const CutPlan plan = body.cut(test::random_sweep(random, body), options);
    divided += static_cast<long>(plan.gone.size());
    const std::string fault = fault_of(plan, before, body);
    if (!fault.empty()) return "seed " + std::to_string(seed) + ", cut " + std::to_string(i) + ": " + fault;
  }
  return {};
}

TEST(DivideTest, RandomCutsKeepEveryInvariant) {
  long cuts = 0;
  long divided = 0;
  for (std::uint64_t seed = 1; cuts < 400; ++seed) {
    const std::string fault = divide_some(seed, cuts, divided);
    ASSERT_TRUE(fault.empty()) << fault;
  }
  EXPECT_GT(divided, 4000);
}

/// The regular tetrahedron and flat blades: 2 to 6 parts, none flatter than the guard, all cut through.
TEST(DivideTest, PartsOfARegularCell) {
  Mesh mesh;
  mesh.positions = {1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1};
  mesh.blocks.push_back({CellType::tetra, {0, 1, 2, 3}});
  Random random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> place(-0.9, 0.9);
  double least = 1.0;
  std::map<std::size_t, int> parts;
  for (int i = 0; i < 4000; ++i) {
    test::CutBody body(mesh);
    const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
    const CutPlan plan = body.cut(body.plane(place(random) * n, n), kDivide);
    EXPECT_TRUE(plan.unresolved.empty());
    if (plan.born.empty()) continue;
    ++parts[plan.born.size()];
    EXPECT_EQ(body.piece_count(), 2U);
    for (const BornCell& cell : plan.born) least = std::min(least, quality(body.hosts, cell.number));
  }
  EXPECT_GE(least, 0.05);
  EXPECT_LT(least, 0.2);  // planes through the middle of it leave flat ones
  for (const auto& [count, times] : parts) {
    EXPECT_TRUE(count == 2 || count == 3 || count == 4 || count == 6) << count << " parts, " << times;
    RecordProperty("parts_" + std::to_string(count), times);
  }
  EXPECT_EQ(parts.size(), 4U);
  RecordProperty("least_quality", std::to_string(least));
}

/// Places on the first day follow from the nodes of the first day alone: two orders of cuts, one place.
TEST(DivideTest, NodesOfLaterCutsLieBetweenNodesOfTheFirstDay) {
  test::CutBody body(test::typed_box(CellType::tetra, Vec3(0.02, 0.012, 0.009), {2, 2, 2}, 0.1, 5));
  const auto first_day = body.hosts.node_count();
  Random random(11);
  for (int i = 0; i < 6; ++i) body.cut(test::random_sweep(random, body), kDivide);
  ASSERT_GT(body.hosts.points().size(), 50U);
  for (std::int32_t node = first_day; node < body.hosts.node_count(); ++node) {
    const std::int32_t root = body.hosts.root(node);
    if (root >= 0) continue;
    const Rider& point = body.hosts.points()[static_cast<std::size_t>(-1 - root)];
    double sum = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k) {
      EXPECT_LT(point.node[k], first_day);
      EXPECT_GE(point.weight[k], 0.0);
      sum += point.weight[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_EQ((point.at(body.hosts.rest()) - block(body.hosts.rest(), node)).norm(), 0.0);
  }
}

TEST(DivideTest, RefusesOtherCellsAndPartsOfCells) {
  const Vec3 size(0.02, 0.012, 0.009);
  test::CutBody cubes(test::typed_box(CellType::hexahedron, size, {2, 2, 2}, 0.0, 5));
  EXPECT_THROW(cubes.cut(cubes.plane(Vec3(0.004, 0, 0), Vec3::UnitX()), kDivide), ParameterError);
  test::CutBody copies(test::typed_box(CellType::tetra, size, {2, 2, 2}, 0.0, 5));
  copies.cut(copies.plane(Vec3(0.004, 0, 0), Vec3::UnitX()));
  EXPECT_THROW(copies.cut(copies.plane(Vec3(0.006, 0, 0), Vec3::UnitX()), kDivide), ParameterError);
}

}  // namespace
}  // namespace tissu
