#include "cube.h"

#include <cmath>
#include <utility>

#include "../beam.h"
#include "resident.h"

namespace tissu::bench {
namespace {

WorldDescription described(int tetrahedra, int threads) {
  const int n = static_cast<int>(std::lround(std::cbrt(tetrahedra / 6.0)));
  Beam beam;
  beam.cells = {n, n, n};
  beam.size = Vec3::Constant(0.1);
  beam.young = 1e4;
  beam.poisson = 0.3;
  beam.mass = 1.0;
  beam.rayleigh = false;
  beam.threads = threads;
  return describe(beam);
}

}  // namespace

Cube::Cube(int tetrahedra, int threads)
    : resident_(-resident_bytes()),
      world_(std::make_shared<const World>(described(tetrahedra, threads))),
      state_(world_->rest_state()),
      matrix_(world_->sparsity(), world_->isa(), world_->threads()) {
  resident_ += resident_bytes() - static_cast<double>(matrix_.bytes());
  assemble();
}

void Cube::assemble() {
  Scratch scratch;
  matrix_.clear();
  world_->mass().add_to(matrix_, state_, 1.0);
  for (const auto& force : world_->forces()) {
    if (force->has_stiffness())
      force->add_stiffness(state_, scratch, {-kStepSeconds * kStepSeconds, 0.0}, matrix_);
  }
  matrix_.constrain(world_->fixed().rows(), world_->fixed().masks());
}

Cube& cube_of(int tetrahedra, int threads) {
  static std::unique_ptr<Cube> kept;
  static std::pair<int, int> key;
  if (kept == nullptr || key != std::pair(tetrahedra, threads)) {
    kept.reset();
    kept = std::make_unique<Cube>(tetrahedra, threads);
    key = {tetrahedra, threads};
  }
  return *kept;
}

}  // namespace tissu::bench
