#include <gtest/gtest.h>

#include "../base/allocations.h"
#include "../world/sample_worlds.h"
#include "tissu/mesh/topology.h"
#include "tissu/step/explicit_euler.h"
#include "tissu/step/runge_kutta.h"

/// A step that sees no more contacts than one before it takes no memory.

namespace tissu {
namespace {

#ifdef TISSU_COUNTS_ALLOCATIONS

using test::allocations;
using test::counting;

SurfaceDescription surface_of(const Mesh& mesh, const char* name) {
  SurfaceDescription surface{.name = name, .closed = true};
  surface.triangles = boundary_surface(mesh).triangles;
  return surface;
}

/// A block on a block that is held, and both beside a plane.
WorldDescription two_blocks() {
  const Mesh low = box_mesh(Vec3::Zero(), Vec3(1, 1, 1), {3, 3, 3}, Split::six);
  const Mesh high = box_mesh(Vec3(0.1, 0.1, 1.02), Vec3(1, 1, 1), {4, 4, 4}, Split::six);
  WorldDescription world;
  world.bodies = {test::body_of(low, {.young = 1e4}, "low"), test::body_of(high, {.young = 1e4}, "high")};
  for (BodyDescription& body : world.bodies) body.rayleigh = {5.0, 0.01};
  world.gravity = Vec3(0, 0, -9.81);
  world.fixed = {test::fixed(test::nodes_at(low, 2, 0.0))};
  world.fixed[0].body = "low";
  ContactDescription contact;
  contact.bodies = {surface_of(low, "low"), surface_of(high, "high")};
  ObstacleDescription floor;
  floor.surface.name = "floor";
  floor.plane = true;
  floor.origin = Vec3(0, 0, -0.02);
  contact.obstacles = {floor};
  contact.pairs = {{.a = 0, .b = 1, .friction = 0.5, .gap = 0.02}, {.a = 1, .b = 2, .gap = 0.02}};
  world.contact = contact;
  return world;
}

/// Allocations, and contacts, of ten steps after many.
void count_steps(Integrator& method, const WorldDescription& description, double h) {
  const World world(description);
  ConjugateGradient solver({1e-6, 5000});
  Profile profile;
  method.prepare(world, &solver, profile);
  State state = world.rest_state();
  for (int i = 0; i < 300; ++i) method.step(state, h);
  allocations = 0;
  counting = true;
  int contacts = 0;
  for (int i = 0; i < 10; ++i) contacts += method.step(state, h).contacts;
  counting = false;
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(contacts, 10);
}

#endif

TEST(ContactAllocation, AStepAtRestTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  ImplicitEuler method({1, 1e-6});
  count_steps(method, two_blocks(), 0.01);
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

TEST(ContactAllocation, AnExplicitStepTakesNone) {
#ifdef TISSU_COUNTS_ALLOCATIONS
  for (const ContactMethod response : {ContactMethod::impulse, ContactMethod::penalty}) {
    WorldDescription description = two_blocks();
    description.contact->method = response;
    for (BodyDescription& body : description.bodies) body.rayleigh = {5.0, 0.0};
    SymplecticEuler euler;
    count_steps(euler, description, 1e-3);
    RungeKutta runge_kutta(4);
    count_steps(runge_kutta, description, 1e-3);
  }
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
#endif
}

}  // namespace
}  // namespace tissu
