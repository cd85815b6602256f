#include <gtest/gtest.h>

#include "../base/allocations.h"
#include "../world/sample_worlds.h"

/// A static step takes no memory, with what the simulation itself does: it asks for cells that are inside
/// out, watches, remembers.

namespace tissu {
namespace {

using test::allocations;
using test::counting;

struct StaticCase {
  const char* name;
  WorldDescription (*world)();
};

void PrintTo(const StaticCase& c, std::ostream* out) { *out << c.name; }

/// Held at x = 0, with gravity across the bar and a load that grows.
WorldDescription pulled(BodyDescription body, std::vector<std::int32_t> held, std::int32_t hand) {
  WorldDescription world;
  world.bodies = {std::move(body)};
  world.gravity = Vec3(0, -1, 0);
  world.fixed = {test::fixed(std::move(held))};
  world.loads = {{"hand", "body", {hand}, {0.1, 0.0, 0.0}, {{0.0, 1.0}, {0.0, 1.0}}}};
  return world;
}

template <Split split>
WorldDescription solid() {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {8, 5, 5}, split);
  return pulled(test::body_of(mesh, {.law = "stvk", .young = 100.0}), test::nodes_at(mesh, 0, 0.0), 8);
}

/// The ends are kept, and what the load takes hold of.
WorldDescription condensed() {
  const Mesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {8, 5, 5}, Split::none);
  BodyDescription body = test::body_of(mesh, {.law = "hooke", .young = 100.0});
  CondensedOptions options;
  options.kept = test::nodes_where(mesh, [](const Vec3& x) { return x[0] < 1e-9 || x[0] > 2.0 - 1e-9; });
  const std::int32_t hand = options.kept.back();
  body.elastic[0].model = options;
  return pulled(std::move(body), test::nodes_at(mesh, 0, 0.0), hand);
}

/// A strip of 8 x 3 quads in its plane, or a row of 8 lines; what could move across it is held.
WorldDescription thin(const char* element, const char* law, Plane plane) {
  const bool line = std::string(element) == "line";
  const std::int32_t rows = line ? 1 : 4;
  BodyDescription body;
  body.name = "body";
  ElasticBlock block = test::elastic_block({}, {.law = law, .young = 100.0});
  block.element = element;
  block.plane = plane;
  std::vector<std::int32_t> held;
  for (std::int32_t i = 0; i < 9; ++i) {
    for (std::int32_t j = 0; j < rows; ++j) {
      const std::int32_t node = i * rows + j;
      body.positions.insert(body.positions.end(), {0.25 * i, 0.25 * j, 0.0});
      if (i == 0) held.push_back(node);
      if (i == 8 || (j == rows - 1 && !line)) continue;
      if (line) block.cells.insert(block.cells.end(), {node, node + 1});
      if (!line) block.cells.insert(block.cells.end(), {node, node + rows, node + rows + 1, node + 1});
    }
  }
  body.elastic = {block};
  const auto nodes = 9 * rows;
  WorldDescription world = pulled(std::move(body), std::move(held), nodes - 1);
  FixedNodes across = test::fixed({}, line ? 6 : 4);
  for (std::int32_t node = rows; node < nodes; ++node) across.nodes.push_back(node);
  world.fixed.push_back(across);
  return world;
}

class StaticAllocation : public testing::TestWithParam<StaticCase> {};

TEST_P(StaticAllocation, AStepOfASimulationTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  StaticEquilibrium::Settings settings;
  settings.newton = {20, 1e-5};
  Simulation simulation =
      test::simulate(GetParam().world(), std::make_unique<StaticEquilibrium>(settings),
                     std::make_unique<ConjugateGradient>(ConjugateGradient::Settings{1e-6, 5000}));
  simulation.step(0.01);
  simulation.step(0.01);
  allocations = 0;
  counting = true;
  bool silent = true;
  for (int i = 0; i < 5; ++i) {
    const StepReport report = simulation.step(0.01);
    silent = silent && report.converged && report.message.empty();
  }
  counting = false;
  EXPECT_EQ(allocations, 0);
  EXPECT_TRUE(silent);
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, StaticAllocation,
    testing::Values(StaticCase{"hexahedra", &solid<Split::none>},
                    StaticCase{"tetrahedra", &solid<Split::six>}, StaticCase{"condensed", &condensed},
                    StaticCase{"plane_stress", [] { return thin("quad", "stvk", Plane::stress); }},
                    StaticCase{"plane_strain", [] { return thin("quad", "stvk", Plane::strain); }},
                    StaticCase{"sheet_of_hooke", [] { return thin("quad", "hooke", Plane::free); }},
                    StaticCase{"line", [] { return thin("line", "stvk", Plane::free); }}),
    testing::PrintToStringParamName());

}  // namespace
}  // namespace tissu
