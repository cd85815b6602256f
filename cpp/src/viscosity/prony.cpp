#include "tissu/viscosity/prony.h"

#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

#include "tissu/base/error.h"

namespace tissu {
namespace {

constexpr std::size_t kEntries = 6;  ///< of a symmetric tensor

Lame small_strain(const ElasticBlock& block, std::int32_t cell) {
  const LawUse use{block.law, block.parameters, block.loaded};
  const LawInfo& info = law_info(block, use);
  if (use.loaded) {
    std::vector<double> parameters;
    for (const LawParameter& parameter : info.parameters) {
      parameters.push_back(of_cell(use.parameters.at(std::string(parameter.name)), cell));
    }
    const std::optional<Lame> moduli = use.loaded->small_strain(parameters);
    if (moduli) return *moduli;
  } else if (info.small_strain != nullptr) {
    std::vector<double> constants(info.constants.size());
    cell_constants(block, use, cell, constants);
    return info.small_strain(constants.data());
  }
  throw ParameterError("body \"" + block.body + "\" asks for a Prony series with the law \"" + block.law +
                       "\", which is not isotropic at rest; the branches need Lamé's moduli, so take another "
                       "viscosity.");
}

}  // namespace

Prony::Prony(const ElasticBlock& block, const std::vector<PronyBranch>& branches, ConstReals rest_positions,
             Isa isa, Threads threads)
    : ViscousCells(block, rest_positions, threads),
      kernels_(find_prony_kernels(isa, reference_.dimension == 3 ? reference_.nodes : 0)),
      shape_kernels_(find_shape_kernels(isa, reference_.nodes, reference_.dimension)) {
  if (kernels_ == nullptr) {
    throw ParameterError("body \"" + block_.body + "\" asks for a Prony series on cells of type " +
                         block_.element + "; only cells with a volume take it, so take another viscosity.");
  }
  for (const PronyBranch& branch : branches) {
    shares_.push_back(branch.weight);
    times_.push_back(branch.time);
  }
  lay_constants(2, uniform(block_.parameters), [&](std::size_t lane, std::span<double> lambda_and_mu) {
    const Lame moduli = small_strain(block_, order_.element[lane]);
    lambda_and_mu[0] = moduli.lambda;
    lambda_and_mu[1] = moduli.mu;
  });
}

Prony::Course Prony::course(const State& state) const {
  const double h = state.time - state.memory_time;
  Course result{};
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const double share = h / times_[k];
    result.decay[k] = std::exp(-share);
    result.rise[k] = share == 0.0 ? 1.0 : -std::expm1(-share) / share;
  }
  return result;
}

PronyView Prony::prony_view(const State& state, const Course& course) const {
  PronyView result{};
  static_cast<ElasticView&>(result) = view();
  result.at_point = kernels_->at_point;
  result.memory = state.memory[place_].data();
  result.branches = static_cast<int>(shares_.size());
  result.shares = shares_.data();
  result.decay = course.decay.data();
  result.rise = course.rise.data();
  return result;
}

void Prony::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const Course now = course(state);
  force_by(Loops{*shape_kernels_, prony_view(state, now), order_}, state.positions, f);
}

void Prony::add_product(const State& state, Scratch& /*scratch*/, StiffnessScale scale, ConstReals p,
                        Reals out) const {
  const Course now = course(state);
  product_by(Loops{*shape_kernels_, prony_view(state, now), order_}, state.positions, scale.position, p, out);
}

void Prony::add_stiffness(const State& state, Scratch& /*scratch*/, StiffnessScale scale,
                          BlockMatrix& matrix) const {
  const Course now = course(state);
  stiffness_by(Loops{*shape_kernels_, prony_view(state, now), order_}, state.positions, scale, matrix);
}

double Prony::energy(const State& state, Scratch& scratch) const {
  const Course now = course(state);
  return energy_by(Loops{*kernels_, prony_view(state, now), order_}, state.positions, scratch);
}

std::size_t Prony::reals_of_cell() const {
  return reference_.points.size() * (1 + shares_.size()) * kEntries;
}

std::size_t Prony::memory_size() const { return order_.element.size() * reals_of_cell(); }

void Prony::claim_memory(MemoryPlaces& places) {
  place_ = places.claim("Prony series of " + block_.body, memory_size());
}

void Prony::check_memory(const State& state) const {
  const std::size_t found = state.memory[place_].size();
  if (found == memory_size()) return;
  throw ParameterError("the state remembers " + std::to_string(found) +
                       " numbers of the Prony series of body \"" + block_.body + "\" where the world has " +
                       std::to_string(memory_size()) + "; restore it in the world that it was taken from.");
}

void Prony::remember(State& state) const {
  const Course now = course(state);
  const PronyView v = prony_view(state, now);
  double* memory = state.memory[place_].data();
  for_chunks(order_,
             [&](const Chunk& chunk) { kernels_->advance(v, chunk, state.positions.data(), memory); });
}

void Prony::carry_memory(const ForceModel& model, const Memory& then, Memory& now) const {
  const auto* before = dynamic_cast<const Prony*>(&model);
  if (before == nullptr || before->block_.body != block_.body) return;
  std::unordered_map<std::int32_t, std::size_t> lane_of;
  before->for_lanes(
      [&](std::size_t lane, std::size_t cell) { lane_of[before->block_.cell_numbers[cell]] = lane; });
  const std::vector<double>& kept = then[before->place_];
  std::vector<double>& memory = now[place_];
  const std::size_t reals = reals_of_cell();
  const std::vector<std::int32_t>& heirs_of = block_.heirs_of.empty() ? block_.cell_numbers : block_.heirs_of;
  for (std::size_t to = 0; to < order_.element.size(); ++to) {  // lanes that pad as well
    const auto found = lane_of.find(heirs_of[static_cast<std::size_t>(order_.element[to])]);
    if (found == lane_of.end()) continue;
    const std::size_t from = found->second;
    for (std::size_t k = 0; k < reals; ++k) {
      memory[(to / kLanes * reals + k) * kLanes + to % kLanes] =
          kept[(from / kLanes * reals + k) * kLanes + from % kLanes];
    }
  }
}

}  // namespace tissu
