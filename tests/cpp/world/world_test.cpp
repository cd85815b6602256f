#include "tissu/world/world.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numeric>

#include "sample_worlds.h"

/// What a description becomes, and what is refused before the first step.
namespace tissu {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class WorldTest : public testing::Test {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}, Split::six);
  WorldDescription description_ = [this] {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_)};
    return world;
  }();

  void expect_refused(const char* what) const { EXPECT_THROW(World{description_}, Error) << what; }
};

TEST_F(WorldTest, NumbersNodesBodyAfterBody) {
  description_.bodies.push_back(test::body_of(mesh_, {.density = 5.0}, "second"));
  description_.frames.emplace_back();
  description_.fixed = {test::fixed({3})};
  description_.fixed[0].body = "second";
  const World world(description_);
  const std::int32_t n = mesh_.node_count();
  EXPECT_EQ(world.blocks(), 2 * n + 2);
  EXPECT_EQ(world.body("second").first_node, n);
  EXPECT_EQ(world.body("second").node_count, n);
  EXPECT_EQ(world.frames()[0].block, 2 * n);
  EXPECT_EQ(world.fixed().rows(), std::vector<std::int32_t>{n + 3});
  const auto& m = world.mass().nodal();
  EXPECT_NEAR(std::accumulate(m.begin(), m.begin() + n, 0.0), 4.0, 1e-14);
  EXPECT_NEAR(std::accumulate(m.begin() + n, m.begin() + 2 * n, 0.0), 10.0, 1e-14);
  EXPECT_EQ(world.sparsity().slot(0, n), -1);  // the bodies do not touch
  EXPECT_THROW((void)world.body("third"), ParameterError);
}

/// One body of two kinds of cells: a hexahedron with tetrahedra on top.
TEST_F(WorldTest, HoldsMixedCells) {
  const Mesh hexa = box_mesh(Vec3::Zero(), Vec3(1, 1, 1), {1, 1, 1}, Split::none);
  BodyDescription body = test::body_of(hexa);
  body.positions.insert(body.positions.end(), {0.5, 0.5, 2.0});
  body.elastic.push_back(test::elastic_block({CellType::tetra, {4, 5, 6, 8, 4, 6, 7, 8}}, {}));
  body.elastic.back().density = {6.0};
  description_.bodies = {body};
  description_.bodies[0].elastic[0].cells = {0, 1, 3, 2, 4, 5, 7, 6};
  // box nodes run x, y, z; VTK goes round: tetrahedra over the nodes 4 5 7 6
  description_.bodies[0].elastic[1].cells = {4, 5, 7, 8, 4, 7, 6, 8};
  const World world(description_);
  EXPECT_EQ(world.body("body").models.size(), 2U);
  EXPECT_NEAR(world.mass().total(), 2.0 + 6.0 / 3.0, 1e-14);
}

/// Affine cells and others of one block are worked through apart; each keeps its number in the body.
TEST_F(WorldTest, NumbersCellsThroughBlocksThatAreSplit) {
  Mesh mesh = box_mesh(Vec3::Zero(), Vec3(4, 1, 1), {4, 1, 1}, Split::none);
  for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
    if (mesh.node(i).x() == 2.0 && mesh.node(i).y() == 1.0)
      mesh.positions[3 * static_cast<std::size_t>(i)] += 0.2;
  }
  BodyDescription body = test::body_of(mesh);
  const ElasticBlock all = body.elastic[0];
  body.elastic = {part_of(all, {0}), part_of(all, {1, 2, 3})};
  body.elastic[1].density = {1.0, 2.0, 3.0};
  description_.bodies = {body};
  const World world(description_);
  std::map<std::int32_t, double> density;  // by the number of the cell; the first block has none of its own
  for (const BodyModel* model : world.body("body").models) {
    for (std::size_t i = 0; i < model->block().cell_numbers.size(); ++i) {
      density[model->block().cell_numbers[i]] = model->block().density[i];
    }
  }
  EXPECT_EQ(density, (std::map<std::int32_t, double>{{1, 1.0}, {2, 2.0}, {3, 3.0}}));
  EXPECT_EQ(world.body("body").models.size(), 3U);
}

TEST_F(WorldTest, StartsAtRest) {
  FrameDescription frame;
  frame.position = Vec3(1, 2, 3);
  frame.velocity = Vec3(4, 5, 6);
  frame.angular_velocity = Vec3(7, 8, 9);
  frame.rotation = Quaternion(2.0, 0.0, 0.0, 2.0);  // normalised on entry
  description_.frames = {frame};
  const World world(description_);
  const State state = world.rest_state();
  const std::int32_t block_of = world.frames()[0].block;
  EXPECT_EQ(state.time, 0.0);
  EXPECT_EQ(block(ConstReals(state.positions), block_of), Vec3(1, 2, 3));
  EXPECT_EQ(block(ConstReals(state.velocities), block_of), Vec3(4, 5, 6));
  EXPECT_EQ(block(ConstReals(state.velocities), block_of + 1), Vec3(7, 8, 9));
  EXPECT_NEAR(state.rotations[0].norm(), 1.0, 1e-15);
  EXPECT_EQ(state.blocks(), world.blocks());
}

TEST_F(WorldTest, IsLinearWhenEveryPartIs) {
  EXPECT_FALSE(World(description_).is_linear());
  description_.bodies[0].elastic[0].law = "hooke";
  description_.gravity = Vec3(0, 0, -1);
  EXPECT_TRUE(World(description_).is_linear());
  description_.bodies[0].rayleigh = {0.1, 0.1};
  EXPECT_TRUE(World(description_).is_linear());
  description_.frames.emplace_back();
  EXPECT_FALSE(World(description_).is_linear());
}

/// Nothing that is not asked for is in the world.
TEST_F(WorldTest, HoldsOnlyWhatIsAskedFor) {
  const World world(description_);
  EXPECT_EQ(world.forces().size(), 1U);
  EXPECT_EQ(world.memory().count(), 0U);
  EXPECT_TRUE(world.run_time().beginning.empty());
  EXPECT_TRUE(world.run_time().coupling.empty());
  EXPECT_TRUE(world.run_time().remembering.empty());
  EXPECT_EQ(world.description(), nullptr);
  EXPECT_TRUE(world.fixed().empty());
}

TEST_F(WorldTest, RunsTheInstructionSetAskedFor) {
  for (const Isa isa : test::available_isas()) {
    description_.isa = isa;
    EXPECT_EQ(World(description_).isa(), isa);
  }
}

TEST_F(WorldTest, CountsExtentOfBodies) { EXPECT_NEAR(World(description_).extent(), std::sqrt(6.0), 1e-15); }

/// The three numbers of a frame's rotation are not a place: a world far from the origin is no larger for
/// them.
TEST_F(WorldTest, ExtentLeavesOutRotations) {
  WorldDescription frames;
  frames.frames.resize(2);
  frames.frames[0].position = Vec3(100, 0, 0);
  frames.frames[1].position = Vec3(101, 0, 0);
  EXPECT_NEAR(World(frames).extent(), 1.0, 1e-12);
}

TEST_F(WorldTest, RefusesNamesTwiceAndUnknown) {
  description_.bodies.push_back(test::body_of(mesh_));
  expect_refused("two bodies of one name");
  description_.bodies.pop_back();
  description_.fixed = {test::fixed({0})};
  description_.fixed[0].body = "nobody";
  expect_refused("fixed nodes of no body");
  description_.fixed.clear();
  description_.loads = {{"hand", "nobody", {0}, {0, 0, 0}, {}}};
  expect_refused("a load on no body");
  description_.loads.clear();
  description_.pressures = {{"blood", "nobody", {{"triangle", {0, 1, 2}}}, 1.0, {}}};
  expect_refused("a pressure on no body");
}

TEST_F(WorldTest, RefusesNodesThatAreNotThere) {
  for (const std::int32_t node : {-1, mesh_.node_count()}) {
    WorldDescription good = description_;
    description_.fixed = {test::fixed({node})};
    expect_refused("fixed");
    description_ = good;
    description_.loads = {{"hand", "body", {node}, {0, 0, 0}, {}}};
    expect_refused("load");
    description_ = good;
    description_.pressures = {{"blood", "body", {{"triangle", {0, 1, node}}}, 1.0, {}}};
    expect_refused("pressure");
    description_ = good;
    description_.bodies[0].elastic[0].cells[3] = node;
    expect_refused("cell");
    description_ = good;
  }
}

TEST_F(WorldTest, RefusesANodeThatNoCellUses) {
  description_.bodies[0].positions.insert(description_.bodies[0].positions.end(), {5.0, 5.0, 5.0});
  expect_refused("a loose node");
  description_.fixed = {test::fixed({mesh_.node_count()})};
  EXPECT_NO_THROW(World{description_});  // held, it does no harm
}

TEST_F(WorldTest, RefusesTablesOfAnotherLength) {
  const WorldDescription good = description_;
  description_.loads = {{"hand", "body", {0, 1}, {1, 2, 3}, {}}};
  expect_refused("forces for half of the nodes");
  description_.loads = {{"hand", "body", {0}, {1, 2, 3}, {{0.0, 1.0}, {1.0}}}};
  expect_refused("a history without a factor");
  description_.loads = {{"hand", "body", {0}, {1, 2, 3}, {{1.0, 0.0}, {1.0, 2.0}}}};
  expect_refused("a history that goes back in time");
  description_ = good;
  description_.pressures = {{"blood", "body", {{"triangle", {0, 1, 2}}}, 1.0, {{0.0, 1.0}, {1.0}}}};
  expect_refused("a history without a factor");
  description_ = good;
  description_.fixed = {test::fixed({0})};
  description_.fixed[0].motion.times = {0.0, 1.0};
  description_.fixed[0].motion.displacements = {Vec3::Zero()};
  description_.fixed[0].motion.angles = {0.0, 0.0};
  expect_refused("a motion without a displacement");
  description_.fixed[0].motion.displacements = {Vec3::Zero(), Vec3::Zero()};
  description_.fixed[0].motion.angles = {0.0};
  expect_refused("a motion without an angle");
  description_ = good;
  description_.bodies[0].positions.pop_back();
  expect_refused("two thirds of a node");
}

TEST_F(WorldTest, RefusesFramesWithoutMass) {
  for (const double mass : {0.0, -1.0, kNaN}) {
    description_.frames.resize(1);
    description_.frames[0].mass = mass;
    expect_refused("mass of a frame");
  }
  description_.frames[0].mass = 1.0;
  description_.frames[0].inertia = Mat3::Zero();
  expect_refused("no inertia");
  description_.frames[0].inertia = -Mat3::Identity();
  expect_refused("negative inertia");
}

}  // namespace
}  // namespace tissu
