#pragma once

/// The cube that sizes are compared on: 10 cm of soft tissue (10 kPa, nu 0.3, 1 kg) in tetrahedra of
/// St-Venant–Kirchhoff, one face held, bent by its weight in implicit steps of 10 ms. It is the same body at
/// every size, so that more elements are smaller ones.

#include <memory>

#include "tissu/assembly/block_matrix.h"
#include "tissu/world/world.h"

namespace tissu::bench {

inline constexpr double kStepSeconds = 0.01;

/// The cube at rest with the matrix of its first step.
class Cube {
 public:
  Cube(int tetrahedra, int threads);
  Cube(const Cube&) = delete;
  Cube& operator=(const Cube&) = delete;

  [[nodiscard]] const std::shared_ptr<const World>& world() const { return world_; }
  [[nodiscard]] const BodyModel& model() const { return *world_->bodies().front().models.front(); }
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double elements() const { return model().cell_count(); }
  [[nodiscard]] const BlockMatrix& matrix() const { return matrix_; }
  /// M - h^2 df/dx with the held nodes as the identity, as a step makes it.
  void assemble();
  /// What the process grew by while the world was made [bytes].
  [[nodiscard]] double resident() const { return resident_; }

 private:
  double resident_;
  std::shared_ptr<const World> world_;
  State state_;
  BlockMatrix matrix_;
};

/// One is kept until another is asked for: rows of a size follow each other.
Cube& cube_of(int tetrahedra, int threads);

}  // namespace tissu::bench
