#include "scene.h"

/// In a source of its own, so that its name reaches the symbol table as it stands.
namespace tissu::effects {

extern "C" void tissu_effects_steps(Scene& scene, int steps) {
  for (int i = 0; i < steps; ++i) {
    if (scene.before) scene.before(*scene.simulation);
    scene.simulation->step(scene.h);
  }
}

}  // namespace tissu::effects
