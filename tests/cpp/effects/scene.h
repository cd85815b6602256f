#pragma once

/// The scenes of tissu-effects: a bar with nothing on it, and the same bar with one effect.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tissu/simulation/simulation.h"

namespace tissu::effects {

/// A simulation that is ready to step.
struct Scene {
  std::unique_ptr<Simulation> simulation;
  double h;                                   ///< [s]
  std::function<void(Simulation&)> before{};  ///< what is done before each step; empty: nothing
  State start{};
};

std::vector<std::string_view> scene_names();
/// A bar of 4 n x 2 n x 2 n boxes of six tetrahedra. Refuses names that are not known.
Scene make_scene(std::string_view name, int n);

/// Steps of a scene: the function in which instructions are counted.
extern "C" void tissu_effects_steps(Scene& scene, int steps);

}  // namespace tissu::effects
