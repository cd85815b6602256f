/// tissu-effects: steps of a bare bar and of bars with one effect, for counting instructions and for timing.
///   tissu-effects list
///   tissu-effects count N STEPS SCENE...          one scene after the other
///   tissu-effects time N STEPS ROUNDS SCENE...    in turn, ROUNDS times; seconds of STEPS steps
/// Prints one JSON object a line.

#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>

#include "ascending_memory.h"
#include "scene.h"
#include "tissu/base/build.h"

namespace tissu::effects {
namespace {

constexpr int kWarmUp = 2;  ///< steps, in which what is made once is made

/// Of the bits of positions and velocities.
std::uint64_t checksum(const State& state) {
  std::uint64_t sum = 14695981039346656037U;  // FNV-1a
  for (const std::vector<double>* values : {&state.positions, &state.velocities}) {
    for (const double value : *values) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      sum = (sum ^ bits) * 1099511628211U;
    }
  }
  return sum;
}

void warm_up(Scene& scene) {
  for (int i = 0; i < kWarmUp; ++i) {
    if (scene.before) scene.before(*scene.simulation);
    scene.simulation->step(scene.h);
  }
}

void count(int n, int steps, const std::vector<std::string>& names) {
  let_memory_ascend();
  for (const std::string& name : names) {
    Scene scene = make_scene(name, n);
    warm_up(scene);
    scene.simulation->profile().clear();
    tissu_effects_steps(scene, steps);
    const Simulation& simulation = *scene.simulation;
    const World& world = simulation.world();
    int cells = 0;
    for (const BodyModel* model : world.bodies().front().models) cells += model->cell_count();
    std::printf(
        "{\"scene\": \"%s\", \"isa\": \"%s\", \"nodes\": %d, \"cells\": %d, \"solves\": %lld, "
        "\"iterations\": %lld, \"checksum\": \"%016llx\"}\n",
        name.c_str(), std::string(tissu::name(world.isa())).c_str(), world.blocks(), cells,
        static_cast<long long>(scene.simulation->profile().solves().solves),
        static_cast<long long>(scene.simulation->profile().solves().iterations),
        static_cast<unsigned long long>(checksum(simulation.state())));
  }
}

void time(int n, int steps, int rounds, const std::vector<std::string>& names) {
  std::vector<Scene> scenes;
  for (const std::string& name : names) {
    scenes.push_back(make_scene(name, n));
    warm_up(scenes.back());
  }
  std::vector<std::vector<double>> seconds(scenes.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      scenes[i].simulation->state() = scenes[i].start;
      const auto start = std::chrono::steady_clock::now();
      tissu_effects_steps(scenes[i], steps);
      seconds[i].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const World& world = scenes[i].simulation->world();
    std::printf("{\"scene\": \"%s\", \"isa\": \"%s\", \"compiler\": \"%s\", \"nodes\": %d, \"seconds\": [",
                names[i].c_str(), std::string(tissu::name(world.isa())).c_str(),
                build_info().compiler.c_str(), world.blocks());
    for (std::size_t k = 0; k < seconds[i].size(); ++k) {
      std::printf("%s%.9f", k == 0 ? "" : ", ", seconds[i][k]);
    }
    std::printf("]}\n");
  }
}

int run(const std::vector<std::string>& arguments) {
  const std::size_t given = arguments.size();
  const std::string job = given == 0 ? "" : arguments[0];
  const auto number = [&](std::size_t i) { return std::stoi(arguments.at(i)); };
  const auto names_from = [&](std::size_t i) {
    return std::vector<std::string>(arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
  };
  if (job == "list") {
    for (const std::string_view name : scene_names()) std::cout << name << '\n';
  } else if (job == "count" && given > 3) {
    count(number(1), number(2), names_from(3));
  } else if (job == "time" && given > 4) {
    time(number(1), number(2), number(3), names_from(4));
  } else {
    std::cerr << "tissu-effects list | count N STEPS SCENE... | time N STEPS ROUNDS SCENE...\n";
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace tissu::effects

int main(int argc, char** argv) {
  try {
    return tissu::effects::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "tissu-effects: " << error.what() << '\n';
    return 1;
  }
}
