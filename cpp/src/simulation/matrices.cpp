#include "tissu/simulation/matrices.h"

namespace tissu {
namespace {

AssembledMatrix empty(const World& world) {
  AssembledMatrix matrix{std::make_unique<BlockMatrix>(world.sparsity(), world.isa(), world.threads()), {}};
  matrix.blocks->clear();
  return matrix;
}

AssembledMatrix assembled(const World& world, const State& state, StiffnessScale scale) {
  AssembledMatrix matrix = empty(world);
  Scratch scratch;
  for (const auto& model : world.forces()) {
    if (model->run_time().couples) {
      model->add_couplings(state, scale, matrix.couplings);
    } else if (model->has_stiffness()) {
      model->add_stiffness(state, scratch, scale, *matrix.blocks);
    }
  }
  matrix.couplings.close(world.blocks(), nullptr);
  return matrix;
}

}  // namespace

std::vector<double> total_force(const World& world, const State& state) {
  std::vector<double> f(state.positions.size(), 0.0);
  Scratch scratch;
  for (const auto& model : world.forces()) model->add_force(state, scratch, f);
  return f;
}

AssembledMatrix stiffness_matrix(const World& world, const State& state) {
  return assembled(world, state, {-1.0, 0.0});
}

AssembledMatrix damping_matrix(const World& world, const State& state) {
  return assembled(world, state, {0.0, -1.0});
}

AssembledMatrix mass_matrix(const World& world, const State& state) {
  AssembledMatrix matrix = empty(world);
  world.mass().add_to(*matrix.blocks, state, 1.0);
  return matrix;
}

}  // namespace tissu
