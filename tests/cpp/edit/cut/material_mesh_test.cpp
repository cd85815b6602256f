#include "tissu/edit/cut/material_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "cut_body.h"
#include "edit/cut/near.h"
#include "tissu/base/error.h"
#include "tissu/base/index.h"
#include "tissu/edit/cut/piece_table.h"
#include "tissu/mesh/quality.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

/// The material's cells at rest as a mesh of their own.
Mesh at_rest(const test::CutBody& body) {
  const MaterialMesh material = material_mesh(body.hosts, body.material);
  Mesh mesh{{}, material.blocks};
  for (const Rider& vertex : material.vertices) {
    const Vec3 p = vertex.at(body.hosts.rest());
    mesh.positions.insert(mesh.positions.end(), p.data(), p.data() + 3);
  }
  return mesh;
}

class MaterialMeshTest : public testing::TestWithParam<CellType> {};

TEST_P(MaterialMeshTest, OfAnUncutBodyItIsTheBody) {
  const Mesh mesh = test::typed_box(GetParam(), Vec3(3, 1, 1), {3, 2, 2}, 0.0, 1);
  const test::CutBody body(mesh);
  const MaterialMesh material = material_mesh(body.hosts, body.material);
  ASSERT_EQ(material.blocks.size(), 1U);
  EXPECT_EQ(material.blocks[0].type, GetParam());
  EXPECT_EQ(material.vertices.size(), at(mesh.node_count()));
  EXPECT_TRUE(std::ranges::none_of(material.vertex_node, [](std::int32_t node) { return node < 0; }));
  const MaterialSurface surface = material_surface(body.hosts, body.material);
  EXPECT_TRUE(std::ranges::none_of(surface.cut, [](char cut) { return cut != 0; }));
  if (info(GetParam()).order == 1) {
    const Surface whole = boundary_surface(mesh);  // quads in two
    EXPECT_EQ(surface.triangles.size(), whole.triangles.size() + 2 * whole.quads.size());
  }
}

/// Cut across at x = 1.1, off the grid; straight edges at rest, so that volumes are those of boxes.
TEST_P(MaterialMeshTest, VolumesAreThoseOfBothParts) {
  test::CutBody body(test::typed_box(GetParam(), Vec3(3, 1, 1), {3, 2, 2}, 0.0, 1));
  body.cut(body.plane(Vec3(1.1, 0, 0), Vec3(1, 0, 0)), {0.0, false});
  const std::vector<Piece> both = pieces(body.hosts, body.material);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_NEAR(std::min(both[0].volume, both[1].volume), 1.1, 1e-13);
  EXPECT_NEAR(std::max(both[0].volume, both[1].volume), 1.9, 1e-13);
  const Mesh mesh = at_rest(body);
  const std::vector<double> all = volumes(mesh);
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 3.0, 1e-13);
  EXPECT_GT(*std::ranges::min_element(all), 0.0);
  if (GetParam() == CellType::tetra) {  // else quads of uncut cells meet two triangles of cut ones
    EXPECT_EQ(nonconforming_faces(mesh).count, 0);
    EXPECT_EQ(overfull_face_count(mesh), 0);
  }
}

TEST_P(MaterialMeshTest, OpenedFacesLieOnTheBlade) {
  test::CutBody body(test::typed_box(GetParam(), Vec3(3, 1, 1), {3, 2, 2}, 0.15, 2));
  const Vec3 point(1.3, 0.5, 0.5);
  const Vec3 normal = Vec3(1, 0.3, -0.2).normalized();
  body.cut(body.plane(point, normal), {0.0, false});
  const MaterialSurface surface = material_surface(body.hosts, body.material);
  int opened = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    EXPECT_TRUE(body.hosts.has(surface.cell[t]));
    if (surface.cut[t] == 0) continue;
    ++opened;
    for (const std::int32_t v : surface.triangles[t]) {
      EXPECT_NEAR((surface.vertices[at(v)].at(body.x) - point).dot(normal), 0.0, 1e-14);
    }
  }
  EXPECT_GT(opened, 20);
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    if (surface.vertex_node[v] < 0) continue;
    EXPECT_EQ(surface.vertices[v].node[0], surface.vertex_node[v]);
  }
}

/// Hosts from a list, as a file keeps them, go on with the same bits.
TEST_P(MaterialMeshTest, HostsFromAListPlanTheSameNextCut) {
  test::CutBody body(test::typed_box(GetParam(), Vec3(3, 1, 1), {3, 2, 2}, 0.15, 2));
  body.cut(body.plane(Vec3(1.3, 0.5, 0.5), Vec3(1, 0.3, -0.2)));
  std::vector<Hosts::Cell> cells;
  std::vector<std::int32_t> roots;
  for (const std::int32_t cell : body.hosts.numbers()) {
    const auto nodes = body.hosts.nodes(cell);
    cells.push_back({cell,
                     body.hosts.type(cell),
                     body.hosts.origin(cell),
                     body.hosts.share(cell),
                     {nodes.begin(), nodes.end()}});
  }
  for (std::int32_t n = 0; n < body.hosts.node_count(); ++n) roots.push_back(body.hosts.root(n));
  const auto rest = body.hosts.rest();
  const Hosts other({rest.begin(), rest.end()}, roots, cells, body.hosts.next_cell());
  const Sweep sweep = body.plane(Vec3(1.3, 0.5, 0.5), Vec3(0.2, 1, 0.4));
  const CutPlan plan = plan_cut(body.hosts, body.material, body.x, sweep);
  const CutPlan same = plan_cut(other, body.material, body.x, sweep);
  EXPECT_EQ(plan.gone, same.gone);
  EXPECT_EQ(plan.area, same.area);
  ASSERT_EQ(plan.born.size(), same.born.size());
  for (std::size_t i = 0; i < plan.born.size(); ++i) {
    EXPECT_EQ(plan.born[i].nodes, same.born[i].nodes);
    EXPECT_EQ(plan.born[i].share, same.born[i].share);
  }
  cells.back().number = cells.front().number;
  EXPECT_THROW(Hosts({rest.begin(), rest.end()}, roots, cells, body.hosts.next_cell()), ParameterError);
}

INSTANTIATE_TEST_SUITE_P(EveryType, MaterialMeshTest,
                         testing::Values(CellType::tetra, CellType::hexahedron, CellType::wedge,
                                         CellType::pyramid, CellType::tetra10, CellType::hexahedron20,
                                         CellType::hexahedron27, CellType::wedge15, CellType::pyramid13));

TEST(CutRefusalTest, OptionsAndPlacesOutOfRangeChangeNothing) {
  test::CutBody body(test::typed_box(CellType::tetra, Vec3(3, 1, 1), {3, 2, 2}, 0.0, 1));
  const Sweep sweep = body.plane(Vec3(1.3, 0.5, 0.5), Vec3(0.2, 1, 0.4));
  EXPECT_THROW(plan_cut(body.hosts, body.material, body.x, sweep, {0.5, false}), ParameterError);
  EXPECT_THROW(plan_cut(body.hosts, body.material, body.x, sweep, {-0.1, false}), ParameterError);
  std::vector<double> x = body.x;
  x.pop_back();
  EXPECT_THROW(plan_cut(body.hosts, body.material, x, sweep), ParameterError);
  x = body.x;
  x[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plan_cut(body.hosts, body.material, x, sweep), ParameterError);
  EXPECT_THROW(plan_ablation(body.hosts, body.material, {100000}), ParameterError);
}

/// A box whose top is pushed through its bottom has no volume to divide: the blade says so.
TEST(CutRefusalTest, ACellInsideOutIsReportedAndStaysWhole) {
  Mesh mesh = test::typed_box(CellType::hexahedron, Vec3(1, 1, 1), {1, 1, 1}, 0.0, 1);
  mesh.positions[3 * 7 + 2] = -0.5;
  test::CutBody body(mesh);
  const CutPlan plan =
      plan_cut(body.hosts, body.material, body.x, body.plane(Vec3(0.4, 0, 0), Vec3(1, 0, 0)));
  EXPECT_TRUE(plan.born.empty());
  ASSERT_EQ(plan.unresolved.size(), 1U);
  EXPECT_EQ(plan.unresolved[0].second, Unresolved::shape);
}

/// A body of one type that was cut and from which cells were taken, each time by `edit(plan, make)`: `make`
/// applies the plan.
template <class Edit>
void edit_some(CellType type, bool divide, std::uint64_t seed, Edit&& edit) {
  std::mt19937_64 random(seed);
  test::CutBody body(test::typed_box(type, Vec3(1, 1, 1), {4, 3, 3}, 0.2, seed));
  CutOptions options;
  options.divide = divide;
  if (divide) options.t0 = 0.2;
  for (int k = 0; k < 8; ++k) {
    if (k % 4 == 3) {
      const std::vector<std::int32_t> all = body.hosts.numbers();
      const std::vector<std::int32_t> gone = {all[random() % all.size()]};
      edit(body, plan_ablation(body.hosts, body.material, gone), [&] { body.ablate(gone); });
    } else {
      const Sweep sweep = test::random_sweep(random, body);
      edit(body, plan_cut(body.hosts, body.material, body.x, sweep, options),
           [&] { body.cut(sweep, options); });
    }
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << ", edit " << k;
  }
}

class EditedTest : public testing::TestWithParam<std::pair<CellType, bool>> {};

TEST_P(EditedTest, PiecesThatAreFollowedAreThoseLookedForAnew) {
  const auto [type, divide] = GetParam();
  std::size_t most = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::optional<PieceTable> table;
    edit_some(type, divide, seed, [&](const test::CutBody& body, const CutPlan& plan, const auto& make) {
      if (!table) table.emplace(body.hosts, body.material);
      table->begin(body.hosts, plan);
      make();
      table->end(body.hosts, body.material, plan);
      const std::vector<Piece> found = table->list(body.hosts, body.material);
      const std::vector<Piece> expected = pieces(body.hosts, body.material);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].cells, expected[i].cells);
        EXPECT_NEAR(found[i].volume, expected[i].volume, 1e-13);  // round-off of sums of parts of 1
      }
      most = std::max(most, found.size());
    });
  }
  EXPECT_GT(most, 2U);
}

/// A cell has every vertex of its material between nodes of its own.
TEST_P(EditedTest, MaterialRidesOnTheNodesOfItsCell) {
  const auto [type, divide] = GetParam();
  for (std::uint64_t seed = 20; seed < 32; ++seed) {
    edit_some(type, divide, seed, [&](const test::CutBody& body, const CutPlan&, const auto& make) {
      make();
      for (const auto& [cell, list] : body.material.cells) {
        const auto nodes = body.hosts.nodes(cell);
        const auto has = [&](std::int32_t node) { return std::ranges::find(nodes, node) != nodes.end(); };
        for (const MaterialTetra& tetra : list) {
          for (const std::int32_t v : tetra.vertices) {
            if (v >= 0) {
              EXPECT_TRUE(has(v));
              continue;
            }
            const Rider& rider = body.material.riders[at(-1 - v)];
            for (std::size_t i = 0; i < at(rider.count); ++i) EXPECT_TRUE(has(rider.node[i]));
          }
        }
      }
    });
  }
}

TEST_P(EditedTest, HostsOverOthersAreACopyOfThem) {
  const auto [type, divide] = GetParam();
  for (std::uint64_t seed = 40; seed < 46; ++seed) {
    edit_some(type, divide, seed, [&](const test::CutBody& body, const CutPlan& plan, const auto& make) {
      Hosts over = Hosts::over(body.hosts);
      over.apply(plan);
      const Hosts before = body.hosts;
      const auto expect_same = [](const Hosts& found, const Hosts& expected) {
        ASSERT_EQ(found.numbers(), expected.numbers());
        ASSERT_EQ(found.node_count(), expected.node_count());
        EXPECT_TRUE(std::ranges::equal(found.rest(), expected.rest()));
        for (const std::int32_t cell : expected.numbers()) {
          EXPECT_TRUE(std::ranges::equal(found.nodes(cell), expected.nodes(cell)));
          EXPECT_EQ(found.origin(cell), expected.origin(cell));
          EXPECT_EQ(found.share(cell), expected.share(cell));
        }
        for (std::int32_t node = 0; node < expected.node_count(); ++node) {
          EXPECT_TRUE(std::ranges::equal(found.cells_at(node), expected.cells_at(node)));
          EXPECT_EQ(found.root(node), expected.root(node));
        }
      };
      Hosts applied = body.hosts;
      applied.apply(plan);
      expect_same(over, applied);
      expect_same(body.hosts, before);
      make();
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Some, EditedTest,
                         testing::Values(std::pair(CellType::tetra, false), std::pair(CellType::tetra, true),
                                         std::pair(CellType::hexahedron, false),
                                         std::pair(CellType::tetra10, false)));

/// The cells near a blade are those of a body that rests in its present places.
TEST(NearCellsTest, BodiesThatMovedFarAndBentHaveTheSame) {
  std::mt19937_64 random(7);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::size_t found = 0;
  for (int k = 0; k < 40; ++k) {
    test::CutBody body(test::typed_box(CellType::tetra, Vec3(4, 1, 1), {24, 6, 6}, 0.2, 3));
    const Vec3 way(real(-50, 50), real(-50, 50), real(-50, 50));
    const Mat3 turn = Eigen::AngleAxisd(real(0, 3), Vec3(1, real(-1, 1), 0.5).normalized()).matrix();
    const double bend = real(-0.3, 0.3);
    body.move([&](const Vec3& X) -> Vec3 { return way + turn * (X + bend * Vec3(0, X[0] * X[0], X[0])); });
    const Hosts hosts = body.hosts;
    std::vector<Hosts::Cell> cells;
    for (const std::int32_t cell : hosts.numbers())
      cells.push_back(
          {cell, CellType::tetra, cell, 1.0, {hosts.nodes(cell).begin(), hosts.nodes(cell).end()}});
    std::vector<std::int32_t> roots(at(hosts.node_count()));
    std::iota(roots.begin(), roots.end(), 0);
    const Hosts resting(body.x, roots, cells, hosts.next_cell());
    const std::int32_t middle = hosts.node_count() / 2 + k;
    const Sweep disc = disc_sweep(block(ConstReals(body.x), middle), Vec3(1, real(-1, 1), 0), 0.4);
    const NearCells near(hosts, body.x, disc.parts[0]);
    EXPECT_EQ(near.cells(), NearCells(resting, body.x, disc.parts[0]).cells());
    found += near.cells().size();
  }
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace tissu
