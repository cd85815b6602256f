#pragma once

/// Lumped mass: one number for each node, and mass and inertia for each frame.

#include <vector>

#include "tissu/assembly/block_matrix.h"
#include "tissu/state/state.h"

namespace tissu {

class Mass {
 public:
  Mass() = default;
  Mass(std::vector<double> nodal, std::vector<Frame> frames);

  /// Mass of each 3-vector of the unknown [kg]; zero for a frame's rotation.
  [[nodiscard]] const std::vector<double>& nodal() const { return nodal_; }
  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  [[nodiscard]] double total() const;
  /// After an edit in place: the mass of a node [kg].
  void set_nodal(std::int32_t row, double mass) { nodal_[static_cast<std::size_t>(row)] = mass; }

  /// out += scale M v
  void add_product(const State& state, double scale, ConstReals v, Reals out) const;
  /// f = M^-1 f; zero where there is no mass
  void divide(const State& state, Reals f) const;
  /// matrix += scale M
  void add_to(BlockMatrix& matrix, const State& state, double scale) const;
  /// 1/2 v^T M v [J]
  [[nodiscard]] double kinetic_energy(const State& state) const;

 private:
  /// The same for rows without rotations.
  void divide_rows(std::int32_t begin, std::int32_t end, Reals f) const;

  std::vector<double> nodal_;
  std::vector<Frame> frames_;
};

}  // namespace tissu
