#include "tissu/simulation/energy_watch.h"

#include <algorithm>
#include <cmath>

#include "tissu/base/number_text.h"
#include "tissu/contact/contact.h"

namespace tissu {
namespace {

constexpr double kRoundOff = 1e-10;  ///< of the scene's extent

}  // namespace

Energy energy_of(const World& world, const State& state, Scratch& scratch) {
  Energy energy;
  energy.kinetic = world.mass().kinetic_energy(state);
  for (const auto& model : world.forces()) {
    const double stored = model->energy(state, scratch);
    const double outer = model->kind() == ForceKind::elastic ? model->potential(state) : stored;
    energy.potential += outer;
    energy.elastic += stored - outer;
  }
  return energy;
}

bool EnergyWatch::can_watch(const World& world) {
  if (world.fixed().moves()) return false;
  return std::ranges::none_of(world.forces(), [](const auto& model) { return model->may_add_energy(); });
}

bool EnergyWatch::may_be_driven(const World& world) {
  const auto& forces = world.forces();
  if (std::ranges::none_of(forces, [](const auto& model) { return model->may_drive_turns(); })) return false;
  const std::vector<std::uint8_t>& masks = world.fixed().masks();
  return std::ranges::any_of(world.bodies(), [&](const Body& body) {
    const auto first = masks.begin() + body.first_node;
    return std::all_of(first, first + body.node_count, [](std::uint8_t mask) { return mask == 0; });
  });
}

void EnergyWatch::begin(const World& world, const State& state) {
  if (is_end(state)) return;
  const Energy energy = energy_of(world, state, scratch_);
  const double taken = total_ - energy.total();
  if (gained_ > 0.0 && taken > 0.0) gained_ = std::max(gained_ - taken, 0.0);
  total_ = energy.total();
  largest_ = std::max(largest_, energy.kinetic + energy.elastic);
}

void EnergyWatch::end(const World& world, const State& state) {
  const Energy energy = energy_of(world, state, scratch_);
  gained_before_ = gained_;
  largest_before_ = largest_;
  gained_ += energy.total() - total_;
  total_ = energy.total();
  // What moves and is strained without having been gained, as in a fall.
  const double own = energy.kinetic + energy.elastic - std::max(gained_, 0.0);
  largest_ = std::max(largest_, own);
  set_end(state);
}

void EnergyWatch::take_back() {
  gained_ = gained_before_;
  largest_ = largest_before_;
  end_.forget();
}

bool EnergyWatch::is_end(const State& state) const { return end_.is(state) && memory_ == state.memory; }

void EnergyWatch::set_end(const State& state) {
  end_.set(state);
  memory_ = state.memory;
}

std::vector<double> EnergyWatch::reference(const State& state) const {
  return {total_, gained_, largest_, is_end(state) ? 1.0 : 0.0};
}

void EnergyWatch::restore(ConstReals reference, const State& state) {
  total_ = reference[0];
  gained_ = reference[1];
  largest_ = reference[2];
  end_.forget();
  if (reference[3] != 0.0) set_end(state);
}

void EnergyWatch::allow_contacts(const World& world, double h) {
  double gap = 0.0;
  for (const ContactPair& pair : world.contact()->description().pairs) gap = std::max(gap, pair.gap);
  allowed_ = world.mass().total() * (gap / h) * (gap / h);
}

void EnergyWatch::ignore_round_off(const World& world, double h) {
  const double speed = kRoundOff * world.extent() / h;
  ignored_ = world.mass().total() * speed * speed;
}

std::string EnergyWatch::say(const World& world) const {
  if (!std::isfinite(growth())) {
    return "the energy is not a number: a cell or a point of tissue is inside out, where its law has none; "
           "take a smaller dt";
  }
  const bool had_any = largest_ > ignored_;
  const std::string found =
      (had_any
           ? "the energy has grown by " + number_text(100.0 * growth()) + " % of what the bodies had"
           : "the energy has grown by " + number_text(gained_ - allowed_) + " J in bodies that had none") +
      ", and nothing in the scene gives any; take ";
  if (world.contact() != nullptr) {
    return found +
           "a smaller dt, steps that are linearised once (newton: iterations: 1), or, if the step is another "
           "one, implicit_euler, which damps most";
  }
  if (may_be_driven(world)) {
    return found +
           "a smaller dt, bdf2, or less damping: in a step, rayleigh's stiffness and kelvin_voigt's "
           "viscosity "
           "squeeze a stiff body that turns";
  }
  return found +
         "energy_momentum, which keeps it, a smaller dt, or a method that damps (implicit_euler, bdf2)";
}

}  // namespace tissu
