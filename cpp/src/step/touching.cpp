/// Steps of a world with contact (Alart and Curnier 1991). What is elastic is linearised once; contacts are
/// looked at again after each system, which differs from the one before in couplings alone.

#include <algorithm>
#include <cmath>
#include <string>

#include "settling.h"
#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/step/stage.h"

namespace tissu {
namespace {

constexpr double kFloor = 1e-3;  ///< of the external impulse: a smaller right-hand side is judged by it
// The next step goes on from the forces of this one: what is left of depth after some systems is left to it.
constexpr double kDepth = 1e-2;      ///< of the gap: contacts so near to it need no other system
constexpr int kLater = 2;            ///< after so many systems …
constexpr double kLaterDepth = 3.2;  ///< … times this for each …
constexpr double kDeepest = 0.1;     ///< … as far as this
constexpr double kTooDeep = 0.5;
constexpr double kUnsettled = 0.1;  ///< of the forces on what is rigid: what still changes is not known
constexpr double kDepthNewton = 1e-3;
constexpr double kForce = 1e-2;       ///< of the contacts' forces: a smaller change needs no other system
constexpr double kForceRigid = 1e-3;  ///< the same where a rigid body is free, which has no other forces
// Contacts of rigid bodies, sheets and lines that neither pull nor exceed friction, and only lack force,
// become stiffer, unless rows are held back: what is stiffer in an impact throws surfaces apart.
constexpr int kPatience = 2;        ///< so many systems later …
constexpr double kStiffer = 4.0;    ///< … by this for each, …
constexpr double kStiffest = 64.0;  ///< … no further than this
constexpr double kForceNewton = 1e-3;
constexpr int kMostRescues = 6;  ///< looks of a step that was linearised once and is iterated
constexpr int kMostLooks = 20;   ///< of a step whose equation is solved to its tolerance

/// As a share of the gap.
double shallow(int systems) {
  return std::min(kDeepest, kDepth * std::pow(kLaterDepth, std::max(0, systems - kLater)));
}

std::string unsettled(int systems) {
  return "contacts had not settled after " + std::to_string(systems) +
         (systems == 1 ? " system" : " systems") +
         ": more than a hundredth of their forces pull or exceed friction, or they are deeper than half "
         "the gap or press where they are so far open; take a smaller dt or more iterations of contact";
}

}  // namespace

double StageSolver::look(const State& at) {
  const Timed timed(*profile_, detection_row_);
  return contact_->look(at);
}

int StageSolver::hold_back(State& to) {
  const Timed timed(*profile_, travel_row_);
  placed_ = to.positions;
  placed_rotations_ = to.rotations;
  const int rows = contact_->run().hold_back(to);
  if (rows > 0 && contact_->barrier() == nullptr) {
    const World& world = system_->world();
    contact_->run().go_on_together(world.mass(), world.fixed(), placed_, to);
  }
  return rows;
}

void StageSolver::update_contacts(const State& end) {
  const Timed timed(*profile_, response_row_);
  contact_->update(end);
}

/// v takes what is given, and what is led goes ahead.
void StageSolver::begin_touching(State& state, std::vector<double>& v) {
  const World& world = system_->world();
  state.memory = stage_.base.memory;
  std::ranges::copy(v, trial_.begin());
  world.fixed().copy(given_, trial_);
  place(state, trial_);
  cut_.clear();
  cut_frames_.clear();
  {
    const Timed timed(*profile_, detection_row_);
    // work_ is the external force, as judge_by_load left it.
    contact_->begin(*step_start_, stage_.end, end_of(state), work_);
  }
  world.contact()->numbers(stage_.base).clear();
  world.contact()->numbers(linearised_at()).clear();
  lay_right(v);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += given_change_[i];
  elastic_ = right_;
  assemble(linearised_at(), false);
  blocks_.resize(3 * v.size());
  system_->system_matrix().diagonal_blocks(blocks_);
  contact_->set_matrix(blocks_, stage_.move * stage_.push, stage_.contact);
}

void StageSolver::set_contacts(State& state) {
  contact_->write(state);
  contact_->write(stage_.base);
  if (turns_) contact_->write(turned_);
}

State& StageSolver::end_of(State& state) {
  const double stretch = stage_.contact.stretch;
  if (stretch == 1.0) return state;
  for (std::size_t i = 0; i < end_.positions.size(); ++i) {
    const double from = stage_.base.positions[i];
    end_.positions[i] = from + stretch * (state.positions[i] - from);
  }
  for (std::size_t k = 0; k < end_.rotations.size(); ++k) {
    const Quaternion& from = stage_.base.rotations[k];
    const Vec3 turn = nearest_turn(state.rotations[k] * from.conjugate(), Vec3::Zero());
    end_.rotations[k] = (turn_by(stretch * turn) * from).normalized();
  }
  return end_;
}

void StageSolver::add_contact_impulse(double seconds, Reals v) {
  if (contact_ == nullptr) return;
  const World& world = system_->world();
  std::ranges::fill(work_, 0.0);
  contact_->add_forces(work_);
  world.fixed().clear(work_);
  world.mass().divide(stage_.base, work_);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += seconds * work_[i];
}

void StageSolver::end_touching(double h, State& end) {
  if (contact_ == nullptr) return;
  const Timed timed(*profile_, response_row_);
  contact_->strike(*impulses_, h, end.velocities, end);
  for (const std::int32_t row : cut_) {
    const Vec3 way = block(ConstReals(end.positions), row) - block(ConstReals(step_start_->positions), row);
    block(Reals(end.velocities), row) = way / h;
  }
  for (const std::size_t frame : cut_frames_) {
    const Quaternion turn = end.rotations[frame] * step_start_->rotations[frame].conjugate();
    const std::int32_t row = system_->world().frames()[frame].rotation;
    block(Reals(end.velocities), row) = nearest_turn(turn, Vec3::Zero()) / h;
  }
}

void StageSolver::follow(const State& end, std::vector<double>& v) {
  const double move = stage_.contact.stretch * stage_.move;
  before_cut_ = v;
  cut_.clear();
  cut_frames_.clear();
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (placed_[i] == end.positions[i]) continue;
    v[i] = (end.positions[i] - stage_.base.positions[i]) / move;
    const auto row = static_cast<std::int32_t>(i / 3);
    if (cut_.empty() || cut_.back() != row) cut_.push_back(row);
  }
  const std::vector<Frame>& frames = system_->world().frames();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (placed_rotations_[k].coeffs() == end.rotations[k].coeffs()) continue;
    cut_frames_.push_back(k);
    const Quaternion turn = end.rotations[k] * stage_.base.rotations[k].conjugate();
    block(Reals(v), frames[k].rotation) = nearest_turn(turn, Vec3::Zero()) / move;
  }
}

/// Of methods whose velocities at the end are those of their equation: others have their own way to them.
void StageSolver::keep_momentum(std::vector<double>& v) {
  if (cut_.empty() || stage_.contact.stretch != 1.0) return;
  const World& world = system_->world();
  contact_->run().keep_momentum(world.mass(), world.fixed(), before_cut_, v);
}

bool StageSolver::solve_contacts(State& state, std::vector<double>& v, StepReport& report) {
  const World& world = system_->world();
  const Contact& contact = *world.contact();
  const int most = contact.description().iterations;
  const double enough = contact.surfaces().carriers().empty() ? kForce : kForceRigid;
  place(state, v);
  State* end = &end_of(state);
  hold_back(*end);
  look(*end);
  contact_->take();
  // Levers of what is rigid are those of the latest places: the step is one of Newton's for contact.
  const State& levers = contact.surfaces().rotations().empty() ? stage_.base : state;
  bool solved = true;
  const bool several = contact.surfaces().carriers().size() > 1;  // one may lie on another
  double stiffer = 1.0;
  Settling settling;
  for (int i = 1;; ++i) {
    set_contacts(state);
    place(state, v);
    std::ranges::fill(work_, 0.0);
    {
      const Timed timed(*profile_, response_row_);
      contact.add_force(state, scratch_, work_);
    }
    for (std::size_t k = 0; k < work_.size(); ++k) right_[k] = elastic_[k] + stage_.push * work_[k];
    world.fixed().clear(right_);
    system_->recouple(levers);
    std::ranges::fill(change_, 0.0);
    const SolveReport found = solve_linear(linearised_at(), kFloor * reference_, false, report);
    solved = solved && found.converged;
    ++report.newton_iterations;
    report.residual = found.residual;
    // Without contact: A change - C change.
    system_->system_matrix().multiply(change_, work_);
    contact.add_product(levers, scratch_, {stage_.move * stage_.push, 0.0}, change_, work_);
    for (std::size_t k = 0; k < v.size(); ++k) {
      elastic_[k] -= work_[k];
      v[k] += change_[k];
    }
    world.fixed().clear(elastic_);
    place(state, v);
    end = &end_of(state);
    update_contacts(*end);
    report.held_back = hold_back(*end);
    const bool lacks_force = several || contact_->depth() > shallow(i);
    if (i >= kPatience && lacks_force && report.held_back == 0 && contact_->inadmissible() <= kForce) {
      stiffer = std::min(kStiffest, kStiffer * stiffer);
      contact_->set_stiffer_whole(stiffer);
    }
    const double other = look(*end);
    // A force that pulled is gone in the next look, and with it what it did to the body.
    const bool pulled = contact_->inadmissible() > kForce;
    const bool free = report.held_back == 0 && !pulled;
    if (free && other <= enough && contact_->depth() <= shallow(i)) break;
    const bool lost = settling.is_lost(
        {report.held_back, contact_->size(), other, contact_->inadmissible(), contact_->depth()});
    if (gives_up_early_ && lost) {
      report.hasty = true;
      report.message = unsettled(i);
      break;
    }
    if (i == most) {
      report.hasty = pulled || contact_->depth() > kTooDeep || (enough < kForce && other > kUnsettled);
      if (report.hasty) report.message = unsettled(most);
      break;
    }
    contact_->take();
    stop_if_asked();
  }
  return solved && !report.hasty;
}

/// Newton's iteration with the contacts of one look, and looks until they stay.
void StageSolver::iterate_contacts(State& state, std::vector<double>& v, StepReport& report) {
  const int most = newton_.iterations;
  int iterations = report.newton_iterations;
  State* end = stage_.contact.stretch != 1.0 ? &end_ : &state;
  for (int i = 0; i < kMostLooks; ++i) {
    look(*end);
    contact_->take();
    set_contacts(state);
    first_ = v;
    std::string_view why = iterate(state, v, Search::none, most, report);
    if (!why.empty() && !is_falling_) {
      v = first_;
      iterations += report.newton_iterations;
      why = iterate(state, v, Search::energy, most, report);
    }
    iterations += report.newton_iterations;
    report.message = why;
    place(state, v);
    end = &end_of(state);
    update_contacts(*end);
    report.held_back = hold_back(*end);
    follow(*end, v);
    const double other = look(*end);
    const bool pulled = contact_->inadmissible() > kForce;
    if (!pulled && other <= kForceNewton && report.held_back == 0 && contact_->depth() <= kDepthNewton) break;
    if (i + 1 == kMostLooks) {
      report.converged = false;
      report.message =
          "contacts had not come to rest after " + std::to_string(kMostLooks) +
          " searches, each with an iteration of Newton's method; take a smaller dt, or steps that "
          "are linearised once (newton: iterations: 1)";
    }
  }
  report.newton_iterations = iterations;
  keep_momentum(v);
  std::ranges::copy(v, state.velocities.begin());
}

bool StageSolver::fits_contacts(State& state, std::vector<double>& v, StepReport& report) {
  place(state, v);
  State& end = end_of(state);
  update_contacts(end);
  report.held_back = hold_back(end);
  follow(end, v);
  const double other = look(end);
  return report.held_back == 0 && other <= kForce && contact_->inadmissible() <= kForce;
}

void StageSolver::judge_touching(State& state, std::vector<double>& v, StepReport& report) {
  place(state, v);
  std::ranges::fill(work_, 0.0);
  world().contact()->add_force(state, scratch_, work_);
  world().fixed().clear(work_);
  balance_.set_contacts(stage_.push, work_);
  const Judged judged = judge_linearised(state, v, report);
  if (judged == Judged::kept) return;
  if (judged == Judged::corrected) {
    if (!fits_contacts(state, v, report)) {
      v = uncorrected_;
      fits_contacts(state, v, report);
    }
    std::ranges::copy(v, state.velocities.begin());
    return;
  }
  const int before = report.newton_iterations;
  const bool failed = report.hasty;  // the iteration, before contacts were looked at again
  int systems = 0;
  for (int i = 0; i < kMostRescues; ++i) {
    report.hasty = !fits_contacts(state, v, report);
    if (failed || !report.hasty || report.held_back != 0 || i + 1 == kMostRescues) break;
    contact_->take();
    set_contacts(state);
    const bool solved = is_near(iterate(state, v, Search::none, kRescue, report), report);
    systems += report.newton_iterations - 1;
    if (!solved) {
      fits_contacts(state, v, report);  // where the iteration went is tested too: it may be kept
      break;
    }
  }
  // A contact that began inside its gap gives energy as it opens, less in parts of a step, where there are
  // any.
  if (!report.hasty && gives_up_early_ && energy_ == EnergyLaw::falls) report.hasty = gains_energy(state);
  report.newton_iterations = before + systems;
  if (!failed) report.message = report.hasty ? unsettled(report.newton_iterations) : std::string();
  report.hasty = report.hasty || failed;
  report.converged = !report.hasty;
  keep_momentum(v);
  std::ranges::copy(v, state.velocities.begin());
}

void StageSolver::solve_touching(State& state, std::vector<double>& v, StepReport& report) {
  begin_touching(state, v);
  if (BarrierContact* barrier = contact_->barrier()) {
    solve_barrier(*barrier, state, v, report);
    return;
  }
  report.converged = solve_contacts(state, v, report);
  if (!report.converged && !report.hasty) report.message = "the linear solver stopped before its tolerance";
  State& end = stage_.contact.stretch != 1.0 ? end_ : state;
  follow(end, v);
  if (newton_.iterations == 1) keep_momentum(v);
  std::ranges::copy(v, state.velocities.begin());
  if (newton_.iterations == 1 && report.held_back == 0 && !report.hasty) judge_touching(state, v, report);
  contact_->finish(end, state);
  if (newton_.iterations > 1) {
    iterate_contacts(state, v, report);
    contact_->finish(end, state);
  }
  report.contacts = static_cast<int>(contact_->size());
  report.least_gap = contact_->least_gap();
  if (contact_->run().opens_by_shares()) {
    report.depth = contact_->deepest();
  } else if (contact_->rests_at_gap() && contact_->deepest() > kTooDeep) {
    // As where a vertex slides over an edge and goes on pressing on the plane of the face before.
    report.hasty = true;
    report.converged = false;
    report.message = "contacts are deeper than half the gap at the end of the step; take a smaller dt";
  }
}

}  // namespace tissu
