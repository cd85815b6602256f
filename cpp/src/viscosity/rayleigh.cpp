#include "tissu/viscosity/rayleigh.h"

#include <algorithm>
#include <utility>

namespace tissu {

Rayleigh::Rayleigh(std::vector<std::unique_ptr<ForceModel>> elastic, std::vector<double> masses, double alpha,
                   double beta)
    : elastic_(std::move(elastic)), masses_(std::move(masses)), alpha_(alpha), beta_(beta) {}

bool Rayleigh::has_constant_stiffness() const {
  return std::ranges::all_of(elastic_, [](const auto& model) { return model->has_constant_stiffness(); });
}

void Rayleigh::couple(SparsityBuilder& builder) const {
  for (const auto& model : elastic_) model->couple(builder);
}

void Rayleigh::bind(const Sparsity& pattern) {
  for (const auto& model : elastic_) model->bind(pattern);
}

void Rayleigh::add_force(const State& state, Reals f) const {
  for (const auto& model : elastic_) model->add_force(state, f);
  add_product(state, {0.0, 1.0}, state.velocities, f);
}

void Rayleigh::add_stiffness(const State& state, StiffnessScale scale, BlockMatrix& matrix) const {
  const double position = scale.position + beta_ * scale.velocity;
  for (const auto& model : elastic_) {
    model->add_stiffness(state, {position, 0.0, scale.definite}, matrix);
  }
  if (alpha_ == 0.0 || scale.velocity == 0.0) return;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    matrix.add_diagonal(static_cast<std::int32_t>(i), -alpha_ * scale.velocity * masses_[i]);
  }
}

void Rayleigh::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) const {
  const double position = scale.position + beta_ * scale.velocity;
  for (const auto& model : elastic_) model->add_product(state, {position, 0.0}, p, out);
  if (alpha_ == 0.0 || scale.velocity == 0.0) return;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    const double c = -alpha_ * scale.velocity * masses_[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) out[k] += c * p[k];
  }
}

double Rayleigh::energy(const State& state) const {
  double sum = 0.0;
  for (const auto& model : elastic_) sum += model->energy(state);
  return sum;
}

}  // namespace tissu
