#include "tissu/edit/world_editor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../force/room.h"
#include "../world/sample_worlds.h"
#include "tissu/edit/cut_body.h"
#include "tissu/edit/remove_cells.h"
#include "tissu/edit/topology.h"

/// Edits in place against the same world laid anew: by the bits of everything that a step reads.
namespace tissu {
namespace {

struct EditedBox {
  const char* name;
  Split split;
  const char* law;
  bool parameters_of_cells;
  bool divide = false;
};
void PrintTo(const EditedBox& c, std::ostream* out) { *out << c.name; }

WorldDescription description(const EditedBox& c) {
  const Mesh mesh = test::distorted_box({7, 6, 5}, c.split, 0.1);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = c.law})};
  BodyDescription& body = world.bodies[0];
  body.room = 4000;
  if (c.parameters_of_cells) {
    ElasticBlock& block = body.elastic[0];
    const auto cells = static_cast<std::size_t>(mesh.blocks[0].size());
    for (auto& [name, values] : block.parameters) {
      values.assign(cells, values.front());
      for (std::size_t e = 0; e < cells; ++e) values[e] *= 1.0 + 0.1 * std::sin(static_cast<double>(e));
    }
    body.rayleigh = RayleighDamping{.mass = 2.0, .stiffness = 1e-3};
    world.consistent_weight = true;
    block.density.assign(cells, block.density.front());
    for (std::size_t e = 0; e < cells; ++e) block.density[e] *= 1.0 + 0.1 * std::cos(static_cast<double>(e));
  }
  world.gravity = Vec3(0.0, 0.0, -9.81);
  world.editable = true;
  return world;
}

/// A state of the world that differs from row to row, alike at copies.
State shaken(const World& world) {
  State state = world.rest_state();
  for (std::int32_t row = 0; row < world.blocks(); ++row) {
    const Vec3 X = block(ConstReals(world.rest_positions()), row);
    block(Reals(state.positions), row) =
        X + 0.02 * Vec3(std::sin(9.0 * X.y()), std::sin(7.0 * X.z()), std::cos(8.0 * X.x()));
    block(Reals(state.velocities), row) = Vec3(X.z(), -X.x(), X.y() * X.x());
  }
  return state;
}

Sweep disc(std::mt19937_64& random, const World& world) {
  Eigen::AlignedBox3d box;
  for (std::int32_t row = 0; row < world.blocks(); ++row)
    box.extend(Vec3(block(ConstReals(world.rest_positions()), row)));
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const Vec3 center = box.min() + Vec3(real(0, 1), real(0, 1), real(0, 1)).cwiseProduct(box.sizes());
  return disc_sweep(center, Vec3(real(-1, 1), real(-1, 1), real(-1, 1)),
                    real(0.15, 0.8) * box.sizes().maxCoeff());
}

std::vector<double> forces(const World& world, const State& state) {
  std::vector<double> f(state.positions.size(), 0.0);
  for (const auto& model : world.forces()) model->add_force(state, test::scratch(), f);
  return f;
}

double energy(const World& world, const State& state) {
  double sum = 0.0;
  for (const auto& model : world.forces()) sum += model->energy(state, test::scratch());
  return sum;
}

std::vector<double> matrix_product(const World& world, const State& state) {
  BlockMatrix matrix(world.sparsity(), world.isa(), world.threads());
  for (const auto& model : world.forces()) model->add_stiffness(state, test::scratch(), {-1.0, 0.0}, matrix);
  matrix.constrain(world.fixed().rows(), world.fixed().masks());
  std::vector<double> out(state.positions.size(), 0.0);
  matrix.multiply(state.velocities, out);
  return out;
}

std::vector<std::vector<std::int32_t>> columns(const Sparsity& pattern) {
  std::vector<std::vector<std::int32_t>> rows;
  for (std::int32_t row = 0; row < pattern.rows(); ++row) {
    rows.emplace_back(pattern.column.begin() + pattern.begin_of(row),
                      pattern.column.begin() + pattern.end_of(row));
  }
  return rows;
}

void expect_same(const World& found, const World& expected) {
  const State state = shaken(expected);
  EXPECT_EQ(found.rest_positions(), expected.rest_positions());
  EXPECT_EQ(found.body("body").node_count, expected.body("body").node_count);
  EXPECT_EQ(found.mass().nodal(), expected.mass().nodal());
  EXPECT_EQ(found.fixed().rows(), expected.fixed().rows());
  EXPECT_EQ(found.fixed().masks(), expected.fixed().masks());
  EXPECT_EQ(columns(found.sparsity()), columns(expected.sparsity()));
  EXPECT_EQ(forces(found, state), forces(expected, state));
  EXPECT_EQ(energy(found, state), energy(expected, state));
  EXPECT_EQ(matrix_product(found, state), matrix_product(expected, state));
}

void expect_same_pieces(const std::vector<Piece>& found, const std::vector<Piece>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  double whole = 0.0;
  for (const Piece& piece : expected) whole += piece.volume;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].cells, expected[i].cells);
    EXPECT_NEAR(found[i].volume, expected[i].volume, 1e-12 * whole);  // sums of some thousand terms
  }
}

class WorldEdited : public testing::TestWithParam<EditedBox> {};

/// Twelve cuts and ablations in a row, each against the description laid anew, and the first ones against a
/// world made by the other way.
TEST_P(WorldEdited, IsTheWorldLaidAnew) {
  const auto first_day = std::make_shared<const World>(description(GetParam()));
  WorldEditor editor(first_day);
  std::shared_ptr<const World> other = first_day;
  std::mt19937_64 random(11);
  int made = 0;
  for (int k = 0; k < 12; ++k) {
    const World& world = *editor.world();
    const State state = shaken(world);
    CutPlan plan;
    if (k % 4 == 3) {
      const std::vector<std::int32_t> cells = remaining_cells(world, "body");
      plan =
          plan_body_ablation(world, "body", {cells[random() % cells.size()], cells[random() % cells.size()]});
    } else {
      CutOptions options;
      options.divide = GetParam().divide;
      plan = plan_body_cut(world, state, "body", disc(random, world), options);
    }
    if (!changes(plan)) continue;
    if (made < 3) other = cut_world(*other, state, "body", plan).world;
    std::vector<std::int32_t> born;
    for (const BornCell& cell : plan.born) born.push_back(cell.number);
    const auto edited = editor.cut("body", plan, state);
    ASSERT_TRUE(edited);
    ++made;
    expect_same(*editor.world(), *laid_anew(*editor.world()));
    if (made <= 3) expect_same(*editor.world(), *other);
    const auto cut = cut_state(*editor.world(), "body");
    expect_same_pieces(editor.pieces("body"), pieces(cut->hosts, cut->material));
    if (k % 4 == 3) continue;
    const State after = shaken(*editor.world());
    const BodyTotals now = editor.totals("body", born, edited->rows, after);
    EXPECT_NEAR(now.volume, edited->before.volume, 1e-12 * (1.0 + now.volume));
    EXPECT_NEAR(now.mass, edited->before.mass, 1e-12 * now.mass);
    if (GetParam().divide) continue;  // the state is not that between the nodes before
    EXPECT_NEAR(now.elastic, edited->before.elastic, 1e-10 * now.elastic);
    EXPECT_NEAR(now.kinetic, edited->before.kinetic, 1e-10 * now.kinetic);
  }
  EXPECT_GT(made, 8);
}

/// Takes cells out a few at a time, until nodes come loose.
TEST_P(WorldEdited, WithoutCellsIsTheWorldLaidAnew) {
  const auto first_day = std::make_shared<const World>(description(GetParam()));
  WorldEditor editor(first_day);
  std::mt19937_64 random(5);
  for (int k = 0; k < 6; ++k) {
    std::vector<std::int32_t> cells = remaining_cells(*editor.world(), "body");
    std::ranges::sort(cells);
    const auto some = static_cast<std::ptrdiff_t>(cells.size() / 8);
    const auto begin = static_cast<std::ptrdiff_t>(random() % (7 * cells.size() / 8));
    const std::vector<std::int32_t> gone(cells.begin() + begin, cells.begin() + begin + some);
    ASSERT_TRUE(editor.remove("body", gone, shaken(*editor.world())));
    expect_same(*editor.world(), *laid_anew(*editor.world()));
    const auto cut = cut_state(*editor.world(), "body");
    expect_same_pieces(editor.pieces("body"), pieces(cut->hosts, cut->material));
  }
  EXPECT_THROW((void)editor.remove("body", std::vector<std::int32_t>{100000}, shaken(*editor.world())),
               ParameterError);
}

INSTANTIATE_TEST_SUITE_P(Meshes, WorldEdited,
                         testing::Values(EditedBox{"tetra", Split::six, "stvk", false},
                                         EditedBox{"tetra_divided", Split::six, "stvk", false, true},
                                         EditedBox{"tetra_of_many_laws", Split::six, "neo_hooke", true},
                                         EditedBox{"hexahedron", Split::none, "stvk", false}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Half of the body is held by supports, one of which has a name, and a part of it is loaded.
WorldDescription held_and_loaded() {
  WorldDescription held = description({"", Split::six, "stvk", false});
  const auto count = static_cast<std::int32_t>(held.bodies[0].positions.size() / 3);
  for (const char* name : {"", "grip"}) {
    FixedNodes& fixed = held.fixed.emplace_back();
    fixed.body = "body";
    fixed.name = name;
  }
  LoadDescription& load = held.loads.emplace_back();
  load.name = "push";
  load.body = "body";
  for (std::int32_t node = 0; node < count; ++node) {
    if (node % 8 < 4) held.fixed[node < count / 2 ? 0 : 1].nodes.push_back(node);
    if (node % 8 > 5) load.nodes.push_back(node);
  }
  for (std::size_t i = 0; i < load.nodes.size(); ++i)
    load.forces.insert(load.forces.end(), {1.0, 0.1 * static_cast<double>(i), -0.7});
  return held;
}

/// Whether a node that is held or loaded has copies.
bool has_parted(const World& world) {
  const WorldDescription& all = *world.description();
  const std::vector<std::int32_t>& copies = all.bodies[0].copies_of;
  const auto is_root = [&](std::int32_t node) { return std::ranges::find(copies, node) != copies.end(); };
  return std::ranges::any_of(all.fixed[1].first_day, is_root) &&
         std::ranges::any_of(all.loads[0].first_day, is_root);
}

double force_of(const LoadDescription& load, std::size_t axis) {
  double sum = 0.0;
  for (std::size_t i = axis; i < load.forces.size(); i += 3) sum += load.forces[i];
  return sum;
}

/// Whether every node that bears a load has a cell.
bool all_have_cells(const World& world, const LoadDescription& load) {
  const Body& body = world.body(load.body);
  std::vector<char> has_cell(static_cast<std::size_t>(body.node_count), 0);
  for (const BodyModel* model : body.models) {
    for (const std::int32_t node : model->block().cells) {
      has_cell[static_cast<std::size_t>(node - body.first_node)] = 1;
    }
  }
  for (std::size_t i = 0; i < load.nodes.size(); ++i) {
    const Vec3 force(load.forces[3 * i], load.forces[3 * i + 1], load.forces[3 * i + 2]);
    if (!force.isZero(0.0) && has_cell[static_cast<std::size_t>(load.nodes[i])] == 0) return false;
  }
  return true;
}

/// Held and loaded nodes part, lose their material and come loose; each time against the description laid
/// anew, and against a world made by the other way, in which the edits were the same.
TEST(WorldEditor, HeldAndLoadedNodesPart) {
  for (const bool divide : {false, true}) {
    const auto first_day = std::make_shared<const World>(held_and_loaded());
    WorldEditor editor(first_day);
    std::shared_ptr<const World> other = first_day;
    std::mt19937_64 random(3);
    CutOptions options;
    options.divide = divide;
    for (int k = 0; k < 10; ++k) {
      const World& world = *editor.world();
      const State state = shaken(world);
      const LoadDescription before = world.description()->loads[0];
      const bool removes = k % 3 == 2;
      if (removes) {
        std::vector<std::int32_t> cells = remaining_cells(world, "body");
        std::ranges::sort(cells);
        const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(random() % (cells.size() / 2));
        const std::vector<std::int32_t> gone(begin, begin + static_cast<std::ptrdiff_t>(cells.size() / 8));
        other = remove_cells(*other, state, "body", gone);
        ASSERT_TRUE(editor.remove("body", gone, state));
      } else {
        const CutPlan plan = plan_body_cut(world, state, "body", disc(random, world), options);
        if (!changes(plan)) continue;
        other = cut_world(*other, state, "body", plan).world;
        ASSERT_TRUE(editor.cut("body", plan, state));
      }
      expect_same(world, *laid_anew(world));
      expect_same(world, *other);
      EXPECT_EQ(world.description()->loads[0].forces, other->description()->loads[0].forces);
      // A cut takes nothing from the sum; a removal what stood on nodes that have no cell any more.
      const LoadDescription& after = world.description()->loads[0];
      EXPECT_TRUE(all_have_cells(world, after));
      for (std::size_t axis = 0; axis < 3 && !removes; ++axis) {
        const double all = force_of(before, axis);
        EXPECT_NEAR(force_of(after, axis), all, 1e-12 * std::abs(all));
      }
      ASSERT_FALSE(testing::Test::HasFailure()) << k << divide;
    }
    EXPECT_TRUE(has_parted(*editor.world()));
  }
}

/// While a run leads a support, or changed a load, an edit that parts its nodes is left to the way that
/// refuses it with the reason.
TEST(WorldEditor, LeavesSupportsThatAreLedLiveAlone) {
  WorldEditor editor(std::make_shared<const World>(held_and_loaded()));
  const World& world = *editor.world();
  State state = shaken(world);
  world.fixed().lead_to("grip", Pose{}, 1.0, state);
  std::mt19937_64 random(3);
  const CutPlan plan = plan_body_cut(world, state, "body", disc(random, world));
  ASSERT_TRUE(changes(plan));
  EXPECT_FALSE(editor.cut("body", plan, state));
  expect_same(world, *laid_anew(world));
}

TEST(WorldEditor, ServesModelsThatFollow) {
  WorldDescription world = description({"", Split::six, "hooke", false});
  EXPECT_TRUE(WorldEditor::serves(World(world)));
  world.bodies[0].elastic[0].model = CorotationalOptions{};
  EXPECT_FALSE(WorldEditor::serves(World(world)));
  world.editable = false;
  EXPECT_FALSE(WorldEditor::serves(World(world)));
}

}  // namespace
}  // namespace tissu
