#include "tissu/force/load.h"

#include <utility>

#include "tissu/assembly/fixed_dofs.h"

namespace tissu {
double History::at(double time) const { return interpolate(times, factors, time, 1.0); }

NodalLoad::NodalLoad(std::string name, std::vector<std::int32_t> nodes, std::vector<double> forces,
                     History history)
    : name_(std::move(name)),
      nodes_(std::move(nodes)),
      forces_(std::move(forces)),
      history_(std::move(history)) {}

void NodalLoad::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const double factor = state.load_factor * history_.at(state.time);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    block(f, nodes_[i]) += factor * block(ConstReals(forces_), static_cast<std::int32_t>(i));
  }
}

double NodalLoad::energy(const State& state, Scratch& /*scratch*/) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    sum -= block(ConstReals(forces_), static_cast<std::int32_t>(i))
               .dot(block(ConstReals(state.positions), nodes_[i]));
  }
  return history_.at(state.time) * sum;
}

}  // namespace tissu
