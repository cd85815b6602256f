#include <gtest/gtest.h>

#include <memory>

#include "../world/sample_worlds.h"
#include "room.h"
#include "tissu/force/frame_weight.h"
#include "tissu/force/grabs.h"
#include "tissu/force/gravity.h"
#include "tissu/force/load.h"
#include "tissu/mesh/topology.h"
#include "tissu/model/models.h"
#include "verbs.h"

/// The line search of a static step follows the energy while the loads grow: at every share of the loads the
/// force is the negative gradient of the energy.
namespace tissu {
namespace {

/// A box of tetrahedra and, behind its nodes, a frame of two blocks.
class LoadEnergy : public testing::TestWithParam<double> {
 protected:
  LoadEnergy() {
    nodes_ = mesh_.node_count();
    state_.positions = mesh_.positions;
    const std::vector<double> origin = random_.numbers(3);
    state_.positions.insert(state_.positions.end(), origin.begin(), origin.end());
    state_.positions.insert(state_.positions.end(), 3, 0.0);
    state_.velocities.assign(state_.positions.size(), 0.0);
    state_.rotations = {random_.rotation()};
    frames_ = {{nodes_, nodes_ + 1, 1.0, Mat3::Identity()}};
    state_.time = 0.5;
    state_.load_factor = GetParam();
  }

  /// Energies of 100 J at most over steps of 1e-3 m: 1e-11 of round-off, two digits more; the differences err
  /// by h^4 / 30 of a fifth derivative of size 100, 3e-12.
  void expect_gradient(ForceModel& model) {
    MemoryPlaces places;
    model.claim_memory(places);
    if (state_.memory.empty()) state_.memory = places.at_rest();
    for (int i = 0; i < 3; ++i) {
      const std::vector<double> p = random_.numbers(state_.positions.size());
      const double work = test::force_of(model, state_).dot(test::view(p));
      const double slope = test::derivative(
          [&](double t) {
            State moved = state_;
            move(state_, frames_, p, t, moved);
            return model.energy(moved, test::scratch());
          },
          1e-3);
      EXPECT_GT(std::abs(work), 1e-3);
      EXPECT_NEAR(work, -slope, 1e-9);
    }
  }
  [[nodiscard]] std::vector<FaceCells> skin() const {
    FaceCells all;
    for (const auto& t : boundary_surface(mesh_).triangles) {
      all.nodes.insert(all.nodes.end(), t.begin(), t.end());
    }
    return {all};
  }

  test::Random random_{67};
  Mesh mesh_ = test::distorted_box({2, 2, 2}, Split::six, 0.2);
  std::int32_t nodes_ = 0;
  std::vector<Frame> frames_;
  State state_;
  History history_{{0.0, 1.0}, {0.0, 1.5}};
};

TEST_P(LoadEnergy, OfGravity) {
  Gravity gravity(std::vector<double>(static_cast<std::size_t>(nodes_) + 1, 0.2), Vec3(1.0, -2.0, -9.81));
  expect_gradient(gravity);
}

TEST_P(LoadEnergy, OfTheWeightThatFramesCarry) {
  FrameWeight weight(frames_, {Vec3(0.3, -0.2, 0.5)}, Vec3(1.0, -2.0, -9.81));
  expect_gradient(weight);
}

TEST_P(LoadEnergy, OfForcesOnNodes) {
  NodalLoad load("hand", {3, 5}, {1, 2, 3, -4, 5, -6}, history_);
  expect_gradient(load);
}

TEST_P(LoadEnergy, OfForcesThatWereChanged) {
  NodalLoad load("hand", {3, 5}, {1, 2, 3, -4, 5, -6}, history_);
  state_.memory = {{1.0, 0.7, 0.0, 0.0, 0.0, 6, 5, 4, 3, 2, 1}};
  expect_gradient(load);
}

TEST_P(LoadEnergy, OfPressure) {
  Pressure pressure("inside", skin(), 2.0, history_);
  expect_gradient(pressure);
}

TEST_P(LoadEnergy, OfPressureThatWasChanged) {
  Pressure pressure("inside", skin(), 2.0, history_);
  state_.memory = {{1.0, 0.7, 3.0}};
  expect_gradient(pressure);
}

TEST_P(LoadEnergy, OfPressureOnTheEdgesOfAFlatBody) {
  FaceCells edges{"line", {0, 1, 1, 4, 4, 3, 3, 0}, 0.1};
  Pressure pressure("inside", {edges}, 20.0, history_);
  expect_gradient(pressure);
}

TEST_P(LoadEnergy, OfGrabs) {
  Grabs grabs;
  MemoryPlaces places;
  grabs.claim_memory(places);
  state_.memory = places.at_rest();
  GrabTable table(state_.memory[0]);
  table.add(1, {{{1, 1.0}}}, Vec3(1, 2, 3), 5.0);
  table.add(2, {{{nodes_, 1.0}}, 0, nodes_ + 1, Vec3(0.3, -0.2, 0.5)}, Vec3(0, 1, 0), 2.0);
  expect_gradient(grabs);
}

/// A condensed region carries the weight of the nodes that it has taken away.
TEST_P(LoadEnergy, OfACondensedRegionUnderItsWeight) {
  ElasticBlock block = test::elastic_block(mesh_.blocks[0], {"hooke", 3.0, 0.3, 2.0});
  CondensedOptions options{.kept = {}, .gravity = Vec3(1.0, -2.0, -9.81)};
  for (std::int32_t i = 0; i < nodes_; ++i) {
    if (i != 13) options.kept.push_back(i);
  }
  block.model = options;
  const auto region = make_model(block, mesh_.positions, choose_isa(), Threads(1));
  const std::vector<double> p = random_.numbers(state_.positions.size());
  move(State(state_), frames_, p, 0.1, state_);
  expect_gradient(*region);
}

INSTANTIATE_TEST_SUITE_P(Shares, LoadEnergy, testing::Values(0.3, 1.0),
                         [](const auto& info) { return info.param < 1.0 ? "part" : "whole"; });

}  // namespace
}  // namespace tissu
