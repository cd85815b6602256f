#pragma once

/// One cell of every element there is, somewhat distorted, moved and moving.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "../cell/reference_nodes.h"
#include "../force/verbs.h"
#include "../world/sample_worlds.h"

namespace tissu::test {

struct ViscousSample {
  ElasticBlock block;
  std::vector<double> positions;
  State state;  ///< deformed and moving
};

/// Below three dimensions it lies turned in space.
inline ViscousSample viscous_sample(std::string_view element) {
  ViscousSample made;
  Random random(17);
  const bool thin = find_element(element)->dimension < 3;
  const Mat3 turn = thin ? Mat3(Eigen::AngleAxisd(0.9, Vec3(0.48, -0.6, 0.64))) : Mat3(Mat3::Identity());
  for (const Vec3& node : reference_nodes(element)) {
    const Vec3 x = turn * (node + random.vector(0.04));
    made.positions.insert(made.positions.end(), x.data(), x.data() + 3);
    made.block.cells.push_back(static_cast<std::int32_t>(made.block.cells.size()));
  }
  made.block.body = "body";
  made.block.element = element;
  made.block.parameters = {{"young", {3.0}}, {"poisson", {0.3}}};
  made.block.density = {2.0};
  made.state.positions = made.positions;
  for (double& x : made.state.positions) x += random.number(0.05);
  made.state.velocities = random.numbers(made.positions.size());
  return made;
}

inline std::vector<std::string> element_names(bool volumes_only) {
  std::vector<std::string> names;
  for (const ElementInfo& element : elements()) {
    if (element.dimension == 3 || !volumes_only) names.emplace_back(element.name);
  }
  return names;
}

/// The state with v + t p for v.
inline State faster(const State& state, ConstReals p, double t) {
  State result = state;
  for (std::size_t i = 0; i < p.size(); ++i) result.velocities[i] += t * p[i];
  return result;
}

/// v = drift + spin x x
inline State rigidly_moving(const State& state, const Vec3& drift, const Vec3& spin) {
  State result = state;
  for (std::int32_t i = 0; i < state.blocks(); ++i) {
    block(Reals(result.velocities), i) = drift + spin.cross(Vec3(block(ConstReals(state.positions), i)));
  }
  return result;
}

}  // namespace tissu::test
