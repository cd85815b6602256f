#include "tissu/step/explicit_euler.h"

#include <algorithm>
#include <cmath>

namespace tissu {
namespace {

constexpr double kGrowth = 0.01;  ///< [1/s]

double forward(double h, double omega, double damping) {
  const auto [one, other] = eigenvalues(omega, damping);
  return std::max(std::abs(1.0 + h * one), std::abs(1.0 + h * other));
}

/// One step is [1 - h^2 omega^2, h (1 - h c); -h omega^2, 1 - h c] on (x, v).
double symplectic(double h, double omega, double damping) {
  const double trace = 2.0 - h * damping - h * h * omega * omega;
  const double determinant = 1.0 - h * damping;
  const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * trace * trace - determinant));
  return std::max(std::abs(0.5 * trace + root), std::abs(0.5 * trace - root));
}

}  // namespace

void ExplicitEuler::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  ExplicitMethod::prepare(world, solver, profile);
  a_ = start().velocities;
}

Amplification ExplicitEuler::amplification() const { return {&forward, kGrowth}; }

void ExplicitEuler::advance(State& state, double h) {
  acceleration(start(), 1.0, a_);
  for (std::size_t i = 0; i < a_.size(); ++i) state.velocities[i] += h * a_[i];
  go(start().velocities, 0.0, h, state);
}

void SymplecticEuler::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  ExplicitMethod::prepare(world, solver, profile);
  a_ = start().velocities;
}

Amplification SymplecticEuler::amplification() const { return {&symplectic, 0.0}; }

void SymplecticEuler::advance(State& state, double h) {
  acceleration(start(), 1.0, a_);
  for (std::size_t i = 0; i < a_.size(); ++i) state.velocities[i] += h * a_[i];
  go(state.velocities, 1.0, h, state);
}

}  // namespace tissu
