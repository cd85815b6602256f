#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "../world/sample_worlds.h"
#include "tissu/mesh/topology.h"
#include "tissu/model/models.h"

/// Two simulations step on one constant world at the same time, while a third thread computes forces with it:
/// the same bits as alone. Under the thread sanitizer, no race.
namespace tissu {
namespace {

struct Ended {
  State state;
  Energy energy;
};

class SharedWorld : public testing::TestWithParam<std::string> {
 protected:
  static constexpr int kSteps = 5;

  static BodyDescription body() {
    const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {5, 2, 1}, Split::six);  // no node inside
    const ModelInfo& info = *find_model(GetParam());
    const std::string law = info.laws.empty() ? "stvk" : std::string(info.laws.back());
    BodyDescription body = test::body_of(mesh, {law, 200.0, 0.3, 2.0});
    ElasticBlock& block = body.elastic[0];
    block.model = options_named(GetParam());
    if (auto* condensed = std::get_if<CondensedOptions>(&block.model)) {
      for (std::int32_t i = 0; i < mesh.node_count(); i += 2) condensed->kept.push_back(i);
    }
    body.frames = GetParam() == "frames" || GetParam() == "shell";
    if (GetParam() == "shell") block = wall(mesh, block);
    if (GetParam() != "condensed" && !body.frames) body.viscosity = {0.1, 0.2, 0.3, {{0.5, 0.1}}};
    body.rayleigh = {0.1, 0.001};
    return body;
  }
  /// The surface of the box.
  static ElasticBlock wall(const Mesh& mesh, ElasticBlock block) {
    block.element = "triangle";
    block.cells.clear();
    for (const auto& face : boundary_surface(mesh).triangles) {
      block.cells.insert(block.cells.end(), face.begin(), face.end());
    }
    block.cross_section = {0.05};
    return block;
  }
  static std::shared_ptr<const World> world() {
    WorldDescription world;
    world.bodies = {body()};
    std::vector<std::int32_t> held;
    const auto& positions = world.bodies[0].positions;
    std::vector<char> used(positions.size() / 3, 0);
    for (const std::int32_t node : world.bodies[0].elastic[0].cells) used[static_cast<std::size_t>(node)] = 1;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const bool eliminated = GetParam() == "condensed" && i % 2 == 1;
      if (used[i] == 0 || (positions[3 * i] == 0.0 && !eliminated))
        held.push_back(static_cast<std::int32_t>(i));
    }
    world.fixed = {test::fixed(held)};
    world.fixed[0].rotations = world.bodies[0].frames;
    world.gravity = Vec3(0.0, 0.0, -1.0);
    world.links = true;
    world.threads = 2;
    return std::make_shared<const World>(world);
  }
  /// The one is pulled by a link, the other is not.
  static Ended run(const std::shared_ptr<const World>& world, bool linked) {
    Simulation simulation(world, test::implicit_euler(3, 1e-8), test::conjugate_gradient(1e-10));
    const std::int32_t last = world->bodies()[0].node_count - 2;
    if (linked) test::links(simulation).add({last}, {last - 4}, 5.0);
    for (int i = 0; i < kSteps; ++i) simulation.step(0.01);
    simulation.settle();
    return {simulation.state(), simulation.energy()};
  }
  /// What a thread beside the step asks of every model: forces, products, energies, fields and, squeezed, a
  /// definite matrix.
  static std::vector<double> ask(const World& world) {
    State state = world.rest_state();
    for (std::size_t i = 0; i < state.positions.size(); i += 3) state.positions[i] *= 0.6;
    Scratch scratch;
    std::vector<double> f(state.positions.size(), 0.0);
    BlockMatrix matrix(world.sparsity(), world.isa(), Threads(1));
    matrix.clear();
    double energy = 0.0;
    for (const auto& model : world.forces()) {
      model->add_force(state, scratch, f);
      model->add_product(state, scratch, {1.0, 0.5}, state.positions, f);
      model->add_stiffness(state, scratch, {-1.0, 0.0, true}, matrix);
      energy += model->energy(state, scratch);
    }
    for (const BodyModel* model : world.bodies()[0].models) {
      for (const double e : model->fields(state).energy_density) energy += e;
    }
    matrix.multiply(state.positions, state.velocities);
    f.insert(f.end(), state.velocities.begin(), state.velocities.end());
    f.push_back(energy);
    return f;
  }
  static void expect_same(const Ended& a, const Ended& b) {
    EXPECT_EQ(a.state.positions, b.state.positions);
    EXPECT_EQ(a.state.velocities, b.state.velocities);
    EXPECT_EQ(a.state.memory, b.state.memory);
    EXPECT_EQ(a.energy.total(), b.energy.total());
  }
};

TEST_P(SharedWorld, GivesTheSameBitsOnThreadsAtTheSameTime) {
  const std::shared_ptr<const World> alone = world();
  const Ended linked = run(alone, true);
  const Ended free = run(world(), false);
  const std::vector<double> forces = ask(*world());
  EXPECT_NE(linked.state.positions, free.state.positions);

  const std::shared_ptr<const World> shared = world();
  Ended one;
  Ended other;
  std::atomic<bool> done{false};
  bool same = true;
  std::thread first([&] { one = run(shared, true); });
  std::thread second([&] { other = run(shared, false); });
  std::thread third([&] {
    do {
      same = ask(*shared) == forces && same;
    } while (!done);
  });
  first.join();
  second.join();
  done = true;
  third.join();
  expect_same(one, linked);
  expect_same(other, free);
  EXPECT_TRUE(same);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const ModelInfo& info : all_models()) all.emplace_back(info.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Models, SharedWorld, testing::ValuesIn(names()), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace tissu
