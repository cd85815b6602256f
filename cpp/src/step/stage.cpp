#include "tissu/step/stage.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "tissu/base/error.h"
#include "tissu/base/interruption.h"
#include "tissu/base/norm.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

constexpr double kFloor = 1e-3;  ///< of the external impulse: a smaller right-hand side is judged against it
constexpr double kFalling =
    0.5;  ///< of the residual before: an iteration that gets so far was only stopped early
constexpr double kHopeless = 1e9;       ///< times the first residual: Newton's iteration has lost its way
constexpr double kRoundings = 16.0;     ///< in each row of the residual
constexpr double kShortest = 1e-3;      ///< a Newton step is not cut below this, …
constexpr double kShortestDown = 1e-9;  ///< … or below this where the energy is to fall
constexpr double kArmijo = 1e-4;        ///< share of the fall that the slope promises
constexpr double kFirstMass = 0.1;      ///< share of the mass that is added first to make a matrix definite
constexpr double kLastMass = 1e9;

/// The norm of what stands in held rows.
double held_norm(const FixedDofs& fixed, ConstReals values) {
  double sum = 0.0;
  for (const std::int32_t row : fixed.rows()) {
    const std::uint8_t mask = fixed.masks()[static_cast<std::size_t>(row)];
    for (int axis = 0; axis < 3; ++axis) {
      const double value = values[static_cast<std::size_t>(3 * row + axis)];
      if (((mask >> axis) & 1) != 0) sum += value * value;
    }
  }
  return std::sqrt(sum);
}

}  // namespace

StageSolver::StageSolver(NewtonSettings newton, PartBalance::Shares most_left, EnergyLaw energy)
    : newton_(newton), most_left_(most_left), energy_(energy) {
  if (newton.iterations < 1 || !(newton.tolerance > 0.0)) {
    throw ParameterError("Newton's iteration needs at least one iteration and a positive tolerance.");
  }
}

void StageSolver::prepare(const World& world, LinearSolver* solver, Profile& profile) {
  system_ = std::make_unique<System>(world, solver, profile);
  stage_.base = world.rest_state();
  for (auto* v : {&given_, &given_change_, &guess_, &first_, &once_, &uncorrected_, &trial_, &change_,
                  &right_, &work_, &momentum_}) {
    v->assign(stage_.base.positions.size(), 0.0);
  }
  turns_ = false;
  if (!world.is_linear()) {
    turned_ = stage_.base;
    turn_to_.assign(stage_.base.positions.size(), 0.0);
    turned_.straining.reserve(stage_.base.positions.size());
  }
  list_turning();
  knows_parts_ = false;
  if (!world.is_linear()) balance_parts();
  contact_.reset();
  if (world.contact() == nullptr) return;
  prepare_contact();
  end_ = stage_.base;
  profile_ = &profile;
  detection_row_ = profile.row("contact", "detection");
  travel_row_ = profile.row("contact", "travel");
  response_row_ = profile.row("contact", "response");
}

void StageSolver::prepare_contact() {
  contact_ = system_->make_contact(false);
  impulses_ = std::make_unique<EndImpulses>(*world().contact(), world().fixed(), world().mass());
}

void StageSolver::follow_edit(std::span<const std::int32_t> rows) {
  system_->follow_edit(rows);
  list_turning();
  knows_parts_ = false;
  if (contact_ != nullptr) prepare_contact();
}

void StageSolver::begin(const State& start, double time, double h) {
  step_start_ = &start;
  stage_.base = start;
  stage_.base.time = time;
  stage_.move = h;
  stage_.push = h;
  stage_.end = time;
  stage_.contact = {};
  stage_.past = {};
}

void StageSolver::lead(const State& start, double time, double h, double share) {
  const FixedDofs& fixed = system_->world().fixed();
  fixed.set_velocities(start, time, h, 1.0, given_);
  fixed.place(start, share * h - stage_.move, given_, stage_.base);
}

void StageSolver::prepare_ahead() {
  assemble(stage_.base, false);
  system_->prepare_ahead();
}

void StageSolver::solve(State& state, std::vector<double>& v, StepReport& report) {
  judge_by_load();
  turn_ahead(v);
  guess_ = v;
  if (contact_ != nullptr) {
    solve_touching(state, v, report);
  } else {
    solve_free(state, v, report);
  }
  report.turned_far = turns_far(v);
}

void StageSolver::solve_free(State& state, std::vector<double>& v, StepReport& report) {
  first_solve(v, report);
  if (newton_.iterations == 1) {
    judge_linearised(state, v, report);
    return;
  }
  first_ = v;
  const int most = newton_.iterations;
  report.message.clear();
  const std::string_view why = iterate(state, v, Search::none, most, report);
  if ((why.empty() || is_falling_) && is_lower(state, v)) {
    report.message = why;
    return;
  }
  v = first_;
  if (iterate(state, v, Search::residual, most, report).empty() && is_lower(state, v)) return;
  v = guess_;
  system_->world().fixed().copy(first_, v);
  report.message = iterate(state, v, Search::energy, most, report);
}

void StageSolver::judge_by_load() {
  reference_ = stage_.push * system_->external_force(stage_.base, work_);
  if (!is_judged()) return;
  balance_parts();
  const double push = reference_ > 0.0 ? stage_.push : 0.0;
  balance_.set_external(push, work_);
}

bool StageSolver::is_lower(State& state, ConstReals v) {
  std::ranges::copy(guess_, trial_.begin());
  system_->world().fixed().copy(v, trial_);
  const double before = potential(state, trial_);
  double way = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) way += (v[i] - trial_[i]) * (v[i] - trial_[i]);
  const double after = potential(state, v);
  // Dissipation and follower loads, which have no potential, are given room.
  return after <= before + std::abs(before) + start_ * std::sqrt(way);
}

void StageSolver::place(State& state, ConstReals v) const {
  move(stage_.base, system_->world().frames(), v, stage_.move, state);
  std::ranges::copy(v, state.velocities.begin());
  set_straining(v, state);
  state.time = stage_.base.time;
}

void StageSolver::lay_right(std::vector<double>& v) {
  const World& world = system_->world();
  const FixedDofs& fixed = world.fixed();
  const double h2 = stage_.move * stage_.push;
  State& at = linearised_at();
  // Changes of velocity that are given, zero elsewhere.
  ConstReals led = v;  // v with them
  std::ranges::fill(change_, 0.0);
  if (!fixed.empty()) {
    std::ranges::copy(v, trial_.begin());
    fixed.copy(given_, trial_);
    led = trial_;
    for (std::size_t i = 0; i < v.size(); ++i) change_[i] = led[i] - v[i];
  }

  set_straining(v, at);
  std::swap(at.velocities, v);
  system_->force(at, right_);
  std::swap(at.velocities, v);
  for (double& r : right_) r *= stage_.push;
  if (turns_) {
    for (std::size_t i = 0; i < v.size(); ++i) work_[i] = led[i] - turn_to_[i];
    led = work_;
  }
  system_->add_product(at, {h2, 0.0}, led, right_);
  if (!fixed.empty() && std::ranges::any_of(change_, [](double c) { return c != 0.0; })) {
    system_->add_product(at, {0.0, stage_.push}, change_, right_);
    world.mass().add_product(stage_.base, -1.0, change_, right_);
  }
  for (std::size_t i = 0; i < v.size(); ++i) work_[i] = v[i] - stage_.base.velocities[i];
  world.mass().add_product(stage_.base, -1.0, work_, right_);
  fixed.clear(right_);
  start_ = norm(right_);
  std::ranges::copy(change_, given_change_.begin());
}

void StageSolver::first_solve(std::vector<double>& v, StepReport& report) {
  lay_right(v);
  const FixedDofs& fixed = system_->world().fixed();
  const State& at = linearised_at();
  // What is given is on the right already: the solver sees free rows only, and judges by them.
  fixed.clear(change_);

  assemble(at, false);
  const SolveReport solved = solve_linear(at, kFloor * reference_, false, report);
  fixed.copy(given_change_, change_);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += change_[i];
  report.newton_iterations += 1;
  report.residual = solved.residual;
  report.converged = solved.converged;
  if (!solved.converged) report.message = "the linear solver stopped before its tolerance";
}

void StageSolver::assemble(const State& state, bool definite, double mass) {
  system_->assemble(state, mass, {-stage_.move * stage_.push, -stage_.push, definite});
}

SolveReport StageSolver::solve_linear(const State& state, double floor, bool definite, StepReport& report) {
  std::ranges::copy(change_, work_.begin());
  SolveReport solved = system_->solve(right_, change_, floor);
  report.solver_iterations += solved.iterations;
  if (solved.positive_definite) return solved;
  ++report.indefinite;
  if (newton_.indefinite == Indefinite::refuse) {
    throw Error("the matrix of the step to t = " + number_text(state.time) +
                " s is not positive definite, as under strong compression; take a smaller dt, or say "
                "indefinite: project instead of refuse.");
  }
  const auto again = [&](double mass, bool projected) {
    assemble(state, projected, mass);
    std::ranges::copy(work_, change_.begin());
    solved = system_->solve(right_, change_, floor);
    report.solver_iterations += solved.iterations;
    return solved.positive_definite;
  };
  const bool project = newton_.indefinite == Indefinite::project;
  if (project && !definite && again(1.0, true)) return solved;
  for (double more = kFirstMass; more < kLastMass; more *= 10.0) {
    if (again(1.0 + more, project)) break;
  }
  return solved;
}

double StageSolver::residual(State& state, ConstReals v) {
  const World& world = system_->world();
  place(state, v);
  system_->force(state, right_);
  for (std::size_t i = 0; i < right_.size(); ++i) {
    right_[i] *= stage_.push;
    work_[i] = v[i] - stage_.base.velocities[i];
  }
  acting_ = reference_;
  if (world.fixed().moves(stage_.base)) {
    acting_ = std::max(acting_, held_norm(world.fixed(), right_));
  }
  std::ranges::fill(momentum_, 0.0);
  world.mass().add_product(stage_.base, -1.0, work_, momentum_);
  world.fixed().clear(momentum_);
  acting_ = std::max(acting_, norm(momentum_));
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] += momentum_[i];
  world.fixed().clear(right_);
  return norm(right_);
}

double StageSolver::potential(State& state, ConstReals v) {
  const World& world = system_->world();
  place(state, v);
  std::ranges::fill(momentum_, 0.0);
  for (std::size_t i = 0; i < v.size(); ++i) work_[i] = v[i] - stage_.base.velocities[i];
  world.mass().add_product(stage_.base, 0.5, work_, momentum_);
  double sum = std::inner_product(work_.begin(), work_.end(), momentum_.begin(), 0.0);
  for (const auto& model : world.forces()) sum += stage_.push / stage_.move * model->energy(state, scratch_);
  return sum;
}

std::string_view StageSolver::iterate(State& state, std::vector<double>& v, Search search, int most,
                                      StepReport& report) {
  report.newton_iterations = 1;
  report.converged = false;
  double now = residual(state, v);
  const double first = now;
  double lowest = now;
  is_falling_ = false;
  while (true) {
    report.residual = acting_ > 0.0 || !std::isfinite(now) ? now / acting_ : 0.0;
    if (!(now <= kHopeless * std::max(acting_, first))) return "Newton's iteration ran away";
    if (now <= newton_.tolerance * acting_) break;
    if (report.newton_iterations >= most) return "Newton's iteration stopped before its tolerance";
    assemble(state, search == Search::energy);
    const double floor = system_->round_off(state) / stage_.move;
    const double rounded = (report.newton_iterations > 1 && !is_falling_ ? kRoundings : 1.0) * floor;
    if (now <= rounded) {
      if (acting_ <= rounded) report.residual = 0.0;  // nothing acts
      break;
    }
    stop_if_asked();
    std::ranges::fill(change_, 0.0);
    solve_linear(state, 0.0, search == Search::energy, report);
    ++report.newton_iterations;
    if (!advance(state, v, search, now)) return "Newton's residual could not be lowered further";
    is_falling_ = now < kFalling * lowest;
    lowest = std::min(lowest, now);
  }
  report.converged = true;
  return {};
}

void StageSolver::go(ConstReals v, double share) {
  for (std::size_t i = 0; i < v.size(); ++i) trial_[i] = v[i] + share * change_[i];
  // Forces are derived by turning frames as they stand: exp(move v') = exp(move share change) exp(move v).
  for (const Frame& frame : system_->world().frames()) {
    const Vec3 turned = stage_.move * block(v, frame.rotation);
    const Vec3 more = stage_.move * share * block(ConstReals(change_), frame.rotation);
    block(Reals(trial_), frame.rotation) =
        nearest_turn(turn_by(more) * turn_by(turned), turned + more) / stage_.move;
  }
}

bool StageSolver::advance(State& state, std::vector<double>& v, Search search, double& now) {
  if (search == Search::energy) return descend(state, v, now);
  double share = 1.0;
  double next = 0.0;
  while (true) {
    go(v, share);
    next = residual(state, trial_);
    if (search == Search::none || next < now || share < kShortest) break;
    share *= 0.5;
  }
  if (search == Search::residual && !(next < now)) return false;
  std::swap(v, trial_);
  now = next;
  return true;
}

StageSolver::DampingWork StageSolver::damping_work(const State& state) {
  std::ranges::fill(work_, 0.0);
  system_->add_product(state, {0.0, -stage_.push}, change_, work_);
  const std::vector<double>& by = state.strains_by();
  const double linear = std::inner_product(by.begin(), by.end(), work_.begin(), 0.0);
  const double square = 0.5 * std::inner_product(change_.begin(), change_.end(), work_.begin(), 0.0);
  return square < 0.0 ? DampingWork{} : DampingWork{linear, square};
}

bool StageSolver::descend(State& state, std::vector<double>& v, double& now) {
  const double slope = -std::inner_product(right_.begin(), right_.end(), change_.begin(), 0.0);
  const DampingWork damping = damping_work(state);
  const double from = potential(state, v);
  for (double share = 1.0; share > kShortestDown; share *= 0.5) {
    go(v, share);
    const double to = potential(state, trial_) + damping.at(share);
    if (!(to <= from + kArmijo * share * slope)) continue;
    now = residual(state, trial_);
    std::swap(v, trial_);
    return true;
  }
  residual(state, v);
  return false;
}

}  // namespace tissu
