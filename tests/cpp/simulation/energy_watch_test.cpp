#include "tissu/simulation/energy_watch.h"

#include <gtest/gtest.h>

#include "../world/sample_worlds.h"

/// Where energy can only be kept or lost it is watched; whatever may give energy ends that.
namespace tissu {
namespace {

class Watched : public testing::Test {
 protected:
  Mesh mesh_ = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}, Split::six);
  WorldDescription description_ = closed();

  WorldDescription closed() const {
    WorldDescription world;
    world.bodies = {test::body_of(mesh_, {.law = "stvk", .young = 100.0})};
    world.bodies[0].rayleigh = {0.1, 0.001};
    world.gravity = Vec3(0, 0, -1);
    world.fixed = {test::fixed(test::nodes_at(mesh_, 0, 0.0))};
    world.loads = {{"hand", "body", {3}, {0.1, 0.0, 0.0}, {}}};
    return world;
  }
  [[nodiscard]] bool is_watched() const { return EnergyWatch::can_watch(World(description_)); }
};

TEST_F(Watched, GravityDampingAndLoadsThatStay) { EXPECT_TRUE(is_watched()); }

TEST_F(Watched, NoLoadThatChangesWithTime) {
  description_.loads[0].history = {{0.0, 1.0}, {0.0, 1.0}};
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, NoPressure) {
  description_.pressures = {{"inside", "body", {{"triangle", {0, 1, 2}}}, 10.0, {}}};
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, NoMaterialThatRemembers) {
  description_.bodies[0].viscosity = {0.0, 0.0, 0.0, {{0.5, 0.1}}};
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, NoLinks) {
  description_.links = true;
  EXPECT_FALSE(is_watched());
}

TEST_F(Watched, NoNodesThatAreLed) {
  Motion motion;
  motion.times = {0.0, 1.0};
  motion.displacements = {Vec3::Zero(), Vec3(0.1, 0.0, 0.0)};
  description_.fixed[0].motion = motion;
  EXPECT_FALSE(is_watched());
}

}  // namespace
}  // namespace tissu
