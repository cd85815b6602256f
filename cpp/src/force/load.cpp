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

void NodalLoad::set_left(std::vector<LoadLeft> left, bool along_normals) {
  left_ = std::move(left);
  along_normals_ = along_normals;
}

template <class Function>
void NodalLoad::for_forces(const State& state, Function&& f) const {
  const double* changed = change_.values(state);
  const ConstReals all =
      changed == nullptr ? ConstReals(forces_) : ConstReals(changed + kMadeOf, forces_.size());
  auto left = left_.begin();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec3 force = block(all, static_cast<std::int32_t>(i));
    if (left != left_.end() && left->place == i) {
      if (changed != nullptr) {
        const Vec3 unit =
            along_normals_ ? Vec3(Vec3::Constant(-changed[0])) : Vec3(changed[0], changed[1], changed[2]);
        force = left->per_unit.cwiseProduct(unit);
      }
      ++left;
    }
    f(nodes_[i], force);
  }
}

void NodalLoad::add_force(const State& state, Scratch& /*scratch*/, Reals f) const {
  const double factor = state.load_factor * change_.factor(state, history_);
  for_forces(state, [&](std::int32_t node, const Vec3& force) { block(f, node) += factor * force; });
}

double NodalLoad::energy(const State& state, Scratch& /*scratch*/) const {
  double sum = 0.0;
  for_forces(state, [&](std::int32_t node, const Vec3& force) {
    sum -= force.dot(block(ConstReals(state.positions), node));
  });
  return state.load_factor * change_.factor(state, history_) * sum;
}

void NodalLoad::claim_memory(MemoryPlaces& places) { change_.claim(name_, kMadeOf + forces_.size(), places); }

void NodalLoad::carry_memory(const ForceModel& before, const Memory& then, Memory& now) const {
  const auto* load = dynamic_cast<const NodalLoad*>(&before);
  if (load != nullptr && load->name_ == name_) change_.carry(load->change_, then, now);
}

}  // namespace tissu
