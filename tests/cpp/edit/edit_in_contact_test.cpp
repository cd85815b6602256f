/// Cuts in place of bodies that touch and that are pressed, against the same run in which every edit lays the
/// whole world anew: by the bits of each step.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>

#include "../world/sample_worlds.h"
#include "edit/body_surface.h"
#include "edit/debris.h"
#include "tissu/base/error.h"
#include "tissu/contact/contact.h"
#include "tissu/mesh/topology.h"

namespace tissu {
namespace {

constexpr double kGap = 0.02;
constexpr double kStep = 0.02;
const Vec3 kOrigin(0.3, -0.2, 0.1);  ///< of the box, whose cells have edges of 1
constexpr std::array<int, 3> kCells = {7, 3, 3};

struct Touch {
  const char* name;
  Split split;
  ContactMethod method;
  bool itself;
  bool pressed;
  bool divide;
};
void PrintTo(const Touch& c, std::ostream* out) { *out << c.name; }

/// A beam that is held at one end. It overlaps a table by a part of the gap, so that it is moved out of it
/// before the first step.
WorldDescription description(const Touch& c) {
  const Mesh mesh = test::distorted_box(kCells, c.split, 0.0);
  WorldDescription world;
  world.bodies = {test::body_of(mesh, {.law = "stvk", .young = 3e3})};
  BodyDescription& body = world.bodies[0];
  body.room = 4000;
  number_cells(body);
  world.fixed = {test::fixed(test::nodes_where(
      mesh, [](const Vec3& x) { return x.x() < kOrigin.x() + 1e-9 && x.z() > kOrigin.z() + 0.5; }))};
  world.gravity = Vec3(0.0, 0.0, -9.81);
  world.editable = true;
  ContactDescription& contact = world.contact.emplace();
  contact.method = c.method;
  contact.bodies = {body_surface(body)};
  ObstacleDescription table;
  table.surface.name = "table";
  table.plane = true;
  table.origin = kOrigin + Vec3(0.0, 0.0, 0.4 * kGap);
  contact.obstacles = {table};
  contact.pairs = {{.a = 0, .b = 1, .friction = 0.3, .gap = kGap}};
  if (c.itself) contact.pairs.push_back({.a = 0, .b = 0, .friction = 0.1, .gap = kGap});
  if (!c.pressed) return world;
  PressureDescription& pressure = world.pressures.emplace_back();
  pressure.name = "weight";
  pressure.body = "body";
  pressure.pressure = 20.0;
  const Surface surface = boundary_surface(mesh);
  const auto is_top = [&](std::int32_t node) { return mesh.node(node).z() > kOrigin.z() + kCells[2] - 1e-9; };
  FaceCells triangles{"triangle", {}};
  for (const auto& t : surface.triangles) {
    if (std::ranges::all_of(t, is_top)) triangles.nodes.insert(triangles.nodes.end(), t.begin(), t.end());
  }
  FaceCells quads{"quad", {}};
  for (const auto& q : surface.quads) {
    if (std::ranges::all_of(q, is_top)) quads.nodes.insert(quads.nodes.end(), q.begin(), q.end());
  }
  for (const FaceCells& faces : {triangles, quads}) {
    if (!faces.nodes.empty()) pressure.faces.push_back(faces);
  }
  return world;
}

Sweep disc(std::mt19937_64& random) {
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const Vec3 center = kOrigin + Vec3(real(3.0, 6.0), real(0.0, 3.0), real(0.5, 3.0));
  return disc_sweep(center, Vec3(1.0, real(-0.5, 0.5), real(-0.5, 0.5)), real(0.6, 1.4));
}

void expect_same(Simulation& found, Simulation& expected) {
  EXPECT_EQ(found.world().rest_positions(), expected.world().rest_positions());
  EXPECT_EQ(found.state().positions, expected.state().positions);
  EXPECT_EQ(found.state().velocities, expected.state().velocities);
  EXPECT_EQ(found.memory(Contact::kMemory), expected.memory(Contact::kMemory));
  const SurfaceSet& surfaces = found.world().contact()->surfaces();
  const SurfaceSet& others = expected.world().contact()->surfaces();
  EXPECT_EQ(surfaces.rest(), others.rest());
  EXPECT_EQ(surfaces.primitives().size(), others.primitives().size());
}

class EditedInContact : public testing::TestWithParam<Touch> {};

TEST_P(EditedInContact, GoesOnWithTheBitsOfAWorldLaidAnew) {
  const auto simulate = [&] { return test::simulate(description(GetParam()), test::implicit_euler()); };
  Simulation found = simulate();
  Simulation expected = simulate();
  found.prepare_edits();
  const std::vector<double>& described = found.world().description()->bodies[0].positions;
  ASSERT_FALSE(
      std::ranges::equal(described, std::span(found.world().rest_positions()).first(described.size())));
  std::mt19937_64 random(4);
  CutOptions options;
  options.divide = GetParam().divide;
  if (options.divide) options.t0 = 0.2;
  int cuts = 0;
  std::size_t touching = 0;
  for (int k = 0; k < 16; ++k) {
    found.step(kStep);
    expected.step(kStep);
    expect_same(found, expected);
    touching += found.memory(Contact::kMemory).size();
    if (k % 2 == 0) continue;
    if (k == 1 || k % 8 == 7) {
      const std::vector<std::int32_t> gone = {
          found.pieces("body")[0].cells[20 + static_cast<std::size_t>(k)]};
      found.remove_cells("body", gone);
      expected.remove_cells("body", gone);
    } else {
      const Sweep blade = disc(random);
      const Simulation::Edited edited = found.cut("body", blade, options);
      expected.cut("body", blade, options);
      EXPECT_FALSE(edited.relaid);
      cuts += edited.plan.cells_cut > 0 ? 1 : 0;
    }
    found.forget_solves();
    expected.forget_solves();
    expect_same(found, expected);
    ASSERT_FALSE(HasFailure()) << "step " << k;
  }
  EXPECT_GT(cuts, 3);
  EXPECT_GT(touching, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, EditedInContact,
    testing::Values(Touch{"table", Split::six, ContactMethod::augmented, false, false, false},
                    Touch{"itself", Split::six, ContactMethod::augmented, true, false, false},
                    Touch{"barrier", Split::six, ContactMethod::barrier, true, false, false},
                    Touch{"penalty", Split::six, ContactMethod::penalty, true, false, false},
                    Touch{"pressed", Split::six, ContactMethod::augmented, true, true, false},
                    Touch{"divided", Split::six, ContactMethod::augmented, true, true, true},
                    Touch{"hexahedra", Split::none, ContactMethod::augmented, true, true, false}),
    [](const auto& info) { return std::string(info.param.name); });

/// A mark taken after a cut is laid from its description, in which surfaces are not moved apart again.
TEST(ContactEdit, AMarkAfterACutIsReturnedTo) {
  Simulation simulation = test::simulate(
      description({"", Split::six, ContactMethod::augmented, true, false, false}), test::implicit_euler());
  simulation.prepare_edits();
  simulation.step(kStep);
  std::mt19937_64 random(4);
  simulation.cut("body", disc(random), {});
  const Simulation::Mark mark = simulation.mark();
  std::vector<std::vector<double>> ends;
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 3; ++i) simulation.step(kStep);
    ends.push_back(simulation.state().positions);
    ends.push_back(simulation.world().rest_positions());
    simulation.cut("body", disc(random), {});
    simulation.rewind(mark);
  }
  EXPECT_EQ(ends[0], ends[2]);
  EXPECT_EQ(ends[1], ends[3]);
}

/// Of a layer of cells that is inside out the walls of a cut would cross.
TEST(ContactEdit, ARefusedCutChangesNothing) {
  for (const bool divide : {false, true}) {
    const Touch touch{"", Split::six, ContactMethod::augmented, true, false, divide};
    CutOptions options;
    options.divide = divide;
    if (divide) options.t0 = 0.2;
    std::array<std::optional<Simulation>, 2> both;
    for (auto& one : both) {
      one.emplace(test::simulate(description(touch), test::implicit_euler()));
      one->prepare_edits();
      one->step(kStep);
      std::mt19937_64 random(5);
      for (int k = 0; k < 2; ++k) one->cut("body", disc(random), options);
    }
    auto& [found, expected] = both;
    const std::vector<double> places = found->state().positions;
    for (std::size_t i = 0; i < places.size(); i += 3) {
      double& x = found->state().positions[i];
      if (std::abs(x - kOrigin.x() - 4.5) < 0.7) x = 2.0 * (kOrigin.x() + 4.5) - x;
    }
    int refused = 0;
    for (const double x : {4.4, 4.6}) {
      const Sweep blade = disc_sweep(kOrigin + Vec3(x, 1.6, 1.4), Vec3(1, 0.1, -0.2), 1.3);
      try {
        found->cut("body", blade, options);
      } catch (const ParameterError&) {
        ++refused;
      }
    }
    ASSERT_EQ(refused, 2);
    found->state().positions = places;
    std::mt19937_64 random(6);
    for (int k = 0; k < 4; ++k) {
      const Sweep blade = disc(random);
      for (auto& one : both) {
        if (k > 0) one->cut("body", blade, options);
        one->step(kStep);
      }
      expect_same(*found, *expected);
      ASSERT_EQ(found->pieces("body").size(), expected->pieces("body").size());
      for (std::size_t i = 0; i < found->pieces("body").size(); ++i)
        EXPECT_EQ(found->pieces("body")[i].cells, expected->pieces("body")[i].cells);
    }
  }
}

}  // namespace
}  // namespace tissu
