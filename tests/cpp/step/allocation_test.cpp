#include <gtest/gtest.h>

#include "../base/allocations.h"
#include "../force/room.h"
#include "../world/sample_worlds.h"
#include "solve/multigrid.h"
#include "tissu/model/models.h"
#include "tissu/step/energy_momentum.h"
#include "tissu/step/newmark.h"

/// A steady step takes no memory.

namespace tissu {
namespace {

using test::allocations;
using test::counting;

struct AllocationCase {
  const char* name;
  const char* law;
  Split split;
  int newton;
  int threads;
  bool viscous = false;  ///< every viscosity there is
  ConjugateGradient::Settings solver = {};
  const char* model = "fem";
  int links = 0;
};

constexpr ConjugateGradient::Settings with(Preconditioning kind, Precision precision = Precision::full,
                                           Product product = Product::assembled) {
  return {1e-6, 5000, kind, precision, product};
}

void PrintTo(const AllocationCase& c, std::ostream* out) { *out << c.name; }

class Allocation : public testing::TestWithParam<AllocationCase> {
 protected:
  static WorldDescription world() {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {8, 5, 5}, GetParam().split);
    WorldDescription world;
    world.bodies = {test::body_of(mesh, {.law = GetParam().law, .young = 100.0})};
    for (ElasticBlock& block : world.bodies[0].elastic) block.model = options_named(GetParam().model);
    world.bodies[0].rayleigh = {0.1, 0.001};
    if (GetParam().viscous) {
      world.bodies[0].viscosity = {0.1, 0.2, 0.3, {{0.5, 0.1}, {0.2, 1.0}}};
    }
    world.gravity = Vec3(0, 0, -1);
    world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
    world.loads = {{"hand", "body", {3}, {0.1, 0.0, 0.0}, {{0.0, 1.0}, {0.0, 1.0}}}};
    world.threads = GetParam().threads;
    world.links = GetParam().links > 0;
    return world;
  }
};

TEST_P(Allocation, ASteadyStepTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  Simulation simulation = test::simulate(world(), test::implicit_euler(GetParam().newton, 1e-6),
                                         std::make_unique<ConjugateGradient>(GetParam().solver));
  for (std::int32_t i = 0; i < GetParam().links; ++i) {
    test::links(simulation).add({20 + i}, {150 - 2 * i}, 1.0 + 0.1 * i);
  }
  simulation.step(0.01);
  simulation.step(0.01);
  allocations = 0;
  counting = true;
  bool converged = true;
  for (int i = 0; i < 10; ++i) converged = simulation.step(0.01).converged && converged;
  counting = false;
  EXPECT_EQ(allocations, 0);
  EXPECT_TRUE(converged);  // else there are words that say why not
  // The count works: this one is seen.
  counting = true;
  {
    const std::vector<double> seen(100, 1.0);
    EXPECT_EQ(seen.size(), 100U);
  }
  counting = false;
  EXPECT_GE(allocations, 1);
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

INSTANTIATE_TEST_SUITE_P(
    Worlds, Allocation,
    testing::Values(
        AllocationCase{"stvk_tetra_once", "stvk", Split::six, 1, 1},
        AllocationCase{"stvk_tetra_newton", "stvk", Split::six, 12, 1},
        AllocationCase{"hooke_hexahedron_once", "hooke", Split::none, 1, 1},
        AllocationCase{"stvk_hexahedron_two_threads", "stvk", Split::none, 1, 2},
        AllocationCase{"stvk_tetra_viscous", "stvk", Split::six, 12, 2, true},
        AllocationCase{"incomplete_cholesky", "stvk", Split::six, 1, 2, false,
                       with(Preconditioning::incomplete_cholesky)},
        AllocationCase{"stale_cholesky_kept", "hooke", Split::six, 1, 1, false,
                       with(Preconditioning::stale_cholesky)},
        AllocationCase{"multigrid", "stvk", Split::six, 1, 2, false, with(Preconditioning::multigrid)},
        AllocationCase{"single_precision", "stvk", Split::six, 1, 1, false,
                       with(Preconditioning::incomplete_cholesky, Precision::single)},
        AllocationCase{"matrix_free", "stvk", Split::six, 1, 1, false,
                       with(Preconditioning::block_jacobi, Precision::full, Product::free)},
        AllocationCase{"linked", "stvk", Split::six, 1, 2, false, {}, "fem", 30},
        AllocationCase{"linked_incomplete_cholesky", "stvk", Split::six, 1, 2, false,
                       with(Preconditioning::incomplete_cholesky), "fem", 30},
        AllocationCase{"linked_multigrid", "stvk", Split::six, 1, 1, false, with(Preconditioning::multigrid),
                       "fem", 30},
        AllocationCase{"linked_single_precision", "stvk", Split::six, 1, 1, false,
                       with(Preconditioning::block_jacobi, Precision::single), "fem", 30},
        AllocationCase{"linked_matrix_free", "stvk", Split::six, 1, 1, false,
                       with(Preconditioning::block_jacobi, Precision::full, Product::free), "fem", 30},
        AllocationCase{"mean_dilatation_tetra", "stvk", Split::six, 12, 2, false, {}, "mean-dilatation"},
        AllocationCase{
            "mean_dilatation_hexahedron", "neo_hooke", Split::none, 1, 1, false, {}, "mean-dilatation"}),
    testing::PrintToStringParamName());

/// Steps of a bar that is held, pulled by a load, by that method, maybe beside another. The first two take
/// what they need.
void expect_no_allocation([[maybe_unused]] Integrator& method, [[maybe_unused]] bool beside = false) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {8, 5, 5}, Split::none);
  WorldDescription description;
  description.bodies = {test::body_of(mesh, {.law = "stvk", .young = 100.0})};
  if (beside) description.bodies.push_back(test::body_of(mesh, {.law = "neo_hooke", .young = 50.0}, "other"));
  description.links = beside;
  description.gravity = Vec3(0, 0, -1);
  description.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  description.loads = {{"hand", "body", {3}, {0.1, 0.0, 0.0}, {{0.0, 1.0}, {0.0, 1.0}}}};
  const World world(description);
  ConjugateGradient solver({1e-6, 5000});
  Profile profile;
  method.prepare(world, &solver, profile);
  State state = world.rest_state();
  method.step(state, 0.01);
  method.step(state, 0.01);
  allocations = 0;
  counting = true;
  bool converged = true;
  int iterations = 0;
  for (int i = 0; i < 5; ++i) {
    const StepReport report = method.step(state, 0.01);
    converged = converged && report.converged;
    iterations += report.newton_iterations;
  }
  counting = false;
  EXPECT_EQ(allocations, 0);
  EXPECT_TRUE(converged);
  EXPECT_GE(iterations, 5);
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

TEST(AllocationOfMethods, EnergyMomentumTakesNone) {
  EnergyMomentum method({20, 1e-7});
  expect_no_allocation(method);
}

TEST(AllocationOfMethods, EnergyMomentumOfTwoBodiesTakesNone) {
  EnergyMomentum method({20, 1e-7});
  expect_no_allocation(method, true);
}

TEST(AllocationOfMethods, AStaticStepTakesNone) {
  StaticEquilibrium::Settings settings;
  settings.newton = {20, 1e-5};
  StaticEquilibrium method(settings);
  expect_no_allocation(method);
}

TEST(AllocationOfMethods, TheWatchOnEnergyTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {8, 5, 5}, Split::none);
  WorldDescription description;
  description.bodies = {test::body_of(mesh, {.law = "stvk", .young = 100.0})};
  description.gravity = Vec3(0, 0, -1);
  description.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  const World world(description);
  ASSERT_TRUE(EnergyWatch::can_watch(world));
  EnergyWatch watch;
  State state = world.rest_state();
  watch.begin(world, state);
  watch.end(world, state);
  allocations = 0;
  counting = true;
  state.positions.back() += 0.1;
  watch.begin(world, state);
  watch.end(world, state);
  counting = false;
  EXPECT_EQ(allocations, 0);
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

// Squeezed flat, so that every cell is projected: by the axes of F, by eigenvalues, at once, in any model.
TEST(AllocationOfModels, ADefiniteMatrixTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {4, 3, 3}, Split::six);
  for (const ModelInfo& info : all_models()) {
    if (info.name == "frames" || info.name == "shell") continue;  // of nodes that have a rotation
    ElasticBlock block = test::elastic_block(
        mesh.blocks[0], {info.laws.empty() ? "stvk" : std::string(info.laws.front()), 100.0});
    block.model = options_named(info.name);
    if (auto* corotational = std::get_if<CorotationalOptions>(&block.model)) corotational->tangent = "exact";
    if (auto* condensed = std::get_if<CondensedOptions>(&block.model)) {
      for (std::int32_t i = 0; i < mesh.node_count(); ++i) condensed->kept.push_back(i);
    }
    if (info.name == "fem") {
      block.reinforcements = {{"fibre",
                               {{"k1", {9.0}},
                                {"k2", {1.0}},
                                {"direction_x", {1.0}},
                                {"direction_y", {0.0}},
                                {"direction_z", {0.0}}}}};
    }
    const auto model = make_model(block, mesh.positions, choose_isa(), Threads(2));
    SparsityBuilder builder(mesh.node_count());
    model->couple(builder);
    const Sparsity pattern = builder.build();
    model->bind(pattern);
    BlockMatrix matrix(pattern, choose_isa(), Threads(2));
    matrix.clear();
    State state;
    state.positions = mesh.positions;
    for (std::size_t i = 0; i < state.positions.size(); i += 3) state.positions[i] *= 0.3;
    model->add_stiffness(state, test::scratch(), {-1.0, 0.0, true}, matrix);
    allocations = 0;
    counting = true;
    model->add_stiffness(state, test::scratch(), {-1.0, 0.0, true}, matrix);
    counting = false;
    EXPECT_EQ(allocations, 0) << info.name;
  }
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

/// Levels and their patterns stay; the values are those of another matrix.
TEST(AllocationOfSolvers, AMultigridMadeAnewTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {18, 6, 6}, Split::six);
  WorldDescription description;
  description.threads = 2;
  description.bodies = {test::body_of(mesh)};
  description.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0))};
  const World world(description);
  ConjugateGradient chosen(with(Preconditioning::multigrid));
  Profile profile;
  System system(world, &chosen, profile);
  State state = world.rest_state();
  system.assemble(state, 1.0, {-1.0, 0.0});
  Multigrid<double> full;
  Multigrid<float> single;
  full.make(system.matrix(), 1.0);
  single.make(system.matrix(), 1.0);
  ASSERT_GE(full.level_rows().size(), 2U);
  for (std::size_t i = 0; i < state.positions.size(); i += 3) state.positions[i] *= 1.1;
  system.assemble(state, 2.0, {-1.0, 0.0});
  allocations = 0;
  counting = true;
  full.make(system.matrix(), 1.0);
  single.make(system.matrix(), 1.0);
  counting = false;
  EXPECT_EQ(allocations, 0);
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

}  // namespace
}  // namespace tissu
