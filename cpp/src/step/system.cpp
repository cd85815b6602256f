#include "tissu/step/system.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

#include "solve/singular_matrix.h"
#include "tissu/base/error.h"
#include "tissu/base/norm.h"
#include "tissu/base/number_text.h"

namespace tissu {
namespace {

bool has_constant_matrix(const std::unique_ptr<ForceModel>& model) {
  return model->has_constant_stiffness() || model->run_time().couples;
}
bool is_external(const std::unique_ptr<ForceModel>& model) { return model->kind() == ForceKind::external; }

/// Which node it is that nothing holds, and what holds it.
std::string say(const World& world, const SingularMatrix& found) {
  std::string node = "row " + std::to_string(found.row());
  for (const Body& body : world.bodies()) {
    const std::int32_t own = found.row() - body.first_node;
    if (own >= 0 && own < body.node_count)
      node = "node " + std::to_string(own) + " of body \"" + body.name + "\"";
  }
  return "the direct solver found " + number_text(found.diagonal()) + " on the diagonal of the matrix, at " +
         node + " along " + "xyz"[found.axis()] +
         ", where numbers above 0 are accepted: nothing resists a motion of the node, as across a line that "
         "is "
         "not stretched in a static step; stretch the line, hold the node, or take a step with inertia, such "
         "as implicit_euler.";
}

}  // namespace

System::System(const World& world, LinearSolver* solver, Profile& profile)
    : world_(world),
      solver_(solver),
      profile_(profile),
      mass_row_(profile.row("inertia", "matrix")),
      is_constant_(world.frames().empty() && std::ranges::all_of(world.forces(), has_constant_matrix)) {
  for (const auto& model : world.forces()) {
    scratch_.reserve(model->scratch_size());
    Rows rows{};
    rows.force = profile.row(model->effect(), "force");
    if (model->has_stiffness()) {
      rows.product = profile.row(model->effect(), "product");
      rows.stiffness = profile.row(model->effect(), "matrix");
    }
    rows_.push_back(rows);
  }
  if (solver == nullptr) return;
  preparation_row_ = profile.row("linear solver", solver->preparation());
  solve_row_ = profile.row("linear solver", "solve");
}

void System::follow_edit(std::span<const std::int32_t> rows) {
  if (matrix_) matrix_->follow_pattern(rows);
  free_.reset();
  assembled_ = false;
  for (const auto& model : world_.forces()) scratch_.reserve(model->scratch_size());
}

const BlockMatrix& System::matrix() const {
  if (!matrix_) throw Error("a matrix is asked for where products alone are made.");
  return *matrix_;
}

const LinearOperator& System::system_matrix() const {
  if (free_) return *free_;
  return matrix();
}

void System::force(const State& state, Reals f) {
  std::ranges::fill(f, 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Timed timed(profile_, rows_[i].force);
    world_.forces()[i]->add_force(state, scratch_, f);
  }
}

double System::external_force(const State& state, Reals f) {
  if (std::ranges::none_of(world_.forces(), is_external)) return 0.0;
  std::ranges::fill(f, 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!is_external(world_.forces()[i])) continue;
    const Timed timed(profile_, rows_[i].force);
    world_.forces()[i]->add_force(state, scratch_, f);
  }
  world_.fixed().clear(f);
  return norm(f);
}

void System::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ForceModel& model = *world_.forces()[i];
    if (!model.has_stiffness()) continue;
    const Timed timed(profile_, rows_[i].product);
    model.add_product(state, scratch_, scale, p, out);
  }
}

void System::assemble(const State& state, double mass, StiffnessScale scale) {
  const bool same = assembled_ && mass_scale_ == mass && scale_.position == scale.position &&
                    scale_.velocity == scale.velocity && scale_.definite == scale.definite;
  if (same && is_constant_ && matrix_) {
    if (!world_.run_time().coupling.empty()) couple(state, scale, *matrix_);
    return;
  }
  if (same && world_.is_linear()) return;
  if (solver_ != nullptr && !solver_->needs_matrix()) {
    if (!free_) free_.emplace(world_);
    free_->set(state, mass, scale);
  } else {
    assemble_blocks(state, mass, scale);
  }
  assembled_ = true;
  mass_scale_ = mass;
  scale_ = scale;
}

void System::assemble_mean(const State& state, double share, double mass) {
  if (solver_ != nullptr && !solver_->needs_matrix()) return assemble(state, mass, {-1.0, 0.0, true});
  assemble_blocks(state, mass, {share - 1.0, 0.0}, share);
  assembled_ = false;
}

void System::assemble_blocks(const State& state, double mass, StiffnessScale scale, double definite) {
  if (!matrix_) matrix_.emplace(world_.sparsity(), world_.isa(), world_.threads());
  BlockMatrix& matrix = *matrix_;
  {
    const Timed timed(profile_, mass_row_);
    matrix.clear();
    if (mass != 0.0) world_.mass().add_to(matrix, state, mass);
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ForceModel& model = *world_.forces()[i];
    if (!model.has_stiffness()) continue;
    const Timed timed(profile_, rows_[i].stiffness);
    model.add_stiffness(state, scratch_, scale, matrix);
    if (definite > 0.0) model.add_stiffness(state, scratch_, {-definite, 0.0, true}, matrix);
  }
  matrix.constrain(world_.fixed().rows(), world_.fixed().masks());
  if (!world_.run_time().coupling.empty()) couple(state, scale, matrix);
  if (solver_ == nullptr || !solver_->needs_places()) return;
  place_rows(state);
  matrix.set_places(&places_);
}

void System::couple(const State& state, StiffnessScale scale, BlockMatrix& matrix) {
  couplings_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ForceModel& model = *world_.forces()[i];
    if (!model.run_time().couples) continue;
    const Timed timed(profile_, rows_[i].stiffness);
    model.add_couplings(state, scale, couplings_);
  }
  couplings_.close(world_.blocks(), &world_.fixed().masks());
  matrix.set_couplings(couplings_.empty() ? nullptr : &couplings_);
}

void System::recouple(const State& state) {
  if (free_) {
    free_->couple(state);
  } else if (matrix_) {
    couple(state, scale_, *matrix_);
  }
}

std::unique_ptr<ImplicitContact> System::make_contact(bool is_static) {
  return make_contact(is_static, world_.contact()->description().method);
}

std::unique_ptr<ImplicitContact> System::make_contact(bool is_static, ContactMethod method) {
  const Contact& contact = *world_.contact();
  std::vector<double> rest;
  if (ImplicitContact::needs_rest(method)) {
    rest.resize(9 * static_cast<std::size_t>(world_.blocks()));
    assemble(world_.shape_state(), 0.0, {-1.0, 0.0, true});
    system_matrix().diagonal_blocks(rest);
    assembled_ = false;
  }
  return ImplicitContact::make(contact, world_.fixed(), is_static ? nullptr : &world_.mass(), std::move(rest),
                               world_.extent(), method);
}

/// A matrix that stays is that of the world at rest, whose rigid motions are about places there.
void System::place_rows(const State& state) {
  if (places_.point.empty()) {
    for (std::int32_t i = 0; i < world_.blocks(); ++i) places_.point.push_back(i);
    for (const Frame& frame : world_.frames()) {
      places_.point[static_cast<std::size_t>(frame.rotation)] = frame.block;
    }
  }
  const bool stays = is_constant_ || world_.is_linear();
  const ConstReals places = stays ? world_.rest_positions() : ConstReals(state.positions);
  places_.positions.assign(places.begin(), places.end());
  for (const Frame& frame : world_.frames()) {
    block(Reals(places_.positions), frame.rotation) = block(places, frame.block);
  }
}

double System::round_off(const State& state) const { return system_matrix().round_off(state.positions); }

void System::prepare_ahead() {
  if (solver_ == nullptr) return;
  const auto start = std::chrono::steady_clock::now();
  if (solver_->prepare_ahead(system_matrix())) {
    profile_.add(preparation_row_,
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    profile_.solves().preparations += 1;
  }
  assembled_ = false;  // a linear body may stand elsewhere when its first step begins
}

SolveReport System::solve(ConstReals b, Reals x, double floor) {
  if (solver_ == nullptr) throw ParameterError("this method solves systems: give it a linear solver.");
  const auto start = std::chrono::steady_clock::now();
  const SolveReport report = [&] {
    try {
      return solver_->solve(system_matrix(), b, x, floor);
    } catch (const SingularMatrix& found) {
      throw Error(say(world_, found));
    }
  }();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  profile_.add(preparation_row_, report.preparation_seconds, report.preparations);
  profile_.add(solve_row_, seconds - report.preparation_seconds);
  Profile::Solves& solves = profile_.solves();
  solves.solves += 1;
  solves.iterations += report.iterations;
  solves.preparations += report.preparations;
  solves.failures += report.converged ? 0 : 1;
  solves.residual = std::max(solves.residual, report.residual);
  solves.work += report.work;
  return report;
}

}  // namespace tissu
