/// Steps of the energy-momentum method in a world with contact.

#include <algorithm>
#include <string>

#include "tissu/base/interruption.h"
#include "tissu/step/energy_momentum.h"

namespace tissu {
namespace {

constexpr int kMostLooks = 20;
constexpr double kForce = 1e-3;      ///< of the contacts' forces: a smaller change needs no other look
constexpr double kDepth = 1e-3;      ///< of the gap
constexpr double kMostForce = 1e-2;  ///< that may be inadmissible after the last look
constexpr double kMostDepth = 0.5;

}  // namespace

void EnergyMomentum::prepare_touching(Profile& profile) {
  const World& world = system_->world();
  contact_ = system_->make_contact(false);
  impulses_ = std::make_unique<EndImpulses>(*world.contact(), world.fixed(), world.mass());
  profile_ = &profile;
  detection_row_ = profile.row("contact", "detection");
  travel_row_ = profile.row("contact", "travel");
  response_row_ = profile.row("contact", "response");
  blocks_.resize(3 * mean_.size());
}

double EnergyMomentum::look() {
  const Timed timed(*profile_, detection_row_);
  return contact_->look(end_);
}

int EnergyMomentum::hold_back() {
  const Timed timed(*profile_, travel_row_);
  placed_ = end_.positions;
  return contact_->run().hold_back(end_);
}

void EnergyMomentum::place_end(const State& from, double h) {
  for (std::size_t i = 0; i < mean_.size(); ++i) end_.positions[i] = from.positions[i] + h * mean_[i];
}

void EnergyMomentum::begin_touching(const State& from, double h) {
  const World& world = system_->world();
  world.contact()->numbers(middle_).clear();
  std::ranges::fill(work_, 0.0);
  load_ = 0.5 * h * system_->external_force(middle_, work_);
  place_end(from, h);
  {
    const Timed timed(*profile_, detection_row_);
    contact_->begin(from, from.time + h, end_, work_);
  }
  system_->assemble(middle_, 1.0, {-0.25 * h * h, -0.5 * h});
  system_->system_matrix().diagonal_blocks(blocks_);
  contact_->set_matrix(blocks_, 0.25 * h * h, {2.0, 2.0});
  hold_back();
  look();
  contact_->take();
}

bool EnergyMomentum::iterate_touching(const State& from, double h, StepReport& report) {
  begin_touching(from, h);
  int held_back = 0;  // of the last search: the report has those of the other halves of the step, too
  for (int i = 1;; ++i) {
    stop_if_asked();
    contact_->write(middle_);
    if (!iterate(from, h, report)) return false;
    place_end(from, h);
    {
      const Timed timed(*profile_, response_row_);
      contact_->update(end_);
    }
    held_back = hold_back();
    const double other = look();
    const bool pulled = contact_->inadmissible() > kMostForce;
    if (held_back == 0 && !pulled && other <= kForce && contact_->depth() <= kDepth) return true;
    if (i == kMostLooks) break;
    contact_->take();
  }
  report.held_back = std::max(report.held_back, held_back);
  if (contact_->inadmissible() > kMostForce || contact_->depth() > kMostDepth) {
    report.hasty = true;
    report.message = "contacts had not settled after " + std::to_string(kMostLooks) + " searches";
  }
  return true;
}

void EnergyMomentum::finish_touching(const State& from, double h, State& state, StepReport& report) {
  const World& world = system_->world();
  contact_->finish(end_, state);
  std::ranges::fill(work_, 0.0);
  contact_->add_forces(work_);
  world.fixed().clear(work_);
  world.mass().divide(middle_, work_);
  for (std::size_t i = 0; i < work_.size(); ++i) state.velocities[i] -= h * work_[i];
  world.fixed().copy(mean_, state.velocities);
  contact_->strike(*impulses_, h, state.velocities, state);
  for (std::size_t i = 0; i < work_.size(); ++i) {
    if (placed_[i] == end_.positions[i]) continue;
    state.positions[i] = end_.positions[i];
    state.velocities[i] = (end_.positions[i] - from.positions[i]) / h;
  }
  report.contacts = static_cast<int>(contact_->size());
  report.least_gap = std::min(report.least_gap, contact_->least_gap());
}

}  // namespace tissu
