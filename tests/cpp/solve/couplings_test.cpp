#include <gtest/gtest.h>

#include <cstring>

#include "../../../cpp/src/solve/coarse_couplings.h"
#include "../assembly/dense.h"
#include "../base/dense_solution.h"
#include "../base/differences.h"
#include "../world/sample_worlds.h"
#include "solver_cases.h"
#include "tissu/step/system.h"

/// Every solver with couplings beside the matrix, against a dense factor of both.
namespace tissu {
namespace {

using test::dense;
using test::view;

/// A bar that stands on one end and is led at the other, and two frames.
WorldDescription linked_bar(int threads = 1) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 0.8), {6, 3, 2}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.young = 500.0, .poisson = 0.4})};
  world.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0)), test::fixed(test::nodes_at(mesh, 0, 3.0), 5)};
  world.links = true;
  world.threads = threads;
  for (const double x : {4.0, 5.0}) {
    FrameDescription frame;
    frame.mass = 2.0;
    frame.inertia = Vec3(1.0, 2.0, 3.0).asDiagonal();
    frame.position = Vec3(x, 0, 0);
    world.frames.push_back(frame);
  }
  return world;
}

/// Links between any nodes and places on frames, held nodes included.
void link(const World& world, State& state, int count) {
  LinkTable table = test::links(world, state);
  table.clear();
  test::Random random(12);
  const std::int32_t nodes = world.bodies()[0].node_count;
  const auto point = [&](int kind) -> LinkPoint {
    if (kind == 0) {
      const auto frame = random.number() > 0.0 ? 0 : 1;
      return {world.frames()[static_cast<std::size_t>(frame)].block, frame, random.vector(0.3)};
    }
    return {static_cast<std::int32_t>((random.number(0.5) + 0.5) * nodes) % nodes};
  };
  for (int i = 0; i < count; ++i) {
    const LinkPoint a = point(i % 5);
    const LinkPoint b = point(1);
    table.add(a, b, 10.0 * (1.5 + random.number()));
  }
}

State deformed(const World& world) {
  State state = world.rest_state();
  test::Random random(5);
  for (std::int32_t node = 0; node < world.bodies()[0].node_count; ++node) {
    auto x = block(Reals(state.positions), node);
    x = 1.05 * x + random.vector(0.01);
  }
  return state;
}

constexpr StiffnessScale kScale = {-4e-2, -0.2};  // a step of 0.2 s: the stiffness outweighs the mass

void expect_solved(System& system, const Eigen::MatrixXd& A, const std::string& where) {
  test::Random random(6);
  const auto size = static_cast<std::size_t>(A.rows());
  const std::vector<double> b = random.numbers(size);
  std::vector<double> x(size, 0.0);
  for (std::size_t k = 0; k < size; ++k) {
    if (system.system_matrix().is_given(static_cast<std::int32_t>(k / 3), static_cast<int>(k % 3)))
      x[k] = b[k];
  }
  const SolveReport report = system.solve(b, x, 0.0);
  EXPECT_TRUE(report.converged) << where;
  EXPECT_TRUE(report.positive_definite) << where;
  const double residual = (view(b) - A * view(x)).norm() / view(b).norm();
  EXPECT_LE(residual, 1e-10) << where;
  EXPECT_NEAR(report.residual, residual, 1e-12) << where;
  const Eigen::VectorXd expected = test::dense_solution(A, view(b));
  // The residual's 1e-10 times the condition number, below 1e6.
  EXPECT_LT((view(x) - expected).norm(), 1e-4 * expected.norm()) << where;
}

class CoupledSystems : public testing::TestWithParam<test::SolverCase> {};

/// One solver through lists that grow, change and go, so that nothing of an older list is left in it.
TEST_P(CoupledSystems, AreSolved) {
  const World world(linked_bar());
  State state = deformed(world);
  Profile profile;
  System assembled(world, nullptr, profile);
  const auto solver = GetParam().make(1e-10);
  System system(world, solver.get(), profile);
  for (const int count : {0, 1, 10, 1000, 16, 17, 0, 1}) {
    link(world, state, count);
    assembled.assemble(state, 1.0, kScale);
    system.assemble(state, 1.0, kScale);
    expect_solved(system, dense(assembled.matrix()), std::to_string(count) + " links");
  }
}

TEST_P(CoupledSystems, TakeTheSameBitsOnAnyNumberOfThreads) {
  const auto run = [&](int threads) {
    WorldDescription description = linked_bar(threads);
    description.gravity = Vec3(0.0, 0.0, -1.0);
    Simulation simulation = test::simulate(description, test::implicit_euler(), GetParam().make(1e-6));
    link(simulation.world(), simulation.state(), 300);
    for (int i = 0; i < 3; ++i) simulation.step(0.02);
    return simulation.state().positions;
  };
  const std::vector<double> one = run(1);
  for (const int threads : {2, 3}) {
    const std::vector<double> several = run(threads);
    EXPECT_EQ(std::memcmp(one.data(), several.data(), one.size() * sizeof(double)), 0) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, CoupledSystems, testing::ValuesIn(test::all_solver_cases()),
                         [](const auto& info) { return info.param.name; });

/// Few couplings leave the factor of the matrix as it is; a linear world keeps it through any of them.
TEST(CoupledCholesky, KeepsTheFactorOfTheMatrix) {
  WorldDescription description = linked_bar();
  description.bodies[0].elastic[0].law = "hooke";
  description.frames.clear();
  const World world(description);
  State state = world.rest_state();
  Profile profile;
  Cholesky solver;
  System system(world, &solver, profile);
  const std::vector<double> b(state.positions.size(), 1.0);
  std::vector<double> x(b.size());
  for (const std::int32_t k : {1, 5, 2, 0, 3}) {
    test::links(world, state).clear();
    for (std::int32_t i = 0; i < k; ++i) test::links(world, state).add({20 + i}, {60 - i}, 100.0);
    system.assemble(state, 1.0, kScale);
    EXPECT_TRUE(system.solve(b, x, 0.0).converged);
    EXPECT_LT((view(b) - dense(system.matrix()) * view(x)).norm(), 1e-10 * view(b).norm()) << k;
  }
  EXPECT_EQ(profile.solves().preparations, 1);
}

/// Columns of the inverse are kept from one system to the next, and dropped when they are too many: the rows
/// that are coupled wander, come back, and carry frames and held nodes, too.
TEST(CoupledCholesky, AnswersManySystemsOfOneFactor) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(3, 1, 0.8), {9, 4, 3}, Split::six);
  WorldDescription description = linked_bar();
  description.bodies = {test::body_of(mesh, {.young = 500.0, .poisson = 0.4})};
  description.bodies[0].elastic[0].law = "hooke";
  description.fixed = {test::fixed(test::nodes_at(mesh, 0, 0.0)),
                       test::fixed(test::nodes_at(mesh, 0, 3.0), 5)};
  const World world(description);
  State state = world.rest_state();
  Profile profile;
  Cholesky solver;
  System system(world, &solver, profile);
  const std::vector<double> b = test::Random(3).numbers(state.positions.size());
  std::vector<double> x(b.size());
  test::Random random(4);
  const std::int32_t nodes = world.bodies()[0].node_count;
  for (int i = 0; i < 80; ++i) {
    LinkTable table = test::links(world, state);
    table.clear();
    const int count = 1 + i % 14;
    for (int k = 0; k < count; ++k) {
      const auto near = static_cast<std::int32_t>((random.number(0.5) + 0.5) * 12) + i;
      const auto other = static_cast<std::int32_t>((random.number(0.5) + 0.5) * nodes) % nodes;
      LinkPoint a{near % nodes};
      if (k == 3) a = {world.frames()[0].block, 0, random.vector(0.3)};
      if (other != near % nodes) table.add(a, {other}, 10.0 * std::pow(10.0, 3.0 * random.number()));
    }
    system.assemble(state, 1.0, kScale);
    EXPECT_TRUE(system.solve(b, x, 0.0).converged);
    EXPECT_LT((view(b) - dense(system.matrix()) * view(x)).norm(), 1e-10 * view(b).norm()) << i;
  }
}

/// A body that links alone hold has no factor without them.
TEST(CoupledCholesky, FactorsBothWhereLinksAloneHold) {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(1, 1, 1), {2, 2, 2}, Split::six);
  WorldDescription description;
  description.bodies = {test::body_of(mesh), test::body_of(mesh, {}, "held")};
  description.bodies[0].name = "ground";
  description.bodies[1].name = "body";
  FixedNodes ground = test::fixed(test::nodes_at(mesh, 2, 0.0));
  ground.body = "ground";
  description.fixed = {ground};
  description.links = true;
  const World world(description);
  State state = world.rest_state();
  for (const std::int32_t node : {0, 2, 6, 8}) {
    test::links(world, state).add({node}, {world.bodies()[1].first_node + node}, 5.0);
  }
  for (const test::SolverCase& solver_case : test::solver_cases()) {
    if (solver_case.name != "cholesky" && !solver_case.name.starts_with("stale_cholesky")) continue;
    const auto solver = solver_case.make(1e-10);
    Profile profile;
    System system(world, solver.get(), profile);
    for (int i = 0; i < 2; ++i) {
      system.assemble(state, 0.0, {-1.0, 0.0});
      expect_solved(system, dense(system.matrix()), solver_case.name);
    }
  }
}

/// Between aggregates a coupling sees the same rigid motions as between their rows.
TEST(CoarseCouplings, SeeRigidMotionsOfAggregates) {
  test::Random random(9);
  constexpr std::int32_t kFine = 12;  // ten points; row 10 a frame's origin, row 11 its rotation
  RowPlaces fine;
  fine.positions = random.numbers(3 * kFine);
  for (std::int32_t i = 0; i < kFine; ++i) fine.point.push_back(i);
  fine.point[11] = 10;
  block(Reals(fine.positions), 11) = block(ConstReals(fine.positions), 10);
  Aggregates aggregates{3, {0, 0, 0, 1, 1, 1, 2, 2, -1, 2, 1, 1}, {3, 4, 3}};
  RowPlaces coarse;
  place_aggregates(aggregates, fine, coarse);
  Couplings list;
  const std::int32_t on_frame =
      list.carry(std::array{CarriedPart{10, 1.0}, CarriedPart{11, 1.0, random.vector(), true}});
  list.add({{0, 3, 0, 0}, {1.0, -1.0, 0.0, 0.0}, Mat3::Identity()});
  list.add({{on_frame, 6, 7, 1}, {1.0, -0.5, -0.25, -0.25}, Mat3::Identity()});
  list.add({{8, 9, 0, 0}, {1.0, -1.0, 0.0, 0.0}, Mat3::Identity()});
  list.close(kFine, nullptr);
  Couplings coarse_list;
  std::vector<CarriedPart> scratch;
  coarsen_couplings(list, aggregates, fine, coarse, scratch, coarse_list);
  const std::vector<double> q = random.numbers(18);
  std::vector<double> p(3 * kFine, 0.0);
  for (std::int32_t i = 0; i < kFine; ++i) {
    const std::int32_t a = aggregates.of[static_cast<std::size_t>(i)];
    if (a < 0) continue;
    const Vec3 t = block(ConstReals(q), 2 * a);
    const Vec3 r = block(ConstReals(q), 2 * a + 1);
    const Vec3 arm = block(ConstReals(fine.positions), i) - block(ConstReals(coarse.positions), 2 * a);
    block(Reals(p), i) = fine.is_rotation(i) ? r : Vec3(t + r.cross(arm));
  }
  const auto energy = [](const Couplings& of, const std::vector<double>& motion) {
    std::vector<double> out(motion.size(), 0.0);
    of.add_product(Threads(1), 1.0, motion.data(), out.data());
    return view(out).dot(view(motion));
  };
  EXPECT_NEAR(energy(coarse_list, q), energy(list, p), 1e-12 * energy(list, p));
  EXPECT_GT(energy(list, p), 0.1);
}

/// A pattern with room between its rows, with the values of a closed one in their places.
TEST(OpenPattern, GivesTheSameBits) {
  const World world(linked_bar());
  Profile profile;
  System assembled(world, nullptr, profile);
  const State state = deformed(world);
  assembled.assemble(state, 1.0, kScale);
  const BlockMatrix& closed = assembled.matrix();
  SparsityBuilder builder(world.blocks());
  for (const auto& model : world.forces()) model->couple(builder);
  const Sparsity pattern = builder.build(0.25);
  ASSERT_FALSE(pattern.open_end.empty());
  EXPECT_GT(pattern.blocks(), closed.sparsity().blocks());
  BlockMatrix open(pattern, closed.isa(), Threads(1));
  const Sparsity& other = closed.sparsity();
  double* values = open.values();
  for (std::int32_t row = 0; row < other.rows(); ++row) {
    ASSERT_EQ(pattern.end_of(row) - pattern.begin_of(row), other.end_of(row) - other.begin_of(row));
    EXPECT_GT(pattern.row_begin[static_cast<std::size_t>(row) + 1], pattern.end_of(row));
    std::memcpy(values + 9 * pattern.begin_of(row), closed.values() + 9 * other.begin_of(row),
                static_cast<std::size_t>(9 * (other.end_of(row) - other.begin_of(row))) * sizeof(double));
  }
  open.constrain(world.fixed().rows(), world.fixed().masks());
  EXPECT_EQ(dense(open), dense(closed));
  test::Random random(6);
  const std::vector<double> b = random.numbers(state.positions.size());
  for (const test::SolverCase& solver_case : test::solver_cases()) {
    std::vector<double> x(b.size(), 0.0);
    std::vector<double> y(b.size(), 0.0);
    const SolveReport one = solver_case.make(1e-8)->solve(closed, b, x, 0.0);
    const SolveReport two = solver_case.make(1e-8)->solve(open, b, y, 0.0);
    EXPECT_TRUE(one.converged);
    EXPECT_EQ(one.iterations, two.iterations) << solver_case.name;
    EXPECT_EQ(x, y) << solver_case.name;
  }
}

}  // namespace
}  // namespace tissu
