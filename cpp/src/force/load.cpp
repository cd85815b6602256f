#include "tissu/force/load.h"

#include <utility>

namespace tissu {

NodalLoad::NodalLoad(std::string name, std::vector<std::int32_t> nodes, std::vector<double> forces,
                     History history)
    : name_(std::move(name)),
      nodes_(std::move(nodes)),
      forces_(std::move(forces)),
      history_(std::move(history)) {}

void NodalLoad::act_on(std::vector<std::int32_t> nodes, std::vector<double> forces) {
  nodes_ = std::move(nodes);
  forces_ = std::move(forces);
  change_.resize(kMadeOf + forces_.size());
}

void NodalLoad::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const double factor = state.load_factor * change_.factor(state, history_);
  const ConstReals all = forces(state);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    block(f, nodes_[i]) += factor * block(all, static_cast<std::int32_t>(i));
  }
}

double NodalLoad::energy(const State& state, Scratch& /*scratch*/) const {
  const ConstReals all = forces(state);
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    sum -= block(all, static_cast<std::int32_t>(i)).dot(block(ConstReals(state.positions), nodes_[i]));
  }
  return state.load_factor * change_.factor(state, history_) * sum;
}

void NodalLoad::claim_memory(MemoryPlaces& places) { change_.claim(name_, kMadeOf + forces_.size(), places); }

void NodalLoad::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  const auto* load = dynamic_cast<const NodalLoad*>(&before);
  if (load != nullptr && load->name_ == name_) change_.carry(load->change_, then, now);
}

ConstReals NodalLoad::forces(const State& state) const {
  const double* changed = change_.values(state);
  return changed == nullptr ? ConstReals(forces_) : ConstReals(changed + kMadeOf, forces_.size());
}

}  // namespace tissu
