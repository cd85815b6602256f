/// The viscosities of a world.

#include <algorithm>
#include <numeric>

#include "builder.h"
#include "tissu/base/error.h"
#include "tissu/viscosity/centroid_damping.h"
#include "tissu/viscosity/kelvin_voigt.h"
#include "tissu/viscosity/prony.h"
#include "tissu/viscosity/spring_dampers.h"

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

/// A node that is not an unknown has no speed of its own.
void refuse_eliminated(const Body& body) {
  if (std::ranges::all_of(body.models, [](const BodyModel* model) { return model->eliminated().empty(); }))
    return;
  throw ParameterError("body \"" + body.name +
                       "\" has a viscosity of its cells and a condensed region, whose inner nodes have no "
                       "speed; take Rayleigh's, or another model.");
}

}  // namespace

void WorldBuilder::add_viscosity(const BodyDescription& body, const Body& made) {
  const Viscosity& viscosity = body.viscosity;
  const ConstReals positions = world_.rest_positions();
  auto& forces = world_.forces_;
  check_viscosity(body.name, viscosity);
  if (viscosity.any()) refuse_eliminated(made);
  if (viscosity.shear > 0.0 || viscosity.bulk > 0.0) {
    const Lame coefficients{viscosity.bulk, viscosity.shear};
    for (const BodyModel* model : made.models) {
      if (model->springs() != nullptr) {
        forces.push_back(std::make_unique<SpringDampers>(*model->springs(), coefficients));
      } else {
        forces.push_back(std::make_unique<KelvinVoigt>(model->block(), coefficients, positions, world_.isa_,
                                                       world_.threads_));
      }
    }
  }
  if (viscosity.centroid > 0.0) {
    forces.push_back(std::make_unique<CentroidDamping>(made.models, viscosity.centroid, world_.threads_));
  }
  if (viscosity.prony.empty()) return;
  std::int32_t first_cell = 0;
  for (const BodyModel* model : made.models) {
    forces.push_back(std::make_unique<Prony>(numbered(*model, first_cell), viscosity.prony, positions,
                                             world_.isa_, world_.threads_));
    first_cell += model->cell_count();
  }
}

}  // namespace tissu
