#include "tissu/step/system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tissu/base/error.h"

namespace tissu {

System::System(const World& world, LinearSolver* solver, Profile& profile)
    : world_(world),
      solver_(solver),
      profile_(profile),
      matrix_(world.sparsity(), world.isa(), world.threads()),
      mass_row_(profile.row("inertia", "matrix")),
      solve_row_(profile.row("linear solver", "solve")) {
  for (const auto& model : world.forces()) {
    Rows rows{};
    rows.force = profile.row(model->effect(), "force");
    if (model->has_stiffness()) {
      rows.product = profile.row(model->effect(), "product");
      rows.stiffness = profile.row(model->effect(), "matrix");
    }
    rows_.push_back(rows);
  }
}

void System::force(const State& state, Reals f) {
  std::ranges::fill(f, 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Timed timed(profile_, rows_[i].force);
    world_.forces()[i]->add_force(state, f);
  }
}

void System::external_force(const State& state, Reals f) {
  std::ranges::fill(f, 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (world_.forces()[i]->kind() != ForceKind::external) continue;
    const Timed timed(profile_, rows_[i].force);
    world_.forces()[i]->add_force(state, f);
  }
}

void System::add_product(const State& state, StiffnessScale scale, ConstReals p, Reals out) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ForceModel& model = *world_.forces()[i];
    if (!model.has_stiffness()) continue;
    const Timed timed(profile_, rows_[i].product);
    model.add_product(state, scale, p, out);
  }
}

void System::assemble(const State& state, double mass, StiffnessScale scale) {
  const bool same = assembled_ && mass_scale_ == mass && scale_.position == scale.position &&
                    scale_.velocity == scale.velocity && scale_.definite == scale.definite;
  if (same && world_.is_linear()) return;
  {
    const Timed timed(profile_, mass_row_);
    matrix_.clear();
    if (mass != 0.0) world_.mass().add_to(matrix_, state, mass);
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ForceModel& model = *world_.forces()[i];
    if (!model.has_stiffness()) continue;
    const Timed timed(profile_, rows_[i].stiffness);
    model.add_stiffness(state, scale, matrix_);
  }
  matrix_.constrain(world_.fixed().rows(), world_.fixed().masks());
  assembled_ = true;
  mass_scale_ = mass;
  scale_ = scale;
}

double System::round_off(const State& state) const {
  double sum = 0.0;
  for (std::int32_t i = 0; i < matrix_.rows(); ++i) {
    sum += matrix_.diagonal_block(i)
               .diagonal()
               .cwiseProduct(block(ConstReals(state.positions), i))
               .squaredNorm();
  }
  return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

SolveReport System::solve(ConstReals b, Reals x, double floor) {
  if (solver_ == nullptr) throw ParameterError("this method solves systems: give it a linear solver.");
  const Timed timed(profile_, solve_row_);
  return solver_->solve(matrix_, b, x, floor);
}

}  // namespace tissu
