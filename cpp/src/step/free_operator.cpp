#include "tissu/step/free_operator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tissu {

FreeOperator::FreeOperator(const World& world) : world_(world), threads_(world.threads()) {
  set_given(&world.fixed().masks());
}

void FreeOperator::set(const State& state, double mass, StiffnessScale scale) {
  state_ = state;
  mass_ = mass;
  scale_ = scale;
  count_change();
  if (!world_.run_time().coupling.empty()) couple(state_);
}

void FreeOperator::couple(const State& state) {
  couplings_.clear();
  for (const ForceModel* model : world_.run_time().coupling) model->add_couplings(state, scale_, couplings_);
  couplings_.close(rows(), &world_.fixed().masks());
  set_couplings(couplings_.empty() ? nullptr : &couplings_);
}

void FreeOperator::multiply(ConstReals p, Reals out) const {
  multiply_models(p, out);
  if (couplings() != nullptr) couplings_.add_product(threads_, 1.0, p.data(), out.data());
}

/// The same without couplings, which leave given degrees of freedom out themselves.
void FreeOperator::multiply_models(ConstReals p, Reals out) const {
  const FixedDofs& fixed = world_.fixed();
  ConstReals x = p;
  if (!fixed.empty()) {
    free_.assign(p.begin(), p.end());
    fixed.clear(free_);
    x = free_;
  }
  std::ranges::fill(out, 0.0);
  if (mass_ != 0.0) world_.mass().add_product(state_, mass_, x, out);
  for (const auto& model : world_.forces()) {
    if (!model->has_stiffness() || model->run_time().couples) continue;
    model->add_product(state_, scratch_, scale_, x, out);
  }
  for (const std::int32_t row : fixed.rows()) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(3 * row + axis);
      if (is_given(row, axis)) out[i] = p[i];
    }
  }
}

int FreeOperator::colours() const {
  color();
  return colours_;
}

/// The smallest colour that no row of the pattern before has, row after row.
void FreeOperator::color() const {
  if (!color_.empty()) return;
  const Sparsity& pattern = world_.sparsity();
  color_.assign(static_cast<std::size_t>(rows()), -1);
  colours_ = 0;
  std::vector<std::int32_t> taken;  ///< the row that saw a colour last
  for (std::int32_t r = 0; r < rows(); ++r) {
    const auto see = [&](std::int32_t other) {
      const std::int32_t c = color_[static_cast<std::size_t>(other)];
      if (c >= 0) taken[static_cast<std::size_t>(c)] = r;
    };
    for (auto s = pattern.begin_of(r); s < pattern.end_of(r); ++s) {
      see(pattern.column[static_cast<std::size_t>(s)]);
    }
    std::int32_t c = 0;
    while (c < colours_ && taken[static_cast<std::size_t>(c)] == r) ++c;
    if (c == colours_) {
      ++colours_;
      taken.push_back(-1);
    }
    color_[static_cast<std::size_t>(r)] = c;
  }
}

void FreeOperator::diagonal_blocks(Reals blocks) const {
  color();
  const std::size_t size = state_.positions.size();
  unit_.resize(size);
  column_.resize(size);
  diagonal_.resize(size);
  for (int c = 0; c < colours_; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::ranges::fill(unit_, 0.0);
      for (std::size_t r = 0; r < color_.size(); ++r) {
        if (color_[r] == c) unit_[3 * r + axis] = 1.0;
      }
      multiply_models(unit_, column_);
      for (std::size_t r = 0; r < color_.size(); ++r) {
        if (color_[r] != c) continue;
        std::copy_n(column_.begin() + static_cast<std::ptrdiff_t>(3 * r), 3,
                    blocks.begin() + static_cast<std::ptrdiff_t>(9 * r + 3 * axis));
      }
    }
  }
  if (couplings() != nullptr) couplings_.add_diagonal(blocks);
  for (std::size_t i = 0; i < size; ++i) diagonal_[i] = blocks[9 * (i / 3) + 4 * (i % 3)];
}

double FreeOperator::round_off(ConstReals x) const {
  if (diagonal_.empty()) {
    std::vector<double> blocks(9 * static_cast<std::size_t>(rows()));
    diagonal_blocks(blocks);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += diagonal_[i] * x[i] * diagonal_[i] * x[i];
  return std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

std::size_t FreeOperator::bytes() const {
  const std::size_t numbers = state_.positions.size() + state_.velocities.size() + free_.size() +
                              unit_.size() + column_.size() + diagonal_.size();
  return numbers * sizeof(double) + color_.size() * sizeof(std::int32_t);
}

}  // namespace tissu
