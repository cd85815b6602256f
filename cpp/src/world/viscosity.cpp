/// The viscosities of a world, and what they remember.

#include <algorithm>
#include <numeric>

#include "tissu/base/error.h"
#include "tissu/viscosity/centroid_damping.h"
#include "tissu/viscosity/kelvin_voigt.h"
#include "tissu/viscosity/spring_dampers.h"
#include "tissu/world/world.h"

namespace tissu {
namespace {

/// A model's cells with their numbers in the body, of which `first` is the first.
ElasticBlock numbered(const BodyModel& model, std::int32_t first) {
  ElasticBlock block = model.block();
  if (block.cell_numbers.empty()) {
    block.cell_numbers.resize(static_cast<std::size_t>(model.cell_count()));
    std::iota(block.cell_numbers.begin(), block.cell_numbers.end(), first);
  }
  return block;
}

/// A node that is no unknown has no speed of its own.
void refuse_eliminated(const Body& body) {
  if (std::ranges::all_of(body.models, [](const BodyModel* model) { return model->eliminated().empty(); }))
    return;
  throw ParameterError("body \"" + body.name +
                       "\" has a viscosity of its cells and a condensed region, whose inner nodes have no "
                       "speed; take Rayleigh's, or another model.");
}

}  // namespace

void World::add_viscosity(const BodyDescription& body, const Body& made) {
  const Viscosity& viscosity = body.viscosity;
  check_viscosity(body.name, viscosity);
  if (viscosity.any()) refuse_eliminated(made);
  if (viscosity.shear > 0.0 || viscosity.bulk > 0.0) {
    const Lame coefficients{viscosity.bulk, viscosity.shear};
    for (const BodyModel* model : made.models) {
      if (const auto* springs = dynamic_cast<const MassSpring*>(model)) {
        forces_.push_back(std::make_unique<SpringDampers>(*springs, coefficients));
      } else {
        forces_.push_back(
            std::make_unique<KelvinVoigt>(model->block(), coefficients, rest_positions_, isa_, threads_));
      }
    }
  }
  if (viscosity.centroid > 0.0) {
    forces_.push_back(std::make_unique<CentroidDamping>(made.models, viscosity.centroid, threads_));
  }
  if (viscosity.prony.empty()) return;
  std::int32_t first_cell = 0;
  for (const BodyModel* model : made.models) {
    auto prony = std::make_unique<Prony>(numbered(*model, first_cell), viscosity.prony, memory_size_,
                                         rest_positions_, isa_, threads_);
    first_cell += model->cell_count();
    memory_size_ += prony->memory_size();
    prony_.push_back(prony.get());
    forces_.push_back(std::move(prony));
  }
}

void World::remember(State& state) const {
  if (prony_.empty()) return;
  for (const Prony* prony : prony_) prony->advance(state);
  state.memory_time = state.time;
}

void World::carry_memory(const World& before, State& state) const {
  if (prony_.empty()) return;
  std::vector<double> memory(memory_size_, 0.0);
  for (const Prony* now : prony_) {
    for (const Prony* then : before.prony_) {
      if (then->block().body == now->block().body) now->take_over(*then, state.memory, memory);
    }
  }
  state.memory = std::move(memory);
}

}  // namespace tissu
