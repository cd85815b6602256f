/// Cuts that move nodes onto the blade. Every failure prints its seed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "cut_body.h"
#include "edit/cut/remedies.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;

const Vec3 kSize(0.02, 0.012, 0.009);

double quality(const Hosts& hosts, std::int32_t cell) {
  const auto nodes = hosts.nodes(cell);
  const auto p = [&](std::size_t i) -> Vec3 { return block(hosts.rest(), nodes[i]); };
  return tetra_quality(p(0), p(1), p(2), p(3));
}

/// How many coordinates of a place lie on the faces of the box.
int faces_of_box(const Vec3& place) {
  int count = 0;
  for (Eigen::Index k = 0; k < 3; ++k)
    count += std::abs(place[k]) < 1e-15 || std::abs(place[k] - kSize[k]) < 1e-15 ? 1 : 0;
  return count;
}

/// Cells whose nodes a plan moves and leaves whole have a third of their quality; the moved nodes that lay on
/// faces and edges of the box still do.
std::string fault_of_moves(const Hosts& before, const CutPlan& plan, const test::CutBody& body) {
  for (const NodeMove& move : plan.moved) {
    const int faces = faces_of_box(block(before.rest(), move.node));
    if (faces_of_box(block(body.hosts.rest(), move.node)) < faces) return "a node left the surface";
    if (faces == 3) return "a corner of the box moved";
    for (const std::int32_t cell : body.hosts.cells_at(move.node)) {
      if (cell >= before.next_cell()) continue;  // a part of a divided cell
      const double least = std::max(0.1, quality(before, cell) / 3.0);
      if (!(quality(body.hosts, cell) >= least * (1.0 - 1e-9))) return "a cell became too flat";
    }
  }
  return body.fault();
}

/// Snaps a jittered, perhaps deformed bar of this seed up to five times; what is wrong, or nothing.
std::string snap_some(std::uint64_t seed, long& cuts, long& moved) {
  Random random(seed);
  const auto count = [&] { return 1 + static_cast<int>(random() % 3); };
  const std::array<int, 3> cells{1 + count(), count(), count()};
  const double jitter = random() % 3 == 0 ? 0.0 : 0.15;
  test::CutBody body(test::typed_box(CellType::tetra, kSize, cells, jitter, random()));
  if (random() % 2 == 0) body.move([](const Vec3& X) -> Vec3 { return X + Vec3(0, 3.0 * X[0] * X[0], 0); });
  const auto many = static_cast<int>(1 + random() % 5);
  for (int i = 0; i < many; ++i, ++cuts) {
    const Hosts before = body.hosts;
    CutOptions options;
    options.refine = random() % 4 == 0;
    options.depth = random() % 3 == 0;
    const CutPlan plan = body.snap(test::random_sweep(random, body), options);
    moved += static_cast<long>(plan.moved.size());
    const std::string fault = fault_of_moves(before, plan, body);
    if (!fault.empty()) return "seed " + std::to_string(seed) + ", cut " + std::to_string(i) + ": " + fault;
  }
  return {};
}

TEST(SnapTest, RandomCutsKeepEveryInvariant) {
  long cuts = 0;
  long moved = 0;
  for (std::uint64_t seed = 1; cuts < 400; ++seed) {
    const std::string fault = snap_some(seed, cuts, moved);
    ASSERT_TRUE(fault.empty()) << fault;
  }
  EXPECT_GT(moved, 1000);
  RecordProperty("moved", static_cast<int>(moved));
}

/// A plane across the bar, beside the nodes: the nodes go there, and no cell is divided.
TEST(SnapTest, NodesBesideAPlaneGoThere) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 3, 3}, 0.0, 5));
  const double step = kSize[0] / 6.0;
  const double place = 3.2 * step;
  const auto cells = body.hosts.next_cell();
  const CutPlan plan = body.snap(body.plane(Vec3(place, 0, 0), Vec3::UnitX()));
  EXPECT_EQ(plan.moved.size(), 16U);  // the layer of 4 x 4 nodes
  EXPECT_TRUE(plan.born.empty());
  EXPECT_EQ(body.hosts.next_cell(), cells);
  for (const NodeMove& move : plan.moved) {
    const Vec3 was = Vec3(3.0 * step, 0, 0);
    const Vec3 now = block(body.hosts.rest(), move.node);
    EXPECT_NEAR(now[0] - was[0], 0.2 * step, 1e-15);
  }
  EXPECT_EQ(body.piece_count(), 2U);
  EXPECT_NEAR(body.cut_area(), 2.0 * kSize[1] * kSize[2], 1e-15);  // both sides
  EXPECT_EQ(body.fault(), "");
}

/// The cut is where the blade is, and not on the faces of cells as where a cut goes to nodes that stay.
TEST(SnapTest, PiecesHaveTheVolumesThatThePlaneLeaves) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 4, 4}, 0.0, 5));
  const CutPlan plan = body.snap(body.plane(Vec3(0.31 * kSize[0], 0, 0), Vec3::UnitX()));
  ASSERT_FALSE(plan.moved.empty());
  const std::vector<Piece> parts = pieces(body.hosts, body.material);
  ASSERT_EQ(parts.size(), 2U);
  const double whole = kSize.prod();
  const double less = std::min(parts[0].volume, parts[1].volume);
  EXPECT_NEAR(less, 0.31 * whole, 1e-12 * whole);
}

TEST(SnapTest, NodesThatMayNotMoveStayAndEdgesAreDivided) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 3, 3}, 0.0, 5));
  test::CutBody divided = body;
  const Sweep sweep = body.plane(Vec3(0.54 * kSize[0], 0.004, 0.004), Vec3(1, 0.3, -0.2));
  SnapRules rules;
  rules.may_move.assign(static_cast<std::size_t>(body.hosts.node_count()), 0);
  const CutPlan plan = body.snap(sweep, {}, rules);
  const CutPlan other = divided.cut(sweep, {.divide = true});
  EXPECT_TRUE(plan.moved.empty());
  EXPECT_EQ(plan.born.size(), other.born.size());
  EXPECT_FALSE(body.hosts.moved());
}

TEST(SnapTest, RefusedMovesAreNotMade) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 3, 3}, 0.1, 5));
  const Sweep sweep = body.plane(Vec3(0.54 * kSize[0], 0.004, 0.004), Vec3(1, 0.3, -0.2));
  test::CutBody all = body;
  const CutPlan whole = all.snap(sweep);
  ASSERT_GT(whole.moved.size(), 4U);
  const std::int32_t one = whole.moved.front().node;
  SnapRules rules;
  rules.refused = [one](const std::vector<NodeMove>& moves) {
    const bool is_there = std::ranges::find(moves, one, &NodeMove::node) != moves.end();
    return is_there ? std::vector<std::int32_t>{one} : std::vector<std::int32_t>{};
  };
  const CutPlan plan = body.snap(sweep, {}, rules);
  EXPECT_EQ(std::ranges::find(plan.moved, one, &NodeMove::node), plan.moved.end());
  EXPECT_FALSE(plan.moved.empty());
  EXPECT_EQ(body.fault(), "");
}

/// Cut faces of an earlier cut stay where they are.
TEST(SnapTest, NodesOfOpenedFacesStay) {
  test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 3, 3}, 0.0, 5));
  body.snap(body.plane(Vec3(0.5 * kSize[0], 0, 0), Vec3::UnitX()));
  std::set<std::int32_t> opened;
  for (std::int32_t node = 0; node < body.hosts.node_count(); ++node) {
    if (std::abs(block(body.hosts.rest(), node)[0] - 0.5 * kSize[0]) < 1e-12) opened.insert(node);
  }
  const CutPlan plan = body.snap(body.plane(Vec3(0, 0.4 * kSize[1], 0), Vec3(0.1, 1.0, 0.1)));
  EXPECT_FALSE(plan.moved.empty());
  for (const NodeMove& move : plan.moved) EXPECT_FALSE(opened.contains(move.node)) << move.node;
  EXPECT_EQ(body.fault(), "");
}

/// A blade that goes less than a cell deep: without depth it crosses edges of the surface alone, and opens no
/// face; with it the inner nodes below go to its plane, and faces open.
TEST(SnapTest, DepthOpensShallowCuts) {
  const auto scratched = [](bool depth) {
    test::CutBody body(test::typed_box(CellType::tetra, kSize, {6, 3, 3}, 0.0, 5));
    const double x = 3.2 * kSize[0] / 6.0;
    const std::array<std::array<std::int32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    const double low = 0.8 * kSize[2];
    const std::vector<double> points{x, -1, low, x, 1, low, x, 1, 1, x, -1, 1};
    CutOptions options;
    options.depth = depth;
    const CutPlan plan = body.snap(triangle_sweep(points, triangles), options);
    EXPECT_EQ(body.fault(), "");
    for (const NodeMove& move : plan.moved) EXPECT_NEAR(block(body.hosts.rest(), move.node)[0], x, 1e-15);
    return std::pair(plan.moved.size(), plan.faces_opened);
  };
  const auto [plain, none] = scratched(false);
  const auto [deep, some] = scratched(true);
  EXPECT_GT(deep, plain);
  EXPECT_GT(some, none);
}

}  // namespace
}  // namespace tissu
