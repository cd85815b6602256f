#include "tissu/simulation/matrices.h"

namespace tissu {
namespace {

using Matrix = std::unique_ptr<BlockMatrix>;

Matrix empty(const World& world) {
  auto matrix = std::make_unique<BlockMatrix>(world.sparsity(), world.isa(), world.threads());
  matrix->clear();
  return matrix;
}

Matrix assembled(const World& world, const State& state, StiffnessScale scale) {
  Matrix matrix = empty(world);
  for (const auto& model : world.forces()) {
    if (model->has_stiffness()) model->add_stiffness(state, scale, *matrix);
  }
  return matrix;
}

}  // namespace

std::vector<double> total_force(const World& world, const State& state) {
  std::vector<double> f(state.positions.size(), 0.0);
  for (const auto& model : world.forces()) model->add_force(state, f);
  return f;
}

Matrix stiffness_matrix(const World& world, const State& state) {
  return assembled(world, state, {-1.0, 0.0});
}

Matrix damping_matrix(const World& world, const State& state) { return assembled(world, state, {0.0, -1.0}); }

Matrix mass_matrix(const World& world, const State& state) {
  Matrix matrix = empty(world);
  world.mass().add_to(*matrix, state, 1.0);
  return matrix;
}

}  // namespace tissu
