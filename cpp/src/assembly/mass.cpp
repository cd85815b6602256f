#include "tissu/assembly/mass.h"

#include <Eigen/Cholesky>
#include <numeric>
#include <utility>

namespace tissu {

Mass::Mass(std::vector<double> nodal, std::vector<Frame> frames)
    : nodal_(std::move(nodal)), frames_(std::move(frames)) {}

double Mass::total() const { return std::accumulate(nodal_.begin(), nodal_.end(), 0.0); }

void Mass::add_product(const State& state, double scale, ConstReals v, Reals out) const {
  for (std::size_t i = 0; i < nodal_.size(); ++i) {
    const double m = scale * nodal_[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) out[k] += m * v[k];
  }
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const std::int32_t r = frames_[k].rotation;
    block(out, r) += scale * (spatial_inertia(frames_[k], state.rotations[k]) * block(v, r));
  }
}

void Mass::divide(const State& state, Reals f) const {
  std::int32_t from = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const std::int32_t r = frames_[k].rotation;
    divide_rows(from, r, f);
    auto value = block(f, r);
    value = spatial_inertia(frames_[k], state.rotations[k]).ldlt().solve(Vec3(value));
    from = r + 1;
  }
  divide_rows(from, static_cast<std::int32_t>(nodal_.size()), f);
}

void Mass::divide_rows(std::int32_t begin, std::int32_t end, Reals f) const {
  for (std::int32_t i = begin; i < end; ++i) {
    const double m = nodal_[static_cast<std::size_t>(i)];
    auto value = block(f, i);
    if (m > 0.0) {
      value /= m;
    } else {
      value.setZero();
    }
  }
}

void Mass::add_to(BlockMatrix& matrix, const State& state, double scale) const {
  double* values = matrix.values();
  for (std::size_t i = 0; i < nodal_.size(); ++i) {
    if (nodal_[i] == 0.0) continue;
    const double m = scale * nodal_[i];
    double* to = values + 9 * matrix.diagonal_slot(static_cast<std::int32_t>(i));
    for (int k = 0; k < 3; ++k) to[4 * k] += m;
  }
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const std::int32_t r = frames_[k].rotation;
    matrix.add(r, r, scale * spatial_inertia(frames_[k], state.rotations[k]));
  }
}

double Mass::kinetic_energy(const State& state) const {
  const ConstReals v = state.velocities;
  double sum = 0.0;
  for (std::size_t i = 0; i < nodal_.size(); ++i) {
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) sum += nodal_[i] * v[k] * v[k];
  }
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const Vec3 spin = block(v, frames_[k].rotation);
    sum += spin.dot(spatial_inertia(frames_[k], state.rotations[k]) * spin);
  }
  return 0.5 * sum;
}

}  // namespace tissu
