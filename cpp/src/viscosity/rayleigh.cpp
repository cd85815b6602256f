#include "tissu/viscosity/rayleigh.h"

#include <algorithm>
#include <utility>

#include "tissu/base/error.h"

namespace tissu {

Rayleigh::Rayleigh(std::vector<std::unique_ptr<ForceModel>> elastic, std::vector<double> masses, double alpha,
                   double beta)
    : elastic_(std::move(elastic)), masses_(std::move(masses)), alpha_(alpha), beta_(beta) {
  for (const auto& model : elastic_) {
    if (model->run_time().couples)
      throw Error("Rayleigh's damping found a model that couples rows at run time.");
  }
}

bool Rayleigh::damps(const ForceModel* model) const {
  return std::ranges::any_of(elastic_, [&](const auto& own) { return own.get() == model; });
}

bool Rayleigh::has_constant_stiffness() const {
  return std::ranges::all_of(elastic_, [](const auto& model) { return model->has_constant_stiffness(); });
}

void Rayleigh::couple(SparsityBuilder& builder) const {
  for (const auto& model : elastic_) model->couple(builder);
}

void Rayleigh::bind(const Sparsity& pattern) {
  for (const auto& model : elastic_) model->bind(pattern);
}

void Rayleigh::add_force(const State& state, Scratch& scratch, Reals f) const {
  for (const auto& model : elastic_) model->add_force(state, scratch, f);
  for (const auto& model : elastic_) model->add_product(state, scratch, {beta_, 0.0}, state.strains_by(), f);
  add_mass_product(1.0, state.velocities, f);
}

void Rayleigh::add_stiffness(const State& state, Scratch& scratch, StiffnessScale scale,
                             BlockMatrix& matrix) const {
  const double position = scale.position + beta_ * scale.velocity;
  for (const auto& model : elastic_) {
    model->add_stiffness(state, scratch, {position, 0.0, scale.definite}, matrix);
  }
  if (alpha_ == 0.0 || scale.velocity == 0.0) return;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    matrix.add_diagonal(static_cast<std::int32_t>(i), -alpha_ * scale.velocity * masses_[i]);
  }
}

void Rayleigh::add_product(const State& state, Scratch& scratch, StiffnessScale scale, ConstReals p,
                           Reals out) const {
  const double position = scale.position + beta_ * scale.velocity;
  for (const auto& model : elastic_) model->add_product(state, scratch, {position, 0.0}, p, out);
  add_mass_product(scale.velocity, p, out);
}

void Rayleigh::add_mass_product(double scale, ConstReals p, Reals out) const {
  if (alpha_ == 0.0 || scale == 0.0) return;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    const double c = -alpha_ * scale * masses_[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) out[k] += c * p[k];
  }
}

double Rayleigh::energy(const State& state, Scratch& scratch) const {
  double sum = 0.0;
  for (const auto& model : elastic_) sum += model->energy(state, scratch);
  return sum;
}

std::size_t Rayleigh::scratch_size() const {
  std::size_t most = 0;
  for (const auto& model : elastic_) most = std::max(most, model->scratch_size());
  return most;
}

RunTime Rayleigh::run_time() const {
  RunTime any;
  for (const auto& model : elastic_) {
    const RunTime one = model->run_time();
    any = {.begins = any.begins || one.begins, .remembers = any.remembers || one.remembers};
  }
  return any;
}

void Rayleigh::claim_memory(MemoryPlaces& places) {
  for (const auto& model : elastic_) model->claim_memory(places);
}

void Rayleigh::begin_step(State& state, Scratch& scratch, double h) const {
  for (const auto& model : elastic_) model->begin_step(state, scratch, h);
}

void Rayleigh::remember(State& state) const {
  for (const auto& model : elastic_) model->remember(state);
}

void Rayleigh::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  const auto* damped = dynamic_cast<const Rayleigh*>(&before);
  if (damped == nullptr) return;
  for (const auto& model : elastic_) {
    for (const auto& one : damped->elastic_) model->carry_memory(*one, then, now);
  }
}

void Rayleigh::check_memory(const State& state) const {
  for (const auto& model : elastic_) model->check_memory(state);
}

}  // namespace tissu
