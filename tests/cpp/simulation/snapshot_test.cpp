#include "tissu/simulation/snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>

#include "../step/methods.h"
#include "tissu/edit/remove_cells.h"

/// A simulation that goes on from a snapshot beside the one that never stopped: the same bits.
namespace tissu {
namespace {

struct SnapshotCase {
  std::string name;
  std::function<std::unique_ptr<Integrator>()> integrator;
  bool direct = false;
  bool statics = false;
  std::string law = "stvk";
  std::string model = "fem";
};

void PrintTo(const SnapshotCase& c, std::ostream* out) { *out << c.name; }

std::unique_ptr<Integrator> equilibrium() {
  return std::make_unique<StaticEquilibrium>(StaticEquilibrium::Settings{{20, 1e-9}, 3});
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class GoesOn : public testing::TestWithParam<SnapshotCase> {
 protected:
  static WorldDescription world() {
    const SnapshotCase& c = GetParam();
    const Mesh mesh = test::distorted_box({4, 3, 2}, Split::six, 0.05);
    WorldDescription world;
    world.bodies = {test::body_of(mesh, {.law = c.law, .young = 300.0})};
    world.bodies[0].elastic[0].model = options_named(c.model);
    world.gravity = Vec3(0.0, 0.0, -2.0);
    world.fixed = {test::fixed(test::nodes_where(mesh, [](const Vec3& x) { return x.x() < 0.4; }))};
    world.loads = {{"hand", "body", {7, 9}, {0, 1, 0, 0, 0, 1}, {{0.0, 0.1}, {0.0, 1.0}}}};
    world.editable = true;
    if (c.model == "condensed") {  // all nodes but three
      auto& kept = std::get<CondensedOptions>(world.bodies[0].elastic[0].model).kept;
      for (std::int32_t i = 0; i < mesh.node_count(); ++i) {
        if (i != 26 && i != 27 && i != 28) kept.push_back(i);
      }
    }
    if (is_plain()) return world;
    if (c.model == "fem") world.bodies[0].viscosity.prony = {{0.5, 0.05}, {0.2, 0.3}};
    FrameDescription frame;
    frame.position = Vec3(6.0, 0.0, 0.0);
    frame.angular_velocity = Vec3(1.0, 2.0, 0.5);
    frame.inertia.diagonal() = Vec3(1.0, 2.0, 3.0);
    world.frames = {frame};
    world.links = true;
    return world;
  }
  /// Without frames, links and viscosity: linear with Hooke's law, so that matrix and factor are kept.
  static bool is_plain() {
    const SnapshotCase& c = GetParam();
    return c.statics || (c.law == "hooke" && (c.model == "fem" || c.model == "condensed"));
  }
  static Simulation begin() {
    return test::simulate(world(), GetParam().integrator(),
                          GetParam().direct ? std::make_unique<Cholesky>() : test::conjugate_gradient(1e-8));
  }
  /// Half the stable step of explicit methods, some of which take very short ones.
  static double step() { return GetParam().statics ? 1.0 : std::min(0.004, 0.5 * begin().stable_step()); }
  static void steps(Simulation& simulation, int count) {
    const double h = step();
    for (int i = 0; i < count; ++i) simulation.step(h);
  }
  static void remove(Simulation& simulation, const std::vector<std::int32_t>& cells) {
    simulation.replace_world(remove_cells(simulation.world(), simulation.state(), "body", cells));
  }
  /// The first cells and those of the last corner, whose nodes get loose: one cut after the other.
  static Simulation edited() {
    Simulation simulation = begin();
    if (!is_plain()) {
      test::links(simulation).add({3}, {simulation.world().frames()[0].block, 0, Vec3(0.1, 0, 0)}, 40.0);
    }
    steps(simulation, 3);
    remove(simulation, {0, 1, 2, 100});
    steps(simulation, 3);
    remove(simulation, {143, 142, 141, 140, 139, 138});
    steps(simulation, 2);
    return simulation;
  }
  static void expect_same(Simulation& a, Simulation& b, const std::string& when) {
    a.settle();
    b.settle();
    EXPECT_EQ(a.state().time, b.state().time) << when;
    EXPECT_TRUE(same_bits(a.state().positions, b.state().positions)) << when;
    EXPECT_TRUE(same_bits(a.state().velocities, b.state().velocities)) << when;
    EXPECT_TRUE(a.state().memory == b.state().memory) << when;
    EXPECT_TRUE(same_bits(a.reactions(), b.reactions())) << when;
    EXPECT_EQ(a.energy().total(), b.energy().total()) << when;
    EXPECT_EQ(a.snapshot().integrator, b.snapshot().integrator) << when;
  }
};

TEST_P(GoesOn, WithTheSameBits) {
  Simulation simulation = edited();
  const Snapshot snapshot = simulation.snapshot();
  Simulation other = begin();
  other.restore(snapshot);
  expect_same(simulation, other, "at once");
  EXPECT_EQ(remaining_cells(other.world(), "body"), remaining_cells(simulation.world(), "body"));
  const double h = step();
  for (int i = 0; i < 4; ++i) {
    const StepReport one = simulation.step(h);
    const StepReport two = other.step(h);
    EXPECT_EQ(one.solver_iterations, two.solver_iterations);
    EXPECT_EQ(one.newton_iterations, two.newton_iterations);
    EXPECT_EQ(one.residual, two.residual);
  }
  expect_same(simulation, other, "after four steps");
  remove(simulation, {50});
  remove(other, {50});
  steps(simulation, 2);
  steps(other, 2);
  expect_same(simulation, other, "after another cut");
}

TEST_P(GoesOn, AgainFromTheMiddle) {
  Simulation simulation = edited();
  const Snapshot snapshot = simulation.snapshot();
  steps(simulation, 3);
  const std::vector<double> end = simulation.state().positions;
  simulation.restore(snapshot);
  steps(simulation, 3);
  EXPECT_TRUE(same_bits(simulation.state().positions, end));
}

TEST_P(GoesOn, FromNothingThatWasMadeUp) {
  Simulation simulation = edited();
  const Snapshot good = simulation.snapshot();
  if (!is_plain()) {
    const std::size_t links = begin().world().memory().find(Links::kMemory);
    for (const std::size_t number : {0U, 1U, 5U, 6U, 10U}) {  // blocks, frames, stiffness
      for (const double odd : {1e6, -3.0, 0.5, 1e300}) {
        if (number == 10U && odd > 0.0) continue;
        Snapshot made_up = good;
        made_up.state.memory[links][number] = odd;
        EXPECT_THROW(begin().restore(made_up), ParameterError) << number << " " << odd;
      }
    }
  }
  const std::string& name = GetParam().name;
  if (!name.starts_with("bdf2") && !name.starts_with("newmark") && !name.starts_with("fixed_point")) return;
  for (const std::size_t size : {std::size_t{1}, good.integrator.size() - 1, good.integrator.size() + 1}) {
    Snapshot made_up = good;
    made_up.integrator.resize(size, 1.0);
    EXPECT_THROW(begin().restore(made_up), ParameterError) << size;
  }
}

std::vector<SnapshotCase> cases() {
  const auto euler = [] { return test::implicit_euler(); };
  std::vector<SnapshotCase> result = {{"euler_cg", euler},
                                      {"euler_cholesky", euler, true},
                                      {"linear_cholesky", euler, true, false, "hooke"},
                                      {"condensed", euler, true, false, "hooke", "condensed"},
                                      {"corotational", euler, false, false, "hooke", "corotational"},
                                      {"mass_spring", euler, false, false, "hooke", "mass-spring"},
                                      {"mass_link", euler, false, false, "stvk", "mass-link"},
                                      {"mass_tensor", euler, false, false, "stvk", "mass-tensor"},
                                      {"static_cholesky", equilibrium, true, true},
                                      {"static_cg", equilibrium, false, true}};
  for (const test::Method& method : test::all_methods(5)) result.push_back({method.name, method.make});
  return result;
}

INSTANTIATE_TEST_SUITE_P(Ways, GoesOn, testing::ValuesIn(cases()), testing::PrintToStringParamName());

/// Counts how often it is told to forget.
class Forgetful final : public LinearSolver {
 public:
  explicit Forgetful(int& count) : count_(count) {}
  [[nodiscard]] std::string_view name() const override { return "forgetful"; }
  [[nodiscard]] std::string_view preparation() const override { return cholesky_.preparation(); }
  SolveReport solve(const LinearOperator& A, ConstReals b, Reals x, double floor) override {
    return cholesky_.solve(A, b, x, floor);
  }
  void forget() override { ++count_; }
  [[nodiscard]] std::size_t bytes() const override { return cholesky_.bytes(); }

 private:
  int& count_;
  Cholesky cholesky_;
};

class Snapshots : public testing::Test {
 protected:
  Snapshots() {
    world_.bodies = {test::body_of(mesh_)};
    world_.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
  }
  void refuse(const std::string& words, const std::function<void(Snapshot&)>& change) const {
    Simulation simulation = test::simulate(world_, test::implicit_euler());
    Snapshot snapshot = simulation.snapshot();
    change(snapshot);
    try {
      simulation.restore(snapshot);
      ADD_FAILURE() << "accepted: " << words;
    } catch (const ParameterError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}, Split::six);
  WorldDescription world_;
};

TEST_F(Snapshots, MakeTheSolverForget) {
  int count = 0;
  Simulation simulation = test::simulate(world_, test::implicit_euler(), std::make_unique<Forgetful>(count));
  const Snapshot snapshot = simulation.snapshot();
  EXPECT_EQ(count, 1);
  simulation.restore(snapshot);
  EXPECT_EQ(count, 2);
}

TEST_F(Snapshots, OfOtherWorldsAreRefused) {
  refuse("positions", [](Snapshot& s) { s.state.positions.pop_back(); });
  refuse("velocities", [](Snapshot& s) { s.state.velocities.clear(); });
  refuse("velocities before", [](Snapshot& s) { s.velocities_before.push_back(0.0); });
  refuse("rotations", [](Snapshot& s) { s.state.rotations.push_back(Quaternion::Identity()); });
  refuse("remember", [](Snapshot& s) { s.state.memory.emplace_back(); });
  refuse("edited bodies", [](Snapshot& s) {
    BodyTopology body;
    body.body = "body";
    body.cells = {0};
    s.bodies.push_back(body);
  });
  world_.editable = true;
  refuse("cells of body", [](Snapshot& s) { s.bodies[0].cells.push_back(99); });
  refuse("loose nodes", [](Snapshot& s) {
    s.bodies[0].cells = {0};
    s.bodies[0].loose_nodes = {3};
  });
  refuse("node 77", [](Snapshot& s) {
    s.bodies[0].cells = {0};
    s.bodies[0].loose_nodes = {77};
    s.bodies[0].places = {0, 0, 0};
  });
  world_.links = true;
  refuse("multiple of 11", [](Snapshot& s) { s.state.memory[0].assign(10, 0.0); });
  refuse("link 0 holds block 99",
         [](Snapshot& s) { s.state.memory[0] = {99, -1, 0, 0, 0, 1, -1, 0, 0, 0, 5}; });
  refuse("frame 3", [](Snapshot& s) { s.state.memory[0] = {0, -1, 0, 0, 0, 1, 3, 0, 0, 0, 5}; });
}

}  // namespace
}  // namespace tissu
