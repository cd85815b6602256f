/// Volumes with a skin and a thread that share their nodes, under random blades.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "cut_body.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

using Random = std::mt19937_64;

constexpr double kRoundOff = 1e-10;  ///< of sums over some thousand parts of areas
const Vec3 kSize(0.3, 0.2, 0.1);

/// The box with a skin on its top, and a thread along the edge y = z = 0.
Mesh with_skin(Mesh mesh, int along) {
  const Surface outer = boundary_surface(mesh);
  CellBlock triangles{CellType::triangle, {}};
  CellBlock quads{CellType::quad, {}};
  const auto on_top = [&](const auto& face) {
    return std::ranges::all_of(face,
                               [&](std::int32_t node) { return mesh.node(node).z() > kSize.z() - 1e-9; });
  };
  for (const auto& face : outer.triangles) {
    if (on_top(face)) triangles.nodes.insert(triangles.nodes.end(), face.begin(), face.end());
  }
  for (const auto& face : outer.quads) {
    if (on_top(face)) quads.nodes.insert(quads.nodes.end(), face.begin(), face.end());
  }
  std::vector<std::int32_t> edge;
  for (std::int32_t node = 0; node < mesh.node_count(); ++node) {
    const Vec3 place = mesh.node(node);
    if (place.y() < 1e-9 && place.z() < 1e-9) edge.push_back(node);
  }
  std::ranges::sort(edge, {}, [&](std::int32_t node) { return mesh.node(node).x(); });
  EXPECT_EQ(edge.size(), static_cast<std::size_t>(along) + 1);
  CellBlock lines{CellType::line, {}};
  for (std::size_t i = 0; i + 1 < edge.size(); ++i)
    lines.nodes.insert(lines.nodes.end(), {edge[i], edge[i + 1]});
  for (CellBlock* block : {&triangles, &quads, &lines}) {
    if (!block->nodes.empty()) mesh.blocks.push_back(*block);
  }
  return mesh;
}

struct MixedBody {
  explicit MixedBody(const Mesh& mesh) : hosts(mesh), x(mesh.positions) {}

  CutPlan cut(const Sweep& sweep) {
    CutPlan plan = plan_cut(hosts, material, x, sweep);
    hosts.apply(plan);
    material.apply(plan);
    for (const BornNode& node : plan.nodes) {
      const Vec3 place = block(ConstReals(x), node.copied);
      x.insert(x.end(), place.begin(), place.end());
    }
    return plan;
  }

  /// Of the material of a dimension [m3, m2, m].
  [[nodiscard]] double measure(int dimension) const {
    double sum = 0.0;
    for (const std::int32_t cell : hosts.numbers()) {
      if (info(hosts.type(cell)).dimension != dimension) continue;
      for (const MaterialTetra& part : material_of(hosts, material, cell))
        sum += rest_volume(hosts, material, cell, part);
    }
    return sum;
  }

  Hosts hosts;
  Material material;
  std::vector<double> x;
};

class MixedCutTest : public testing::TestWithParam<CellType> {};

TEST_P(MixedCutTest, RandomBladesPartTheSkinAsTheyPartTheVolume) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Mesh box = test::typed_box(GetParam(), kSize, {6, 4, 2}, seed % 3 == 0 ? 0.0 : 0.15, seed);
    test::CutBody alone(box);
    MixedBody mixed(with_skin(box, 6));
    const double skin = mixed.measure(2);
    for (int i = 0; i < 6; ++i) {
      const std::string where = "seed " + std::to_string(seed) + ", cut " + std::to_string(i);
      const Sweep sweep = test::random_sweep(random, alone);
      alone.cut(sweep);
      mixed.cut(sweep);
      ASSERT_EQ(mixed.x.size(), alone.x.size()) << where;  // as many nodes part
      ASSERT_EQ(pieces(mixed.hosts, mixed.material).size(), alone.piece_count()) << where;
      ASSERT_NEAR(mixed.measure(3), 0.006, 0.006 * kRoundOff) << where;
      ASSERT_NEAR(mixed.measure(2), skin, skin * kRoundOff) << where;
      ASSERT_NEAR(mixed.measure(1), 0.3, 0.3 * kRoundOff) << where;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, MixedCutTest, testing::Values(CellType::tetra, CellType::hexahedron),
                         [](const auto& type) { return std::string(tissu::info(type.param).name); });

/// One tetrahedron, and a line that stands on its node 3.
TEST(ThinOnVolumeTest, ABladeBetweenAVolumeAndALineOnItPartsThem) {
  Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2}, {}};
  mesh.blocks = {{CellType::tetra, {0, 1, 2, 3}}, {CellType::line, {3, 4}}};
  const Vec3 low(-1, -1, -1);
  const Vec3 high(2, 2, 3);
  for (const double height : {0.5, 1.0, 1.5}) {
    MixedBody body(mesh);
    ASSERT_EQ(pieces(body.hosts, body.material).size(), 1U);
    const CutPlan plan = body.cut(plane_sweep({0, 0, height}, {0, 0, 1}, low, high));
    const std::vector<Piece> found = pieces(body.hosts, body.material);
    ASSERT_EQ(found.size(), 2U) << height;
    const double line = height < 1.0 ? 1.0 + 1.0 / 48.0 : height > 1.0 ? 0.5 : 1.0;
    EXPECT_NEAR(std::min(std::abs(found[0].volume - line), std::abs(found[1].volume - line)), 0.0, 1e-12);
    EXPECT_EQ(plan.faces_opened, 1) << height;
  }
}

}  // namespace
}  // namespace tissu
