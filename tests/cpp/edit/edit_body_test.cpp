#include "tissu/edit/edit_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../force/room.h"
#include "../world/sample_worlds.h"
#include "tissu/edit/body_totals.h"
#include "tissu/edit/topology.h"

/// Cells that hold a share of their volume, copies of nodes, and what is refused.
namespace tissu {
namespace {

/// Sums of some hundred terms.
constexpr double kRoundOff = 1e-13;

struct ShareCase {
  const char* name;
  ModelOptions model;
  Split split;
  const char* law;
};
void PrintTo(const ShareCase& c, std::ostream* out) { *out << c.name; }

WorldDescription box(const ShareCase& c, double share) {
  const Mesh mesh = test::distorted_box({2, 1, 1}, c.split, 0.05);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = c.law})};
  for (ElasticBlock& block : world.bodies[0].elastic) {
    block.model = c.model;
    block.share = {share};
  }
  return world;
}

State shaken(const World& world) {
  State state = world.rest_state();
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    state.positions[i] += 0.04 * std::sin(3.0 * static_cast<double>(i));
    state.velocities[i] = std::cos(2.0 * static_cast<double>(i));
  }
  return state;
}

class Share : public testing::TestWithParam<ShareCase> {};

/// Every integral over a cell is multiplied by its share, and no mean is.
TEST_P(Share, MultipliesIntegralsOnly) {
  constexpr double kShare = 0.3;
  const World whole(box(GetParam(), 1.0));
  const World part(box(GetParam(), kShare));
  const State state = shaken(whole);
  const BodyTotals all = totals(whole, state, "body");
  const BodyTotals some = totals(part, state, "body");
  EXPECT_NEAR(some.volume, kShare * all.volume, kRoundOff * all.volume);
  EXPECT_NEAR(some.mass, kShare * all.mass, kRoundOff * all.mass);
  EXPECT_NEAR(some.kinetic, kShare * all.kinetic, kRoundOff * all.kinetic);
  EXPECT_GT(all.elastic, 0.0);
  EXPECT_NEAR(some.elastic, kShare * all.elastic, kRoundOff * all.elastic);
  std::vector<double> f(state.positions.size(), 0.0);
  std::vector<double> g = f;
  for (const auto& model : whole.forces()) model->add_force(state, test::scratch(), f);
  for (const auto& model : part.forces()) model->add_force(state, test::scratch(), g);
  const double largest = std::abs(*std::ranges::max_element(f, {}, [](double v) { return std::abs(v); }));
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(g[i], kShare * f[i], 1e-12 * largest);
  const CellFields mean = whole.body("body").models.front()->fields(state);
  const CellFields same = part.body("body").models.front()->fields(state);
  for (std::size_t e = 0; e < mean.volume_ratio.size(); ++e) {
    EXPECT_NEAR(same.volume_ratio[e], mean.volume_ratio[e], 1e-12);
    EXPECT_NEAR(same.energy_density[e], mean.energy_density[e], 1e-12 * all.elastic / all.volume);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Models, Share,
    testing::Values(ShareCase{"fem_tetra", FemOptions{}, Split::six, "stvk"},
                    ShareCase{"fem_hexahedron", FemOptions{}, Split::none, "neo_hooke"},
                    ShareCase{"corotational", CorotationalOptions{}, Split::six, "hooke"},
                    ShareCase{"mean_dilatation", MeanDilatationOptions{}, Split::none, "stvk"},
                    ShareCase{"mass_link", MassLinkOptions{}, Split::six, "stvk"},
                    ShareCase{"mass_link_neo", MassLinkOptions{}, Split::six, "neo_hooke"},
                    ShareCase{"mass_tensor", MassTensorOptions{}, Split::six, "hooke"},
                    ShareCase{"mass_spring", MassSpringOptions{}, Split::six, "hooke"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(ShareOfMaterial, IsAboveZeroAndAtMostOne) {
  for (const double share : {0.0, -0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(World(box({"", FemOptions{}, Split::six, "stvk"}, share)), ParameterError) << share;
  }
}

/// Two hexahedra side by side, with room for the four nodes that they share.
struct Pair {
  Pair() {
    const Mesh mesh = test::distorted_box({2, 1, 1}, Split::none, 0.0);
    world.bodies = {test::body_of(mesh)};
    world.bodies[0].room = 4;
    world.editable = true;
    const auto first = mesh.blocks[0].cell(0);
    const auto second = mesh.blocks[0].cell(1);
    nodes.assign(second.begin(), second.end());
    const auto count = static_cast<std::int32_t>(mesh.node_count());
    for (std::int32_t& node : nodes) {
      if (std::ranges::find(first, node) == first.end()) continue;
      edit.copied.push_back(node);
      node = count + static_cast<std::int32_t>(edit.copied.size()) - 1;
    }
    edit.moved = {{1, nodes}};
  }
  WorldDescription world;
  std::vector<std::int32_t> nodes;
  BodyEdit edit;
};

TEST(EditBody, PartsNodesAndKeepsMassAndRows) {
  Pair pair;
  pair.world.loads = {{"pull", "body", pair.edit.copied, std::vector<double>(12, 1.0), {}}};
  const World before(pair.world);
  const auto after = edit_body(before, before.rest_state(), "body", pair.edit);
  EXPECT_EQ(after->blocks(), before.blocks());
  EXPECT_EQ(after->body("body").node_count, before.body("body").node_count + 4);
  EXPECT_EQ(after->body("body").room, 0);
  EXPECT_NEAR(after->mass().total(), before.mass().total(), kRoundOff * before.mass().total());
  std::vector<double> f(before.rest_positions().size(), 0.0);
  for (const auto& model : after->forces()) {
    if (model->kind() == ForceKind::external) model->add_force(after->rest_state(), test::scratch(), f);
  }
  for (const RowCopy copy : rows_born(before, "body", pair.edit).copies) {
    EXPECT_NEAR(block(ConstReals(f), copy.to).x(), 0.5, 1e-12);  // both cells are alike
    EXPECT_NEAR(block(ConstReals(f), copy.from).x(), 0.5, 1e-12);
  }
}

TEST(EditBody, RefusesMoreNodesThanThereIsRoomFor) {
  Pair pair;
  pair.world.bodies[0].room = 3;
  const World before(pair.world);
  EXPECT_THROW(edit_body(before, before.rest_state(), "body", pair.edit), ParameterError);
}

TEST(EditBody, RefusesCellsThatAreNotThere) {
  Pair pair;
  pair.edit.gone = {7};
  const World before(pair.world);
  EXPECT_THROW(edit_body(before, before.rest_state(), "body", pair.edit), ParameterError);
}

TEST(PackedMaterial, RefusesListsThatDoNotFit) {
  Material material;
  material.riders.push_back({{0, 1, -1, -1}, {0.5, 0.5, 0, 0}, 2});
  material.cells[3] = {{{0, 1, 2, -1}, 1}};
  material.incisions = {{0, {-1, 2}, {2}}};
  const PackedMaterial packed = pack(material);
  const Material back = unpack(packed, 4);
  EXPECT_EQ(back.cells.at(3)[0].vertices, material.cells.at(3)[0].vertices);
  EXPECT_EQ(back.riders[0].weight, material.riders[0].weight);
  EXPECT_EQ(back.incisions[0].vertices, material.incisions[0].vertices);
  EXPECT_EQ(back.incisions[0].front, material.incisions[0].front);
  const auto broken = [&](auto&& damage) {
    PackedMaterial other = packed;
    damage(other);
    EXPECT_THROW((void)unpack(other, 4), ParameterError);
  };
  EXPECT_THROW((void)unpack(packed, 2), ParameterError);
  broken([](PackedMaterial& p) { p.rider_nodes[0] = 9; });
  broken([](PackedMaterial& p) { p.vertices[0] = -2; });
  broken([](PackedMaterial& p) { p.vertices.pop_back(); });
  broken([](PackedMaterial& p) { p.at_front.pop_back(); });
  broken([](PackedMaterial& p) { p.first.back() = 2; });
  broken([](PackedMaterial& p) { p.on_incision[0] = 4; });
  broken([](PackedMaterial& p) { p.first_of_incision.clear(); });
}

}  // namespace
}  // namespace tissu
